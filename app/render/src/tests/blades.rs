// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Soft shadows beneath leaves at rest, what insects leave of blades, and rain on all of it.

use glam::Vec3;
use image::{Rgba, RgbaImage};
use windfall_core::Scene;
use windfall_core::device::leaf::record::{STATE_FALLING, STATE_RESTING};
use windfall_core::scene::{Camera, Exposure, Litter};

use super::{Drawn, bench, differing};
use crate::with_shader_edit;

/// Leaves as large as they may be, so that they are drawn finely.
fn large(scene: &mut Scene) {
    scene.species[0].size_m = 0.5;
}

/// A camera that looks down on the place, six metres before its target, where the bench's large leaf is: on the ground.
fn looking_down(scene: &mut Scene) {
    large(scene);
    scene.view.camera = Camera {
        eye_m: Vec3::new(0.0, 7.0, 12.0),
        target_m: Vec3::new(0.0, 0.0, 0.0),
        vertical_fov_deg: 50.0,
    };
    scene.view.lens.exposure = Exposure::Manual { ev100: 13.0 };
}

fn green(pixel: &Rgba<u8>) -> u8 {
    let [_, green, ..] = pixel.0;
    green
}

/// Pixels in which a picture is darker and lighter than another.
fn darker_and_lighter(picture: &RgbaImage, than: &RgbaImage) -> [usize; 2] {
    let steps =
        || picture.pixels().zip(than.pixels()).map(|(a, b)| i32::from(green(a)) - i32::from(green(b)));
    [steps().filter(|&step| step < -6).count(), steps().filter(|&step| step > 6).count()]
}

#[test]
fn a_leaf_that_lies_darkens_what_is_beneath_its_rim() {
    let picture = |state: u32, edit: [&str; 2]| {
        with_shader_edit(edit[0], edit[1], || {
            let mut bench = bench(looking_down);
            bench.draw_world(Drawn { is_level: true, ..Drawn::default() }, state, 60_000, 0.0, 0.0)
        })
    };
    let whole = ["const DARKEST: f32 = 0.60;", "const DARKEST: f32 = 0.6;"];
    let without = ["const DARKEST: f32 = 0.60;", "const DARKEST: f32 = 0.0;"];
    let [lying, bare] = [whole, without].map(|edit| picture(STATE_RESTING, edit));
    let [darker, lighter] = darker_and_lighter(&lying, &bare);
    assert!((10..2000).contains(&darker) && lighter == 0, "{darker} pixels are darker, {lighter} lighter");
    let [falling, other] = [whole, without].map(|edit| picture(STATE_FALLING, edit));
    assert_eq!(falling, other, "none below a leaf that falls");
}

#[test]
fn some_leaves_are_eaten_and_plates_are_not() {
    const HAS_NONE: &str = "table.layers[layer].dryness < 0.0 || unit_from(word) > DAMAGED_SHARE";
    let picture = |condition: &str| {
        with_shader_edit(HAS_NONE, condition, || bench(large).draw(STATE_FALLING, 0.0, 0.0))
    };
    let (own, none, all) = (picture("table.layers[layer].dryness < 0.0"), picture("true"), picture("false"));
    assert_eq!(own, none, "what does not dry is whole");
    let blade = differing(&none, &bench(large).draw(0, 0.0, 0.0));
    let eaten = differing(&none, &all);
    assert!(eaten > 3 && eaten < blade / 2, "{eaten} of {blade} pixels are eaten or dead");
    assert_eq!(all, picture("false"), "the same on a leaf in every frame");
}

#[test]
fn rain_darkens_the_ground_and_its_film_shines_on_leaves() {
    let picture = |moisture: f32, state: u32| {
        let mut bench = bench(|scene| {
            looking_down(scene);
            scene.ground.litter = Some(Litter { moisture, ..Litter::default() });
        });
        bench.draw_world(Drawn { is_level: true, ..Drawn::default() }, state, 60_000, 0.0, 0.0)
    };
    let ground = |moisture: f32| {
        let picture = picture(moisture, 0);
        picture.pixels().map(|pixel| f64::from(green(pixel))).sum::<f64>() / picture.pixels().len() as f64
    };
    let [dry, damp, wet] = [0.0, 1.0, 2.0].map(ground);
    assert!(wet + 1.0 < damp && damp + 1.0 < dry, "brightness of grass: {dry} dry, {damp} damp, {wet} wet");
    let [dry, wet] = [0.0, 2.0].map(|moisture| picture(moisture, STATE_RESTING));
    let seen = differing(&wet, &dry);
    assert!(seen > 30, "{seen} pixels of leaf and ground differ");
}
