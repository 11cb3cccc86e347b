// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The cone spiral against its closed form in double precision, and what a fall on it has in common with all others.

use std::f64::consts::{PI, TAU};

use glam::{DVec3, Vec2};
use windfall_core::World;
use windfall_core::device::leaf::record::{heading_angle, leaf_primitive, lies};
use windfall_core::leaf::{LeafMotion, LeafState};
use windfall_core::motion::{ConeSpiral, MotionConstants, Primitive};
use windfall_core::scene::{
    ConeShape, Litter, MotionParameters, Release, STANDARD_GRAVITY_M_S2, Scene, Species,
};

use crate::common::{attitude, build, position, single_motion, step, still_scene, velocity};

const SHAPES: [ConeShape; 2] = [ConeShape::Bowl, ConeShape::Cone];
/// Descent, radius, depth and orbit rate of the leaves of this file.
const U: f64 = 0.8;
const R: f64 = 0.75;
const H: f64 = 4.0;
const W: f64 = 2.5;

fn winding(shape: ConeShape, unevenness: f32, swing_deg: f32) -> Species {
    let motion = MotionParameters {
        descent_m_s: Some(0.8),
        cone_shape: Some(shape),
        cone_radius_m: Some(0.75),
        cone_depth_m: Some(4.0),
        cone_rad_s: Some(2.5),
        cone_unevenness: Some(unevenness),
        corner_swing_deg: Some(swing_deg),
        corner_swing_rad_s: Some(6.0),
        ..MotionParameters::default()
    };
    Species { motion, ..single_motion(Primitive::ConeSpiral) }
}

/// Place from the tip and velocity on a surface, `time` after the tip, with a descent as even as can be.
fn closed_form(shape: ConeShape, time: f64, phi: f64) -> (DVec3, DVec3) {
    let share = U * time / H;
    let (root, growth) = match shape {
        ConeShape::Bowl => (share.sqrt(), 0.5 / share.sqrt()),
        ConeShape::Cone => (share, 1.0),
    };
    let is_open = share >= 1.0;
    let radius = if is_open { R } else { R * root };
    let outward = if is_open { 0.0 } else { R * growth * U / H };
    let (sin, cos) = (phi + W * time).sin_cos();
    let place = DVec3::new(radius * cos, -U * time, -radius * sin);
    let around = DVec3::new(-sin, 0.0, -cos) * (radius * W);
    (place, DVec3::new(outward * cos, -U, -outward * sin) + around)
}

/// Time after the tip at which leaves set off: where the bowl is as steep as one to one.
fn start_s(shape: ConeShape) -> f64 {
    match shape {
        ConeShape::Bowl => R * R / (4.0 * H) / U,
        ConeShape::Cone => 0.0,
    }
}

/// Heading of a leaf in radians.
fn heading(world: &World, slot: usize) -> f64 {
    f64::from(heading_angle(world.leaves.schedule[slot].heading)) / 65536.0 * TAU
}

fn constants(species: &Species) -> MotionConstants {
    MotionConstants::of(species, STANDARD_GRAVITY_M_S2)
}

#[test]
fn leaves_follow_the_closed_form() {
    for shape in SHAPES {
        let species = winding(shape, 0.0, 30.0);
        let tau = constants(&species).response_s();
        let mut world = build(&still_scene(species, 20, 12.0));
        let from = DVec3::Y * 12.0;
        // Heights are right to half a unit of 16 bits of the way in their table, four swings long.
        let unit = U * 4.0 * TAU / 6.0 / 65_534.0;
        let (mut level, mut up, mut fast) = (0f64, 0f64, 0f64);
        for now in 1..=720u32 {
            step(&mut world, 1);
            let time = f64::from(now) / 60.0;
            for slot in 0..20 {
                let phi = heading(&world, slot);
                let (first, set_off) = closed_form(shape, start_s(shape).max(1e-12), phi);
                let (place, speed) = closed_form(shape, start_s(shape) + time, phi);
                // From rest: what it lacks in the beginning fades within the time constant.
                let left = (-time / tau).exp();
                let expected = from + (place - first) - set_off * (tau * (1.0 - left));
                let off = position(&world, slot) - expected;
                level = level.max(off.x.hypot(off.z));
                up = up.max(off.y.abs());
                // Just as the spiral is open the outward speed ends.
                if ((start_s(shape) + time) * U - H).abs() > 0.05 {
                    fast = fast.max((velocity(&world, slot) - (speed - set_off * left)).length());
                }
            }
        }
        println!("{shape:?}: {level:.1e} m aside, {up:.1e} m up, {fast:.1e} m/s");
        assert!(level < 2e-5, "{shape:?}: {level:e} m aside");
        assert!(up < 2.0 * unit + 1e-5, "{shape:?}: {up:e} m up, unit {unit:e}");
        assert!(fast < 2e-4, "{shape:?}: {fast:e} m/s");
    }
}

