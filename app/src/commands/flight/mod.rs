// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall flight`: a wind tunnel for leaves, comparisons to measured drops, and pictures.

mod compare;
mod diagram;
mod measure;
mod measured_table;
mod outline;
mod piece;
mod track_file;
mod tracks3d;

use clap::{Args, Subcommand};

/// Options of `windfall flight`.
///
/// Every number is an average over drops of what each does from 0.6 m below its release to the ground. Turns are half the
/// peaks of the area seen from above: turns of what tumbles, swings of what flutters; of what autorotates they are those
/// about the vertical. A drop's regime is the one that
/// lasted longest since it was first seen to turn or swing a few times; one that tumbles for less than three quarters of
/// that time counts as chaotic.
#[derive(Clone, Debug, Args)]
#[command(args_conflicts_with_subcommands = true)]
pub struct Arguments {
    #[command(subcommand)]
    task: Option<Task>,
    #[command(flatten)]
    measure: measure::Arguments,
}

/// Comparisons and pictures.
#[derive(Clone, Debug, Subcommand)]
enum Task {
    /// Drop the pieces of a table of measured drops, and set both side by side.
    Compare(compare::Arguments),
    /// Draw how discs of many sizes and masses fall, beside the boundaries that were measured.
    Diagram(diagram::Arguments),
    /// Draw twelve drops as one sees them.
    #[command(name = "tracks3d")]
    Tracks3d(tracks3d::Arguments),
}

/// Runs the command.
///
/// # Errors
/// Errors of the command.
pub(crate) fn run(arguments: &Arguments) -> anyhow::Result<()> {
    match &arguments.task {
        None => measure::run(&arguments.measure),
        Some(Task::Compare(options)) => compare::run(options),
        Some(Task::Diagram(options)) => diagram::run(options),
        Some(Task::Tracks3d(options)) => tracks3d::run(options),
    }
}
