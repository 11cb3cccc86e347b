// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall flight`: a wind tunnel for leaves, and what it shows as pictures.

mod measure;
mod outline;
mod piece;
mod sample;
mod statistics;
mod track_file;
mod tunnel;

use clap::Args;

/// Options of `windfall flight`.
///
/// Every number is an average over drops of what each does from 0.6 m below its release to the ground. Turns are half the
/// peaks of the area seen from above: turns of what tumbles, swings of what flutters. A drop's regime is the one that
/// lasted longest.
#[derive(Clone, Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    measure: measure::Arguments,
}

/// Runs the command.
///
/// # Errors
/// What the command says.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    measure::run(&arguments.measure)
}
