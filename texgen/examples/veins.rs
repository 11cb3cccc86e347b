// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reads leaves from photos and draws what was found: `veins OUT_DIR PHOTO…`; NAME.mask.png beside NAME.png is used.

use std::env;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::Instant;

use windfall_texgen::{Overlay, Photo};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = env::args_os().skip(1).map(PathBuf::from);
    let out = arguments.next().ok_or("usage: veins OUT_DIR PHOTO…")?;
    std::fs::create_dir_all(&out)?;
    for path in arguments {
        let beside = path.with_extension("mask.png");
        let mask: Option<&Path> = if beside.exists() { Some(&beside) } else { None };
        let start = Instant::now();
        let extraction = Photo { path: &path, mask, root: None }.extract()?;
        let elapsed = start.elapsed();
        let blade = &extraction.specimen.blade;
        let laterals = extraction.specimen.veins.nodes.iter().filter(|node| node.order == 2).count();
        println!(
            "{}: confidence {:.2}, root {:.0}, tip {:.0}, {} nodes ({laterals} lateral), {} corners, {:.0?} {:?}",
            path.display(),
            blade.confidence,
            blade.root,
            blade.tip,
            extraction.specimen.veins.nodes.len(),
            blade.outline.len(),
            elapsed,
            extraction.notes,
        );
        let folder =
            path.parent().and_then(Path::file_name).unwrap_or_default().to_string_lossy().into_owned();
        Overlay::of(&extraction)
            .image()
            .save(out.join(format!("{folder}-{}.png", extraction.specimen.name)))?;
    }
    Ok(())
}