/// The surface: on a bowl the squared radius over the depth is constant, on a cone the radius over the depth; neither is the other's.
#[test]
fn bowls_are_bowls_and_cones_are_cones() {
    for shape in SHAPES {
        let species = winding(shape, 0.0, 30.0);
        let tau = constants(&species).response_s();
        let mut world = build(&still_scene(species, 1, 12.0));
        let phi = heading(&world, 0);
        let (first, set_off) = closed_form(shape, start_s(shape).max(1e-12), phi);
        step(&mut world, 75);
        let (mut low, mut high) = ([f64::MAX; 2], [0f64; 2]);
        while (f64::from(world.clock.step()) / 60.0 + start_s(shape)) * U < H - 0.02 {
            // What it lacked in the beginning is behind it for good.
            let tip = DVec3::Y * 12.0 - first - set_off * tau;
            let from_tip = position(&world, 0) - tip;
            let (radius, depth) = (from_tip.x.hypot(from_tip.z), -from_tip.y);
            for (index, ratio) in [radius * radius / depth, radius / depth].into_iter().enumerate() {
                low[index] = low[index].min(ratio);
                high[index] = high[index].max(ratio);
            }
            step(&mut world, 1);
        }
        let spread = [0, 1].map(|index| high[index] / low[index] - 1.0);
        let (own, other) = if shape == ConeShape::Bowl { (0, 1) } else { (1, 0) };
        let expected = [R * R / H, R / H][own];
        println!("{shape:?}: ratio to {:.1e}, spread {spread:?}", high[own] / expected - 1.0);
        assert!((high[own] / expected - 1.0).abs() < 2e-4, "{shape:?}: {} is not {expected}", high[own]);
        assert!(spread[own] < 2e-4, "{shape:?}: {spread:?}");
        assert!(spread[other] > 0.3, "{shape:?}: {spread:?}");
    }
}

#[test]
fn paths_do_not_depend_on_the_step() {
    for shape in SHAPES {
        let base = still_scene(winding(shape, 0.3, 30.0), 20, 14.0);
        let mut coarse = build(&Scene { dt_s: 1.0 / 30.0, ..base.clone() });
        let mut fine = build(&Scene { dt_s: 1.0 / 240.0, ..base });
        let mut worst = 0f64;
        for _ in 0..16 {
            step(&mut coarse, 30);
            step(&mut fine, 240);
            for slot in 0..20 {
                worst = worst.max(position(&coarse, slot).distance(position(&fine, slot)));
            }
        }
        assert!(coarse.stats().leaves.falling == 20, "all of them are in the air for 16 s");
        println!("{shape:?}: {worst:.1e} m apart");
        assert!(worst < 2e-5, "{shape:?}: {worst:e} m apart at 30 and 240 steps a second");
    }
}

/// However uneven it is, a descent has the mean U over the period of its table, and it never stops or goes back.
#[test]
fn the_mean_descent_is_u() {
    for unevenness in [0.0f32, 0.3, 0.9] {
        let species = winding(ConeShape::Bowl, unevenness, 30.0);
        let period = 4.0 * TAU / 6.0;
        let steps = 250;
        #[expect(clippy::cast_possible_truncation, reason = "scenes are in single precision")]
        let dt_s = (period / f64::from(steps)) as f32;
        let mut world = build(&Scene { dt_s, ..still_scene(species, 8, 40.0) });
        step(&mut world, steps);
        let before: Vec<_> = (0..8).map(|slot| position(&world, slot)).collect();
        let (mut slowest, mut fastest) = (f64::MAX, 0f64);
        for _ in 0..2 * steps {
            step(&mut world, 1);
            for slot in 0..8 {
                let down = -velocity(&world, slot).y / U;
                (slowest, fastest) = (slowest.min(down), fastest.max(down));
            }
        }
        for (slot, before) in before.iter().enumerate() {
            let mean = (before.y - position(&world, slot).y) / (2.0 * period);
            assert!((mean / U - 1.0).abs() < 1e-4, "unevenness {unevenness}: {mean} m/s");
        }
        let most = f64::from(unevenness);
        let widest = (fastest - 1.0).max(1.0 - slowest);
        assert!((widest - most).abs() < 0.01 + 0.03 * most, "{unevenness}: from {slowest} to {fastest} U");
    }
}

