// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall completions`: what a shell needs to complete commands and options.

use clap::Args;
use clap_complete::Shell;

use crate::run::terminal;

/// Options of `windfall completions`.
#[derive(Clone, Debug, Args)]
pub struct Arguments {
    /// Shell that will read it.
    #[arg(value_name = "SHELL")]
    shell: Shell,
}

/// Prints the script for the program that `program` describes.
///
/// # Errors
/// A standard output that cannot be written to.
pub(crate) fn run(arguments: &Arguments, mut program: clap::Command) -> anyhow::Result<()> {
    let name = program.get_name().to_owned();
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut program, name, &mut script);
    terminal::print(&String::from_utf8_lossy(&script))
}
