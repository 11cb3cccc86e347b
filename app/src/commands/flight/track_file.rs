// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Drops as a table of comma-separated values, moment by moment.

use std::path::Path;

use crate::files::{CsvFile, WriteError};
use crate::study::sample::Sample;

const HEADER: [&str; 13] =
    ["drop", "time_s", "x", "y", "z", "qx", "qy", "qz", "qw", "vx", "vy", "vz", "regime"];

/// A table in the making.
#[derive(Debug)]
pub(super) struct TrackFile {
    table: CsvFile,
}

impl TrackFile {
    /// Begins the table.
    ///
    /// # Errors
    /// Whatever would keep the file from being written.
    pub(super) fn create(path: &Path) -> Result<Self, WriteError> {
        Ok(Self { table: CsvFile::create(path, &HEADER)? })
    }

    /// Adds a row.
    ///
    /// # Errors
    /// Errors of the system, named with the path.
    pub(super) fn add(&mut self, drop: usize, sample: &Sample) -> Result<(), WriteError> {
        self.table.field(drop).field(format_args!("{:.6}", sample.time_s));
        let (position, velocity) = (sample.position_m.to_array(), sample.velocity_m_s.to_array());
        for number in position.into_iter().chain(sample.attitude.to_array()).chain(velocity) {
            self.table.field(format_args!("{number:.6}"));
        }
        self.table.field(sample.regime.name()).end_row()
    }

    /// Completes the table under its own name.
    ///
    /// # Errors
    /// Errors of the system, named with the path.
    pub(super) fn finish(self) -> Result<(), WriteError> {
        self.table.finish()
    }
}
