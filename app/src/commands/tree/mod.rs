// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall tree`: trees without any scene, or one tree of a scene.

pub(crate) mod export;
pub(crate) mod info;
pub(crate) mod shedding;
mod source;

use clap::Subcommand;

/// Commands on trees.
#[derive(Clone, Debug, Subcommand)]
pub enum Command {
    /// Write a tree as a glTF file: bark that joints move, places of leaves and fruit, wind weights.
    Export(export::Arguments),
    /// Report how large a tree is, in numbers.
    Info(info::Arguments),
    /// Plot how many leaves a tree sheds against the wind, for several times of the year.
    Shedding(shedding::Arguments),
}

impl Command {
    /// Runs the command.
    ///
    /// # Errors
    /// Errors of the command.
    pub fn run(self) -> anyhow::Result<()> {
        match self {
            Self::Export(arguments) => export::run(&arguments),
            Self::Info(arguments) => info::run(&arguments),
            Self::Shedding(arguments) => shedding::run(&arguments),
        }
    }
}
