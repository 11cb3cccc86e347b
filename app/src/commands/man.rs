// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall man`: pages of the manual for packages, one for each command.

use std::fs;
use std::path::PathBuf;

use clap::Args;

use crate::files::{OutputFolder, WriteError};
use crate::run::terminal;

/// Options of `windfall man`.
#[derive(Clone, Debug, Args)]
pub struct Arguments {
    /// Folder for the pages, windfall.1 and one for each command; made if it is not there.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

/// Writes the pages of the program that `program` describes.
///
/// # Errors
/// A folder that cannot be written to; then no file has changed.
pub(crate) fn run(arguments: &Arguments, program: clap::Command) -> anyhow::Result<()> {
    let folder = OutputFolder::create(&arguments.out)?;
    let at_destination = WriteError::at(&arguments.out);
    clap_mangen::generate_to(program, folder.partial()).map_err(&at_destination)?;
    let entries = fs::read_dir(folder.partial()).and_then(Iterator::collect::<Result<Vec<_>, _>>);
    let mut names: Vec<_> = entries.map_err(&at_destination)?.iter().map(fs::DirEntry::file_name).collect();
    names.sort();
    let lines: String =
        names.iter().map(|name| format!("{}\n", folder.destination().join(name).display())).collect();
    folder.finish("")?;
    terminal::print(&lines)
}
