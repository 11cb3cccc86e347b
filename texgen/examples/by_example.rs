// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Paints every leaf of some photos in the manner of the others: `by_example OUT_DIR SCALE PHOTO…`.
//!
//! NAME.mask.png beside NAME.png is used. Each blade is enlarged by SCALE and painted from all photos but its own;
//! the intermediate pictures of the first lie in OUT_DIR/stages.

use std::env;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::Instant;

use windfall_texgen::{Blade, Mask, Painter, Photo, Specimen, VeinGraph};

fn main() -> Result<(), Box<dyn Error>> {
    let usage = "usage: by_example OUT_DIR SCALE PHOTO…";
    let mut arguments = env::args_os().skip(1).map(PathBuf::from);
    let out = arguments.next().ok_or(usage)?;
    let scale: f32 = arguments.next().and_then(|text| text.to_str()?.parse().ok()).ok_or(usage)?;
    let mut specimens = Vec::new();
    for path in arguments {
        let beside = path.with_extension("mask.png");
        let mask: Option<&Path> = if beside.exists() { Some(&beside) } else { None };
        specimens.push(Photo { path: &path, mask, root: None }.extract()?.specimen);
    }
    let stages = out.join("stages");
    std::fs::create_dir_all(&stages)?;
    for index in 0..specimens.len() {
        let others: Vec<Specimen> =
            (0..specimens.len()).filter(|i| *i != index).map(|i| specimens[i].clone()).collect();
        let start = Instant::now();
        let painter = Painter::new(if others.is_empty() { &specimens } else { &others })?;
        let studied = start.elapsed();
        let (blade, veins) = enlarged(&specimens[index], scale);
        let start = Instant::now();
        let painted = painter.paint(&blade, &veins, 7 + index as u64, index == 0)?;
        println!(
            "{}: {}x{} px, studied in {studied:.0?}, painted in {:.0?}",
            specimens[index].name,
            blade.mask.width,
            blade.mask.height,
            start.elapsed()
        );
        let mut picture = painted.colour;
        for (pixel, inside) in picture.pixels_mut().zip(&blade.mask.inside) {
            if !inside {
                pixel.0 = [255; 3];
            }
        }
        picture.save(out.join(format!("{}.png", specimens[index].name)))?;
        for stage in &painted.stages {
            stage.picture.save(stages.join(format!("{}.png", stage.name)))?;
        }
    }
    Ok(())
}

/// A specimen's blade and veins with `scale` times as many pixels a side.
fn enlarged(specimen: &Specimen, scale: f32) -> (Blade, VeinGraph) {
    let old = &specimen.blade;
    let side = |pixels: u32| (f64::from(pixels) * f64::from(scale)) as u32;
    let mut mask = Mask::empty(side(old.mask.width), side(old.mask.height));
    for y in 0..mask.height {
        for x in 0..mask.width {
            let at = |i: u32| ((f64::from(i) + 0.5) / f64::from(scale)) as i32;
            mask.inside[(y * mask.width + x) as usize] = old.mask.contains(at(x), at(y));
        }
    }
    let blade = Blade {
        mask,
        outline: old.outline.iter().map(|p| *p * scale).collect(),
        root: old.root * scale,
        tip: old.tip * scale,
        confidence: old.confidence,
    };
    let mut veins = specimen.veins.clone();
    for node in &mut veins.nodes {
        node.position *= scale;
        node.radius *= scale;
    }
    (blade, veins)
}
