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

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::scene::{Litter, Look, ParticleRelease, PlumeKey};

    /// Line with which a scene of burning leaves is refused after a change; empty if it is not.
    fn refused(change: impl FnOnce(&mut Scene)) -> String {
        let mut scene = Scene::default();
        scene.species[0].burns = Some(Burning::default());
        scene.sources[0].recycle_after_s = None;
        scene.ground.litter = Some(Litter::default());
        scene.wind.plumes = vec![Plume { keys: Vec::new(), fed_within_m: Some(1.0), ..Plume::default() }];
        let count = scene.leaf_count();
        scene.particles =
            vec![Particles { count, release: ParticleRelease::BurningLeaves, ..Particles::default() }];
        change(&mut scene);
        let line = scene.validate("a.ron").map_or_else(|error| error.to_string(), |()| String::new());
        assert_eq!(line.lines().count(), usize::from(!line.is_empty()), "one line: {line}");
        line
    }

    #[test]
    fn burning_scenes_are_checked_as_wholes() {
        assert_eq!(refused(|_| {}), "", "as it is");
        let still = refused(|scene| scene.ground.litter = Some(Litter { still: true, ..Litter::default() }));
        assert!(
            still.contains("species[0].burns") && still.contains("ground.litter that is not still"),
            "{still}"
        );
        let bare = refused(|scene| scene.ground.litter = None);
        assert!(bare.contains("species[0].burns"), "{bare}");
        let again = refused(|scene| scene.sources[0].recycle_after_s = Some(5.0));
        assert!(again.contains("sources[0].recycle_after_s is Some(5.0)"), "{again}");
        let grown = refused(|scene| scene.regrow_after_s = Some(5.0));
        assert!(grown.contains("regrow_after_s"), "{grown}");
        let many = refused(|scene| {
            scene.species = vec![scene.species[0].clone(); MAX_BURNING_SPECIES + 1];
        });
        assert!(many.contains("at most 8 species"), "{many}");
        let few = refused(|scene| scene.particles[0].count -= 1);
        assert!(few.contains("particles[0].count") && few.contains("one for each leaf"), "{few}");
        let cold = refused(|scene| scene.species[0].burns = None);
        assert!(cold.contains("wind.plumes[0].fed_within_m"), "{cold}");
        let both = refused(|scene| scene.wind.plumes[0].keys = vec![PlumeKey { time_s: 0.0, power_kw: 1.0 }]);
        assert!(both.contains("wind.plumes[0].keys"), "{both}");
        let cold = refused(|scene| {
            scene.species[0].burns = None;
            scene.wind.plumes.clear();
        });
        assert!(cold.contains("particles[0].release"), "{cold}");
        let flame = refused(|scene| {
            let from = ParticleShape::Feet { center_m: Vec3::ZERO, radius_m: 0.1, feet: 8 };
            let look = Look { kind: LookKind::Flame { samples: 8, shell: 1.0 }, ..Look::default() };
            scene.particles = vec![Particles { from, look, ..Particles::default() }];
        });
        assert!(flame.contains("Flame without a plume") && flame.contains("with keys"), "{flame}");
    }

    #[test]
    fn leaves_that_burn_state_a_heat_value() {
        let text =
            "(species: [(burns: Some(()))], sources: [(recycle_after_s: None)], ground: (litter: Some(())))";
        let scene = Scene::from_ron(text, "a.ron");
        let line = scene.and_then(|scene| scene.validate("a.ron")).expect_err("none is stated").to_string();
        assert!(
            line.contains("species[0].burns.heat_mj_kg is 0") && line.contains("5 to 30 MJ/kg"),
            "{line}"
        );
        let turned = refused(|scene| {
            scene.species[0].burns = Some(Burning { ignition_c: (400.0, 300.0), ..Burning::default() });
        });
        assert!(turned.contains("ignition_c") && turned.contains("rising order"), "{turned}");
    }
}
