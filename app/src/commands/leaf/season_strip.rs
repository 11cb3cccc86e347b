// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall leaf season-strip`: one leaf through its autumn, as a picture.

use std::path::PathBuf;

use clap::Args;
use windfall_texgen::season;

use super::make::Species;
use crate::files::OutputFile;
use crate::run::parse::png_file;
use crate::run::parse::whole;

/// Options of `windfall leaf season-strip`.
#[derive(Clone, Debug, Args)]
pub struct Arguments {
    /// Kind of leaf.
    #[arg(value_name = "SPECIES")]
    species: Species,
    /// Seed of the leaf.
    #[arg(long, value_name = "N", default_value = "1", value_parser = whole::<u64, 0, { u64::MAX }>)]
    seed: u64,
    /// Number of leaves from green to brown.
    #[arg(long, value_name = "N", default_value = "6", value_parser = whole::<u32, 2, 64>)]
    steps: u32,
    /// Edge of each leaf's picture in pixels.
    #[arg(long, value_name = "PX", default_value = "256", value_parser = whole::<u32, 16, 2048>)]
    size: u32,
    /// PNG to write.
    #[arg(long, value_name = "FILE", value_parser = png_file)]
    out: PathBuf,
}

/// Runs the command.
///
/// # Errors
/// Numbers that do not go together, or whatever keeps the file from being written.
pub(crate) fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let sheet = season::strip(arguments.species.shape(), arguments.steps, arguments.size, arguments.seed)?;
    Ok(OutputFile::create(&arguments.out)?.finish_png(&sheet)?)
}
