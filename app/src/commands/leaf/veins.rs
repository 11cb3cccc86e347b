// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall leaf veins`: what is read from a photo, drawn over it.

use std::path::PathBuf;

use clap::Args;
use glam::Vec2;
use windfall_texgen::{Overlay, Photo};

use crate::files::OutputFile;
use crate::run::parse::png_file;
use crate::run::terminal;

/// Options of `windfall leaf veins`.
#[derive(Clone, Debug, Args)]
pub struct Arguments {
    /// Photo of one leaf.
    #[arg(value_name = "PHOTO")]
    photo: PathBuf,
    /// Mask, light where the leaf is [default: PHOTO's NAME.mask.png, its alpha channel or its plain background].
    #[arg(long, value_name = "FILE")]
    mask: Option<PathBuf>,
    /// Point where the petiole meets the blade, in the photo's pixels, if it is not found.
    #[arg(long, value_name = "X,Y", value_parser = point)]
    root: Option<Vec2>,
    /// Picture to write: outline, root (red), tip (blue), main veins (yellow), lateral veins (orange), petiole
    /// (violet); a bar at the top is as long as root and tip are sure.
    #[arg(long, value_name = "FILE", value_parser = png_file)]
    out: PathBuf,
}

/// Runs the command.
///
/// # Errors
/// A photo or mask that cannot be used, or a file that cannot be written.
pub(crate) fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let beside = arguments.photo.with_extension("mask.png");
    let mask = arguments.mask.clone().or_else(|| beside.is_file().then_some(beside));
    let photo = Photo { path: &arguments.photo, mask: mask.as_deref(), root: arguments.root };
    let extraction = photo.extract()?;
    OutputFile::create(&arguments.out)?.finish_png(Overlay::of(&extraction).image())?;
    for note in &extraction.notes {
        terminal::note(&format!("note: {note}"));
    }
    let blade = &extraction.specimen.blade;
    let ends = |order: u8| {
        let nodes = &extraction.specimen.veins.nodes;
        let mut is_parent = vec![false; nodes.len()];
        nodes.iter().filter_map(|node| node.parent).for_each(|parent| is_parent[parent as usize] = true);
        nodes.iter().zip(is_parent).filter(|(node, is_parent)| node.order == order && !is_parent).count()
    };
    terminal::print(&format!(
        "root {:.0},{:.0}\ntip {:.0},{:.0}\nconfidence {:.2}\nmain veins {}\nlateral veins {}\n{}\n",
        blade.root.x,
        blade.root.y,
        blade.tip.x,
        blade.tip.y,
        blade.confidence,
        ends(1),
        ends(2),
        arguments.out.display(),
    ))
}

/// Reads a point.
fn point(text: &str) -> Result<Vec2, String> {
    let numbers = text.split_once(',').and_then(|(x, y)| Some((x.parse().ok()?, y.parse().ok()?)));
    let point =
        numbers.map(|(x, y)| Vec2::new(x, y)).filter(|p| p.is_finite() && p.abs().max_element() < 1e6);
    point.ok_or_else(|| "allowed: two numbers in pixels, such as 120,340".into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_two_numbers() {
        assert_eq!(point("120,340.5"), Ok(Vec2::new(120.0, 340.5)), "a point");
        for text in ["", "1", "1,", "a,b", "1,2,3", "nan,1", "1e9,1"] {
            assert!(point(text).is_err(), "{text:?} is no point");
        }
    }
}
