// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Scenes that repeat after so many steps, to the bit for leaves, for clips without a seam.
//!
//! Wind: gusts and turbulence of a period that divides the cycle, carried at the speed of the mean wind by whole
//! periods. Leaves: a source lets go the same leaves in every cycle, and each of them comes down over several; its slot
//! is then released again as the same leaf. What is in the air at a moment is the same as a cycle later, of other slots.
//! Particles: populations bear the same particles in every cycle, as many as their rate gives in one, and their children with them.
//! Trees: petioles hold, flutter fits the cycle, and damping brings segments to the motion that the wind repeats.

use super::births::reaches_s;
use super::block::FLUTTER_HZ;
use crate::SceneError;
use crate::clock::Clock;
use crate::convert::single;
use crate::device::leaf::record::leaf_appearance;
use crate::device::wind::gust::{GUST_ROWS, GUST_SPACING};
use crate::device::wind::turbulence::TURBULENCE_X;
use crate::layout::Uint4;
use crate::leaf::{Identity, Leaves, Place, Schedule};
use crate::scene::{ForceKind, ObjectMotion, ParticleRelease, Release, Scene, limits};

/// Seconds in which trees come to repeat what the wind does: ten times what the slowest sway takes to fade e-fold.
const TREES_SETTLE_S: f64 = 120.0;
/// Petioles sample the wind every so many steps.
const STEP_GRID: u32 = 8;
/// Shortest cycle in seconds, and the shortest with trees, whose leaves would flutter too fast.
const SHORTEST_S: [f64; 2] = [1.0, 6.0];
/// Longest cycle in seconds.
const LONGEST_S: f64 = 120.0;
/// Least cells of turbulence that the wind carries past in a cycle.
const FEWEST_CELLS: u32 = 8;

/// The rhythm of a scene that repeats.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cycle {
    /// Steps after which everything repeats.
    pub steps: u32,
    /// Steps from time zero until it does, a multiple of the cycle's.
    pub run_in: u32,
    /// Rows of the gust table that pass in a cycle.
    pub(super) gust_rows: u32,
    /// Cells of the turbulence box that pass in a cycle.
    pub(super) cells: u32,
    /// Leaves that each source lets go in a cycle, and cycles until a slot is released again; of sources that let go
    /// nothing any more, none.
    sources: Vec<Option<(u32, u32)>>,
    /// Particles that each population bears in a cycle, those that are born of others left out of account.
    births: Vec<u32>,
}

impl Cycle {
    /// Field that errors of a length name.
    pub const LENGTH: &str = "cycle length";