/// The corner swing turns the blade about a diagonal: two corners keep their height, two go up and down as far as the amplitude says,
/// and area and angles of the blade stay. (Heights of two corners alone would stretch it: by 1/cos A, a seventh at 30 degrees.)
#[test]
fn two_corners_swing_and_the_area_stays() {
    let mut species = winding(ConeShape::Bowl, 0.0, 30.0);
    // Without an orbit there is no bank.
    species.motion.cone_radius_m = Some(0.0);
    let mut world = build(&still_scene(species, 6, 12.0));
    let corner = |x: f64, z: f64| DVec3::new(x, 0.0, z) / 2f64.sqrt();
    let corners = [corner(1.0, 1.0), corner(1.0, -1.0), corner(-1.0, -1.0), corner(-1.0, 1.0)];
    let (mut highest, mut still, mut apart) = ([0f64; 6], 0f64, 0f64);
    for _ in 0..600 {
        step(&mut world, 1);
        for (slot, highest) in highest.iter_mut().enumerate() {
            let [a, b, c, d] = corners.map(|corner| attitude(&world, slot) * corner);
            let area = 0.5 * (c - a).cross(d - b).length();
            assert!((area - 2.0).abs() < 4e-6, "area {area}");
            assert!((c - a).dot(d - b).abs() < 4e-6, "the diagonals stay at right angles");
            still = still.max(a.y.abs()).max(c.y.abs());
            *highest = highest.max(b.y.abs()).max(d.y.abs());
        }
        let [one, other] = [0, 1].map(|slot| (attitude(&world, slot) * corners[1]).y);
        apart = apart.max((one - other).abs());
    }
    assert!(still < 1e-6, "the corners on the axis move by {still}");
    for most in highest {
        assert!((most - (PI / 6.0).sin()).abs() < 2e-3, "corners swing by {most}");
    }
    assert!(apart > 0.1, "leaves do not swing together: {apart}");
}

/// An open spiral stays as wide, so that no leaf becomes faster than that; the blade banks as a coordinated turn does.
#[test]
fn an_open_spiral_is_a_helix() {
    let mut world = build(&still_scene(winding(ConeShape::Cone, 0.0, 0.0), 3, 20.0));
    step(&mut world, 400);
    for _ in 0..300 {
        step(&mut world, 1);
        for slot in 0..3 {
            let speed = velocity(&world, slot);
            let level = speed.x.hypot(speed.z);
            assert!((level - R * W).abs() < 1e-3, "{level} m/s on the orbit");
            let normal = attitude(&world, slot) * DVec3::Y;
            let bank = normal.y.acos();
            let expected = (R * W * W / f64::from(STANDARD_GRAVITY_M_S2)).atan();
            assert!((bank - expected).abs() < 1e-3, "bank {bank}, {expected} expected");
            let inward = DVec3::new(speed.z, 0.0, -speed.x).normalize();
            assert!(normal.dot(inward).abs() > 0.3, "towards the axis: {normal}, {inward}");
        }
    }
}

/// Leaves that were let go before time zero are where steps would have brought them.
#[test]
fn a_fall_can_be_sought() {
    for shape in SHAPES {
        let mut scene = still_scene(winding(shape, 0.6, 30.0), 4, 15.0);
        let mut stepped = build(&scene);
        step(&mut stepped, 12 * 60);
        scene.sources[0].release = Release::Rate { per_s: 10_000.0, from_s: -12.0 };
        let sought = build(&scene);
        for slot in 0..4 {
            let apart = position(&stepped, slot).distance(position(&sought, slot));
            assert!(apart < 4e-5, "{shape:?}: {apart:e} m apart");
            let (one, other) = (attitude(&stepped, slot), attitude(&sought, slot));
            let turned = (one - other).length().min((one + other).length());
            assert!(turned < 1e-5, "{shape:?}: quaternions {turned:e} apart");
            assert_eq!(stepped.leaves.drift[slot].phase, sought.leaves.drift[slot].phase, "the same age");
        }
        // After the ground they lie.
        scene.sources[0].release = Release::Rate { per_s: 10_000.0, from_s: -60.0 };
        assert_eq!(build(&scene).stats().leaves.resting, 4, "{shape:?}");
    }
}

