// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Motion blur of a leaf and of what else moves.

use glam::{Vec2, Vec3};
use image::RgbaImage;
use windfall_core::Scene;
use windfall_core::scene::{
    Exposure, LeafShape, Object, ObjectKey, ObjectMotion, ObjectShape, ToneMap, Walker,
};

use super::{Bench, SIZE, bench, differing};

/// State of a falling leaf.
const FALLING: u32 = 2;
/// Time between two frames.
const FRAME_S: f64 = 0.02;

/// A bench whose picture is proportional to light.
fn camera_with(shutter_s: f32) -> Bench {
    camera_at(shutter_s, |_| {})
}

/// The same with other things in sight.
fn camera_at(shutter_s: f32, change: impl FnOnce(&mut Scene)) -> Bench {
    bench(|scene| {
        change(scene);
        // Trees are painted then: where objects stand, grown ones are drawn by other shaders, which round otherwise.
        scene.species.iter_mut().for_each(|species| species.shape = LeafShape::Feather);
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

/// Change of the picture by a leaf: its sum, and its place: mean and variance of column and row.
fn seen(empty: &RgbaImage, picture: &RgbaImage) -> (f64, [(f64, f64); 2]) {
    let mut sums = [0.0; 5];
    for ((x, y, before), after) in empty.enumerate_pixels().zip(picture.pixels()) {
        let change: f64 = (0..3).map(|c| f64::from(after.0[c]) - f64::from(before.0[c])).sum();
        let (x, y) = (f64::from(x), f64::from(y));
        for (sum, power) in sums.iter_mut().zip([1.0, x, x * x, y, y * y]) {
            *sum += change * power;
        }
    }
    let [all, x, xx, y, yy] = sums;
    let spread = |first: f64, second: f64| (first / all, second / all - (first / all).powi(2));
    (all, [spread(x, xx), spread(y, yy)])
}

#[test]
fn a_leaf_is_drawn_along_its_way() {
    let mut still = camera_with(0.0);
    let empty = still.draw(0, 0.0, FRAME_S);
    let (light, [(column, width), (row, height)]) = seen(&empty, &still.draw(FALLING, 0.0, FRAME_S));
    let (_, [(aside, _), _]) = seen(&empty, &still.draw(FALLING, 1.0, FRAME_S));
    // 20 m/s, half the time between the frames.
    let way_px = 0.2 * (aside - column);
    let (blurred_light, [(blurred_column, longer), (blurred_row, higher)]) = seen(&empty, &moved(0.01, 0.4));
    println!("{way_px} px; light {light} {blurred_light}, {column} {width} {blurred_column} {longer}");
    assert!(way_px > 5.0, "far enough to be measured: {way_px} px");
    // What goes evenly over a way spreads by a twelfth of its square.
    let share = (longer - width) / (way_px * way_px / 12.0);
    assert!((0.75..1.25).contains(&share), "spread along the way: {share} of what is expected");
    assert!((higher - height).abs() < 0.05 * height, "no higher: {height} and {higher}");
    let apart = (blurred_column - column).hypot(blurred_row - row);
    assert!(apart < 0.3, "as far behind as ahead: the middle is {apart} px aside");
    let kept = blurred_light / light;
    assert!((0.95..1.05).contains(&kept), "{kept} of the leaf's light");
}

#[test]
fn what_does_not_move_stays_sharp() {
    let mut still = camera_with(0.0);
    let sharp = still.draw(FALLING, 0.0, FRAME_S);
    let is_sharp = |picture: RgbaImage| picture == sharp;
    assert!(is_sharp(moved(0.02, 0.0)), "a leaf that hangs");
    assert!(is_sharp(moved(0.02, 1.7)), "a leaf that was put elsewhere: 85 m/s");
    let mut bench = camera_with(0.02);
    assert!(is_sharp(bench.draw(FALLING, 0.0, FRAME_S)), "the first picture");
    bench.draw(FALLING, -0.1, FRAME_S);
    assert!(is_sharp(bench.draw(FALLING, 0.0, FRAME_S)), "no time between two pictures");
    bench.draw(FALLING, -0.1, FRAME_S - 5.0);
    assert!(is_sharp(bench.draw(FALLING, 0.0, FRAME_S)), "long after the one before");
    assert!(differing(&sharp, &moved(0.02, 0.3)) > 10, "but a leaf that moves does not");
}

#[test]
fn blurred_tiles_join_without_a_seam() {
    let draw = |tile_px: u32| {
        let mut bench = camera_with(0.02);
        bench.renderer.set_tile_px(tile_px).expect("the same size");
        bench.draw(FALLING, -0.3, 0.0);
        bench.draw(FALLING, 0.0, FRAME_S)
    };
    let (whole, tiled) = (draw(u32::MAX), draw(1500));
    let off = differing(&whole, &tiled);
    assert!(off < 20, "{off} of {} pixels differ by more than 12 of 255", SIZE.0 * SIZE.1);
}

#[test]
fn a_shutter_that_opens_later_blurs_too() {
    let mut bench = camera_with(0.0);
    let mut lens = bench.scene.view.lens;
    lens.shutter_s = 0.02;
    bench.renderer.set_lens(lens);
    bench.draw(FALLING, -0.3, 0.0);
    let blurred = bench.draw(FALLING, 0.0, FRAME_S);
    assert!(blurred == moved(0.02, 0.3), "as if it had been so from the start");
    lens.shutter_s = 0.0;
    bench.renderer.set_lens(lens);
    bench.draw(FALLING, -0.3, 0.0);
    let sharp = camera_with(0.0).draw(FALLING, 0.0, FRAME_S);
    assert!(bench.draw(FALLING, 0.0, FRAME_S) == sharp, "and closes again");
}

/// Time in seconds at which a ball or somebody who walks is in the middle.
const MIDDLE_S: f64 = 1.5;

/// Puts a ball in sight that goes so fast to the right.
fn roll(scene: &mut Scene, speed_m_s: f32) {
    // At the first and the last key it stands.
    let keys = [0.0f32, 1.0, 2.0, 3.0].map(|time_s| ObjectKey {
        time_s,
        moved_m: Vec3::X * (speed_m_s * (time_s - 1.5)),
        turned_deg: 0.0,
    });
    let shape = ObjectShape::Sphere { radius_m: 0.3 };
    let (at_m, color) = (scene.view.camera.target_m, Vec3::splat(0.01));
    let motion = ObjectMotion::Path(keys.into());
    scene.objects = vec![Object { shape, at_m, color, motion, ..Object::default() }];
}

/// The part of a picture without the shadow of what is in the middle.
fn above_ground(picture: &RgbaImage) -> RgbaImage {
    image::imageops::crop_imm(picture, 0, 0, SIZE.0, SIZE.1 / 2 + 6).to_image()
}

#[test]
fn an_object_is_drawn_along_its_way() {
    let second = |shutter_s: f32, speed_m_s: f32| {
        let mut bench = camera_at(shutter_s, |scene| roll(scene, speed_m_s));
        bench.draw(0, 0.0, MIDDLE_S - FRAME_S);
        above_ground(&bench.draw(0, 0.0, MIDDLE_S))
    };
    let mut nothing = camera_with(0.0);
    let empty = above_ground(&nothing.draw(0, 0.0, MIDDLE_S));
    let sharp = second(0.0, 20.0);
    let (light, [(column, width), (row, height)]) = seen(&empty, &sharp);
    let (blurred_light, [(blurred_column, longer), (blurred_row, higher)]) =
        seen(&empty, &second(0.02, 20.0));
    // 20 m/s for 0.02 s, a metre being some eleven pixels there, as in the tests of objects.
    let way_px = (12.0 * (longer - width)).sqrt();
    assert!((3.6..6.0).contains(&way_px), "{way_px} px along its way");
    assert!((higher - height).abs() < 0.1 * height, "no higher: {height} and {higher}");
    let apart = (blurred_column - column).hypot(blurred_row - row);
    assert!(apart < 0.5, "as far behind as ahead: the middle is {apart} px aside");
    let kept = blurred_light / light;
    // The woods behind it are not equally bright along its way.
    assert!((0.85..1.15).contains(&kept), "{kept} of its light");
    assert!(second(0.02, 0.0) == second(0.0, 0.0), "one that is on no way stays sharp");
    let mut first = camera_at(0.02, |scene| roll(scene, 20.0));
    assert!(above_ground(&first.draw(0, 0.0, MIDDLE_S)) == sharp, "the first picture");
}

#[test]
fn somebody_who_walks_is_blurred_where_he_moves() {
    let second = |shutter_s: f32| {
        let mut bench = camera_at(shutter_s, |scene| {
            let camera = scene.view.camera;
            scene.view.camera.eye_m = Vec3::new(0.0, 1.0, 5.0);
            scene.view.camera.target_m = Vec3::new(0.0, 1.0, 0.0);
            scene.view.camera.vertical_fov_deg = camera.vertical_fov_deg;
            let way_m = vec![Vec2::new(-3.0, 0.0), Vec2::new(6.0, 0.0)];
            scene.walkers = vec![Walker { way_m, speed_m_s: 2.0, ..Walker::default() }];
        });
        bench.draw(0, 0.0, MIDDLE_S - 0.1);
        bench.draw(0, 0.0, MIDDLE_S)
    };
    let (sharp, blurred) = (second(0.0), second(0.1));
    let changed = sharp.pixels().zip(blurred.pixels()).filter(|(a, b)| a != b).count();
    assert!((60..2000).contains(&changed), "{changed} pixels differ");
}
