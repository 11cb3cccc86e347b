// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The air that moving things drag along, against the momentum that their drag gives to it, and what it does to leaves beside their way.

use std::f64::consts::{PI, TAU};

use glam::{DVec3, Vec2, Vec3};
use windfall_core::arith::Vec3 as Kernel;
use windfall_core::device::wind::sample::wind_at;
use windfall_core::scene::{
    Litter, Object, ObjectKey, ObjectMotion, ObjectShape, Profile, Scene, WindParameters,
};
use windfall_core::{Clock, CompiledScene, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};

use crate::common::{build, steady_wind, still_scene, uniform_species, vector};

/// An object that goes from 20 m before the origin to 20 m behind it at a speed, a height above the ground.
fn passing(shape: ObjectShape, height_m: f32, speed_m_s: f32) -> Object {
    let key = |time_s, x| ObjectKey { time_s, moved_m: Vec3::new(x, 0.0, 0.0), turned_deg: 0.0 };
    // Keys on both sides, so that it is as fast in between as everywhere.
    let span_s = 20.0 / speed_m_s;
    let keys = (0..5u8).map(|number| key(f32::from(number) * span_s, (f32::from(number) - 2.0) * 20.0));
    Object {
        shape,
        at_m: Vec3::new(0.0, height_m, 0.0),
        motion: ObjectMotion::Path(keys.collect()),
        ..Object::default()
    }
}

fn scene(object: Object) -> Scene {
    let wind = WindParameters { profile: Profile::Uniform, ..steady_wind(0.0) };
    let mut scene = Scene { wind, objects: vec![object], ..still_scene(uniform_species(), 1, 5.0) };
    scene.ground.litter = Some(Litter { size_m: Vec2::splat(4.0), ..Litter::default() });
    scene
}

/// The air at a moment at which the object is at the origin.
fn air(object: Object, speed_m_s: f32) -> impl Fn(DVec3) -> DVec3 {
    let compiled = CompiledScene::compile(&scene(object)).expect("valid");
    let mut clock = Clock::new(1.0 / 60.0);
    while clock.seconds() < f64::from(40.0 / speed_m_s) - 1e-6 {
        compiled.advance(&mut clock);
    }
    let block = compiled.step_block(&clock);
    move |place| {
        let place = Kernel::from(place.as_vec3().to_array());
        vector(wind_at(&compiled.context(&block), place).to_array())
    }
}

#[test]
fn the_air_takes_the_momentum_of_the_drag() {
    const SPEED: f64 = 10.0;
    let air = air(passing(ObjectShape::Sphere { radius_m: 0.5 }, 50.0, 10.0), 10.0);
    for behind_m in [1.0, 2.0, 4.0, 6.0] {
        let (rings, step_m) = (4000, 0.005);
        let sum: f64 = (0..rings)
            .map(|ring| {
                let radius_m = (f64::from(ring) + 0.5) * step_m;
                let velocity = air(DVec3::new(-behind_m, 50.0 + radius_m, 0.0));
                assert!(velocity.y == 0.0 && velocity.z == 0.0, "along its way");
                velocity.x * (SPEED - velocity.x) * TAU * radius_m * step_m
            })
            .sum();
        // Half of the drag coefficient, 0.8, times area and squared speed.
        let expected = 0.5 * 0.8 * PI * 0.25 * SPEED * SPEED;
        println!("{behind_m} m behind: {:.3} of the momentum", sum / expected);
        assert!((sum / expected - 1.0).abs() < 0.03, "{behind_m} m behind: {sum}, not {expected} m⁴/s²");
    }
}

#[test]
fn it_goes_with_the_thing_and_ends() {
    let shape = ObjectShape::Box { size_m: Vec3::new(4.0, 1.5, 1.8) };
    let air_at = |x| air(passing(shape.clone(), 50.0, 10.0), 10.0)(DVec3::new(x, 50.0, 0.0)).x;
    assert_eq!(air_at(3.0), 0.0, "nothing in front");
    assert!((2.0..6.0).contains(&air_at(-2.5)), "{} m/s right behind it", air_at(-2.5));
    assert!(
        air_at(-2.5) > air_at(-8.0) && air_at(-8.0) > air_at(-14.0) && air_at(-14.0) > 0.0,
        "less farther off"
    );
    assert_eq!(air_at(-20.0), 0.0, "twelve lengths of its sides behind it is over");
}

#[test]
fn leaves_beside_the_way_of_a_fast_thing_fly_up_and_no_others() {
    // Half a metre above the ground: it touches none.
    let shape = ObjectShape::Box { size_m: Vec3::new(4.0, 1.4, 1.8) };
    let [fast, slow] = [(14.0, 343), (0.7, 6857)].map(|(speed_m_s, steps)| {
        let mut scene = scene(passing(shape.clone(), 1.2, speed_m_s));
        scene.sources = Vec::new();
        scene.species[0].size_m = 0.06;
        scene.species[0].areal_density_kg_m2 = 0.05;
        scene.ground.litter =
            Some(Litter { size_m: Vec2::splat(6.0), leaf_area_index: 0.1, ..Litter::default() });
        let mut simulator = CpuSimulator::new(&build(&scene), CpuOptions::default()).expect("threads start");
        simulator.step(steps).expect("the CPU steps");
        let world: &World = simulator.world();
        (world.litter_stats().expect("litter").woken, world.leaves.len())
    });
    println!("woken of {}: {} by the fast one, {} by the slow one", fast.1, fast.0, slow.0);
    assert!(fast.0 as usize > fast.1 / 10, "{fast:?} behind 14 m/s");
    assert_eq!(slow.0, 0, "{slow:?} behind 0.7 m/s");
}
