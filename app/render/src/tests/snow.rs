// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Snow in the picture: as white as it is deep, where it lies.

use glam::{Vec2, Vec3};
use image::RgbaImage;
use windfall_core::device::leaf::record::{STATE_ATTACHED, STATE_FALLING};
use windfall_core::device::terrain::snow::SNOW_CELLS_PER_M;
use windfall_core::scene::{Camera, Exposure, Litter, Object, ObjectShape, Tree, Water, Weather};
use windfall_core::{CompiledScene, World};

use super::{Bench, SIZE, bench, bench_with};
use crate::trees::SceneTrees;

/// A bench that looks down on a rectangle of snow, which ends in the middle of the picture.
fn snowy() -> (Bench, World) {
    let bench = bench(|scene| {
        let (center_m, size_m) = (Vec2::new(-4.0, 0.0), Vec2::new(8.0, 16.0));
        scene.weather = Some(Weather { center_m, size_m, snow_mm_h: vec![(0.0, 0.0)], ..Weather::default() });
        scene.view.camera = Camera {
            eye_m: Vec3::new(0.0, 4.0, 3.0),
            target_m: Vec3::new(0.0, 0.0, 0.0),
            vertical_fov_deg: 40.0,
        };
        scene.view.lens.exposure = Exposure::Manual { ev100: 14.0 };
    });
    let world = World::build(&bench.scene).expect("valid");
    (bench, world)
}

/// The same bed with snow of so many mm of water, a tenth as dense, in all cells.
fn covered(world: &World, mm: u32) -> Vec<u32> {
    let mut bed = world.bed.clone();
    let snow = bed.snow_mut(world.compiled.block());
    snow.water.fill(4096 * mm);
    // 2^-18 m.
    snow.depth.fill(2621 * mm);
    bed.words
}

/// Mean brightness of the left and the right half of a picture, from 0 to 255.
fn halves(picture: &RgbaImage) -> [f64; 2] {
    let mut sums = [0.0; 2];
    for (x, _, pixel) in picture.enumerate_pixels() {
        sums[usize::from(x >= SIZE.0 / 2)] += pixel.0[..3].iter().copied().map(f64::from).sum::<f64>();
    }
    sums.map(|sum| sum / (1.5 * f64::from(SIZE.0 * SIZE.1)))
}

#[test]
fn snow_is_white_where_it_lies() {
    let (mut bench, world) = snowy();
    let bare = halves(&bench.draw_snow(&world.bed.words));
    let thin = halves(&bench.draw_snow(&covered(&world, 1)));
    let deep = halves(&bench.draw_snow(&covered(&world, 10)));
    assert!(bare[0] + 10.0 < thin[0] && thin[0] + 10.0 < deep[0], "{bare:?}, {thin:?}, {deep:?}");
    assert!((bare[1] - deep[1]).abs() < 2.0, "nothing lies on the right: {bare:?}, {deep:?}");
}

/// No snow is drawn on water, whatever lies beside it.
#[test]
fn no_snow_is_drawn_on_water() {
    let bench_on = |height_m: f32| {
        bench(|scene| {
            scene.weather = Some(Weather {
                size_m: Vec2::splat(16.0),
                snow_mm_h: vec![(0.0, 0.0)],
                ..Weather::default()
            });
            scene.ground.water = Some(Water { height_m });
            scene.view.lens.exposure = Exposure::Manual { ev100: 14.0 };
        })
    };
    for (height_m, is_drawn) in [(-0.5, true), (0.3, false)] {
        let mut bench = bench_on(height_m);
        let world = World::build(&bench.scene).expect("valid");
        let bare = bench.draw_snow(&world.bed.words);
        let seen = super::differing(&bare, &bench.draw_snow(&covered(&world, 10)));
        assert_eq!(seen > 1000, is_drawn, "water at {height_m} m: {seen} pixels differ");
    }
}

/// Heaps stand above what is level: their near slopes hide more of what is behind.
#[test]
fn snow_stands_as_high_as_it_is_deep() {
    let (mut bench, world) = snowy();
    let level = bench.draw_snow(&covered(&world, 10));
    let mut heap = covered(&world, 10);
    let block = world.compiled.block();
    let (columns, lines) = (block.snow.columns as usize, block.snow.lines as usize);
    let depths = block.snow.first_word as usize + columns * lines;
    for line in lines / 2 - 4..lines / 2 + 4 {
        for column in columns - 16..columns - 8 {
            heap[depths + line * columns + column] = 160_000;
        }
    }
    let seen = super::differing(&level, &bench.draw_snow(&heap));
    assert!((100..4000).contains(&seen), "{seen} pixels differ");
}

