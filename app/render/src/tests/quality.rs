// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Pictures of less effort beside full ones.

use image::RgbaImage;
use windfall_core::Scene;
use windfall_core::scene::Focus;

use super::{Bench, bench_in, differing, disc_atlas};
use crate::Quality;
use crate::trees::SceneTrees;

fn bench(quality: Quality, focus: Option<Focus>) -> Bench {
    let mut scene = Scene::default();
    scene.view.lens.focus = focus;
    let atlas = disc_atlas(&scene, 32);
    bench_in(scene, SceneTrees::default(), &atlas, quality)
}

/// Mean difference of two pictures, of 255.
fn apart(a: &RgbaImage, b: &RgbaImage) -> f64 {
    let sum: u64 = a.as_raw().iter().zip(b.as_raw()).map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
    sum as f64 / a.as_raw().len() as f64
}

#[test]
fn less_effort_shows_the_same_things() {
    let full = bench(Quality::Full, None).draw(2, 0.3, 1.5);
    for (quality, most) in [(Quality::Draft, 9.0), (Quality::Plain, 16.0)] {
        let mut bench = bench(quality, None);
        let picture = bench.draw(2, 0.3, 1.5);
        let mean = apart(&full, &picture);
        println!("{}: {mean}", quality.name());
        assert!((0.2..most).contains(&mean), "{}: {mean} of 255 apart on average", quality.name());
        let leaf = differing(&bench.draw(0, 0.3, 1.5), &picture);
        assert!((30..6000).contains(&leaf), "{}: a leaf of {leaf} pixels", quality.name());
    }
}

#[test]
fn drafts_join_without_a_seam_in_tiles_and_end_where_the_picture_does() {
    for focus in [None, Some(Focus { distance_m: 0.5, f_number: 1.0 })] {
        let mut bench = bench(Quality::Draft, focus);
        let whole = bench.draw(2, 0.3, 1.5);
        bench.renderer.set_tile_px(1500).expect("the same size");
        let tiled = bench.draw(2, 0.3, 1.5);
        let (mean, seen) = (apart(&whole, &tiled), differing(&whole, &tiled));
        println!("{focus:?}: {mean} on average, {seen} pixels");
        // Beyond the edge of a tile there are no samples to be averaged with.
        assert!(mean < 0.6, "{focus:?}: {mean} of 255 apart on average");
        // Odd numbers of pixels are shaded beyond the edge.
        let (width, height) = super::SIZE;
        bench.renderer.resize((width - 1, height - 3)).expect("a size within the limits");
        let odd = bench.draw(2, 0.3, 1.5);
        let is_drawn = |x: u32, y: u32| odd.get_pixel(x, y).0[..3].iter().any(|&channel| channel > 8);
        assert!((0..height - 3).all(|y| is_drawn(width - 2, y)), "up to the right edge");
        assert!((0..width - 1).all(|x| is_drawn(x, height - 4)), "down to the last row");
        assert!(!is_drawn(width - 1, 5) && !is_drawn(5, height - 1), "and nothing beyond");
    }
}
