// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall drift`: snow that drifts behind a fence.

use std::fmt::Write as _;
use std::path::PathBuf;

use clap::Args;
use serde::Serialize;

use crate::files::OutputFile;
use crate::plot::{fence_drift, picture};
use crate::run::cancel::Cancel;
use crate::run::parse::{png_file, whole, within};
use crate::run::terminal;
use crate::study::fence_drift::{Drift, Fence};

/// Options of `windfall drift`.
///
/// Snow lies on level ground, with a fence across the wind. A storm takes it along by the law of saltation, and it gathers where the fence
/// shelters it, until its lee is full.
#[derive(Clone, Debug, Args)]
pub struct Arguments {
    /// Height of the fence in m, 0.3 to 3.
    #[arg(long, value_name = "M", default_value = "0.5", value_parser = height)]
    height: f64,
    /// Share of its face that air passes through, 0 to 0.9.
    #[arg(long, value_name = "SHARE", default_value = "0.5", value_parser = open)]
    open: f64,
    /// Mean wind 10 m above the ground in m/s, 5 to 40.
    #[arg(long, value_name = "M/S", default_value = "22", value_parser = wind)]
    u10: f64,
    /// Temperature of the air in °C, -30 to 0.
    #[arg(long, value_name = "C", default_value = "-5", value_parser = air, allow_hyphen_values = true)]
    air: f64,
    /// Hours for which the storm blows, 1 to 96.
    #[arg(long, value_name = "HOURS", default_value = "36", value_parser = hours)]
    hours: f64,
    /// Number of reports, evenly over these hours.
    #[arg(long, value_name = "N", default_value = "6", value_parser = whole::<u32, 1, 100>)]
    reports: u32,
    /// Print one JSON object instead of a table, profiles included.
    #[arg(long)]
    json: bool,
    /// Draw the profiles: .png.
    #[arg(long, value_name = "FILE", value_parser = png_file)]
    out: Option<PathBuf>,
}

fn height(text: &str) -> Result<f64, String> {
    within(text, 0.3, 3.0)
}

fn open(text: &str) -> Result<f64, String> {
    within(text, 0.0, 0.9)
}

fn wind(text: &str) -> Result<f64, String> {
    within(text, 5.0, 40.0)
}

fn air(text: &str) -> Result<f64, String> {
    within(text, -30.0, 0.0)
}

fn hours(text: &str) -> Result<f64, String> {
    within(text, 1.0, 96.0)
}

/// Outcome of the storm. The names of these fields are keys of its JSON; they stay.
#[derive(Clone, Debug, Serialize)]
struct Report {
    height_m: f64,
    open: f64,
    u10_m_s: f64,
    air_c: f64,
    drifts: Vec<Drift>,
}

/// Runs the command.
///
/// # Errors
/// A file that cannot be written; then nothing has changed.
pub(crate) fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let cancel = Cancel::on_interrupt();
    let file = arguments.out.as_deref().map(OutputFile::create).transpose()?;
    let Arguments { height, open, u10, air, .. } = *arguments;
    #[expect(clippy::cast_possible_truncation, reason = "numbers of a scene are single precision")]
    let fence = Fence { height_m: height as f32, open: open as f32, u10_m_s: u10 as f32, air_c: air as f32 };
    let count = f64::from(arguments.reports);
    let hours: Vec<f64> =
        (1..=arguments.reports).map(|number| arguments.hours * f64::from(number) / count).collect();
    let drifts = fence.drifts(&hours, &cancel)?;
    if let Some(file) = file {
        let caption = format!(
            "Snow behind a fence {height} m high, {:.0} % open, in {u10} m/s ten metres up",
            100.0 * open
        );
        picture::write(file, fence_drift::SIZE, |area| fence_drift::draw(area, &caption, &drifts))?;
    }
    let report = Report { height_m: height, open, u10_m_s: u10, air_c: air, drifts };
    match arguments.json {
        true => terminal::print(&format!("{}\n", serde_json::to_string(&report)?)),
        false => terminal::print(&report.to_text()),
    }
}

impl Report {
    /// The report for people.
    fn to_text(&self) -> String {
        let mut text = String::from("hours   section H²   length H   deepest H   section before H²\n");
        for Drift { hours, section, length, deepest, section_before, .. } in &self.drifts {
            // Writing to a String cannot fail.
            let _ =
                writeln!(text, "{hours:5.1}{section:13.1}{length:11.1}{deepest:12.2}{section_before:20.1}");
        }
        text
    }
}