/// At the end of the ages another spiral begins: a step without any way of its own, no jump.
#[test]
fn another_spiral_begins_without_a_jump() {
    let mut world = build(&still_scene(winding(ConeShape::Bowl, 0.3, 30.0), 3, 700.0));
    step(&mut world, 600);
    for drift in &mut world.leaves.drift {
        drift.phase = u32::MAX - 5 * 65536;
    }
    for _ in 0..20 {
        let before: Vec<_> = (0..3).map(|slot| position(&world, slot)).collect();
        step(&mut world, 1);
        for (slot, before) in before.into_iter().enumerate() {
            let way = position(&world, slot).distance(before);
            // From the tip of a bowl outwards it is fast.
            assert!(way < 0.16, "{way} m in a step");
        }
    }
    assert!(world.leaves.drift.iter().all(|drift| drift.phase < 20 * 65536), "the ages have begun anew");
}

/// A fall keeps its motion from release to ground and lies there as all leaves do, on bare ground and on litter.
#[test]
fn leaves_land_and_lie() {
    let mut scene = still_scene(winding(ConeShape::Bowl, 0.3, 30.0), 200, 3.0);
    scene.sources[0].recycle_after_s = Some(8.0);
    for litter in [None, Some(Litter { size_m: Vec2::splat(6.0), leaf_area_index: 1.0, ..Litter::default() })]
    {
        scene.ground.litter = litter;
        let mut world = build(&scene);
        step(&mut world, 100);
        let stats = world.stats();
        assert_eq!(stats.leaves.primitives[Primitive::ConeSpiral.index()], 200, "{stats:?}");
        let block = world.step_block();
        let cx = world.context(&block);
        for slot in 0..world.leaves.len() {
            let leaf = world.leaves.view(&cx, slot);
            if leaf.state == LeafState::Falling {
                assert_eq!(leaf.motion, Some(LeafMotion::Primitive(Primitive::ConeSpiral)), "slot {slot}");
                assert_eq!(leaf.motion_code(), "CS", "slot {slot}");
            }
        }
        step(&mut world, 320);
        assert_eq!(world.stats().leaves.falling, 0, "all have come down: {:?}", world.stats());
        for place in &world.leaves.place {
            assert_eq!(lies(place.bits), litter.is_some(), "in litter or on the ground");
            assert_eq!(leaf_primitive(place.bits) == 7, litter.is_some(), "no spiral on the ground");
        }
        step(&mut world, 100);
        assert_eq!(world.stats().leaves.falling, 200, "and fall again: {:?}", world.stats());
        assert_eq!(world.stats().leaves.broken, 0, "{litter:?}");
    }
}

#[test]
fn a_resumed_fall_is_the_same_to_the_bit() {
    let mut world = build(&still_scene(winding(ConeShape::Bowl, 0.3, 30.0), 50, 6.0));
    step(&mut world, 150);
    let mut bytes = Vec::new();
    world.write_checkpoint(&mut bytes).expect("memory takes every byte");
    let mut resumed = World::from_checkpoint(&bytes[..], "cone").expect("just written");
    for world in [&mut world, &mut resumed] {
        step(world, 400);
    }
    assert_eq!(world.state_hash(), resumed.state_hash(), "an unbroken run and a resumed one");
    assert_eq!(world.stats().leaves.resting, 50, "down to the ground");
}

/// The period of the table and the start on a bowl are what the scene's numbers say.
#[test]
fn a_bowl_begins_where_it_is_as_steep_as_one_to_one() {
    let species = winding(ConeShape::Bowl, 0.3, 30.0);
    let spiral = ConeSpiral::new(&constants(&species), [1, 0]);
    assert!((spiral.period_s() - 4.0 * TAU / 6.0).abs() < 1e-12, "four swings");
    assert!((spiral.start_s() - start_s(ConeShape::Bowl)).abs() < 1e-7, "{}", spiral.start_s());
    let mut wide = constants(&species);
    wide.cone_radius_m = 5.0;
    let start_m = ConeSpiral::new(&wide, [1, 0]).start_s() * U;
    assert!((start_m - 0.25 * H).abs() < 1e-6, "of a flat bowl, no deeper than a quarter: {start_m}");
}
