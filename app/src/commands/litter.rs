// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall litter`: a wind tunnel for leaves that lie on the ground.

use std::fmt::Write as _;
use std::path::PathBuf;

use anyhow::bail;
use clap::Args;
use serde::Serialize;
use windfall_core::scene::Species;

use crate::files::OutputFile;
use crate::plot::{litter_onset, picture};
use crate::run::cancel::Cancel;
use crate::run::parse::{png_file, whole, within};
use crate::run::terminal;
use crate::study::litter_tunnel::{Tunnel, TunnelGround, TunnelPoint};

/// Fastest mean wind in m/s.
const FASTEST_M_S: f64 = 30.0;
/// Most winds of a range.
const MOST_WINDS: u32 = 100;

/// Options of `windfall litter`.
///
/// Leaves lie on a ground, each in its own pose, and the wind blows at them with the turbulence of its own profile. A leaf
/// slides, tips or lifts by the forces of the flight model, and flies as a body from then on.
#[derive(Clone, Debug, Args)]
pub struct Arguments {
    /// Kinds of leaves, separated by commas: maple, oak, birch, beech, linden, ginkgo, japanese-maple, hornbeam, or feather,
    /// paper-scrap, plate, samara.
    #[arg(long, value_name = "SPECIES", default_value = "beech", value_delimiter = ',', value_parser = species)]
    species: Vec<Species>,
    /// Grounds, separated by commas.
    #[arg(long, value_name = "GROUND", default_value = "pavement", value_delimiter = ',')]
    ground: Vec<TunnelGround>,
    /// Mean winds 10 m above the ground in m/s: one, or a range and how many, such as 0..12/13; each 0 to 30.
    #[arg(long, value_name = "A..B/N", default_value = "1..12/12", value_parser = winds)]
    u10: Winds,
    /// Number of leaves on bare ground.
    #[arg(long, value_name = "N", default_value = "1000", value_parser = whole::<u32, 1, 100_000>)]
    leaves: u32,
    /// Seconds for which each wind blows, 1 to 3600.
    #[arg(long, value_name = "SECONDS", default_value = "60", value_parser = seconds)]
    seconds: f64,
    /// Water in the leaves in kg per kg of dry leaf, 0 to 4.
    #[arg(long, value_name = "SHARE", default_value = "0", value_parser = moisture)]
    moisture: f64,
    /// Suction of wet leaves in N/m², 0 to 20.
    #[arg(long, value_name = "N/M2", default_value = "0", value_parser = adhesion)]
    adhesion: f64,
    /// Seed of everything random.
    #[arg(long, value_name = "N", default_value = "1", value_parser = whole::<u64, 0, { u64::MAX }>)]
    seed: u64,
    /// Print one JSON object instead of a table.
    #[arg(long)]
    json: bool,
    /// Draw the share of leaves that have moved against the wind: .png.
    #[arg(long, value_name = "FILE", value_parser = png_file)]
    out: Option<PathBuf>,
}

/// Mean winds in m/s, in rising order.
#[derive(Clone, Debug, PartialEq)]
struct Winds(Vec<f32>);

fn species(text: &str) -> Result<Species, String> {
    Species::preset(text).ok_or_else(|| format!("allowed: {}", Species::PRESETS.join(", ")))
}

fn seconds(text: &str) -> Result<f64, String> {
    within(text, 1.0, 3600.0)
}

fn moisture(text: &str) -> Result<f64, String> {
    within(text, 0.0, 4.0)
}

fn adhesion(text: &str) -> Result<f64, String> {
    within(text, 0.0, 20.0)
}

