// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall tree shedding`: how many leaves a crown loses in which wind and season, as a plot.

use std::path::PathBuf;

use anyhow::bail;
use clap::Args;
use windfall_core::Scene;
use windfall_core::scene::TreePreset;

use crate::files::OutputFile;
use crate::plot::{picture, shedding};
use crate::run::cancel::Cancel;
use crate::run::parse::{png_file, whole};
use crate::run::terminal;
use crate::study::shedding::{Crown, Season};

/// Times of the year that are drawn.
const SEASONS: [f32; 5] = [0.0, 0.3, 0.45, 0.6, 0.75];

/// Options of `windfall tree shedding`.
///
/// Curves are the model of the petioles, in a steady wind. Marks are simulations of one crown: filled in a steady wind,
/// hollow in gusts and turbulence about the same mean. Their bars are the standard error of counting.
#[derive(Clone, Debug, Args)]
pub struct Arguments {
    /// Kind of tree: maple, birch, oak, bush, weed, berry-bush.
    #[arg(value_name = "KIND")]
    kind: String,
    /// File to write: .png.
    #[arg(long, value_name = "FILE", value_parser = png_file)]
    out: PathBuf,
    /// Minutes over which shedding is averaged, and that every mark simulates, 1 to 60.
    #[arg(long, value_name = "N", default_value = "5", value_parser = whole::<u32, 1, 60>)]
    minutes: u32,
    /// Leaves that are simulated one by one; each stands for several if the crown has more.
    #[arg(long, value_name = "N", default_value = "3000", value_parser = whole::<u32, 1, 200_000>)]
    leaves: u32,
    /// Seed of everything random.
    #[arg(long, value_name = "N", default_value = "1", value_parser = whole::<u64, 0, { u64::MAX }>)]
    seed: u64,
}

/// Runs the command.
///
/// # Errors
/// An unknown kind, or a file that cannot be written; then nothing has changed.
pub(crate) fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let cancel = Cancel::on_interrupt();
    let Some(preset) = TreePreset::named(&arguments.kind) else {
        let kinds = TreePreset::ALL.map(TreePreset::name).join(", ");
        bail!("tree '{}': allowed: a kind ({kinds})", arguments.kind.escape_debug());
    };
    let file = OutputFile::create(&arguments.out)?;
    let mut seasons = Vec::with_capacity(SEASONS.len());
    // A wood has leaves of every kind.
    let wood = Scene::preset("forest").expect("a scene that travels in the program");
    for autumn in SEASONS {
        let crown = Crown::new(&wood, preset, arguments.leaves, arguments.seed, autumn)?;
        seasons.push(Season::of(&crown, arguments.minutes, &cancel)?);
    }
    cancel.check()?;
    picture::write(file, shedding::SIZE, |area| {
        shedding::draw(area, preset.name(), arguments.minutes, &seasons)
    })?;
    let marks: usize = seasons.iter().map(|season| season.marks.len()).sum();
    let out = arguments.out.display();
    terminal::print(&format!("{out}: {} seasons, {marks} simulations that shed leaves\n", seasons.len()))
}
