// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Commands and options, and reports of their errors: one line on the standard error, exit code 2.

use std::ffi::OsString;
use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};

use crate::commands::{
    bench, completions, drift, export, flight, info, leaf, litter, man, merge, motions, render, simulate,
    study, tree, view,
};
use crate::run::terminal;

/// Exit code of everything that goes wrong.
const FAILURE: u8 = 2;

/// Falling leaves on the CPU or the GPU.
#[derive(Debug, Parser)]
#[command(name = "windfall", version, about, disable_help_subcommand = true, arg_required_else_help = false)]
pub struct Cli {
    /// The command.
    #[command(subcommand)]
    pub command: Command,
}

/// Commands of the program.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Watch a scene in a window and change it while it goes on.
    View(view::Arguments),
    /// Draw a scene to a picture or a clip, without a window.
    Render(render::Arguments),
    /// Simulate a scene without drawing it: statistics, tracks, checkpoints.
    Simulate(simulate::Arguments),
    /// Write a stretch of a scene for other programs: USD, glTF, a table or point clouds.
    Export(export::Arguments),
    /// Put together what shards of a scene have written.
    Merge(merge::Arguments),
    /// List graphics adapters with their limits, and what is chosen by default.
    Info,
    /// Measure how fast this machine simulates.
    Bench(bench::Arguments),
    /// Drop leaves or pieces of paper in still air, and measure how they fall.
    Flight(flight::Arguments),
    /// Blow at leaves that lie on the ground, and measure which move and how.
    Litter(litter::Arguments),
    /// Let snow drift behind a fence, and measure the drift.
    Drift(drift::Arguments),
    /// Drop leaves under many settings of a scene, and compare how they fall and where they land.
    Study(study::Arguments),
    /// Write the motion tables of every species of a scene as text files.
    Motions(motions::Arguments),
    /// Make leaves for scenes, and study them.
    #[command(subcommand)]
    Leaf(leaf::Command),
    /// Write trees as glTF files, and report how large they are.
    #[command(subcommand)]
    Tree(tree::Command),
    /// Print what a shell needs to complete commands and options.
    Completions(completions::Arguments),
    /// Write the pages of the manual.
    Man(man::Arguments),
}

impl Command {
    fn run(self) -> anyhow::Result<()> {
        match self {
            Self::View(arguments) => view::run(arguments),
            Self::Render(arguments) => render::run(&arguments),
            Self::Simulate(arguments) => simulate::run(&arguments),
            Self::Export(arguments) => export::run(&arguments),
            Self::Merge(arguments) => merge::run(&arguments),
            Self::Info => info::run(),
            Self::Bench(arguments) => bench::run(&arguments),
            Self::Flight(arguments) => flight::run(&arguments),
            Self::Litter(arguments) => litter::run(&arguments),
            Self::Drift(arguments) => drift::run(&arguments),
            Self::Study(arguments) => study::run(&arguments),
            Self::Motions(arguments) => motions::run(&arguments),
            Self::Leaf(command) => command.run(),
            Self::Tree(command) => command.run(),
            Self::Completions(arguments) => completions::run(&arguments, Cli::command()),
            Self::Man(arguments) => man::run(&arguments, Cli::command()),
        }
    }
}

/// Runs the program with the arguments it was started with.
pub fn main() -> ExitCode {
    run(std::env::args_os())
}

/// Runs the program with these arguments; the first is its own name.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    ExitCode::from(status(arguments))
}

/// The same with the exit code as a number: 0, or 2 after an error.
pub fn status(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let outcome = match Cli::try_parse_from(arguments) {
        Ok(cli) => cli.command.run().map_err(|error| error.to_string()),
        // Help and version, which were asked for.
        Err(error) if !error.use_stderr() => {
            terminal::print(&error.render().to_string()).map_err(|error| error.to_string())
        }
        Err(error) => Err(usage_error(&error)),
    };
    match outcome {
        Ok(()) => 0,
        Err(message) => {
            terminal::note(&format!("error: {message}"));
            FAILURE
        }
    }
}

/// The paragraphs of a parser's error that matter, on one line.
fn usage_error(error: &clap::Error) -> String {
    let text = error.render().to_string();
    let mut message = String::new();
    let lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    for line in lines.take_while(|line| !line.starts_with("Usage:") && !line.starts_with("For more")) {
        if !message.is_empty() {
            message += if message.ends_with(':') || line.starts_with('[') { " " } else { "; " };
        }
        message += line;
    }
    message.strip_prefix("error: ").unwrap_or(&message).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_description_of_the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn errors_of_the_parser_become_one_line() {
        let message = |arguments: &[&str]| {
            let error = Cli::try_parse_from(arguments).expect_err("bad arguments");
            usage_error(&error)
        };
        let text = message(&["windfall", "simulate", "--stepz", "3"]);
        assert_eq!(text, "unexpected argument '--stepz' found; tip: a similar argument exists: '--steps'");
        let text = message(&["windfall", "simulate", "--steps", "x"]);
        assert!(text.contains("--steps") && text.contains("'x'") && text.contains("allowed"), "{text}");
        let text = message(&["windfall", "motions"]);
        assert!(text.contains("--out <DIR>") && !text.contains('\n'), "{text}");
    }
}
