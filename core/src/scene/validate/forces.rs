// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Checks forces on particles: their numbers, what carries them, and that they act on what feels them.

use super::check::Check;
use super::particle_look::check_curve;
use super::particles::check_axis;
use crate::SceneError;
use crate::scene::limits;
use crate::scene::{
    Air, Force, ForceKind, MAX_CARRIERS, MAX_FORCES, MAX_MUTUAL, Particles, Scene, SwirlProfile,
};

impl Scene {
    /// Checks forces, what carries them, and that populations feel what acts on them.
    pub(super) fn check_forces(&self, check: &Check<'_>) -> Result<(), SceneError> {
        check.length("forces", self.forces.len(), 0, MAX_FORCES)?;
        for (index, force) in self.forces.iter().enumerate() {
            let at = check.inside(format!("forces[{index}]"));
            force.check(&at)?;
            at.holds(self.forces[..index].iter().all(|other| other.name != force.name), "name", || {
                (format!("{:?} again", force.name), "a name of its own".into())
            })?;
            self.check_carriers(force, &at)?;
            let is_felt = |particles: &Particles| particles.feels.contains(&force.name);
            at.holds(self.particles.iter().any(is_felt), "name", || {
                (format!("{:?}, which acts on nothing", force.name), "one that particles feel".into())
            })?;
        }
        for (index, particles) in self.particles.iter().enumerate() {
            self.check_feels(particles, &check.inside(format!("particles[{index}]")))?;
        }
        Ok(())
    }

    /// Checks the particles that carry a force.
    fn check_carriers(&self, force: &Force, at: &Check<'_>) -> Result<(), SceneError> {
        let Some(carriers) = &force.carried_by else { return Ok(()) };
        let has_place = matches!(force.of, ForceKind::Attract { .. } | ForceKind::Swirl { .. });
        at.holds(has_place, "carried_by", || {
            ("of a force without a place".into(), "None, unless it is Attract or Swirl".into())
        })?;
        let at = at.inside("carried_by");
        let Some(population) = self.particles.iter().find(|one| one.name == carriers.of) else {
            let names: Vec<_> = self.particles.iter().map(|one| one.name.as_str()).collect();
            return Err(at.error("of", format!("{:?}", carriers.of), format!("one of {names:?}")));
        };
        at.holds(population.count <= MAX_CARRIERS, "of", || {
            let found = format!("{:?} of {} slots", carriers.of, population.count);
            (found, format!("a population of at most {MAX_CARRIERS} slots"))
        })?;
        check_curve(&carriers.strength, "strength", &at, |at, strength| {
            at.numbers([("strength", strength.into(), limits::CARRIED_STRENGTH)])
        })
    }

    /// Checks the forces that a population feels: that they are there, once each, and act on it.
    fn check_feels(&self, particles: &Particles, at: &Check<'_>) -> Result<(), SceneError> {
        for (index, name) in particles.feels.iter().enumerate() {
            let field = format!("feels[{index}]");
            let Some(force) = self.forces.iter().find(|force| force.name == *name) else {
                let names: Vec<_> = self.forces.iter().map(|force| force.name.as_str()).collect();
                return Err(at.error(&field, format!("{name:?}"), format!("one of the forces {names:?}")));
            };
            at.holds(!particles.feels[..index].contains(name), &field, || {
                (format!("{name:?} again"), "each force once".into())
            })?;
            let is_lorentz = matches!(force.of, ForceKind::Lorentz { .. });
            at.holds(!is_lorentz || particles.charge_c_kg != 0.0, &field, || {
                (format!("{name:?}, which acts on charges"), "a charge_c_kg other than zero with it".into())
            })?;
            if matches!(force.of, ForceKind::Mutual { .. }) {
                at.holds(particles.count <= MAX_MUTUAL, "count", || {
                    (particles.count.to_string(), format!("at most {MAX_MUTUAL} that attract one another"))
                })?;
                let first_s = self.ancestor(particles).first_birth_s();
                let of_first = if particles.nest.is_none() { "release.from_s" } else { "nest.of" };
                at.holds(first_s >= 0.0, of_first, || {
                    let found = format!("with the first birth at {first_s} s");
                    (found, "0 or later, where particles attract one another".into())
                })?;
                let kinds = particles.feels[..index].iter().filter_map(|name| {
                    self.forces.iter().find(|force| force.name == *name).map(|force| force.of)
                });
                let is_first = !kinds.into_iter().any(|kind| matches!(kind, ForceKind::Mutual { .. }));
                at.holds(is_first, &field, || (format!("{name:?}"), "one Mutual force at most".into()))?;
            }
            let is_swirl = matches!(force.of, ForceKind::Swirl { .. });
            at.holds(is_swirl || particles.air != Air::Massless, &field, || {
                (format!("{name:?}, which acts on a mass"), "Swirl alone, where air is Massless".into())
            })?;
        }
        Ok(())
    }
}

