// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Mass of a body: that of its blade and that of its petiole.

use glam::DVec3;

use crate::scene::{Aerodynamics, FlightModel, PetioleRod, Planform, Species};

/// Distribution of a body's mass in the leaf's frame: x to the right, y along the normal, z towards the tip. Lengths are shares of
/// the radius of the disc with the blade's area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassDistribution {
    /// Centre of mass, from the middle of the blade's area.
    pub centre: DVec3,
    /// Moments of inertia about the centre of mass and the axes of the frame, over the mass. A petiole that hangs turns the principal
    /// axes by a few degrees, which is left out.
    pub inertia: DVec3,
}

impl MassDistribution {
    /// Distribution of a species; a synthesised one is an even blade.
    pub fn of(species: &Species) -> Self {
        let (body, petiole) = match species.flight {
            FlightModel::Synthesis => (Aerodynamics::default(), None),
            FlightModel::Aerodynamic(body) => (body, species.petiole()),
        };
        Self::of_parts(&body, species.planform(), petiole)
    }

    fn of_parts(body: &Aerodynamics, planform: Planform, petiole: Option<PetioleRod>) -> Self {
        let stretch = libm::sqrt(f64::from(planform.aspect));
        let (along, across) = (f64::from(planform.extent) * stretch, f64::from(planform.extent) / stretch);
        let blade_centre =
            DVec3::new(f64::from(body.mass_offset.1), -f64::from(body.curl), f64::from(body.mass_offset.0));
        let [about_x, about_z] = [f64::from(body.gyration.0) * along, f64::from(body.gyration.1) * across]
            .map(|radius| radius * radius);
        let blade_inertia = DVec3::new(about_x, about_x + about_z, about_z);
        let Some(rod) = petiole else { return Self { centre: blade_centre, inertia: blade_inertia } };
        let droop = f64::from(rod.droop_deg).to_radians();
        let direction = DVec3::new(0.0, -libm::sin(droop), -libm::cos(droop));
        let (length, share) = (f64::from(rod.length), f64::from(rod.mass));
        let rod_centre = DVec3::NEG_Z * f64::from(rod.base) + direction * (0.5 * length);
        let about = |arm: DVec3| DVec3::splat(arm.length_squared()) - arm * arm;
        Self {
            centre: blade_centre.lerp(rod_centre, share),
            inertia: blade_inertia * (1.0 - share)
                + about(direction) * (share * length * length / 12.0)
                + about(rod_centre - blade_centre) * (share * (1.0 - share)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn body(petiole: Option<PetioleRod>) -> Species {
        let planform = Some(Planform { aspect: 1.44, extent: 1.1 });
        let body = Aerodynamics { planform, petiole, curl: 0.1, ..Aerodynamics::default() };
        Species { flight: FlightModel::Aerodynamic(body), ..Species::default() }
    }

    /// Centre and moments of many points on blade and rod, summed one by one.
    fn summed(rod: PetioleRod) -> (DVec3, DVec3) {
        let mut points = Vec::new();
        // Four points at the radii of gyration stand for the blade.
        for (x, z) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
            let (along, across) = (1.1 * 1.2, 1.1 / 1.2);
            let half = std::f64::consts::FRAC_1_SQRT_2;
            points.push((
                DVec3::new(x * across * half, -f64::from(0.1f32), z * along * half),
                0.25 * (1.0 - f64::from(rod.mass)),
            ));
        }
        let droop = f64::from(rod.droop_deg).to_radians();
        for piece in 0..1000 {
            let far = f64::from(rod.length) * (f64::from(piece) + 0.5) / 1000.0;
            let at = DVec3::new(0.0, -far * libm::sin(droop), -f64::from(rod.base) - far * libm::cos(droop));
            points.push((at, f64::from(rod.mass) / 1000.0));
        }
        let centre: DVec3 = points.iter().map(|(at, mass)| *at * *mass).sum();
        let about = |arm: DVec3| DVec3::splat(arm.length_squared()) - arm * arm;
        (centre, points.iter().map(|(at, mass)| about(*at - centre) * *mass).sum())
    }

    #[test]
    fn a_petiole_adds_to_the_blade_as_points_of_mass_do() {
        for (base, length, mass, droop_deg) in
            [(0.8, 1.4, 0.15, 15.0), (1.2, 0.3, 0.05, 60.0), (1.0, 4.0, 0.5, -90.0)]
        {
            let rod = PetioleRod { base, length, mass, droop_deg };
            let found = MassDistribution::of(&body(Some(rod)));
            let (centre, inertia) = summed(rod);
            assert!(found.centre.distance(centre) < 1e-6, "{rod:?}: {found:?}, points have {centre}");
            assert!(found.inertia.distance(inertia) < 1e-5, "{rod:?}: {found:?}, points have {inertia}");
        }
    }

    #[test]
    fn petioles_are_the_shapes_unless_the_body_says_otherwise() {
        let bare = MassDistribution::of(&body(None));
        assert_eq!(bare.centre, DVec3::NEG_Y * f64::from(0.1f32), "a stated planform comes without petiole");
        let maple =
            Species { flight: FlightModel::Aerodynamic(Aerodynamics::default()), ..Species::default() };
        assert_eq!(maple.petiole(), maple.shape.petiole(), "that of the shape");
        assert!(MassDistribution::of(&maple).centre.z < -0.05, "its mass is towards the petiole");
        assert_eq!(
            MassDistribution::of(&Species::default()).centre,
            DVec3::ZERO,
            "synthesised leaves are even"
        );
        let plate = Species::preset("plate").expect("a preset");
        assert_eq!(plate.petiole(), None, "a plate has none");
    }
}
