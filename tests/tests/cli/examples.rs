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
    let (above, below) = (*picture.get_pixel(320, 4), *picture.get_pixel(320, 350));
    assert!(above[2] > below[2], "sky over meadow: {above:?} and {below:?}");
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
