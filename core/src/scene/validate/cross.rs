// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Checks of values that depend on one another. Each number on its own has been found in its range before.

use std::f64::consts::TAU;

use super::check::Check;
use crate::SceneError;
use crate::motion::{JOINED_COUNT, MotionConstants, Primitive};
use crate::scene::limits::{MAX_FALL_STEPS, MAX_PERIODS_PER_STEP, MAX_SCHEDULE_STEPS};
use crate::scene::nearest::nearest;
use crate::scene::{FlightModel, Release, Scene, Source, SourceShape, Species};

impl Scene {
    /// Species have names of their own, and every share names one of them, once.
    pub(super) fn check_species_names(&self, check: &Check<'_>) -> Result<(), SceneError> {
        for (index, species) in self.species.iter().enumerate() {
            let at = check.inside(format!("species[{index}]"));
            let free = self.species[..index].iter().all(|other| other.name != species.name);
            at.holds(!species.name.trim().is_empty() && free, "name", || {
                (format!("{:?}", species.name), "a name that no other species has".into())
            })?;
        }
        let names = || self.species.iter().map(|species| species.name.as_str());
        for (index, source) in self.sources.iter().enumerate() {
            let at = check.inside(format!("sources[{index}]"));
            for (index, share) in source.species.iter().enumerate() {
                let at = at.inside(format!("species[{index}]"));
                at.holds(names().any(|name| name == share.species), "species", || {
                    let all = names().collect::<Vec<_>>().join(", ");
                    let hint = nearest(&share.species, names());
                    let hint = hint.map(|name| format!(" (did you mean {name:?}?)")).unwrap_or_default();
                    (format!("{:?}", share.species), format!("a species of this scene: {all}{hint}"))
                })?;
                let first = source.species[..index].iter().all(|other| other.species != share.species);
                at.holds(first, "species", || {
                    (format!("{:?} again", share.species), "each species once per source".into())
                })?;
            }
        }
        Ok(())
    }

    /// Every primitive motion that a fall can reach leads on, and a draw from its row fits sixteen bits. The cone spiral needs none.
    pub(super) fn check_transitions(&self, check: &Check<'_>) -> Result<(), SceneError> {
        let joins = |species: &Species| species.start != Primitive::ConeSpiral;
        for (index, species) in self.species.iter().enumerate().filter(|(_, species)| joins(species)) {
            let rows = &species.transitions.0;
            let mut reached = [false; JOINED_COUNT];
            let mut open = vec![species.start as usize];
            while let Some(from) = open.pop() {
                if std::mem::replace(&mut reached[from], true) {
                    continue;
                }
                let total: u64 = rows[from].iter().copied().map(u64::from).sum();
                let row = format!("species[{index}].transitions[{from}]");
                check.holds((1..=65_535).contains(&total), &row, || {
                    let (found, code) = (&rows[from], Primitive::JOINED[from].code());
                    let allowed = format!("counts with a sum of 1 to 65535, for falls reach {code}");
                    (format!("{found:?} (sum {total})"), allowed)
                })?;
                open.extend((0..JOINED_COUNT).filter(|&to| rows[from][to] > 0));
            }
        }
        Ok(())
    }

    /// Every motion stays below a quarter period per step, also for the smallest and fastest leaf of a species, at the
    /// fastest that chaotic motion draws, and at the scene's rotation speed. Bodies in the air have no such motions.
    pub(super) fn check_rates(&self, check: &Check<'_>) -> Result<(), SceneError> {
        let is_synthesised = |species: &Species| species.flight == FlightModel::Synthesis;
        for (index, species) in self.species.iter().enumerate().filter(|(_, species)| is_synthesised(species))
        {
            let at = check.inside(format!("species[{index}].motion"));
            let (given, used) = (&species.motion, MotionConstants::of(species, self.gravity_m_s2));
            let leaf = (1.0 + f64::from(species.speed_variation)) / (1.0 - f64::from(species.size_variation));
            let speedup = leaf * (1.0 + used.chaos_jitter) * f64::from(self.rotation_speed.max(1.0));
            let fastest = MAX_PERIODS_PER_STEP * TAU / (f64::from(self.dt_s) * speedup);
            let winds = species.start == Primitive::ConeSpiral;
            let joined = [
                ("flutter_rad_s", given.flutter_rad_s, used.flutter_rad_s),
                ("tumble_rad_s", given.tumble_rad_s, used.tumble_rad_s),
                ("spiral_rad_s", given.spiral_rad_s, used.spiral_rad_s),
            ];
            let wound = [
                ("cone_rad_s", given.cone_rad_s, used.cone_rad_s),
                ("corner_swing_rad_s", given.corner_swing_rad_s, used.corner_swing_rad_s),
            ];
            for (name, given, rate) in joined.into_iter().chain(wound.into_iter().filter(|_| winds)) {
                at.holds(rate < fastest, name, || {
                    let origin = if given.is_some() { "" } else { " (from size and mass)" };
                    let allowed =
                        format!("below {fastest:.2} rad/s at dt_s {}, or a smaller dt_s", self.dt_s);
                    (format!("{rate:.2}{origin}"), allowed)
                })?;
            }
        }
        Ok(())
    }

