// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall flight compare`: measured drops and those of the same pieces in the flight model, side by side.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use anyhow::bail;
use clap::Args;
use serde_json::{Map, Value, json};

use super::measured_table::{MeasuredRow, MeasuredTable};
use crate::files::{CsvFile, OutputFile};
use crate::plot::comparison::{self, Pair};
use crate::plot::picture;
use crate::run::backend::{BackendArguments, Device};
use crate::run::cancel::Cancel;
use crate::run::parse::{png_file, whole};
use crate::run::{progress, terminal};
use crate::study::descent::{DescentSummary, SETTLE_M};
use crate::study::figure::{CLOSE, FIGURE_COUNT, Figure, is_close};
use crate::study::regime::Regime;
use crate::study::still_air::Drops;

/// Options of `windfall flight compare`.
///
/// A row of the table is a piece, a release, and what was measured of its drops; columns of other names are skipped, and fields may be
/// empty. The piece: shape (disc, circle, square, hexagon, a kind of leaf, or a CSV file of corners beside the table), size_m or
/// diameter_or_width_m (as --size of windfall flight), areal_density_kg_m2, release (broadside, edge-on, random), height_m [default: 1.8].
/// Means over its drops: mean_descent_m_s, turns_per_s (or projected_area_peaks_per_s, twice as many), rms_vz_within_drop_m_s,
/// mean_horizontal_speed_m_s, drift_per_drop_height, all from 0.6 m below the release on. Rows whose fluid is not air are left out.
#[derive(Clone, Debug, Args)]
#[command(mut_arg("backend", |arg| arg.help("Where to simulate [default: cpu]")))]
pub(super) struct Arguments {
    /// Table of measured drops.
    #[arg(value_name = "FILE.csv")]
    measured: PathBuf,
    /// Drops of each piece.
    #[arg(long, value_name = "N", default_value = "200", value_parser = whole::<u32, 1, 100_000>)]
    drops: u32,
    /// Seed of everything random.
    #[arg(long, value_name = "N", default_value = "1", value_parser = whole::<u64, 0, { u64::MAX }>)]
    seed: u64,
    #[command(flatten)]
    backend: BackendArguments,
    /// Plot of the simulated figures over the measured ones: .png.
    #[arg(long, value_name = "FILE", value_parser = png_file)]
    out: Option<PathBuf>,
    /// Table of both, and of the regimes.
    #[arg(long, value_name = "FILE.csv")]
    table: Option<PathBuf>,
    /// Print one JSON object instead of text.
    #[arg(long)]
    json: bool,
}

/// A measured row, and the same pieces in the flight model.
struct Compared {
    measured: MeasuredRow,
    simulated: DescentSummary,
}

impl Compared {
    /// Measured and simulated values of the figures that were measured.
    fn pairs(&self) -> impl Iterator<Item = (Figure, f64, f64)> {
        let measured = Figure::ALL.into_iter().zip(self.measured.figures);
        measured.filter_map(|(figure, value)| Some((figure, value?, figure.of(&self.simulated))))
    }
}

/// Runs the command.
///
/// # Errors
/// A table that cannot be used, files that cannot be written, a device that is missing or lost. Then no file has changed.
pub(super) fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let cancel = Cancel::on_interrupt();
    let MeasuredTable { rows, left_out } = MeasuredTable::read(&arguments.measured)?;
    let picture = arguments.out.as_deref().map(OutputFile::create).transpose()?;
    let table = arguments.table.as_deref().map(|path| CsvFile::create(path, &header())).transpose()?;
    let device = arguments.backend.or_cpu()?;
    for line in left_out {
        terminal::note(&format!(
            "{}:{line}: left out, for its fluid is not air",
            arguments.measured.display()
        ));
    }
    let bar = progress::bar(rows.len() as u64, "piece");
    let mut compared = Vec::with_capacity(rows.len());
    for measured in rows {
        let simulated = drop_piece(&measured, arguments, &device, &cancel)?;
        compared.push(Compared { measured, simulated });
        bar.inc(1);
    }
    bar.finish_and_clear();
    if let Some(table) = table {
        write_table(table, &compared)?;
    }
    if let Some(file) = picture {
        let name = title(&arguments.measured);
        let pairs: Vec<Pair> = compared
            .iter()
            .flat_map(|row| {
                let release = row.measured.release.name();
                row.pairs().map(move |(figure, measured, simulated)| Pair {
                    figure,
                    release,
                    measured,
                    simulated,
                })
            })
            .collect();
        picture::write(file, comparison::SIZE, |area| {
            comparison::draw(area, &name, arguments.drops, &pairs)
        })?;
    }
    match arguments.json {
        true => terminal::print(&format!("{}\n", to_json(&compared, arguments.drops))),
        false => terminal::print(&to_text(&compared)),
    }
}

/// Name of a table, for people.
fn title(path: &Path) -> String {
    path.file_stem().map_or_else(|| path.display().to_string(), |stem| stem.to_string_lossy().into_owned())
}

