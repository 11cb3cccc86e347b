// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The end of a fall: flat within a fifth of a second, slid as far as friction lets it, at rest until it is recycled.

use crate::common::{
    GRAVITY, attitude, build, many_species, position, single_motion, steady_wind, step, still_scene, velocity,
};
use glam::{DVec3, Vec3};
use windfall_core::arith::Quat;
use windfall_core::device::leaf::settle::flatten_on;
use windfall_core::device::terrain::ground::Slope;
use windfall_core::leaf::LeafState;
use windfall_core::motion::{AIR_DENSITY, Primitive};
use windfall_core::scene::{Ground, Release, Scene, Source, SourceShape};
use windfall_core::{CompiledScene, REST_OFFSET_M, World};

fn state(world: &World, slot: usize) -> LeafState {
    world.leaves.place[slot].state()
}

/// Angle between a leaf's blade and the ground in degrees.
fn tilt(world: &World, slot: usize) -> f64 {
    (attitude(world, slot) * DVec3::Y).y.abs().min(1.0).acos().to_degrees()
}

/// Leaves of many species over ground at a height of its own, in some wind.
fn landing_scene() -> Scene {
    Scene {
        species: many_species(),
        sources: vec![Source {
            shape: SourceShape::Box {
                center_m: Vec3::new(0.0, 3.5, 0.0),
                half_extent_m: Vec3::new(2.0, 1.0, 2.0),
            },
            count: 1000,
            release: Release::Burst { at_s: 0.0 },
            recycle_after_s: None,
            species: Vec::new(),
        }],
        wind: steady_wind(1.5),
        ground: Ground { height_m: 1.5, friction: 0.5, ..Ground::default() },
        ..still_scene(single_motion(Primitive::SteadyDescent), 1, 5.0)
    }
}

#[test]
fn leaves_lie_flat_soon_after_contact() {
    let mut world = build(&landing_scene());
    let mut contact = vec![None; 1000];
    let (mut steepest, mut worst_tenth, mut worst_fifth) = (0.0f64, 0.0f64, 0.0f64);
    for now in 0..900u32 {
        step(&mut world, 1);
        for (slot, contact) in contact.iter_mut().enumerate() {
            if state(&world, slot) != LeafState::Resting {
                assert!(position(&world, slot).y >= 1.5, "leaf {slot} falls below the ground");
                assert!(contact.is_none(), "leaf {slot} left the ground");
                continue;
            }
            let since = now - *contact.get_or_insert(now);
            let angle = tilt(&world, slot);
            match since {
                0 => steepest = steepest.max(angle),
                6 => worst_tenth = worst_tenth.max(angle),
                12 => worst_fifth = worst_fifth.max(angle),
                _ => {}
            }
            let height = position(&world, slot).y - 1.5 - f64::from(REST_OFFSET_M);
            assert!(height.abs() < 1e-6, "leaf {slot} rests {height} m off its height");
        }
    }
    assert!(contact.iter().all(Option::is_some), "every leaf has landed");
    println!(
        "tilt at contact up to {steepest:.1}, after 0.1 s {worst_tenth:.2}, after 0.2 s {worst_fifth:.2} degrees"
    );
    assert!(steepest > 60.0, "some leaves land steeply: {steepest} degrees");
    assert!(worst_tenth < 10.0, "after a tenth of a second a leaf is tilted by {worst_tenth} degrees");
    assert!(worst_fifth < 1.0, "after a fifth of a second a leaf is tilted by {worst_fifth} degrees");
}

/// Coulomb friction stops a slide of speed v after v^2 / (2 mu g), in its own direction, whatever the step.
#[test]
fn slides_end_where_friction_says() {
    // Far from the origin positions round by a micrometre or two in every step of a slide.
    for (friction, dt_s, rounding) in [
        (0.5f32, 1.0 / 60.0, 2e-5),
        (0.8, 1.0 / 30.0, 2e-5),
        (0.8, 1.0 / 240.0, 1e-4),
        (0.05, 1.0 / 30.0, 1e-4),
    ] {
        let mut scene = landing_scene();
        scene.dt_s = dt_s;
        scene.ground.friction = friction;
        scene.wind = steady_wind(6.0);
        let mut world = build(&scene);
        let mut starts = vec![None; 1000];
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "seconds to steps")]
        let steps = ((10.0 + 1.0 / friction) / dt_s) as u32;
        for _ in 0..steps {
            step(&mut world, 1);
            for (slot, start) in starts.iter_mut().enumerate() {
                if start.is_none() && state(&world, slot) == LeafState::Resting {
                    *start = Some((position(&world, slot), velocity(&world, slot)));
                }
            }
        }
        let (mut fastest, mut worst) = (0.0f64, 0.0f64);
        for (slot, start) in starts.into_iter().enumerate() {
            let (place, speed) = start.expect("every leaf has landed");
            assert_eq!(velocity(&world, slot), DVec3::ZERO, "leaf {slot} has come to rest");
            assert_eq!(speed.y, 0.0, "leaf {slot} does not bounce");
            let way = speed * (speed.length() / (2.0 * f64::from(friction) * GRAVITY));
            let error = (position(&world, slot) - place - way).length();
            fastest = fastest.max(speed.length());
            worst = worst.max(error / (1.0 + way.length()));
            assert!(
                error < rounding * (1.0 + way.length()),
                "friction {friction}, leaf {slot}: slid {}, expected {way}",
                position(&world, slot) - place
            );
        }
        println!(
            "friction {friction}: slides of up to {fastest:.2} m/s, off by up to {worst:.1e} of 1 m and the way"
        );
        assert!(fastest > 4.0, "friction {friction}: the fastest slide had {fastest} m/s");
    }
}