/// Reads one wind or a range of winds.
fn winds(text: &str) -> Result<Winds, String> {
    let read = || {
        let Some((low, rest)) = text.split_once("..") else { return Some((text, text, "1")) };
        let (high, count) = rest.split_once('/')?;
        Some((low, high, count))
    };
    let fault = || {
        format!(
            "allowed: a speed, or A..B/N with A below B and N from 2 to {MOST_WINDS}; speeds 0 to {FASTEST_M_S}"
        )
    };
    let (low, high, count) = read().ok_or_else(fault)?;
    let speed = |text: &str| within(text, 0.0, FASTEST_M_S).map_err(|_| fault());
    let (low, high) = (speed(low)?, speed(high)?);
    let count: u32 = count.parse().map_err(|_| fault())?;
    let is_range = low < high && (2..=MOST_WINDS).contains(&count);
    if !is_range && (low != high || count != 1) {
        return Err(fault());
    }
    let share = |number: u32| if count < 2 { 0.0 } else { f64::from(number) / f64::from(count - 1) };
    #[expect(clippy::cast_possible_truncation, reason = "speeds of a scene are single precision")]
    Ok(Winds((0..count).map(|number| (low + (high - low) * share(number)) as f32).collect()))
}

/// Outcome of the tunnel. The names of these fields are keys of its JSON; they stay.
#[derive(Clone, Debug, Serialize)]
struct Report {
    leaves: u32,
    seconds: f64,
    moisture: f64,
    adhesion_n_m2: f64,
    points: Vec<TunnelPoint>,
}

/// Runs the command.
///
/// # Errors
/// A file that cannot be written; then nothing has changed.
pub(crate) fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let cancel = Cancel::on_interrupt();
    let Winds(winds) = &arguments.u10;
    if arguments.out.is_some() && winds.len() < 2 {
        bail!("--out draws a curve, which needs a range of winds: --u10 A..B/N");
    }
    let file = arguments.out.as_deref().map(OutputFile::create).transpose()?;
    let mut points = Vec::new();
    for species in &arguments.species {
        for &ground in &arguments.ground {
            #[expect(clippy::cast_possible_truncation, reason = "numbers of a scene are single precision")]
            let tunnel = Tunnel {
                species: species.clone(),
                ground,
                leaves: arguments.leaves,
                seconds: arguments.seconds as f32,
                moisture: arguments.moisture as f32,
                adhesion_n_m2: arguments.adhesion as f32,
                seed: arguments.seed,
            };
            for &wind in winds {
                points.push(tunnel.blow(wind, &cancel)?);
            }
        }
    }
    cancel.check()?;
    if let Some(file) = file {
        picture::write(file, litter_onset::SIZE, |area| {
            litter_onset::draw(area, arguments.seconds, &points)
        })?;
    }
    let report = Report {
        leaves: arguments.leaves,
        seconds: arguments.seconds,
        moisture: arguments.moisture,
        adhesion_n_m2: arguments.adhesion,
        points,
    };
    match arguments.json {
        true => terminal::print(&format!("{}\n", serde_json::to_string(&report)?)),
        false => terminal::print(&report.to_text()),
    }
}

impl Report {
    /// The report for people.
    fn to_text(&self) -> String {
        let mut text = String::from(
            "species         ground      U10 m/s   moved %   speed m/s   airborne %   hops a leaf   hop m\n",
        );
        for point in &self.points {
            let TunnelPoint { species, u10_m_s, mean_speed_m_s, hops_per_leaf, mean_hop_m, .. } = point;
            let (moved, airborne) = (100.0 * point.moved_share, 100.0 * point.airborne_share);
            // Writing to a String cannot fail.
            let _ = writeln!(
                text,
                "{species:<16}{:<10}{u10_m_s:9.2}{moved:10.1}{mean_speed_m_s:12.3}{airborne:13.1}{hops_per_leaf:14.2}{mean_hop_m:8.2}",
                point.ground.name(),
            );
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn winds_are_one_or_a_range() {
        assert_eq!(winds("4"), Ok(Winds(vec![4.0])), "one");
        assert_eq!(winds("0..12/4"), Ok(Winds(vec![0.0, 4.0, 8.0, 12.0])), "a range");
        for text in ["", "x", "31", "-1", "1..2", "2..1/3", "1..2/1", "1..2/101", "1..1/2", "1../3", "nan"] {
            let error = winds(text).expect_err(text);
            assert!(error.contains("A..B/N") && error.contains("0 to 30"), "{text}: {error}");
        }
    }
}