/// Snow on a box at an angle to the cells ends where the box does: it covers its top, and nothing beside it.
#[test]
fn caps_end_where_what_bears_them_ends() {
    const SIZE_M: Vec3 = Vec3::new(2.4, 0.5, 0.7);
    let camera = Camera {
        eye_m: Vec3::new(0.0, 4.4, 0.9),
        target_m: Vec3::new(0.0, 0.5, 0.0),
        vertical_fov_deg: 34.0,
    };
    let mut bench = bench(|scene| {
        scene.ground.litter =
            Some(Litter { leaf_area_index: 0.0, size_m: Vec2::splat(8.0), ..Litter::default() });
        scene.weather =
            Some(Weather { size_m: Vec2::splat(8.0), snow_mm_h: vec![(0.0, 0.0)], ..Weather::default() });
        scene.objects = vec![Object {
            shape: ObjectShape::Box { size_m: SIZE_M },
            at_m: Vec3::new(0.0, 0.25, 0.0),
            heading_deg: 33.0,
            ..Object::default()
        }];
        scene.view.camera = camera;
        scene.view.lens.exposure = Exposure::Manual { ev100: 14.0 };
    });
    let world = World::build(&bench.scene).expect("valid");
    let along = Vec2::new(33f32.to_radians().cos(), -33f32.to_radians().sin());
    // Distance of a place within the top from its nearest edge.
    let inset_m = |at: Vec2| {
        let half_m = 0.5 * Vec2::new(SIZE_M.x, SIZE_M.z);
        (half_m - Vec2::new(at.dot(along), at.dot(along.perp())).abs()).min_element()
    };
    // 6 cm on the box, and nothing around it.
    let mut bed = world.bed.clone();
    let block = world.compiled.block();
    let middle =
        |first: u32, number: u32| (first.cast_signed() as f32 + number as f32 + 0.5) / SNOW_CELLS_PER_M;
    for (number, depth) in (0..).zip(bed.snow_mut(block).depth) {
        let (column, line) = (number % block.snow.columns, number / block.snow.columns);
        let at = Vec2::new(middle(block.snow.first_column, column), middle(block.snow.first_line, line));
        *depth = if inset_m(at) > 0.0 { 15_729 } else { 0 };
    }
    let (bare, snowy) = (bench.draw_snow(&world.bed.words), bench.draw_snow(&bed.words));
    let forward = (camera.target_m - camera.eye_m).normalize();
    let right = forward.cross(Vec3::Y).normalize();
    let reach = (0.5 * camera.vertical_fov_deg.to_radians()).tan();
    let at = |x: u32, y: u32| {
        let half = 0.5 * Vec2::new(SIZE.0 as f32, SIZE.1 as f32);
        let off = (Vec2::new(x as f32, y as f32) + 0.5 - half) / half.y * reach;
        let way = forward + right * off.x - right.cross(forward) * off.y;
        // At the height of the middle of the snow.
        let place = camera.eye_m + way * ((0.53 - camera.eye_m.y) / way.y);
        Vec2::new(place.x, place.z)
    };
    let (mut top, mut white, mut beside) = (0, 0, 0);
    for ((x, y, bare), snowy) in bare.enumerate_pixels().zip(snowy.pixels()) {
        let inset_m = inset_m(at(x, y));
        let changed = bare.0.iter().zip(snowy.0).map(|(a, b)| a.abs_diff(b)).max().unwrap_or(0);
        // The side of its rim away from the sun is as dark as the box.
        top += u32::from(inset_m > 0.09);
        white += u32::from(inset_m > 0.09 && changed > 12);
        beside += u32::from(inset_m < -0.05 && changed > 40);
    }
    println!("{white} of {top} pixels have changed, and {beside} beside");
    assert!(top > 1000 && white * 100 > top * 99 && beside == 0, "{white} of {top}, and {beside} beside");
}

/// A bare tree against the ground is brighter where snow lies on it, and nothing else changes.
#[test]
fn snow_on_branches_is_white() {
    let mut bench = bench_with(|scene| {
        let size_m = Vec2::splat(12.0);
        scene.weather = Some(Weather { size_m, snow_mm_h: vec![(0.0, 0.0)], ..Weather::default() });
        scene.trees = vec![Tree { kind: "maple".into(), at_m: [0.0, 0.0], ..Tree::default() }];
        scene.view.camera = Camera {
            eye_m: Vec3::new(0.0, 9.0, 9.0),
            target_m: Vec3::new(0.0, 4.0, 0.0),
            vertical_fov_deg: 40.0,
        };
        scene.view.lens.exposure = Exposure::Manual { ev100: 14.0 };
        SceneTrees::of(scene, CompiledScene::compile(scene).expect("valid").forest())
    });
    let world = World::build(&bench.scene).expect("valid");
    let mut laden = world.bed.clone();
    let held = laden.branch_snow_mut(world.compiled.block()).held;
    assert!(!held.is_empty(), "the tree stands on the rectangle");
    held.fill(400_000);
    let (bare, laden) = (bench.draw_snow(&world.bed.words), bench.draw_snow(&laden.words));
    let sum = |pixel: &image::Rgba<u8>| pixel.0[..3].iter().copied().map(f64::from).sum::<f64>();
    let changed: Vec<_> = bare.pixels().zip(laden.pixels()).filter(|(a, b)| a != b).collect();
    let brighter = changed.iter().filter(|(a, b)| sum(b) > sum(a)).count();
    assert!(changed.len() > 100 && brighter * 10 > changed.len() * 8, "{brighter} of {}", changed.len());
}

