// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall flight diagram`: how discs of many sizes and masses fall, beside what was measured.

use std::path::PathBuf;

use clap::Args;
use windfall_core::motion::AIR_DENSITY;
use windfall_core::scene::limits::{AREAL_DENSITY_KG_M2, SIZE_M};

use super::piece::{Piece, Release};
use crate::files::OutputFile;
use crate::plot::picture;
use crate::plot::regime_diagram::{self, Spot};
use crate::run::backend::BackendArguments;
use crate::run::cancel::Cancel;
use crate::run::parse::{png_file, whole};
use crate::run::terminal;
use crate::study::regime::Regime;
use crate::study::still_air::Drops;

/// Kinematic viscosity of air at 20 °C in m²/s.
const VISCOSITY_M2_S: f64 = 1.5e-5;
/// Columns and rows of discs.
const GRID: (u32, u32) = (12, 13);
/// Aimed Reynolds numbers of the first and the last column.
const REYNOLDS: (f64, f64) = (80.0, 24_000.0);
/// Dimensionless moments of inertia of the first and the last row.
const INERTIA: (f64, f64) = (0.002, 0.2);
/// Speed of descent in m/s that a disc of 1 kg/m² is aimed with: 0.757 m/s at 70 g/m².
const AIMED_M_S: f64 = 2.861;
/// Height of a release in m, and what is added to it for every metre of diameter: a large disc takes its time.
const HEIGHT_M: (f64, f64) = (2.0, 80.0);
/// Share of the height after which a drop counts.
const SETTLED: f64 = 0.5;

/// Options of `windfall flight diagram`.
///
/// Discs are let go any way round. Each is a pie at its Reynolds number, descent times diameter over viscosity, and its
/// dimensionless moment of inertia, pi/64 of mass per area over density of air times diameter; slices are the shares of
/// drops by regime. Lines and tints are the boundaries that Field and others measured in 1997.
#[derive(Clone, Debug, Args)]
pub(super) struct Arguments {
    /// File to write: .png.
    #[arg(long, value_name = "FILE", value_parser = png_file)]
    out: PathBuf,
    /// Drops of each disc.
    #[arg(long, value_name = "N", default_value = "40", value_parser = whole::<u32, 1, 10_000>)]
    drops: u32,
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
    let mut spots = Vec::new();
    for row in 0..GRID.1 {
        for column in 0..GRID.0 {
            let inertia = between(INERTIA, row, GRID.1);
            let reynolds = between(REYNOLDS, column, GRID.0);
            spots
                .extend(disc(inertia, reynolds).map(|(size_m, density)| {
                    spot(size_m, density, arguments.drops, arguments.seed, &cancel)
                }));
        }
    }
    let spots: Vec<Spot> =
        spots.into_iter().collect::<anyhow::Result<Vec<_>>>()?.into_iter().flatten().collect();
    picture::write(file, regime_diagram::SIZE, |area| regime_diagram::draw(area, arguments.drops, &spots))?;
    let counts =
        Regime::ALL.map(|regime| (regime, spots.iter().filter(|spot| spot.prevailing() == regime).count()));
    let counts = counts.map(|(regime, count)| format!("{} {count}", regime.name())).join(", ");
    terminal::print(&format!("{}: {} discs; {counts}\n", arguments.out.display(), spots.len()))
}

/// A number of a row of numbers, each the same multiple of the last.
fn between((low, high): (f64, f64), index: u32, count: u32) -> f64 {
    low * (high / low).powf(f64::from(index) / f64::from(count - 1))
}

/// Size in m and mass per area in kg/m² of a disc, if it may be so.
fn disc(inertia: f64, reynolds: f64) -> Option<(f32, f32)> {
    // Descent grows with the root of mass per area, which for this moment of inertia grows with size.
    let density_per_size = 64.0 * AIR_DENSITY * inertia / std::f64::consts::PI;
    let size = (reynolds * VISCOSITY_M2_S / (AIMED_M_S * density_per_size.sqrt())).powf(2.0 / 3.0);
    #[expect(clippy::cast_possible_truncation, reason = "scenes hold single precision")]
    let (size_m, density) = (size as f32, (density_per_size * size) as f32);
    (SIZE_M.contains(size_m) && AREAL_DENSITY_KG_M2.contains(density)).then_some((size_m, density))
}

/// Drops a disc.
fn spot(size_m: f32, density: f32, count: u32, seed: u64, cancel: &Cancel) -> anyhow::Result<Option<Spot>> {
    let piece = Piece::flat("disc", size_m, density)?.held(Release::Random);
    let size = f64::from(size_m);
    let height = HEIGHT_M.0 + HEIGHT_M.1 * size;
    #[expect(clippy::cast_possible_truncation, reason = "scenes hold single precision")]
    let drops = Drops { species: &piece.species, count, height_m: height as f32, seed };
    let summary = drops.summary(SETTLED * height, &BackendArguments::default().cpu(), cancel)?;
    Ok(summary.map(|summary| Spot {
        reynolds: summary.mean_descent_m_s * size / VISCOSITY_M2_S,
        inertia: std::f64::consts::PI * f64::from(density) / (64.0 * AIR_DENSITY * size),
        shares: summary.regimes.to_array(),
    }))
}
