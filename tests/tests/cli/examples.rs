// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The examples of the library, run for a few steps each.

#[path = "../../../app/examples/custom_backend.rs"]
#[allow(dead_code, reason = "an example's own main")]
mod custom_backend;
#[path = "../../../app/examples/custom_wind.rs"]
#[allow(dead_code, reason = "an example's own main")]
mod custom_wind;
#[path = "../../../app/render/examples/draw_scene.rs"]
#[allow(dead_code, reason = "an example's own main")]
mod draw_scene;
#[path = "../../../app/examples/embed.rs"]
#[allow(dead_code, reason = "an example's own main")]
mod embed;
#[path = "../../../app/examples/headless.rs"]
#[allow(dead_code, reason = "an example's own main")]
mod headless;

use windfall_core::World;

#[test]
fn a_simulation_without_a_window_prints_where_leaves_are() {
    let height_m = headless::run(30).expect("it runs");
    assert!((1.0..10.0).contains(&height_m), "leaves fall from crowns: {height_m} m");
}

#[test]
fn leaves_are_drawn_by_another_program() {
    let picture = embed::run(3).expect("it runs");
    let sky = *picture.get_pixel(0, 0);
    let leaves = picture.pixels().filter(|pixel| **pixel != sky).count();
    assert!(leaves > 500, "leaves cover {leaves} pixels");
    assert!(picture.pixels().any(|pixel| pixel[0] > 100 && pixel[2] < 60), "and are red or yellow");
}

#[test]
fn a_whole_scene_is_drawn_into_another_programs_texture() {
    let picture = draw_scene::run(2).expect("it runs");
    let blue = |rows: std::ops::Range<u32>| {
        let count = rows.len() as f64 * f64::from(picture.width());
        let pixels = rows.flat_map(|y| (0..picture.width()).map(move |x| (x, y)));
        pixels.map(|(x, y)| f64::from(picture.get_pixel(x, y)[2])).sum::<f64>() / count
    };
    let (above, below) = (blue(0..picture.height() / 2), blue(picture.height() / 4 * 3..picture.height()));
    assert!(above > 1.2 * below, "sky between crowns over a meadow: {above} and {below} of blue");
    let colors: std::collections::BTreeSet<[u8; 4]> = picture.pixels().map(|pixel| pixel.0).collect();
    assert!(colors.len() > 2000, "trees, grass and leaves: {} colours", colors.len());
}

#[test]
fn a_wind_of_ones_own_carries_leaves_on_both_backends() {
    let world = custom_wind::run(180).expect("it runs");
    let higher = |world: &World| world.leaves.place.iter().filter(|place| place.position[1] > 9.5).count();
    assert!(higher(&world) > 20, "{} leaves rise", higher(&world));
}

#[test]
fn a_backend_of_ones_own_passes_the_suite() {
    custom_backend::run(200).expect("it passes");
}
