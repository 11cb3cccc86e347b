// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall leaf`: leaves without any scene.

pub mod make;
mod output_folder;
mod photo_arguments;

use clap::Subcommand;

/// What can be done with leaves.
#[derive(Clone, Debug, Subcommand)]
pub enum Command {
    /// Make leaves, from photos or from nothing but the name of a kind, and write them as pictures.
    Make(make::Arguments),
}

impl Command {
    /// Runs the command.
    ///
    /// # Errors
    /// What the command says.
    pub fn run(self) -> anyhow::Result<()> {
        match self {
            Self::Make(arguments) => make::run(&arguments),
        }
    }
}
