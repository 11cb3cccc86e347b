// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall flight diagram`: how discs and strips of many sizes and masses fall, beside what was measured.

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
use crate::study::descent::DescentSummary;
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
/// Width of strips in m.
const STRIP_WIDTH_M: f64 = 0.06;
/// Lengths of strips over their width.
const STRIP_ASPECTS: [f64; 4] = [2.0, 4.5, 7.0, 9.5];
/// Froude numbers of the first and the last column of strips, and the number of columns.
const STRIP_FROUDE: (f64, f64) = (0.3, 1.7);
const STRIP_COLUMNS: u32 = 15;
/// Share of the height after which a drop counts.
const SETTLED: f64 = 0.5;

/// Options of `windfall flight diagram`.
///
/// Discs are let go any way round. Each is a pie at its Reynolds number, descent times diameter over viscosity, and its
/// dimensionless moment of inertia, pi/64 of mass per area over density of air times diameter; slices are the shares of
/// drops by regime. Lines and tints are the boundaries that Field and others measured in 1997. Below are strips by
/// their Froude number, the root of mass per area over density of air times width, at whose 0.67 Belmonte and others
/// (1998) found that strips which cannot turn aside begin to tumble.
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
    let mut discs = Vec::new();
    for row in 0..GRID.1 {
        for column in 0..GRID.0 {
            let inertia = between(INERTIA, row, GRID.1);
            let reynolds = between(REYNOLDS, column, GRID.0);
            if let Some((size_m, density)) = disc(inertia, reynolds) {
                discs.extend(dropped_disc(size_m, density, arguments, &cancel)?);
            }
        }
    }
    let mut strips = Vec::new();
    for aspect in STRIP_ASPECTS {
        for column in 0..STRIP_COLUMNS {
            let share = f64::from(column) / f64::from(STRIP_COLUMNS - 1);
            let froude = STRIP_FROUDE.0 + share * (STRIP_FROUDE.1 - STRIP_FROUDE.0);
            strips.extend(dropped_strip(froude, aspect, arguments, &cancel)?);
        }
    }
    picture::write(file, regime_diagram::SIZE, |area| {
        regime_diagram::draw(area, arguments.drops, &discs, &strips)
    })?;
    let counts = |spots: &[Spot]| {
        let count = |regime| spots.iter().filter(|spot| spot.prevailing() == regime).count();
        Regime::ALL.map(|regime| format!("{} {}", regime.name(), count(regime))).join(", ")
    };
    terminal::print(&format!(
        "{}: {} discs; {}\n{} strips; {}\n",
        arguments.out.display(),
        discs.len(),
        counts(&discs),
        strips.len(),
        counts(&strips)
    ))
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
fn dropped_disc(
    size_m: f32,
    density: f32,
    arguments: &Arguments,
    cancel: &Cancel,
) -> anyhow::Result<Option<Spot>> {
    let size = f64::from(size_m);
    let summary = dropped(&Piece::flat("disc", size_m, density)?, size, arguments, cancel)?;
    Ok(summary.map(|summary| Spot {
        place: (
            summary.mean_descent_m_s * size / VISCOSITY_M2_S,
            std::f64::consts::PI * f64::from(density) / (64.0 * AIR_DENSITY * size),
        ),
        shares: summary.regimes.to_array(),
    }))
}

/// Drops a strip.
fn dropped_strip(
    froude: f64,
    aspect: f64,
    arguments: &Arguments,
    cancel: &Cancel,
) -> anyhow::Result<Option<Spot>> {
    let density = froude * froude * AIR_DENSITY * STRIP_WIDTH_M;
    let piece = Piece::strip(STRIP_WIDTH_M, aspect, density);
    let summary = dropped(&piece, STRIP_WIDTH_M, arguments, cancel)?;
    Ok(summary.map(|summary| Spot { place: (froude, aspect), shares: summary.regimes.to_array() }))
}

/// Drops a piece of a width from so high that it settles.
fn dropped(
    piece: &Piece,
    width_m: f64,
    arguments: &Arguments,
    cancel: &Cancel,
) -> anyhow::Result<Option<DescentSummary>> {
    let species = piece.clone().held(Release::Random).species;
    let height = HEIGHT_M.0 + HEIGHT_M.1 * width_m;
    #[expect(clippy::cast_possible_truncation, reason = "scenes hold single precision")]
    let drops =
        Drops { species: &species, count: arguments.drops, height_m: height as f32, seed: arguments.seed };
    drops.summary(SETTLED * height, &BackendArguments::default().cpu(), cancel)
}
