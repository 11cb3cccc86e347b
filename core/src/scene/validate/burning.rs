// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Checks burning leaves: their species, the litter that they burn in, the fires that they feed and the particles that are where they burn.

use super::check::Check;
use crate::SceneError;
use crate::scene::{Burning, LookKind, MAX_BURNING_SPECIES, ParticleShape, Particles, Plume, Scene, limits};

impl Burning {
    pub(super) fn check(&self, at: &Check<'_>) -> Result<(), SceneError> {
        at.numbers([
            ("heat_mj_kg", self.heat_mj_kg.into(), limits::HEAT_MJ_KG),
            ("ignition_c.0", self.ignition_c.0.into(), limits::IGNITION_C),
            ("ignition_c.1", self.ignition_c.1.into(), limits::IGNITION_C),
            ("front_mm_s", self.front_mm_s.into(), limits::FRONT_MM_S),
            ("ash", self.ash.into(), limits::ASH),
        ])?;
        at.holds(self.ignition_c.0 <= self.ignition_c.1, "ignition_c", || {
            (format!("{:?}", self.ignition_c), "two temperatures in rising order".into())
        })
    }
}

impl Scene {
    /// Checks what burning leaves ask of the rest of the scene.
    pub(super) fn check_burning(&self, check: &Check<'_>) -> Result<(), SceneError> {
        for (index, plume) in self.wind.plumes.iter().enumerate() {
            let at = check.inside(format!("wind.plumes[{index}]"));
            at.holds(plume.fed_within_m.is_none() || self.leaves_burn(), "fed_within_m", || {
                (format!("{:?}", plume.fed_within_m), "None, where no species burns".into())
            })?;
        }
        for (index, particles) in self.particles.iter().enumerate() {
            let at = check.inside(format!("particles[{index}]"));
            self.check_on_leaves(particles, &at)?;
            self.check_fire_beneath(particles, &at)?;
        }
        let Some(index) = self.species.iter().position(|species| species.burns.is_some()) else {
            return Ok(());
        };
        let at = check.inside(format!("species[{index}]"));
        at.holds(self.species.len() <= MAX_BURNING_SPECIES, "burns", || {
            let found = format!("stated, in a scene of {} species", self.species.len());
            (found, format!("at most {MAX_BURNING_SPECIES} species where leaves burn"))
        })?;
        at.holds(self.ground.litter.is_some_and(|litter| !litter.still), "burns", || {
            ("stated, without litter that moves".into(), "None, or ground.litter that is not still".into())
        })?;
        for (index, source) in self.sources.iter().enumerate() {
            let at = check.inside(format!("sources[{index}]"));
            at.holds(source.recycle_after_s.is_none(), "recycle_after_s", || {
                (format!("{:?}", source.recycle_after_s), "None, where leaves burn".into())
            })?;
        }
        check.holds(self.regrow_after_s.is_none(), "regrow_after_s", || {
            (format!("{:?}", self.regrow_after_s), "None, where leaves burn".into())
        })
    }

    /// Checks particles that are where leaves burn: one for each leaf.
    fn check_on_leaves(&self, particles: &Particles, at: &Check<'_>) -> Result<(), SceneError> {
        if !particles.is_on_leaves() {
            return Ok(());
        }
        at.holds(self.leaves_burn(), "release", || {
            ("BurningLeaves".into(), "Burst, Rate or Poisson, where no species burns".into())
        })?;
        at.holds(particles.count == self.leaf_count(), "count", || {
            (particles.count.to_string(), format!("{}, one for each leaf of the scene", self.leaf_count()))
        })
    }

    /// Checks that a flame stands on the fire of a plume.
    fn check_fire_beneath(&self, particles: &Particles, at: &Check<'_>) -> Result<(), SceneError> {
        let (LookKind::Flame { .. }, ParticleShape::Feet { center_m, radius_m, .. }) =
            (particles.look.kind, particles.from)
        else {
            return Ok(());
        };
        let is_beneath = |plume: &&Plume| {
            let reach_m = plume.base_radius_m + radius_m;
            plume.fed_within_m.is_none() && plume.at_m.distance(center_m) <= reach_m
        };
        at.holds(self.wind.plumes.iter().any(|plume| is_beneath(&plume)), "look.kind", || {
            let allowed = "something else, unless a plume with keys rises from its feet";
            ("Flame without a plume".into(), allowed.into())
        })
    }
}