impl Force {
    fn check(&self, at: &Check<'_>) -> Result<(), SceneError> {
        at.holds(!self.name.is_empty(), "name", || ("\"\"".into(), "a name".into()))?;
        let at = &at.inside("of");
        match self.of {
            ForceKind::Attract { at_m, gm_m3_s2, softening_m } => {
                at.vector("at_m", at_m, limits::FORCE_AT_M)?;
                at.numbers([
                    ("gm_m3_s2", gm_m3_s2.into(), limits::GM_M3_S2),
                    ("softening_m", softening_m.into(), limits::SOFTENING_M),
                ])
            }
            ForceKind::Mutual { gm_m3_s2, softening_m } => at.numbers([
                ("gm_m3_s2", gm_m3_s2.into(), limits::GM_M3_S2),
                ("softening_m", softening_m.into(), limits::SOFTENING_M),
            ]),
            ForceKind::Noise { m_s2, cell_m } => at.numbers([
                ("m_s2", m_s2.into(), limits::NOISE_M_S2),
                ("cell_m", cell_m.into(), limits::CELL_M),
            ]),
            ForceKind::Lorentz { b_t, e_v_m } => {
                at.vector("b_t", b_t, limits::B_T)?;
                at.vector("e_v_m", e_v_m, limits::E_V_M)
            }
            ForceKind::Spiral { rad_s, axis } => {
                at.numbers([("rad_s", rad_s.into(), limits::FORCE_RAD_S)])?;
                check_axis(axis, at)
            }
            ForceKind::Swirl { at_m, axis, rate_rad_s, swirl_radius_m, profile } => {
                at.vector("at_m", at_m, limits::FORCE_AT_M)?;
                check_axis(axis, at)?;
                at.numbers([
                    ("rate_rad_s", rate_rad_s.into(), limits::FORCE_RAD_S),
                    ("swirl_radius_m", swirl_radius_m.into(), limits::SOFTENING_M),
                ])?;
                let at = at.inside("profile");
                match profile {
                    SwirlProfile::Power { alpha } => at.numbers([("alpha", alpha.into(), limits::ALPHA)]),
                    SwirlProfile::Compact { d } => at.numbers([("d", d.into(), limits::SWIRL_D)]),
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{ForceCarriers, ParticleRelease};

    /// The line that refuses a scene in which a population carries a force, changed; empty if nothing does.
    fn refused(change: impl FnOnce(&mut Scene)) -> String {
        let whirls = Particles {
            name: "whirls".into(),
            count: MAX_CARRIERS,
            release: ParticleRelease::Burst { at_s: 0.0 },
            feels: vec!["pull".into()],
            ..Particles::default()
        };
        let of = ForceKind::Attract { at_m: glam::Vec3::ZERO, gm_m3_s2: 1.0, softening_m: 0.1 };
        let carried_by = ForceCarriers { of: "whirls".into(), strength: vec![(0.0, 0.0), (1.0, -1000.0)] };
        let force = Force { name: "pull".into(), of, carried_by: Some(carried_by) };
        let mut scene = Scene { particles: vec![whirls], forces: vec![force], ..Scene::default() };
        change(&mut scene);
        let line = scene.validate("a.ron").map_or_else(|error| error.to_string(), |()| String::new());
        assert_eq!(line.lines().count(), usize::from(!line.is_empty()), "one line: {line}");
        line
    }

    fn carriers(scene: &mut Scene) -> &mut ForceCarriers {
        scene.forces[0].carried_by.as_mut().expect("it is carried")
    }

    #[test]
    fn carriers_are_few_and_there_and_their_strength_is_a_curve() {
        assert_eq!(refused(|_| {}), "", "as it is");
        let line = refused(|scene| scene.particles[0].count += 1);
        assert!(
            line.contains("carried_by.of") && line.contains("65") && line.contains("at most 64"),
            "{line}"
        );
        let line = refused(|scene| carriers(scene).of = "nobody".into());
        assert!(
            line.contains("carried_by.of") && line.contains("nobody") && line.contains("whirls"),
            "{line}"
        );
        let line = refused(|scene| scene.forces[0].of = ForceKind::Noise { m_s2: 1.0, cell_m: 1.0 });
        assert!(line.contains("carried_by") && line.contains("Attract or Swirl"), "{line}");
        for strength in [f32::NAN, -1000.1, 1e4] {
            let line = refused(|scene| carriers(scene).strength[1].1 = strength);
            assert!(line.contains("strength[1].strength") && line.contains("-1000 to 1000"), "{line}");
        }
        let line = refused(|scene| carriers(scene).strength[1].0 = 0.0);
        assert!(line.contains("carried_by.strength[1]") && line.contains("more than"), "{line}");
    }
}
