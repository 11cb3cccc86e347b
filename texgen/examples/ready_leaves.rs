// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Makes the small leaves that come with the program: `cargo run --release -p windfall-texgen --example ready_leaves -- texgen/ready`.

use std::path::PathBuf;
use std::{env, fs};

use windfall_texgen::{ReadyFiles, Shape};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = PathBuf::from(env::args().nth(1).ok_or("usage: ready_leaves FOLDER")?);
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
        let files = ReadyFiles::make(shape)?;
        println!("{name}: {} bytes of pictures, {} of meshes", files.sheet.len(), files.forms.len());
        fs::write(folder.join(name).with_extension("png"), files.sheet)?;
        fs::write(folder.join(name).with_extension("forms"), files.forms)?;
    }
    Ok(())
}