    /// The cycle of about `seconds` of a scene, and the scene as it must be for that: sources let go as many leaves a
    /// second as they do on average, evenly, gusts and cells of turbulence are a little longer or shorter.
    ///
    /// # Errors
    /// [`SceneError::Field`] for what cannot repeat: leaves let go once, vortices that travel, jets that move or change, plumes of changing power,
    /// objects that move, those who walk, particles that are born all at once or at random, whose forces sum up over slots, that need several
    /// rounds of slots, or whose ways are sampled in another rhythm. Pictures of a scene may have more
    /// that does not, such as a camera that travels.
    pub fn of(scene: &Scene, file: &str, seconds: f64) -> Result<(Scene, Self), SceneError> {
        let refuse = |field: String, value: String, allowed: &str| {
            Err(SceneError::Field {
                file: file.into(),
                field,
                value,
                allowed: format!("{allowed} in a loop"),
            })
        };
        let shortest = SHORTEST_S[usize::from(scene.tree_leaf_count() > 0)];
        if !(shortest..=LONGEST_S).contains(&seconds) {
            let allowed = format!("{shortest} to {LONGEST_S} s for this scene");
            return refuse(Self::LENGTH.into(), seconds.to_string(), &allowed);
        }
        for (index, vortex) in scene.wind.vortices.iter().enumerate() {
            if vortex.drift_m_s != glam::Vec3::ZERO {
                let field = format!("wind.vortices[{index}].drift_m_s");
                return refuse(field, vortex.drift_m_s.to_string(), "vortices that stay where they are");
            }
        }
        for (index, jet) in scene.wind.jets.iter().enumerate() {
            if !jet.is_steady() {
                let field = format!("wind.jets[{index}].keys");
                let value = format!("{} that differ", jet.keys.len());
                return refuse(field, value, "jets that stay as they are");
            }
        }
        for (index, plume) in scene.wind.plumes.iter().enumerate() {
            if !plume.is_steady() {
                let field = format!("wind.plumes[{index}].keys");
                let value = format!("{} that differ", plume.keys.len());
                return refuse(field, value, "plumes of a power that stays");
            }
        }
        if scene.weather.is_some() {
            return refuse("weather".into(), "Some".into(), "None, for snow has a memory,");
        }
        for (index, object) in scene.objects.iter().enumerate() {
            if object.motion != ObjectMotion::Still {
                let field = format!("objects[{index}].motion");
                return refuse(field, "a path".into(), "Still");
            }
        }
        if !scene.walkers.is_empty() {
            let value = format!("a list of {}", scene.walkers.len());
            return refuse("walkers".into(), value, "nobody who walks");
        }
        for (index, force) in scene.forces.iter().enumerate() {
            if matches!(force.of, ForceKind::Mutual { .. }) {
                let allowed = "no attraction of particles by one another";
                return refuse(format!("forces[{index}].of"), "Mutual".into(), allowed);
            }
            if force.carried_by.is_some() {
                return refuse(format!("forces[{index}].carried_by"), "Some".into(), "None");
            }
        }
        for (index, particles) in scene.particles.iter().enumerate() {
            let at = |field: &str| format!("particles[{index}].{field}");
            if let Some(nest) = &particles.nest {
                let parents = scene.particles.iter().find(|parents| parents.name == nest.of);
                let events = parents.map_or(0, |parents| parents.count.saturating_mul(nest.fan));
                if particles.count != events {
                    let allowed = format!("{events}: slots for one event of each parent");
                    return refuse(at("count"), particles.count.to_string(), &allowed);
                }
            } else if !matches!(particles.release, ParticleRelease::Rate { .. }) {
                let value = match particles.release {
                    ParticleRelease::Burst { .. } => "Burst",
                    ParticleRelease::BurningLeaves => "BurningLeaves",
                    ParticleRelease::BranchSnow => "BranchSnow",
                    ParticleRelease::Snowfall => "Snowfall",
                    _ => "Poisson",
                };
                let allowed = "Rate: particles born evenly one after another";
                return refuse(at("release"), value.into(), allowed);
            }
        }
        if scene.ground.litter.is_some_and(|litter| !litter.still) {
            let allowed = "true, for what leaves do to each other has a memory,";
            return refuse("ground.litter.still".into(), "false".into(), allowed);
        }
        let mut looped = scene.clone();
        looped.regrow_after_s = None;
        let dt = f64::from(scene.dt_s);
        let steps = round(seconds / dt / f64::from(STEP_GRID)).max(1) * STEP_GRID;
        let length_s = f64::from(steps) * dt;
        for (index, particles) in scene.particles.iter().enumerate() {
            if let Some(history) = particles.history
                && !steps.is_multiple_of(history.every_steps)
            {
                let field = format!("particles[{index}].history.every_steps");
                return refuse(
                    field,
                    history.every_steps.to_string(),
                    &format!("a divisor of its {steps} steps"),
                );
            }
        }
        let mut sources = Vec::with_capacity(scene.sources.len());
        let mut longest = 1;
        for (index, source) in looped.sources.iter_mut().enumerate() {
            let Some(life_s) = source.recycle_after_s.map(f64::from) else {
                let last_s = match source.release {
                    Release::Burst { at_s } => f64::from(at_s),
                    Release::Rate { per_s, from_s } => {
                        f64::from(from_s) + f64::from(source.count - 1) / f64::from(per_s)
                    }
                };
                if last_s > 0.0 {
                    let allowed = "a time, or releases that end before time zero,";
                    return refuse(format!("sources[{index}].recycle_after_s"), "None".into(), allowed);
                }
                sources.push(None);
                continue;
            };
            if matches!(source.release, Release::Burst { .. }) {
                let allowed = "Rate: leaves let go one after another";
                return refuse(format!("sources[{index}].release"), "Burst".into(), allowed);
            }
            let each = round(f64::from(source.count) * length_s / life_s).max(1);
            let cycles = ceil(life_s / length_s).max(1);
            longest = longest.max(cycles);
            source.count = each.saturating_mul(cycles);
            source.recycle_after_s = Some(single(f64::from(cycles * steps) * dt));
            source.release = Release::Rate {
                per_s: single(f64::from(each) / length_s).max(limits::PER_S.low),
                from_s: 0.0,
            };
            sources.push(Some((each, cycles)));
        }
        let mut births = Vec::with_capacity(scene.particles.len());
        let reach_s = reaches_s(scene).into_iter().fold(0.0, f64::max);
        for particles in &mut looped.particles {
            let mut each = 0;
            if let (None, ParticleRelease::Rate { per_s, from_s }) = (&particles.nest, &mut particles.release)
            {
                each = whole(f64::from(*per_s) * length_s).max(1);
                *per_s = single(f64::from(each) / length_s);
                *from_s = 0.0;
            }
            births.push(each);
            if let Some(blink_s) = &mut particles.look.blink_s {
                let blinks = round(length_s / f64::from(*blink_s)).max(1);
                *blink_s = single(length_s / f64::from(blinks));
            }
        }
        longest = longest.max(ceil(reach_s / length_s));
        let way_m = scene.wind.speed.metres_per_second() * length_s;
        let gusts = periods(length_s / f64::from(scene.wind.gusts.interval_s), 1, GUST_ROWS / GUST_SPACING);
        let (mut gust_rows, mut cells) = (0, 0);
        let interval_s = single(length_s / f64::from(gusts));
        if way_m > 0.0 && limits::INTERVAL_S.contains(interval_s) {
            looped.wind.gusts.interval_s = interval_s;
            gust_rows = gusts * GUST_SPACING;
        } else {
            looped.wind.gusts.strength = 0.0;
        }
        let passing = periods(way_m / f64::from(scene.wind.turbulence.cell_m), FEWEST_CELLS, TURBULENCE_X);
        let cell_m = single(way_m / f64::from(passing));
        // In air that hardly moves turbulence stands still.
        if limits::CELL_M.contains(cell_m) {
            looped.wind.turbulence.cell_m = cell_m;
            cells = passing;
        }
        let run_in =
            if scene.trees.is_empty() { longest } else { longest.max(ceil(TREES_SETTLE_S / length_s)) };
        looped.validate(file)?;
        Ok((looped, Self { steps, run_in: run_in * steps, gust_rows, cells, sources, births }))
    }

