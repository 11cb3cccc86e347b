// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Files and folders that are written out of sight and appear at their destination when they are complete.
//!
//! Whatever is dropped before it is finished leaves no trace, and what lay at its destination stays as it was. Long work alone is kept
//! unfinished, to be gone on with ([`UnfinishedWork`]). Partial files
//! lie in the destination's own folder, so that giving them their name is one step of the file system.

mod csv_file;
mod identity;
mod output_file;
mod output_folder;
mod parents;
mod partial;
mod unfinished_work;
mod write_error;

pub(crate) use csv_file::CsvFile;
pub(crate) use identity::Identity;
pub(crate) use output_file::OutputFile;
pub(crate) use output_folder::OutputFolder;
pub(crate) use unfinished_work::UnfinishedWork;
pub(crate) use write_error::WriteError;