/// A leaf that hangs over laden branches is white, one that falls there is as it was.
#[test]
fn snow_lies_on_leaves_that_hang() {
    let mut bench = bench_with(|scene| {
        let size_m = Vec2::splat(16.0);
        scene.weather = Some(Weather { size_m, snow_mm_h: vec![(0.0, 0.0)], ..Weather::default() });
        scene.trees = vec![Tree { kind: "maple".into(), at_m: [0.0, 0.0], ..Tree::default() }];
        // The leaf is six metres before the target.
        scene.view.camera = Camera {
            eye_m: Vec3::new(0.0, 6.2, 4.2),
            target_m: Vec3::new(0.0, 5.0, -4.0),
            vertical_fov_deg: 60.0,
        };
        scene.view.lens.exposure = Exposure::Manual { ev100: 14.0 };
        SceneTrees::of(scene, CompiledScene::compile(scene).expect("valid").forest())
    });
    let world = World::build(&bench.scene).expect("valid");
    let mut laden = world.bed.clone();
    laden.branch_snow_mut(world.compiled.block()).held.fill(400_000);
    let beds = [&world.bed.words, &laden.words];
    let [bare, white] = beds.map(|words| bench.draw_snowy_leaf(words, STATE_ATTACHED));
    let [falling, falling_too] = beds.map(|words| bench.draw_snowy_leaf(words, STATE_FALLING));
    // Distance from grey.
    let colour = |pixel: &image::Rgba<u8>| {
        let [r, g, b, _] = pixel.0.map(f64::from);
        (r.max(g).max(b) - r.min(g).min(b)) / r.max(g).max(b).max(1.0)
    };
    let hanging = bare.pixels().zip(white.pixels()).zip(falling.pixels().zip(falling_too.pixels()));
    let changed: Vec<_> = hanging.filter(|((a, b), (c, d))| a != b && c == d).map(|(pair, _)| pair).collect();
    let paler = changed.iter().filter(|(a, b)| colour(b) < colour(a)).count();
    // Those that are seen from below only lose light.
    assert!(paler > 100 && paler * 10 > changed.len() * 6, "{paler} of {}", changed.len());
}

/// A bed without snow, in some cells of which, by column and line, so much has melted in mm of water.
fn melted(world: &World, mm: f32, is_there: impl Fn(u32, u32) -> bool) -> Vec<u32> {
    let mut bed = world.bed.clone();
    let block = world.compiled.block();
    for (number, melted) in (0..).zip(bed.snow_mut(block).melted) {
        if is_there(number % block.snow.columns, number / block.snow.columns) {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "some mm")]
            let units = (4096.0 * mm) as u32;
            *melted = units;
        }
    }
    bed.words
}

#[test]
fn ground_is_darker_where_snow_has_melted() {
    let (mut bench, world) = snowy();
    let mut left = |mm| halves(&bench.draw_snow(&melted(&world, mm, |_, _| true)))[0];
    let [dry, damp, wet, soaked] = [0.0, 0.4, 1.0, 20.0].map(&mut left);
    println!("dry {dry}, damp {damp}, wet {wet}, soaked {soaked}");
    assert!(wet + 1.0 < damp && damp + 1.0 < dry, "{dry}, {damp}, {wet}");
    assert!((0.6..0.9).contains(&(wet / dry)), "as bright to the eye as wet ground is: {wet} of {dry}");
    assert!((wet - soaked).abs() < 0.1, "no wetter than wet: {wet}, {soaked}");
}

#[test]
fn ground_is_wet_only_where_snow_has_melted() {
    let (mut bench, world) = snowy();
    let dry = bench.draw_snow(&melted(&world, 0.0, |_, _| true));
    // Columns from x = -8 m to -1.5 m, and lines from z = -8 m to 0 m, which are above the middle of the picture.
    let wet = bench.draw_snow(&melted(&world, 5.0, |column, line| column < 52 && line < 64));
    let places = dry.enumerate_pixels().zip(wet.pixels()).filter(|((_, _, a), b)| a != b);
    let places: Vec<_> = places.map(|((x, y, _), _)| (x, y)).collect();
    println!("{} pixels differ", places.len());
    assert!((300..4000).contains(&places.len()), "{} pixels differ", places.len());
    let (right, low) = places.iter().fold((0, 0), |(right, low), (x, y)| (right.max(*x), low.max(*y)));
    assert!(right < SIZE.0 / 2 && low < SIZE.1 / 2 + 6, "up to {right}, {low}");
}
