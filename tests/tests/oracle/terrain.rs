// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves and trees on hills, held to the hills' grid and to the mechanics of an inclined plane, in double precision.

use crate::common::{GRAVITY, attitude, build, position, step, velocity};
use glam::DVec3;
use windfall_core::arith::Vec3;
use windfall_core::device::leaf::settle::{ground_friction, slide};
use windfall_core::device::terrain::ground::Slope;
use windfall_core::leaf::LeafState;
use windfall_core::terrain::Hills;
use windfall_core::{REST_OFFSET_M, Scene, World};
use windfall_tests::strategies::{flying_scene, hilly_scene, varied_scene};

/// Height of the pond's surface in [`hilly_scene`] in metres.
const WATER_M: f64 = 1.5;

/// Height of the hills and their rise along x and z, interpolated between the four grid points around a place.
fn ground(hills: &Hills, x: f64, z: f64) -> DVec3 {
    let cells = i64::from(hills.cells);
    let cell = f64::from(hills.cell_m);
    let (u, v) = (x / cell, z / cell);
    let (ku, kv) = (u.floor(), v.floor());
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "grid points of a small world"
    )]
    let at = |du: f64, dv: f64| {
        let (x, z) = (((ku + du) as i64).rem_euclid(cells), ((kv + dv) as i64).rem_euclid(cells));
        f64::from(hills.heights_m[(z * cells + x) as usize])
    };
    let (tu, tv) = (u - ku, v - kv);
    let corners = [at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0), at(1.0, 1.0)];
    let [a, b, c, d] = corners;
    let height = a * (1.0 - tu) * (1.0 - tv) + b * tu * (1.0 - tv) + c * (1.0 - tu) * tv + d * tu * tv;
    let along_x = ((b - a) * (1.0 - tv) + (d - c) * tv) / cell;
    let along_z = ((c - a) * (1.0 - tu) + (d - b) * tu) / cell;
    DVec3::new(height, along_x, along_z)
}

fn hills_of(world: &World) -> Hills {
    Hills::grow(&world.compiled.scene().ground.terrain.expect("the scene has hills"))
}

fn hilly(leaves: u32) -> Scene {
    hilly_scene(varied_scene(11, leaves, 2.0, 1.0 / 60.0))
}

#[test]
fn leaves_lie_on_hills_and_water_along_the_slope() {
    let mut world = build(&hilly(1500));
    let hills = hills_of(&world);
    let mut contact = vec![None; world.leaves.len()];
    let (mut on_water, mut on_slopes, mut still_steep, mut still) = (0, 0, 0, 0);
    for now in 0..700u32 {
        step(&mut world, 1);
        for (slot, contact) in contact.iter_mut().enumerate() {
            let state = world.leaves.place[slot].state();
            let place = position(&world, slot);
            let [height, along_x, along_z] = ground(&hills, place.x, place.z).to_array();
            let rest = height.max(WATER_M) + f64::from(REST_OFFSET_M);
            if state == LeafState::Falling {
                assert!(place.y > rest - 1e-4, "leaf {slot} is {} m under the ground", rest - place.y);
            }
            if state != LeafState::Resting {
                *contact = None;
                continue;
            }
            assert!((place.y - rest).abs() < 1e-4, "leaf {slot} rests {} m off", place.y - rest);
            if velocity(&world, slot).length() > 0.0 {
                *contact = None;
                continue;
            }
            let since = now - *contact.get_or_insert(now);
            if since == 20 {
                let is_wet = height < WATER_M;
                let normal = if is_wet { DVec3::Y } else { DVec3::new(-along_x, 1.0, -along_z).normalize() };
                let upright = (attitude(&world, slot) * DVec3::Y).dot(normal).abs().min(1.0);
                let tilt = upright.acos().to_degrees();
                assert!(tilt < 1.0, "leaf {slot} lies {tilt} degrees off the ground's slope");
                still += 1;
                on_water += u32::from(is_wet);
                let rise = (1.0 - normal.y * normal.y).sqrt() / normal.y;
                on_slopes += u32::from(rise > 0.2);
                still_steep += u32::from(rise > 0.55);
            }
        }
    }
    assert!(
        still > 800 && on_water > 50 && on_slopes > 200,
        "{still}: {on_water} wet, {on_slopes} on slopes"
    );
    assert!(20 * still_steep < still, "{still_steep} of {still} leaves stay where friction cannot hold them");
}

