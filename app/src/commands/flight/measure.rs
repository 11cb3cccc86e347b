// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall flight` by itself: drops a piece many times, and reports how it falls.

use std::fmt::Write as _;
use std::path::PathBuf;

use anyhow::bail;
use clap::Args;
use serde::Serialize;

use super::piece::{HEIGHTS_M, PieceArguments, Release};
use super::track_file::TrackFile;
use crate::run::backend::BackendArguments;
use crate::run::cancel::Cancel;
use crate::run::parse::whole;
use crate::run::terminal;
use crate::study::descent::{DescentSummary, DropNumbers, SETTLE_M, Watch};
use crate::study::regime::{PerRegime, Regime};
use crate::study::still_air::Drops;

/// Options of a measurement.
#[derive(Clone, Debug, Args)]
#[command(mut_arg("backend", |arg| arg.help("Where to simulate [default: cpu]")))]
// The command's own options are a group of this name.
#[group(skip)]
pub(super) struct Arguments {
    #[command(flatten)]
    piece: PieceArguments,
    /// Hold of the piece before it is let go.
    #[arg(long, value_name = "HOLD", default_value = "broadside")]
    release: Release,
    /// Height of the release in metres, 0.8 to 50. The first 0.6 m of a drop are not counted.
    #[arg(long, value_name = "METRES", default_value = "1.8", value_parser = height)]
    height: f32,
    /// Number of drops, each with small irregularities of its own.
    #[arg(long, value_name = "N", default_value = "400", value_parser = whole::<u32, 1, 100_000>)]
    drops: u32,
    /// Seed of everything random.
    #[arg(long, value_name = "N", default_value = "1", value_parser = whole::<u64, 0, { u64::MAX }>)]
    seed: u64,
    #[command(flatten)]
    backend: BackendArguments,
    /// Print one JSON object instead of text.
    #[arg(long)]
    json: bool,
    /// Write every step of every drop to this CSV file: place in metres from the point below the release, orientation
    /// (a quaternion that turns the normal, y, and the length, z, into place), velocity in m/s, regime.
    #[arg(long, value_name = "FILE.csv")]
    tracks: Option<PathBuf>,
}

/// Reads a height.
fn height(text: &str) -> Result<f32, String> {
    let number = text.parse().ok().filter(|number| HEIGHTS_M.contains(number));
    number.ok_or_else(|| format!("allowed: {} to {} m", HEIGHTS_M.start(), HEIGHTS_M.end()))
}

/// Report on a falling piece. The names of these fields are the keys of its JSON; they stay.
#[derive(Clone, Debug, Serialize)]
struct Report {
    shape: String,
    size_m: f32,
    areal_density_kg_m2: f32,
    release: &'static str,
    drops: u32,
    mean_descent_m_s: f64,
    sd_between_drops: f64,
    p10_m_s: f64,
    p90_m_s: f64,
    turns_per_s: f64,
    rms_vz_within_drop_m_s: f64,
    mean_horizontal_speed_m_s: f64,
    drift_per_drop_height: f64,
    regimes: PerRegime,
}

/// Runs the command.
///
/// # Errors
/// Bad input, a file that cannot be written, a device that is missing or lost. Then no file has changed.
pub(super) fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let cancel = Cancel::on_interrupt();
    let piece = arguments.piece.load()?.held(arguments.release);
    let mut tracks = arguments.tracks.as_deref().map(TrackFile::create).transpose()?;
    let device = arguments.backend.or_cpu()?;
    let (count, height_m, seed) = (arguments.drops, arguments.height, arguments.seed);
    let drops = Drops { species: &piece.species, count, height_m, seed };
    let mut watches = vec![Watch::new(SETTLE_M); count as usize];
    let aloft = drops.run(&device, &cancel, &mut |drop, sample| {
        watches[drop].add(sample);
        tracks.as_mut().map_or(Ok(()), |tracks| Ok(tracks.add(drop, sample)?))
    })?;
    if aloft > 0 {
        terminal::note(&format!("{aloft} of {count} drops had not landed when they were given up"));
    }
    let numbers: Vec<DropNumbers> = watches.iter().filter_map(Watch::finish).collect();
    let Some(summary) = DescentSummary::of(&numbers) else {
        bail!("no drop fell {SETTLE_M} m and on from there");
    };
    if let Some(tracks) = tracks {
        tracks.finish()?;
    }
    let report = Report {
        shape: piece.name,
        size_m: piece.size_m,
        areal_density_kg_m2: piece.areal_density_kg_m2,
        release: arguments.release.name(),
        drops: count,
        mean_descent_m_s: summary.mean_descent_m_s,
        sd_between_drops: summary.sd_between_drops,
        p10_m_s: summary.p10_m_s,
        p90_m_s: summary.p90_m_s,
        turns_per_s: summary.turns_per_s,
        rms_vz_within_drop_m_s: summary.rms_vz_m_s,
        mean_horizontal_speed_m_s: summary.horizontal_speed_m_s,
        drift_per_drop_height: summary.drift,
        regimes: summary.regimes,
    };
    match arguments.json {
        true => terminal::print(&format!("{}\n", serde_json::to_string(&report)?)),
        false => terminal::print(&report.to_text(height_m)),
    }
}

impl Report {
    /// The report for people.
    fn to_text(&self, height_m: f32) -> String {
        let mut text = String::new();
        let mut row = |name: &str, value: String| {
            // Writing to a String cannot fail.
            let _ = writeln!(text, "{name:<19}{value}");
        };
        let Self { shape, size_m, areal_density_kg_m2, release, drops, .. } = self;
        row("piece", format!("{shape}, {size_m} m, {areal_density_kg_m2} kg/m²"));
        row("drops", format!("{drops}, {release}, from {height_m} m; counted after {SETTLE_M} m"));
        row("descent", format!("{:.3} m/s on average", self.mean_descent_m_s));
        let (low, high) = (self.p10_m_s, self.p90_m_s);
        row(
            "between drops",
            format!("±{:.3} m/s; 8 of 10 from {low:.3} to {high:.3} m/s", self.sd_between_drops),
        );
        row("within a drop", format!("±{:.3} m/s", self.rms_vz_within_drop_m_s));
        row("horizontal speed", format!("{:.3} m/s", self.mean_horizontal_speed_m_s));
        row("drift", format!("{:.3} m for each metre of fall", self.drift_per_drop_height));
        row("turns", format!("{:.2} a second", self.turns_per_s));
        let shares = Regime::ALL.into_iter().zip(self.regimes.to_array());
        let shares = shares.map(|(regime, share)| format!("{} {:.1} %", regime.name(), 100.0 * share));
        row("regimes", shares.collect::<Vec<_>>().join(", "));
        text
    }
}
