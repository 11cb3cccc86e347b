// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Writes the packs of small leaves: `cargo run --release -p windfall-texgen --example leaf_packs -- texgen/packs`.

use std::path::PathBuf;
use std::{env, fs};

use windfall_texgen::{LeafPack, Shape};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = PathBuf::from(env::args().nth(1).ok_or("usage: leaf_packs FOLDER")?);
    for (name, shape) in [
        ("maple", Shape::Maple),
        ("japanese-maple", Shape::JapaneseMaple),
        ("oak", Shape::Oak),
        ("birch", Shape::Birch),
        ("beech", Shape::Beech),
        ("hornbeam", Shape::Hornbeam),
        ("linden", Shape::Linden),
        ("ginkgo", Shape::Ginkgo),
    ] {
        let bytes = LeafPack::make(shape)?.to_bytes();
        println!("{name}: {} bytes", bytes.len());
        fs::write(folder.join(name).with_extension("leaves"), bytes)?;
    }
    Ok(())
}