    /// Particles that each population bears in a cycle, and the steps of one.
    pub(super) fn births(&self) -> (&[u32], u32) {
        (&self.births, self.steps)
    }

    /// Gusts after which those of the table repeat.
    pub(super) fn gusts(&self) -> u32 {
        period(self.gust_rows / GUST_SPACING, GUST_ROWS / GUST_SPACING)
    }

    /// Cells after which those of the turbulence box repeat.
    pub(super) fn cell_period(&self) -> u32 {
        period(self.cells, TURBULENCE_X)
    }

    /// Share of the cycle that has passed so many steps after a step.
    pub(super) fn share(&self, step: u32, after: f64) -> f64 {
        (f64::from(step % self.steps) + after) / f64::from(self.steps)
    }

    /// Rate per second of what repeats about so often, a whole number of times in a cycle, and how often it has so many steps after that of a clock.
    pub(super) fn repeated(&self, per_s: f64, clock: &Clock, after: f64) -> (f64, f64) {
        let length_s = f64::from(self.steps) * f64::from(clock.dt_s());
        let each = f64::from(round(per_s * length_s).max(1));
        (each / length_s, self.share(clock.step(), after) * each)
    }

    /// Rate of a fluttering leaf in 2^-32 turns a step: as near to the usual as a whole number of turns in a cycle
    /// allows to every leaf, the fastest of which flutter by half faster in steps of 1/32.
    pub(super) fn flutter(&self, dt_s: f32) -> u32 {
        let turns = round(f64::from(FLUTTER_HZ) * f64::from(self.steps) * f64::from(dt_s) / 32.0).max(1);
        32 * round(f64::from(turns) * 4_294_967_296.0 / f64::from(self.steps))
    }

    /// Makes all slots of the sources wait for their releases: the same leaves in every cycle, in slots of their own.
    pub(crate) fn schedule(&self, scene: &Scene, leaves: &mut Leaves) {
        let mut first = scene.tree_leaf_count();
        for (index, (source, rhythm)) in (0u32..).zip(scene.sources.iter().zip(&self.sources)) {
            if let &Some((each, _)) = rhythm {
                for place in 0..source.count {
                    let slot = (first + place) as usize;
                    let (cycle, leaf) = (place / each, place % each);
                    let within = u64::from(leaf) * u64::from(self.steps) / u64::from(each);
                    #[expect(clippy::cast_possible_truncation, reason = "within the steps of a cycle")]
                    let event = 1 + within as u32 + cycle * self.steps;
                    leaves.place[slot] = Place::default();
                    leaves.drift[slot] = Default::default();
                    leaves.attitude[slot] = Default::default();
                    leaves.air[slot] = Default::default();
                    leaves.schedule[slot] = Schedule { event, ..Schedule::default() };
                    leaves.identity[slot] = Identity {
                        id: first + leaf,
                        appearance: leaf_appearance(0, 0, index),
                        ..Identity::default()
                    };
                }
            }
            first += source.count;
        }
    }
}

/// Rows of petioles that never break.
pub(super) fn firm(chances: &mut [Uint4]) {
    chances.fill(Uint4::default());
}

/// The number nearest to `natural` (by ratio) that is a power of two up to `table`, or so many tables.
fn periods(natural: f64, fewest: u32, table: u32) -> u32 {
    if natural >= f64::from(table) {
        return round(natural / f64::from(table)) * table;
    }
    let power = round(libm::log2(natural.max(1.0)));
    (1 << power).clamp(fewest, table)
}

/// After how many of a table a pattern repeats of which `passing` pass in a cycle; a still one fills the table.
fn period(passing: u32, table: u32) -> u32 {
    if passing == 0 { table } else { passing.min(table) }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "positive, saturating")]
fn round(value: f64) -> u32 {
    libm::floor(value + 0.5) as u32
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "positive, saturating")]
fn whole(value: f64) -> u32 {
    libm::floor(value + 1e-6) as u32
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "positive, saturating")]
fn ceil(value: f64) -> u32 {
    libm::ceil(value - 1e-6) as u32
}
