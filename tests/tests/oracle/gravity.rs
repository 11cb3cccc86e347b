// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! One gravity for everything: on the Moon, leaves of either model fall by the root of its gravity more slowly, slide
//! further, and trees stand as they do on Earth with a sixth of the load in their joints.

use crate::common::{GRAVITY, build, position, single_motion, step, still_air, still_scene, uniform_species};
use windfall_core::motion::Primitive;
use windfall_core::scene::{Aerodynamics, FlightModel, Scene, SourceShape, Species, Tree};

/// Gravity of the Moon in m/s².
const MOON_M_S2: f32 = 1.62;

/// Root of the Moon's gravity over the Earth's.
fn root() -> f64 {
    (f64::from(MOON_M_S2) / GRAVITY).sqrt()
}

/// Mean fall speed of the leaves of a scene between two steps in m/s.
fn fall_speed(scene: &Scene, from: u32, to: u32) -> f64 {
    let mut world = build(scene);
    let count = scene.leaf_count() as usize;
    let mean_height = |world: &windfall_core::World| {
        (0..count).map(|slot| position(world, slot).y).sum::<f64>() / count as f64
    };
    step(&mut world, from);
    let above = mean_height(&world);
    step(&mut world, to - from);
    (above - mean_height(&world)) / (f64::from(to - from) * f64::from(scene.dt_s))
}

/// The scene on the Moon, in steps that are longer by as much as everything is slower there.
fn on_the_moon(scene: &Scene) -> Scene {
    #[expect(clippy::cast_possible_truncation, reason = "scenes are in single precision")]
    let dt_s = (f64::from(scene.dt_s) / root()) as f32;
    Scene { gravity_m_s2: MOON_M_S2, dt_s, ..scene.clone() }
}

#[test]
fn bodies_fall_by_the_root_of_gravity() {
    let flight = FlightModel::Aerodynamic(Aerodynamics::default());
    for (areal_density_kg_m2, size_m, tolerance) in
        [(0.05, 0.03, 0.08), (0.07, 0.07, 0.03), (0.2, 0.12, 0.03)]
    {
        let species = Species { flight, areal_density_kg_m2, size_m, ..uniform_species() };
        let mut earth = still_scene(species, 400, 30.0);
        earth.dt_s = 1.0 / 240.0;
        // But for viscosity, which small and slow bodies feel, the same motion goes on at another pace.
        let [here, there] = [&earth, &on_the_moon(&earth)].map(|scene| fall_speed(scene, 480, 1440));
        println!("{size_m} m, {areal_density_kg_m2} kg/m²: {here:.3} m/s here, {there:.3} m/s on the Moon");
        assert!((there / here / root() - 1.0).abs() < tolerance, "{here} m/s, on the Moon {there} m/s");
    }
}

#[test]
fn synthesised_leaves_fall_by_the_root_of_gravity() {
    let earth = still_scene(single_motion(Primitive::SteadyDescent), 50, 30.0);
    let [here, there] = [&earth, &on_the_moon(&earth)].map(|scene| fall_speed(scene, 120, 600));
    assert!((there / here / root() - 1.0).abs() < 0.005, "{here} m/s, on the Moon {there} m/s");
}

#[test]
fn slides_are_longer_under_less_gravity() {
    let stop = |gravity_m_s2: f32| {
        let scene = Scene { gravity_m_s2, ..still_scene(uniform_species(), 1, 2.0) };
        f64::from(build(&scene).compiled.block().stop_s2_m)
    };
    let ratio = stop(MOON_M_S2) / stop(windfall_core::scene::STANDARD_GRAVITY_M_S2);
    assert!((ratio * root() * root() - 1.0).abs() < 1e-5, "stopping distances differ by a factor of {ratio}");
}

#[test]
fn trees_stand_on_the_moon_with_a_sixth_of_the_load() {
    let tree = Tree { kind: "birch".into(), leaves: 40, ..Tree::default() };
    let mut earth = Scene { trees: vec![tree], wind: still_air(), ..Scene::default() };
    earth.sources[0].shape =
        SourceShape::Box { center_m: glam::Vec3::Y * 3.0, half_extent_m: glam::Vec3::ONE };
    let moon = Scene { gravity_m_s2: MOON_M_S2, ..earth.clone() };
    let [mut here, mut there] = [&earth, &moon].map(build);
    let loads = |world: &windfall_core::World| {
        let segments = world.compiled.forest().segments().iter();
        segments.map(|segment| glam::Vec3::from(segment.preload).length()).fold(0.0, f32::max)
    };
    let ratio = f64::from(loads(&there) / loads(&here));
    assert!((ratio / root() / root() - 1.0).abs() < 1e-5, "loads differ by a factor of {ratio}");
    for world in [&mut here, &mut there] {
        let before = world.branches.pose.clone();
        step(world, 300);
        let moved = before
            .iter()
            .zip(&world.branches.pose)
            .map(|(a, b)| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max));
        let worst = moved.fold(0.0, f32::max);
        assert!(worst < 1e-3, "a tree in calm air turned by {worst}");
    }
}