/// Drops the piece of a row.
fn drop_piece(
    row: &MeasuredRow,
    arguments: &Arguments,
    device: &Device,
    cancel: &Cancel,
) -> anyhow::Result<DescentSummary> {
    let (count, seed) = (arguments.drops, arguments.seed);
    let drops = Drops { species: &row.piece.species, count, height_m: row.height_m, seed };
    let Some(summary) = drops.summary(SETTLE_M, device, cancel)? else {
        bail!("{}:{}: no drop fell {SETTLE_M} m and on from there", arguments.measured.display(), row.line);
    };
    Ok(summary)
}

/// Columns of the table of both.
fn header() -> Vec<&'static str> {
    let piece = ["line", "shape", "size_m", "areal_density_kg_m2", "release", "height_m"];
    let both = Figure::ALL.into_iter().flat_map(|figure| [figure.measured_column(), figure.column()]);
    piece.into_iter().chain(both).chain(Regime::ALL.map(Regime::name)).collect()
}

/// Writes the table of both.
fn write_table(mut table: CsvFile, compared: &[Compared]) -> anyhow::Result<()> {
    for Compared { measured, simulated } in compared {
        table.field(measured.line).field(&measured.piece.name).field(measured.piece.size_m);
        table
            .field(measured.piece.areal_density_kg_m2)
            .field(measured.release.name())
            .field(measured.height_m);
        for (figure, value) in Figure::ALL.into_iter().zip(measured.figures) {
            match value {
                Some(value) => table.field(value),
                None => table.empty(1),
            };
            table.field(figure.of(simulated));
        }
        simulated.regimes.to_array().into_iter().for_each(|share| _ = table.field(share));
        table.end_row()?;
    }
    Ok(table.finish()?)
}

/// Figures that were measured, and those of them that are met, by kind.
fn counts(compared: &[Compared]) -> [(usize, usize); FIGURE_COUNT] {
    let mut counts = [(0, 0); FIGURE_COUNT];
    for (figure, measured, simulated) in compared.iter().flat_map(Compared::pairs) {
        let (all, met) = &mut counts[figure as usize];
        *all += 1;
        *met += usize::from(is_close(simulated, measured));
    }
    counts
}

/// Both as text: simulated / measured.
fn to_text(compared: &[Compared]) -> String {
    let mut text = format!("{:<34}{:<11}", "piece", "release");
    for figure in Figure::ALL {
        // Writing to a String cannot fail.
        let _ = write!(text, "{:>15}", figure.short_title());
    }
    text.push('\n');
    for row in compared {
        let piece = &row.measured.piece;
        let name = format!("{}, {} m, {} kg/m²", piece.name, piece.size_m, piece.areal_density_kg_m2);
        let _ = write!(text, "{name:<34}{:<11}", row.measured.release.name());
        for (figure, measured) in Figure::ALL.into_iter().zip(row.measured.figures) {
            let simulated = figure.of(&row.simulated);
            let both = match measured {
                Some(measured) => format!("{simulated:.2} / {measured:.2}"),
                None => format!("{simulated:.2} /    –"),
            };
            let _ = write!(text, "{both:>15}");
        }
        text.push('\n');
    }
    let counts = counts(compared);
    let (all, met) = counts.iter().fold((0, 0), |sum, count| (sum.0 + count.0, sum.1 + count.1));
    let parts = Figure::ALL.into_iter().zip(counts).filter(|(_, (all, _))| *all > 0);
    let parts: Vec<_> =
        parts.map(|(figure, (all, met))| format!("{} {met} of {all}", figure.short_title())).collect();
    let _ = writeln!(
        text,
        "simulated / measured; {met} of {all} figures within {:.0} %: {}",
        100.0 * CLOSE,
        parts.join(", ")
    );
    text
}

/// Both as one object. The names of these fields stay.
fn to_json(compared: &[Compared], drops: u32) -> Value {
    let rows: Vec<_> = compared
        .iter()
        .map(|Compared { measured, simulated }| {
            let of = |value: &dyn Fn(Figure) -> Value| -> Map<String, Value> {
                Figure::ALL.into_iter().map(|figure| (figure.column().to_owned(), value(figure))).collect()
            };
            json!({
                "line": measured.line,
                "shape": measured.piece.name,
                "size_m": measured.piece.size_m,
                "areal_density_kg_m2": measured.piece.areal_density_kg_m2,
                "release": measured.release.name(),
                "height_m": measured.height_m,
                "measured": of(&|figure| json!(measured.figures[figure as usize])),
                "simulated": of(&|figure| json!(figure.of(simulated))),
                "regimes": simulated.regimes,
            })
        })
        .collect();
    let counts = counts(compared);
    let (all, met) = counts.iter().fold((0, 0), |sum, count| (sum.0 + count.0, sum.1 + count.1));
    json!({ "drops": drops, "figures": all, "within_a_quarter": met, "rows": rows })
}
