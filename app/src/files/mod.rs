// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Files and folders that are written out of sight and appear at their destination when they are complete.

mod output_file;
mod output_folder;

pub(crate) use output_file::{OutputFile, write_error};
pub(crate) use output_folder::OutputFolder;