/// A lying leaf can leave the ground where the air's stagnation pressure carries its weight: `rho V^2 / 2 = sigma g`
/// (Wills, Lee and Wyatt 2002, with a force coefficient of one). At half that speed the wind has a quarter of the force.
/// Nothing here says what becomes of leaves in stronger winds.
#[test]
fn resting_leaves_stay_below_the_lift_off_speed() {
    let mut world = build(&landing_scene());
    step(&mut world, 900);
    assert_eq!(world.stats().leaves.resting, 1000, "all leaves have landed");
    let lightest = many_species().iter().map(|species| species.areal_density_kg_m2).fold(f32::MAX, f32::min);
    #[expect(clippy::cast_possible_truncation, reason = "a speed to the accuracy of a scene")]
    let lift_off_m_s = (2.0 * f64::from(lightest) * GRAVITY / AIR_DENSITY).sqrt() as f32;
    println!("the lightest of them, {lightest} kg/m², can lift off at {lift_off_m_s:.2} m/s");
    for wind_m_s in [0.0, 0.25 * lift_off_m_s, 0.5 * lift_off_m_s] {
        let calm = Scene { wind: steady_wind(wind_m_s), ..landing_scene() };
        world.compiled = CompiledScene::compile(&calm).expect("the scene of this test is valid");
        let before = world.leaves.clone();
        step(&mut world, 600);
        assert!(world.leaves == before, "resting leaves moved, turned or vanished in {wind_m_s} m/s");
    }
}

/// A slot is released again exactly when its time has come, whether its leaf has landed or not.
/// A leaf that never comes to rest lies down without end. Devices may take subnormal numbers for zero, so there are none.
#[test]
fn lying_down_ends_flat_and_passes_no_subnormal_number() {
    for hint in [Quat::new(0.3, 0.8, -0.2, 0.5), Quat::new(-0.7, 0.1, 0.6, -0.3)] {
        let mut q = hint;
        for step in 0..20_000 {
            q = flatten_on(Slope { x: 0.0, z: 0.0, gain: 1.0, inv_gain: 1.0 }, q, 0.97);
            let parts = q.to_array();
            assert!(parts.iter().all(|part| *part == 0.0 || part.is_normal()), "step {step}: {parts:?}");
        }
        let [x, y, z, w] = q.to_array();
        let (upright, tilted) = (y * y + w * w, x * x + z * z);
        assert!(upright == 0.0 && tilted > 0.99 || tilted == 0.0 && upright > 0.99, "{q:?} is flat");
    }
}

#[test]
fn slots_are_recycled_on_schedule() {
    let count = 90;
    let mut scene = landing_scene();
    scene.sources[0].count = count;
    scene.sources[0].release = Release::Rate { per_s: 15.0, from_s: -2.0 };
    scene.sources[0].recycle_after_s = Some(6.0);
    let mut world = build(&scene);
    let mut landed_before = 0;
    for now in 0..1500i32 {
        let resting = world.stats().leaves.resting;
        step(&mut world, 1);
        // A leaf that is let go at the start of step `now` has been in the air for one step.
        for slot in 0..count as usize {
            // Slot n is let go for the first time 4 n steps after the step -120, then every 360 steps.
            let first = 4 * i32::try_from(slot).expect("few slots") - 120;
            let life = (now - first).div_euclid(360);
            let identity = world.leaves.identity[slot];
            if life < 0 {
                assert_eq!(state(&world, slot), LeafState::Dormant, "slot {slot} at {now} waits");
                continue;
            }
            assert_ne!(state(&world, slot), LeafState::Dormant, "slot {slot} at {now} has been let go");
            let id = u32::try_from(slot).expect("few slots") + count * life.unsigned_abs();
            assert_eq!(identity.id, id, "slot {slot} at step {now} is in its life {life}");
            assert_eq!(identity.release.cast_signed(), first + 360 * life, "slot {slot} at step {now}");
        }
        landed_before = landed_before.max(resting);
    }
    assert!(landed_before > 30, "up to {landed_before} leaves rested meanwhile");
    assert_eq!(world.stats().leaves.total(), count, "no leaf vanished");
}
