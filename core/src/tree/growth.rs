// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Growth in time: from the shoots of the full-grown tree to the tree at an age.
//!
//! A shoot is born when its step of the derivation comes and grows from nothing to its full length within
//! `GROWING_TIME`. With the growth function *g*, which rises from 0 to 1 in that time, its length goes with a power
//! of *g* that is the larger the more branches lie between it and the foot, and its pipes with a higher power: thick
//! branches come before thin ones. A shoot that is there at one age is there at every later one, and no length ever
//! shrinks.

use glam::DVec3;

use super::grammar::Settings;
use super::pipe::{self, Radii};
use super::turtle::Shoot;

/// Share of a tree's life in which one shoot grows.
const GROWING_TIME: f64 = 0.4;
/// Power of the growth function by which the length of the trunk grows, and what each branch on the way adds to it.
const LENGTH_POWERS: (f64, f64) = (1.0, 0.2);
/// Branches beyond this many add nothing to the power.
const MOST_ORDERS: u32 = 4;
/// Power of the growth function by which pipes grow.
const PIPE_POWER: f64 = 3.0;
/// Shortest shoot that is there, in metres; a smaller one is still a bud.
const BUD_M: f64 = 0.001;

/// A shoot of a tree at an age, in metres.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grown {
    /// Index among the shoots of the full-grown tree.
    pub(crate) shoot: usize,
    /// The segment that it grows from.
    pub(crate) parent: Option<usize>,
    pub(crate) start_m: DVec3,
    pub(crate) end_m: DVec3,
    pub(crate) length_m: f64,
    pub(crate) start_radius_m: f64,
    pub(crate) end_radius_m: f64,
    /// The growth function.
    pub(crate) growth: f64,
}

/// The growth function of a shoot at an age: 0 when it is born, 1 when it is full-grown.
fn growth(born: f64, age: f64) -> f64 {
    ((age - born * (1.0 - GROWING_TIME)) / GROWING_TIME).clamp(0.0, 1.0)
}

/// Height of the full-grown tree in the grammar's unit.
pub(crate) fn full_height(shoots: &[Shoot]) -> f64 {
    let mut tops: Vec<f64> = Vec::with_capacity(shoots.len());
    for shoot in shoots {
        tops.push(shoot.parent.map_or(0.0, |parent| tops[parent]) + shoot.direction.y * shoot.length);
    }
    tops.into_iter().fold(0.0, f64::max)
}

/// For each shoot, whether it is there at an age; `scale` is in metres per unit.
pub(crate) fn present(shoots: &[Shoot], scale: f64, age: f64) -> Vec<bool> {
    let mut present: Vec<bool> = Vec::with_capacity(shoots.len());
    for shoot in shoots {
        present.push(match shoot.parent {
            None => true,
            Some(parent) => present[parent] && length_m(shoot, scale, age) >= BUD_M,
        });
    }
    present
}

/// The tree at an age in its own frame; `scale` is in metres per unit.
pub(crate) fn grow(shoots: &[Shoot], settings: &Settings, scale: f64, age: f64) -> Vec<Grown> {
    let present = present(shoots, scale, age);
    let full = pipe::radii(shoots, |shoot| shoot.pipes, settings.pipe_exponent, |_| true);
    let factor = pipe::metres_per_unit(shoots, &full, settings.girth, scale);
    let pipes = |shoot: &Shoot| shoot.pipes * libm::pow(growth(shoot.born, age), PIPE_POWER);
    let radii = pipe::radii(shoots, pipes, settings.pipe_exponent, |index| present[index]);

    let mut grown: Vec<Grown> = Vec::new();
    let mut places = vec![0; shoots.len()];
    for (index, shoot) in shoots.iter().enumerate().filter(|&(index, _)| present[index]) {
        places[index] = grown.len();
        let parent = shoot.parent.map(|parent| places[parent]);
        let start_m = parent.map_or(DVec3::ZERO, |parent| grown[parent].end_m);
        let length_m = length_m(shoot, scale, age).max(BUD_M);
        let Radii { start, end } = radii[index];
        grown.push(Grown {
            shoot: index,
            parent,
            start_m,
            end_m: start_m + shoot.direction * length_m,
            length_m,
            start_radius_m: pipe::at_least_thin(start * factor),
            end_radius_m: pipe::at_least_thin(end * factor),
            growth: growth(shoot.born, age),
        });
    }
    grown
}

fn length_m(shoot: &Shoot, scale: f64, age: f64) -> f64 {
    let power = LENGTH_POWERS.0 + LENGTH_POWERS.1 * f64::from(shoot.order.min(MOST_ORDERS));
    shoot.length * scale * libm::pow(growth(shoot.born, age), power)
}
