// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! What an open shutter makes of a leaf that moves.

use std::ops::Range;

use image::RgbaImage;
use windfall_core::scene::{Exposure, ToneMap};

use super::tests::{Bench, SIZE, bench, differing};

/// State of a falling leaf.
const FALLING: u32 = 2;
/// Time between two frames.
const FRAME_S: f64 = 0.02;

/// A bench whose picture is proportional to light.
fn camera_with(shutter_s: f32) -> Bench {
    bench(|scene| {
        scene.view.lens.shutter_s = shutter_s;
        scene.view.lens.tone_map = ToneMap::Linear { gamma: 1.0 };
        scene.view.lens.exposure = Exposure::Manual { ev100: 15.5 };
        scene.view.lens.glare.strength = 0.0;
    })
}

/// The second of two frames, between which the leaf has gone so far to the right, to the middle.
fn moved(shutter_s: f32, way_m: f32) -> RgbaImage {
    let mut bench = camera_with(shutter_s);
    bench.draw(FALLING, -way_m, 0.0);
    bench.draw(FALLING, 0.0, FRAME_S)
}

/// Columns and rows where a leaf is seen, and how much it changes the picture.
fn seen(empty: &RgbaImage, picture: &RgbaImage) -> ([Range<u32>; 2], i64) {
    let mut ranges = [u32::MAX..0, u32::MAX..0];
    let mut sum = 0;
    for ((x, y, before), after) in empty.enumerate_pixels().zip(picture.pixels()) {
        let change: i64 = (0..3).map(|c| i64::from(after.0[c]) - i64::from(before.0[c])).sum();
        sum += change;
        if change.abs() > 6 {
            for (range, at) in ranges.iter_mut().zip([x, y]) {
                *range = range.start.min(at)..range.end.max(at + 1);
            }
        }
    }
    (ranges, sum)
}

#[test]
fn a_leaf_is_drawn_along_its_way() {
    let mut still = camera_with(0.0);
    let empty = still.draw(0, 0.0, 0.0);
    let sharp = still.draw(FALLING, 0.0, 0.0);
    let ([columns, rows], sum) = seen(&empty, &sharp);
    let ([aside, _], _) = seen(&empty, &still.draw(FALLING, 0.5, 0.0));
    let px_per_m = 2.0 * f64::from(aside.start - columns.start);
    // 6 m/s, half the time between the frames.
    let way_px = 0.06 * px_per_m;
    let ([blurred_columns, blurred_rows], blurred_sum) = seen(&empty, &moved(0.01, 0.12));
    let longer = f64::from(blurred_columns.len() as u32) - f64::from(columns.len() as u32);
    println!("{columns:?} {rows:?} {sum}; {blurred_columns:?} {blurred_rows:?} {blurred_sum}; {way_px} px");
    assert!(way_px > 3.0, "far enough to be measured: {way_px} px");
    assert!((longer - way_px).abs() < 3.0, "{longer} px longer after {way_px} px");
    assert!(blurred_rows.len().abs_diff(rows.len()) <= 1, "no higher: {rows:?} and {blurred_rows:?}");
    let (before, after) = (columns.start - blurred_columns.start, blurred_columns.end - columns.end);
    assert!(before.abs_diff(after) <= 2, "as far behind as ahead: {before} and {after} px");
    let kept = blurred_sum as f64 / sum as f64;
    assert!((0.85..1.15).contains(&kept), "{kept} of the leaf's light");
}

#[test]
fn what_does_not_move_stays_sharp() {
    let mut still = camera_with(0.0);
    let sharp = still.draw(FALLING, 0.0, 0.0);
    assert_eq!(sharp, moved(0.02, 0.0), "a leaf that hangs");
    assert_eq!(sharp, moved(0.02, 1.7), "a leaf that was put elsewhere: 85 m/s");
    assert_eq!(sharp, camera_with(0.02).draw(FALLING, 0.0, 0.0), "the first picture");
    let mut paused = camera_with(0.02);
    paused.draw(FALLING, -0.1, 0.0);
    assert_eq!(sharp, paused.draw(FALLING, 0.0, 0.0), "no time between two pictures");
    assert_eq!(sharp, paused.draw(FALLING, 0.0, 5.0), "long after the one before");
    assert!(differing(&sharp, &moved(0.02, 0.1)) > 10, "but a leaf that moves does not");
}

#[test]
fn blurred_tiles_join_without_a_seam() {
    let draw = |tile_px: u32| {
        let mut bench = camera_with(0.02);
        bench.renderer.set_tile_px(tile_px).expect("the same size");
        bench.draw(FALLING, -0.1, 0.0);
        bench.draw(FALLING, 0.0, FRAME_S)
    };
    let (whole, tiled) = (draw(u32::MAX), draw(1500));
    let off = differing(&whole, &tiled);
    assert!(off < 20, "{off} of {} pixels differ by more than 12 of 255", SIZE.0 * SIZE.1);
}

#[test]
fn a_shutter_that_opens_later_blurs_too() {
    let mut bench = camera_with(0.0);
    let sharp = bench.draw(FALLING, 0.0, 0.0);
    let mut lens = bench.scene.view.lens;
    lens.shutter_s = 0.02;
    bench.renderer.set_lens(lens);
    bench.draw(FALLING, -0.1, 0.0);
    assert_eq!(bench.draw(FALLING, 0.0, FRAME_S), moved(0.02, 0.1), "as if it had been so from the start");
    lens.shutter_s = 0.0;
    bench.renderer.set_lens(lens);
    assert_eq!(bench.draw(FALLING, 0.0, 2.0 * FRAME_S), sharp, "and closes again");
}
