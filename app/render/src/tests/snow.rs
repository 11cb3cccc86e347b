// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Snow in the picture: as white as it is deep, where it lies.

use glam::{Vec2, Vec3};
use image::RgbaImage;
use windfall_core::World;
use windfall_core::scene::{Camera, Exposure, Weather};

use super::{Bench, SIZE, bench};

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
