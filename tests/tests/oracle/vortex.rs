// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Vortices against their profiles: circulations, peaks, and curved axes.

use std::f64::consts::TAU;

use glam::{DVec3, Vec3};
use windfall_core::device::wind::sample::wind_at;
use windfall_core::scene::{Vortex, VortexProfile};
use windfall_core::{Scene, World};

use crate::solids::calm;

fn vortex(profile: VortexProfile) -> Vortex {
    Vortex {
        center_m: Vec3::new(1.0, 0.0, -2.0),
        axis: Vec3::Y,
        circulation_m2_s: 30.0,
        core_m: 2.0,
        axial_m_s: 0.0,
        drift_m_s: Vec3::ZERO,
        profile,
        spline_m: Vec::new(),
    }
}

fn world(vortex: Vortex) -> World {
    let mut scene = Scene { wind: calm(), ..Scene::default() };
    scene.sources[0].count = 1;
    scene.wind.vortices = vec![vortex];
    World::build(&scene).expect("one vortex is valid")
}

fn air(world: &World, at: DVec3) -> DVec3 {
    let block = world.step_block();
    let found = wind_at(&world.context(&block), at.as_vec3().to_array().into());
    DVec3::from_array(found.to_array().map(f64::from))
}

/// Speed about the axis at so many core radii from it, over Γ / (2π a).
fn speed(world: &World, s: f64) -> f64 {
    let center = DVec3::new(1.0, 5.0, -2.0);
    let found = (0..12).map(|number| {
        let angle = TAU * f64::from(number) / 12.0;
        let radial = DVec3::new(angle.cos(), 0.0, angle.sin());
        // Anticlockwise seen from the axis' tip.
        air(world, center + radial * (2.0 * s)).dot(DVec3::Y.cross(radial))
    });
    found.sum::<f64>() / 12.0 * TAU * 2.0 / 30.0
}

/// Circulation is that of a rigid body, of equal speeds, or the same on every circle; that of Kaufmann is half of it on its core.
#[test]
fn powers_have_their_circulation() {
    for (alpha, exponent) in [(0, 1), (1, 0), (2, -1)] {
        let world = world(vortex(VortexProfile::Power { alpha }));
        for s in [0.2, 0.7, 1.0, 3.0, 8.0] {
            let wanted = f64::powi(s, exponent);
            assert!((speed(&world, s) / wanted - 1.0).abs() < 1e-4, "{alpha} at {s}: {}", speed(&world, s));
        }
    }
    let world = world(vortex(VortexProfile::Kaufmann));
    assert!((speed(&world, 1.0) - 0.5).abs() < 1e-4, "{}", speed(&world, 1.0));
}

/// Compact vortices are fastest where they should be, and nothing beyond their radius.
#[test]
fn compact_vortices_have_their_peak_and_their_end() {
    for (d, peak, at) in [(0.0, 0.2862, 0.4472), (1.0, 0.2434, 0.393), (5.0, 0.1713, 0.297)] {
        let world = world(vortex(VortexProfile::Compact { d }));
        let speeds: Vec<f64> = (0..1000).map(|number| speed(&world, f64::from(number) / 1000.0)).collect();
        let (place, largest) =
            speeds.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).expect("a thousand numbers");
        assert!((largest - peak).abs() < 1e-4, "{d}: {largest}, not {peak}");
        assert!((place as f64 / 1000.0 - at).abs() < 6e-3, "{d}: at {place} thousandths, not {at}");
        assert_eq!(speed(&world, 1.001), 0.0, "nothing beyond");
    }
}

/// An axis whose control points lie on a line is a straight one, beyond its ends as well; one that bends is followed.
#[test]
fn curved_axes_are_followed() {
    let profile = VortexProfile::Compact { d: 1.0 };
    let (from, to) = (Vec3::new(1.0, 1.0, -2.0), Vec3::new(4.0, 9.0, 0.0));
    let straight = Vortex { center_m: from, axis: to - from, axial_m_s: 2.0, ..vortex(profile) };
    let spline_m = (0..5u8).map(|number| from.lerp(to, f32::from(number) / 4.0)).collect();
    let curved = Vortex { spline_m, axis: Vec3::X, center_m: Vec3::ZERO, ..straight.clone() };
    let (straight, curved) = (world(straight), world(curved));
    for number in 0..400 {
        let share = |part: f64| (f64::from(number) * part).fract() - 0.5;
        let at = DVec3::new(2.0 + 6.0 * share(0.618), 5.0 + 14.0 * share(0.382), -1.0 + 6.0 * share(0.755));
        let apart = (air(&straight, at) - air(&curved, at)).length();
        assert!(apart < 2e-5, "{apart:e} m/s apart at {at}");
    }
    let bent: Vec<Vec3> =
        [[0.0, 0.0, 0.0], [0.5, 2.0, 0.0], [2.0, 4.0, 0.5], [2.0, 7.0, 2.0], [1.0, 10.0, 2.0]]
            .map(Vec3::from)
            .to_vec();
    // Middle of the first piece, by the weights of the basis: 1, 23, 23, 1 over 48.
    let middle = (bent[0] + bent[3] + (bent[1] + bent[2]) * 23.0) / 48.0;
    let along = ((bent[3] - bent[0]) + (bent[2] - bent[1]) * 5.0).normalize().as_dvec3();
    let world = world(Vortex { spline_m: bent, axial_m_s: 3.0, ..vortex(profile) });
    let found = air(&world, middle.as_dvec3());
    assert!((found - along * 3.0).length() < 0.15, "{found} along {along}");
    let side = along.cross(DVec3::Z).normalize();
    let round = air(&world, middle.as_dvec3() + side * 0.8) - air(&world, middle.as_dvec3() - side * 0.8);
    assert!(round.dot(along.cross(side)) > 0.5, "it turns about the curve: {round}");
}
