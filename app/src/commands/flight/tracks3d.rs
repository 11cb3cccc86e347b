// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall flight tracks3d`: single drops as one sees them.

use std::path::PathBuf;

use clap::Args;

use super::piece::{Piece, Release};
use crate::files::OutputFile;
use crate::plot::drop_paths::{self, Track};
use crate::plot::picture;
use crate::run::backend::BackendArguments;
use crate::run::cancel::Cancel;
use crate::run::parse::{png_file, whole};
use crate::run::terminal;
use crate::study::still_air::Drops;

/// Height of the releases in m.
const HEIGHT_M: f32 = 1.8;
/// Discs of paper of 70 g/m², by diameter in m, and how they are held.
const DISCS: [(f32, Release); 4] = [
    (0.035, Release::EdgeOn),
    (0.055, Release::EdgeOn),
    (0.078, Release::Broadside),
    (0.2, Release::Broadside),
];
/// Leaves, let go any way round.
const LEAVES: [&str; 8] =
    ["maple", "oak", "birch", "beech", "linden", "ginkgo", "japanese-maple", "hornbeam"];

/// Options of `windfall flight tracks3d`.
///
/// Four discs of paper and a leaf of each kind are dropped once, from 1.8 m, and drawn every twentieth of a second; the
/// colour of a path is the regime, its grey twin the path of the shadow. Each is turned so that it drifts to the right.
#[derive(Clone, Debug, Args)]
pub(super) struct Arguments {
    /// File to write: .png.
    #[arg(long, value_name = "FILE", value_parser = png_file)]
    out: PathBuf,
    /// Seed of everything random.
    #[arg(long, value_name = "N", default_value = "1", value_parser = whole::<u64, 0, { u64::MAX }>)]
    seed: u64,
}

/// Runs the command.
///
/// # Errors
/// A file that cannot be written, or an interruption; then nothing has changed.
pub(super) fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let cancel = Cancel::on_interrupt();
    let file = OutputFile::create(&arguments.out)?;
    let mut tracks = Vec::new();
    for (size_m, release) in DISCS {
        let piece = Piece::flat("disc", size_m, 0.07)?.held(release);
        let name = format!("disc, {:.1} cm", 100.0 * size_m);
        tracks.push(track(&piece, name, arguments.seed, &cancel)?);
    }
    for name in LEAVES {
        let piece = Piece::leaf(name, None, None)?.held(Release::Random);
        let name = format!("{}, {:.1} cm", name.replace('-', " "), 100.0 * piece.size_m);
        tracks.push(track(&piece, name, arguments.seed, &cancel)?);
    }
    picture::write(file, drop_paths::SIZE, |area| drop_paths::draw(area, &tracks))?;
    let last = |track: &Track| track.samples.last().map_or("none", |sample| sample.regime.name());
    let ends: Vec<_> = tracks.iter().map(|track| format!("{} {}", track.name, last(track))).collect();
    terminal::print(&format!("{}: {} drops; {}\n", arguments.out.display(), tracks.len(), ends.join("; ")))
}

/// Drops a piece once.
fn track(piece: &Piece, name: String, seed: u64, cancel: &Cancel) -> anyhow::Result<Track> {
    let mut samples = Vec::new();
    let drops = Drops { species: &piece.species, count: 1, height_m: HEIGHT_M, seed };
    drops.run(&BackendArguments::default().cpu(), cancel, &mut |_, sample| {
        samples.push(*sample);
        Ok(())
    })?;
    let planform = piece.planform();
    let reach = 0.5 * f64::from(piece.species.size_m) * f64::from(planform.extent);
    let stretch = f64::from(planform.aspect).sqrt();
    Ok(Track { name, half_axes_m: [reach * stretch, reach / stretch], samples })
}
