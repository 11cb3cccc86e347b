// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws a string of modules: a turtle walks in three dimensions and leaves shoots behind.
//!
//! # Source
//! P. Prusinkiewicz and A. Lindenmayer, "The Algorithmic Beauty of Plants" (1990), sections 1.5 and 2.3.

use glam::DVec3;

use super::grammar::{Command, Derivation, GrammarError, Module, Settings};
use super::skeleton::MAX_SEGMENTS;

/// Most branches inside one another.
pub const MAX_BRANCH_DEPTH: usize = 256;
/// Shortest segment in the grammar's unit; shorter ones are passed without a segment.
const SHORTEST: f64 = 1e-9;
/// Longest segment, most leaves, fruit and pipes in a grammar's own unit: beyond this sums would lose their small parts.
const LARGEST: f64 = 1e6;
/// Farthest that axes may be from unit vectors at a right angle.
const MOST_OFF: f64 = 1e-9;

/// A segment of the full-grown tree, in the grammar's unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shoot {
    /// The shoot that it grows from, an earlier one.
    pub(crate) parent: Option<usize>,
    /// Unit vector along it.
    pub(crate) direction: DVec3,
    pub(crate) length: f64,
    /// Pipes that begin in it.
    pub(crate) pipes: f64,
    /// Share of the tree's steps that have passed when it is born, 0 to 1.
    pub(crate) born: f64,
    /// Branches passed on the way here.
    pub(crate) order: u32,
    /// Leaves for its length, compared with others.
    pub(crate) leaves: f64,
    /// Number of fruit at its end.
    pub(crate) fruit: f64,
}

#[derive(Clone, Copy)]
struct Turtle {
    heading: DVec3,
    left: DVec3,
    last: Option<usize>,
    order: u32,
    pull: f64,
    pull_to: DVec3,
}

impl Turtle {
    fn up(&self) -> DVec3 {
        self.heading.cross(self.left)
    }

    fn yaw(&mut self, radians: f64) {
        let up = self.up();
        self.heading = rotated(self.heading, up, radians);
        self.left = rotated(self.left, up, radians);
        self.square();
    }

    fn pitch(&mut self, radians: f64) {
        self.heading = rotated(self.heading, self.left, radians);
        self.square();
    }

    fn roll(&mut self, radians: f64) {
        self.left = rotated(self.left, self.heading, radians);
        self.square();
    }

    /// Sets the axes right once rounding has put them off: each turns about the other, and the error would grow without end.
    fn square(&mut self) {
        let lengths = [self.heading, self.left].map(|axis| (axis.length_squared() - 1.0).abs());
        if lengths[0].max(lengths[1]).max(self.heading.dot(self.left).abs()) > MOST_OFF {
            self.heading = self.heading.normalize();
            self.left = self.left.reject_from_normalized(self.heading).normalize();
        }
    }

    /// Rolls until left and right are level; a turtle that heads straight up or down is level anyhow.
    fn level(&mut self) {
        let left = DVec3::Y.cross(self.heading);
        if left.length() > 1e-6 {
            self.left = left.normalize();
        }
    }

    /// Bends by `pull` times the sine of the angle between the heading and the pull, at most as far as the pull.
    fn bend(&mut self) {
        let across = self.heading.cross(self.pull_to);
        let sine = across.length();
        if sine < 1e-9 {
            return;
        }
        let axis = across / sine;
        let whole = libm::atan2(sine, self.heading.dot(self.pull_to));
        let radians = (self.pull * sine).clamp(whole - std::f64::consts::PI, whole);
        self.heading = rotated(self.heading, axis, radians).normalize();
        self.left = rotated(self.left, axis, radians);
        self.left = (self.left - self.heading * self.left.dot(self.heading)).normalize();
    }
}

/// `vector` turned about the unit vector `axis`.
pub(crate) fn rotated(vector: DVec3, axis: DVec3, radians: f64) -> DVec3 {
    let (sin, cos) = libm::sincos(radians);
    vector * cos + axis.cross(vector) * sin + axis * (axis.dot(vector) * (1.0 - cos))
}

