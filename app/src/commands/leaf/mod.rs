// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall leaf`: leaves without any scene.

pub(crate) mod compare;
pub(crate) mod make;
mod photo_arguments;
pub(crate) mod season_strip;
pub(crate) mod veins;

use clap::Subcommand;

/// Commands on leaves.
#[derive(Clone, Debug, Subcommand)]
pub enum Command {
    /// Make leaves, from photos or from nothing but the name of a kind, and write them as pictures.
    Make(make::Arguments),
    /// Report how far leaves are from photographed ones, in twelve numbers and a verdict.
    Compare(compare::Arguments),
    /// Draw over a photo what is read from it: outline, root, tip and veins.
    Veins(veins::Arguments),
    /// Paint one leaf through its autumn, from green to brown.
    SeasonStrip(season_strip::Arguments),
}

impl Command {
    /// Runs the command.
    ///
    /// # Errors
    /// Errors of the command.
    pub fn run(self) -> anyhow::Result<()> {
        match self {
            Self::Make(arguments) => make::run(&arguments),
            Self::Compare(arguments) => compare::run(&arguments),
            Self::Veins(arguments) => veins::run(&arguments),
            Self::SeasonStrip(arguments) => season_strip::run(&arguments),
        }
    }
}
