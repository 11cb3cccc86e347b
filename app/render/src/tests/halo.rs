// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves have no halo: along their edge they are as they are inside, whatever lies behind.

use windfall_core::Scene;
use windfall_core::scene::{Exposure, Haze, ToneMap};
use windfall_texgen::{Assortment, Atlas, Layer, Shape};

use super::bench_of;
use crate::trees::SceneTrees;
use crate::with_shader_edit;

/// State of a falling leaf.
const FALLING: u32 = 2;
/// Light of the white ground in kcd/m², which becomes white in the picture.
const WHITE: f32 = 10.0;

/// The scene: a leaf before the sky, in pictures proportional to light.
fn scene() -> Scene {
    let mut scene = Scene::default();
    // The leaf hangs 6 m before the target, a metre from the eye and above the horizon.
    scene.view.camera.eye_m = [0.0, 60.0, 7.0].into();
    scene.view.camera.target_m = [0.0, 60.25, 0.0].into();
    scene.view.lens.tone_map = ToneMap::Linear { gamma: 1.0 };
    scene.view.lens.exposure = Exposure::Manual { ev100: (1000.0 * WHITE / 1.2).log2() };
    scene.view.lens.glare.strength = 0.0;
    scene.view.lens.vignette = 0.0;
    scene.view.lens.saturation = 1.0;
    scene.view.haze = Haze { visibility_m: 100_000.0, ..scene.view.haze };
    scene
}

/// Light of the edge relative to that inside, by colour.
fn edge_against_inside(atlas: &Atlas) -> [f32; 3] {
    let draw = |backdrop: f32| {
        let sky = "    let clear = sky_radiance(direction);";
        let plain = format!("    if true {{ return vec4(vec3({backdrop:?}), 1.0); }}\n{sky}");
        let mut bench = with_shader_edit(sky, &plain, || bench_of(scene(), SceneTrees::default(), atlas));
        (bench.draw(FALLING, 0.0, 0.0), bench.draw(0, 0.0, 0.0))
    };
    let ((black, _), (white, without)) = (draw(0.0), draw(WHITE));
    let (mut inside, mut edge) = (([0.0f32; 3], 0.0f32), ([0.0f32; 3], 0.0f32));
    for ((dark, light), free) in black.pixels().zip(white.pixels()).zip(without.pixels()) {
        if free.0.iter().any(|&channel| channel < 250) {
            continue;
        }
        let (dark, light) = (dark.0.map(f32::from), light.0.map(f32::from));
        // What is not covered shows the ground.
        let open = (0..3).map(|c| (light[c] - dark[c]) / 255.0).sum::<f32>() / 3.0;
        let cover = 1.0 - open;
        let (sum, count) = match cover {
            cover if cover > 0.99 => &mut inside,
            cover if (0.2..0.9).contains(&cover) => &mut edge,
            _ => continue,
        };
        for (sum, dark) in sum.iter_mut().zip(dark) {
            *sum += dark;
        }
        *count += cover;
    }
    println!("{} px inside, {} px of edge", inside.1, edge.1);
    assert!(inside.1 > 100.0 && edge.1 > 20.0, "a leaf with an edge: {inside:?} {edge:?}");
    std::array::from_fn(|c| (edge.0[c] / edge.1) / (inside.0[c] / inside.1))
}

/// A made leaf of each of the scene's species.
fn atlas() -> Atlas {
    let assortment = Assortment { shape: Shape::Maple, season: (0.7, 0.7), count: 1, size_px: 128, seed: 3 };
    let folder = assortment.make(|| {}).expect("a leaf");
    let layer = Layer::of_leaf(&folder.leaves[0], 128);
    Atlas { size_px: 128, variants: 1, layers: vec![layer; scene().species.len()] }
}

#[test]
fn a_leaf_has_no_halo() {
    let atlas = atlas();
    let share = edge_against_inside(&atlas);
    assert!(share.iter().all(|share| (0.75..1.25).contains(share)), "as inside: {share:?}");

    // As it would be if the pictures had white or black ground that their edges take a part of.
    let painted = "blade_color(image.rgb, in.tint_open.rgb)";
    for (ground, sign) in [("vec3(1.0)", 1.0), ("vec3(0.0)", -1.0)] {
        let haloed = format!(
            "blade_color(mix({ground}, image.rgb, clamp(2.0 * image.a - 1.0, 0.0, 1.0)), in.tint_open.rgb)"
        );
        let share = with_shader_edit(painted, &haloed, || edge_against_inside(&atlas));
        let is_seen = share.iter().any(|share| sign * (share - 1.0) > 0.25);
        assert!(is_seen, "a halo of {ground} is noticed: {share:?}");
    }
}