    /// Leaves start at or above the ground, and not so high that the steps of a fall could not be counted.
    pub(super) fn check_heights(&self, check: &Check<'_>) -> Result<(), SceneError> {
        for (index, source) in self.sources.iter().enumerate() {
            let at = check.inside(format!("sources[{index}]"));
            let (lowest_m, highest_m) = source.shape.heights_m();
            // A hollow may be as deep as all hills are high.
            let relief_m = self.ground.terrain.map_or(0.0, |terrain| terrain.relief_m);
            let ground_m = f64::from(self.ground.height_m) - f64::from(relief_m);
            at.holds(lowest_m >= ground_m, "shape", || {
                let allowed = format!("at or above the ground at {ground_m} m");
                (format!("reaching down to {lowest_m} m"), allowed)
            })?;
            for species in self.species.iter().filter(|species| source.lets_go(species)) {
                let limit_m =
                    MAX_FALL_STEPS * f64::from(self.dt_s) * species.slowest_descent_m_s(self.gravity_m_s2);
                at.holds(highest_m - ground_m < limit_m, "shape", || {
                    let found = format!("reaching up to {} m above the ground", highest_m - ground_m);
                    let reason = format!("{MAX_FALL_STEPS} steps for a fall of {:?}", species.name);
                    (found, format!("below {limit_m:.1} m ({reason})"))
                })?;
            }
        }
        Ok(())
    }

    /// The last leaf of every source is released, and recycled for the first time, at a step that can be counted.
    pub(super) fn check_times(&self, check: &Check<'_>) -> Result<(), SceneError> {
        for (index, source) in self.sources.iter().enumerate() {
            let (field, last_s) = match source.release {
                Release::Burst { at_s } => ("release.at_s", f64::from(at_s)),
                Release::Rate { per_s, from_s } => {
                    ("release.per_s", f64::from(from_s) + f64::from(source.count) / f64::from(per_s))
                }
            };
            let end_s = last_s + source.recycle_after_s.map_or(0.0, f64::from);
            let limit_s = MAX_SCHEDULE_STEPS * f64::from(self.dt_s);
            let at = check.inside(format!("sources[{index}]"));
            at.holds(end_s < limit_s, field, || {
                let found = format!("such that the last of {} leaves ends after {end_s:.0} s", source.count);
                (found, format!("an end before {limit_s:.0} s"))
            })?;
        }
        Ok(())
    }
}

impl Source {
    /// Returns true if leaves of this species come from here.
    fn lets_go(&self, species: &Species) -> bool {
        self.species.is_empty() || self.species.iter().any(|share| share.species == species.name)
    }
}

impl SourceShape {
    /// Lowest and highest point in metres.
    fn heights_m(&self) -> (f64, f64) {
        let (center, half) = match *self {
            Self::Box { center_m, half_extent_m } => (center_m.y, half_extent_m.y),
            Self::Disc { center_m, .. } => (center_m.y, 0.0),
            Self::Sphere { center_m, radius_m } => (center_m.y, radius_m),
        };
        (f64::from(center) - f64::from(half), f64::from(center) + f64::from(half))
    }
}

impl Species {
    /// Mean descent speed of the slowest leaf of the species in m/s.
    fn slowest_descent_m_s(&self, gravity_m_s2: f32) -> f64 {
        MotionConstants::of(self, gravity_m_s2).descent_m_s * (1.0 - f64::from(self.speed_variation))
    }
}