/// Up, down and on the level: a slide ends after v² (1 + s²) / (2 g (mu + s)), and does not end where s exceeds mu.
#[test]
fn slides_obey_the_inclined_plane() {
    let world = build(&varied_scene(1, 3, 0.0, 1.0 / 60.0));
    let clock = world.compiled.step_block(&world.clock);
    let cx = world.compiled.context(&clock);
    let friction = f64::from(world.compiled.scene().ground.friction);
    for rise in [-0.4f32, -0.2, 0.0, 0.3, 1.0, 3.0] {
        let gain = 1.0 + rise * rise;
        let slope = Slope { x: rise, z: 0.0, gain, inv_gain: 1.0 / gain };
        let mut velocity = Vec3::new(2.0, 0.0, 0.0);
        let (mut way, mut seconds) = (0.0, 0.0);
        while velocity.x > 0.0 && seconds < 60.0 {
            let (moved, left) = slide(&cx, velocity, 0.001, slope, ground_friction(&cx));
            way += f64::from(moved.x);
            velocity = left;
            seconds += 0.001;
        }
        let rise = f64::from(rise);
        let expected = 4.0 * (1.0 + rise * rise) / (2.0 * GRAVITY * (friction + rise));
        assert!((way / expected - 1.0).abs() < 0.01, "rise {rise}: {way} m, not {expected} m");
    }
    let steep = Slope { x: -1.0, z: 0.0, gain: 2.0, inv_gain: 0.5 };
    let mut velocity = Vec3::new(0.1, 0.0, 0.0);
    for _ in 0..1000 {
        velocity = slide(&cx, velocity, 0.001, steep, ground_friction(&cx)).1;
    }
    let expected = 0.1 + GRAVITY * (1.0 - friction) / 2.0;
    assert!((f64::from(velocity.x) / expected - 1.0).abs() < 1e-3, "{} m/s, not {expected}", velocity.x);
}

#[test]
fn trees_stand_on_the_hills() {
    let world: World = build(&hilly_scene(flying_scene(3, 30, 2.0, 1.0 / 60.0)));
    let hills = hills_of(&world);
    let mut heights = Vec::new();
    for tree in world.compiled.forest().trees() {
        let [x, y, z] = tree.foot_m.to_array().map(f64::from);
        let height = ground(&hills, x, z).x;
        assert!((y - height).abs() < 1e-4, "a foot at {y} m on ground at {height} m");
        heights.push(height);
    }
    let spread =
        heights.iter().copied().fold(f64::MIN, f64::max) - heights.iter().copied().fold(f64::MAX, f64::min);
    assert!(spread > 1.0, "trees stand high and low: {heights:?}");
}

#[test]
fn other_winds_leave_the_hills_where_they_are() {
    let mut world = build(&hilly(30));
    let before = (hills_of(&world), world.compiled.tables().clone());
    let mut scene = world.compiled.scene().clone();
    scene.wind.reference_height_m = 20.0;
    scene.ground.terrain = None;
    world.compiled.retune(&scene);
    assert_eq!(before.0, hills_of(&world), "the scene keeps its hills");
    let rows = before.0.heights_m.len();
    let tables = world.compiled.tables();
    assert_ne!(before.1, *tables, "the profile is another");
    let hills = world.compiled.block().first_hill_row as usize..;
    assert_eq!(before.1[hills.clone()][..rows], tables[hills][..rows], "the table of the hills stays");
}
