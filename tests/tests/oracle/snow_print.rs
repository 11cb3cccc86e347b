// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Prints in snow: of feet, and of things that move over it.

use glam::{Vec2, Vec3};
use windfall_core::device::terrain::snow::{SNOW_CELLS_PER_M, SNOW_DEPTH_M, SNOW_WATER_MM};
use windfall_core::scene::{Litter, Object, ObjectKey, ObjectMotion, ObjectShape, Scene, Walker};
use windfall_core::{World, oracle};

use super::snow::snowy;

/// Edge in m of the square on which snow lies.
const EDGE_M: f32 = 8.0;

/// So many millimetres of water as fresh snow, fifteen times as deep, to which nothing is added.
fn fresh(lying_mm: f32) -> Scene {
    let mut scene = snowy(0.0, -5.0, EDGE_M, 1);
    let weather = scene.weather.as_mut().expect("stated");
    (weather.snow_mm_h, weather.lying_mm) = (vec![(0.0, 0.0)], lying_mm);
    scene.dt_s = 1.0 / 60.0;
    // Things and walkers need a bed; no leaf lies on it.
    scene.ground.litter =
        Some(Litter { size_m: Vec2::splat(2.0), leaf_area_index: 0.0, ..Litter::default() });
    scene
}

/// Depth in m of the cell at a place.
fn depth_m(world: &World, x_m: f32, z_m: f32) -> f32 {
    let block = world.compiled.block();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a cell on the square")]
    let [column, line] = [x_m, z_m].map(|at_m| ((at_m + 0.5 * EDGE_M) * SNOW_CELLS_PER_M) as usize);
    world.bed.snow(block).depth[line * block.snow.columns as usize + column] as f32 * SNOW_DEPTH_M
}

fn water(world: &World) -> u64 {
    world.bed.snow(world.compiled.block()).water.iter().copied().map(u64::from).sum()
}

/// A walker leaves one print for each step in four centimetres of snow, trodden to 300 kg/m³ at most, and nothing beside the way.
#[test]
fn feet_leave_prints() {
    let mut scene = fresh(3.0);
    scene.walkers = vec![Walker::default()];
    let mut world = World::build(&scene).expect("valid");
    let (before, fresh_m) = (water(&world), depth_m(&world, 3.0, 3.0));
    oracle::step(&mut world, 8 * 60);
    assert_eq!(water(&world), before, "no water is lost");
    let (settled_m, lying_mm) = (depth_m(&world, 3.0, 3.0), before as f32 * SNOW_WATER_MM / (64.0 * 64.0));
    assert!(
        (0.95 * fresh_m..=fresh_m).contains(&settled_m),
        "beside the way it settles: {settled_m} of {fresh_m} m"
    );
    let trodden_m = lying_mm / 300.0;
    // Cells across the way, from one end to the other: in which of them it is pressed deep.
    let pressed: Vec<bool> = (0..64u8)
        .map(|column| {
            let x_m = (f32::from(column) + 0.5) / SNOW_CELLS_PER_M - 0.5 * EDGE_M;
            let across =
                (-6..=6i8).map(|line| depth_m(&world, x_m, (f32::from(line) + 0.5) / SNOW_CELLS_PER_M));
            let least_m = across.fold(f32::INFINITY, f32::min);
            assert!(least_m > 0.97 * trodden_m, "no denser than trodden: {least_m} m, {trodden_m}");
            least_m < 0.6 * settled_m
        })
        .collect();
    let prints = pressed.windows(2).filter(|pair| pair[0] && !pair[1]).count();
    // Steps of seven to nine decimetres, on eight metres.
    assert!((8..=13).contains(&prints), "{prints} prints: {pressed:?}");
    assert!(pressed.iter().filter(|pressed| !**pressed).count() > 12, "untrodden between them: {pressed:?}");
}

/// A ball that is moved along leaves a furrow of its own shape, as deep as it reaches.
#[test]
fn things_leave_their_ways() {
    let mut scene = fresh(8.0);
    let (radius_m, under_m) = (0.3, 0.06);
    let key = |time_s: f32, x_m: f32| ObjectKey { time_s, moved_m: Vec3::X * x_m, turned_deg: 0.0 };
    scene.objects = vec![Object {
        shape: ObjectShape::Sphere { radius_m },
        at_m: Vec3::new(-3.0, under_m + radius_m, 0.0625),
        motion: ObjectMotion::Path(vec![key(0.0, 0.0), key(4.0, 4.0)]),
        ..Object::default()
    }];
    let mut world = World::build(&scene).expect("valid");
    let before = water(&world);
    oracle::step(&mut world, 5 * 60);
    assert_eq!(water(&world), before, "no water is lost");
    let untouched_m = depth_m(&world, 3.0, 0.0625);
    assert!(untouched_m > 0.09, "as it fell: {untouched_m} m");
    for x_m in [-3.0, -2.2, -1.4, -0.6, 0.2, 0.9] {
        let middle_m = depth_m(&world, x_m, 0.0625);
        assert!((middle_m - under_m).abs() < 0.004, "down to the ball's underside: {middle_m} m at {x_m}");
        // One cell aside, and where the ball does not reach.
        let aside_m = depth_m(&world, x_m, 0.1875);
        let round_m = under_m + radius_m - (radius_m * radius_m - 0.125 * 0.125f32).sqrt();
        assert!((aside_m - round_m).abs() < 0.006, "round: {aside_m} m at {x_m}, {round_m}");
        assert!(depth_m(&world, x_m, 0.8) > 0.98 * untouched_m, "no farther");
    }
}
