// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall tree export`: a tree as a glTF file.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use serde::Serialize;
use windfall_core::scene::TreePreset;
use windfall_core::tree::gltf::{GltfLook, to_glb, to_gltf};
use windfall_core::tree::{BarkDetail, bark_mesh};

use super::source::TreeArguments;
use crate::files::{OutputFile, WriteError};
use crate::run::cancel::Cancel;
use crate::run::terminal;

/// Detail of the bark.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Detail {
    /// Every twig, for close views.
    Full,
    /// Without the thinnest twigs.
    Middle,
    /// Trunk and limbs, for far views.
    Far,
}

/// Options of `windfall tree export`.
#[derive(Clone, Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    tree: TreeArguments,
    /// File to write: .glb, or .gltf with everything in it.
    #[arg(long, value_name = "FILE", value_parser = gltf_file)]
    out: PathBuf,
    /// Detail of the bark.
    #[arg(long, value_name = "DETAIL", default_value = "full")]
    detail: Detail,
    /// Put wind weights into the vertex colours too, for engines that look for them there. Other programs tint the bark
    /// with them.
    #[arg(long)]
    wind_colors: bool,
    /// Print the outcome as one line of JSON.
    #[arg(long)]
    json: bool,
}

/// The outcome. The names of these fields are the keys of its JSON; they stay.
#[derive(Debug, Serialize)]
struct Report {
    file: String,
    bytes: usize,
    joints: usize,
    attachments: usize,
    vertices: usize,
    triangles: usize,
}

/// Runs the command.
///
/// # Errors
/// A tree that cannot be had, or a file that cannot be written; then nothing has changed.
pub(crate) fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let cancel = Cancel::on_interrupt();
    let mut file = OutputFile::create(&arguments.out)?;
    let tree = arguments.tree.load()?;
    let mesh = bark_mesh(&tree.skeleton, arguments.detail.into());
    let look = GltfLook {
        name: tree.name,
        bark_color: tree.preset.map_or(GltfLook::default().bark_color, bark_color),
        has_wind_colors: arguments.wind_colors,
        ..GltfLook::default()
    };
    let bytes = match has_ending(&arguments.out, "glb") {
        true => to_glb(&tree.skeleton, &mesh, &look),
        false => to_gltf(&tree.skeleton, &mesh, &look).into_bytes(),
    };
    cancel.check()?;
    file.write_all(&bytes).map_err(WriteError::at(&arguments.out))?;
    file.finish()?;
    let report = Report {
        file: arguments.out.display().to_string(),
        bytes: bytes.len(),
        joints: tree.skeleton.segments.len(),
        attachments: tree.skeleton.attachments.len(),
        vertices: mesh.positions_m.len(),
        triangles: mesh.triangle_count(),
    };
    let text = if arguments.json { serde_json::to_string(&report)? } else { report.file };
    terminal::print(&(text + "\n"))
}

impl From<Detail> for BarkDetail {
    fn from(detail: Detail) -> Self {
        match detail {
            Detail::Full => Self::Full,
            Detail::Middle => Self::Middle,
            Detail::Far => Self::Far,
        }
    }
}

/// Colour of the bark, linear.
fn bark_color(preset: TreePreset) -> [f32; 3] {
    match preset {
        TreePreset::Maple => [0.16, 0.125, 0.095],
        TreePreset::Birch => [0.6, 0.57, 0.52],
        TreePreset::Oak => [0.105, 0.08, 0.06],
        TreePreset::Bush => [0.13, 0.1, 0.07],
        TreePreset::Weed => [0.12, 0.17, 0.05],
        TreePreset::BerryBush => [0.15, 0.09, 0.06],
    }
}

/// Reads the name of a glTF file on the command line.
fn gltf_file(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let is_gltf = has_ending(&path, "glb") || has_ending(&path, "gltf");
    if is_gltf { Ok(path) } else { Err("allowed: a file name that ends in .glb or .gltf".into()) }
}

fn has_ending(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|found| found.eq_ignore_ascii_case(ending))
}