/// The shoots that a string of modules draws, each after its parent.
///
/// # Errors
/// [`GrammarError`] for numbers that no segment, leaf or fruit can have, and for too many of them.
pub(crate) fn draw(derivation: &Derivation, settings: &Settings) -> Result<Vec<Shoot>, GrammarError> {
    let mut shoots: Vec<Shoot> = Vec::new();
    let mut stack: Vec<Turtle> = Vec::new();
    let mut turtle =
        Turtle { heading: DVec3::Y, left: DVec3::NEG_X, last: None, order: 0, pull: 0.0, pull_to: DVec3::Y };
    let limit = |what, reached, limit| GrammarError::Limit {
        step: derivation.steps,
        steps: settings.iterations,
        what,
        reached,
        limit,
    };
    for module in &derivation.modules {
        let Some(&command) = Command::ALL.get(module.symbol) else { continue };
        let arguments = derivation.arguments(module);
        let argument = |index: usize, otherwise: f64| arguments.get(index).copied().unwrap_or(otherwise);
        let radians = argument(0, settings.angle_deg).to_radians();
        match command {
            Command::Forward => {
                let length = amount(module, "a length", argument(0, 1.0))?;
                let pipes = amount(module, "a number of pipes", argument(1, length))?;
                if length < SHORTEST {
                    continue;
                }
                let parent = turtle.last;
                if parent.is_none() && !shoots.is_empty() {
                    let allowed =
                        "one segment from the foot; several stems branch from the end of a short one";
                    return Err(GrammarError::text(module.at, "a second segment from the foot", allowed));
                }
                turtle.bend();
                let born = f64::from(module.born) / f64::from(derivation.steps.max(1));
                let (direction, order) = (turtle.heading, turtle.order);
                shoots.push(Shoot { parent, direction, length, pipes, born, order, leaves: 0.0, fruit: 0.0 });
                turtle.last = Some(shoots.len() - 1);
                if shoots.len() > MAX_SEGMENTS {
                    return Err(limit("segments", shoots.len(), MAX_SEGMENTS));
                }
            }
            Command::Leaves | Command::Fruit => {
                let value = amount(module, "a number of leaves or fruit", argument(0, 1.0))?;
                let Some(last) = turtle.last else {
                    let allowed = "`L` and `K` behind the `F` that bears them";
                    return Err(GrammarError::text(module.at, "leaves or fruit before any segment", allowed));
                };
                let shoot = &mut shoots[last];
                let sum = if command == Command::Leaves { &mut shoot.leaves } else { &mut shoot.fruit };
                *sum = (*sum + value).min(LARGEST);
            }
            Command::Tropism => {
                let pull_to = DVec3::new(argument(1, 0.0), argument(2, 1.0), argument(3, 0.0));
                let length = pull_to.length();
                if !(length >= SHORTEST && length.is_finite()) {
                    let found =
                        format!("a pull towards ({})", pull_to.to_array().map(|x| x.to_string()).join(", "));
                    return Err(GrammarError::text(module.at, found, "a direction"));
                }
                turtle.pull = argument(0, 0.0);
                turtle.pull_to = pull_to / length;
            }
            Command::Left => turtle.yaw(radians),
            Command::Right => turtle.yaw(-radians),
            Command::Down => turtle.pitch(radians),
            Command::Up => turtle.pitch(-radians),
            Command::RollLeft => turtle.roll(radians),
            Command::RollRight => turtle.roll(-radians),
            Command::Around => turtle.yaw(std::f64::consts::PI),
            Command::Level => turtle.level(),
            Command::Push => {
                stack.push(turtle);
                turtle.order += 1;
                if stack.len() > MAX_BRANCH_DEPTH {
                    return Err(limit("branches inside one another", stack.len(), MAX_BRANCH_DEPTH));
                }
            }
            Command::Pop => {
                turtle = stack.pop().expect("brackets are balanced in the axiom and all successors")
            }
        }
    }
    Ok(shoots)
}

/// A number from 0 to [`LARGEST`].
fn amount(module: &Module, what: &str, value: f64) -> Result<f64, GrammarError> {
    if (0.0..=LARGEST).contains(&value) {
        return Ok(value);
    }
    Err(GrammarError::text(module.at, format!("{what} of {value}"), format!("0 to {LARGEST}")))
}
