// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Makes a few leaves and tells how long each step takes: `make OUT_DIR SIZE COUNT SEASON SHAPE [PHOTO…]`.
//!
//! SHAPE is the index of a shape (0 to 7), or `-` for leaves like those of the photos. NAME.mask.png beside a photo
//! NAME.png is used.

use std::env;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::Instant;

use windfall_texgen::{LeafMaker, MakeOptions, Photo, Shape};

fn main() -> Result<(), Box<dyn Error>> {
    let usage = "usage: make OUT_DIR SIZE COUNT SEASON SHAPE [PHOTO…]";
    let arguments: Vec<String> = env::args().skip(1).collect();
    let [out, size, count, season, shape, photos @ ..] = arguments.as_slice() else {
        return Err(usage.into());
    };
    let out = PathBuf::from(out);
    std::fs::create_dir_all(&out)?;
    let options = MakeOptions { size_px: size.parse()?, season: Some(season.parse()?), seed: 1 };
    let shape = match shape.as_str() {
        "-" => None,
        index => Some(*Shape::ALL.get(index.parse::<usize>()?).ok_or(usage)?),
    };
    let start = Instant::now();
    let maker = match (shape, photos) {
        (Some(shape), []) => LeafMaker::of_shape(shape, options)?,
        (shape, photos) => {
            let mut read = Vec::new();
            for path in photos.iter().map(Path::new) {
                let beside = path.with_extension("mask.png");
                let mask: Option<&Path> = if beside.exists() { Some(&beside) } else { None };
                read.push(Photo { path, mask, root: None }.extract()?);
            }
            LeafMaker::of_photos(&read, shape, options)?
        }
    };
    println!("examples studied in {:.2?}", start.elapsed());
    for number in 0..count.parse()? {
        let start = Instant::now();
        let leaf = maker.make(number, number == 0)?;
        println!("{} in {:.2?}, {:?}", leaf.facts.name, start.elapsed(), leaf.facts);
        let save = |ending: &str| out.join(format!("{}.{ending}", leaf.facts.name));
        leaf.maps.albedo.save(save("png"))?;
        leaf.maps.normal.save(save("normal.png"))?;
        leaf.maps.height.save(save("height.png"))?;
        leaf.maps.translucency.save(save("translucency.png"))?;
        leaf.maps.mask.save(save("mask.png"))?;
        for stage in &leaf.stages {
            stage.picture.save(save(&format!("stage-{}.png", stage.name)))?;
        }
    }
    Ok(())
}
