// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Drops as a table of comma-separated values, moment by moment.

use std::io::{BufWriter, Write};
use std::path::Path;

use super::sample::Sample;
use crate::files::{OutputFile, write_error};

const HEADER: &str = "drop,time_s,x,y,z,qx,qy,qz,qw,vx,vy,vz,regime";

/// A table in the making.
#[derive(Debug)]
pub(super) struct TrackFile {
    out: BufWriter<OutputFile>,
}

impl TrackFile {
    /// Begins the table.
    ///
    /// # Errors
    /// Whatever would keep the file from being written.
    pub(super) fn create(path: &Path) -> anyhow::Result<Self> {
        let mut out = BufWriter::new(OutputFile::create(path)?);
        writeln!(out, "{HEADER}").map_err(|error| write_error(path, &error))?;
        Ok(Self { out })
    }

    /// Adds a row.
    ///
    /// # Errors
    /// What the system says, named with the path.
    pub(super) fn add(&mut self, drop: usize, sample: &Sample) -> anyhow::Result<()> {
        let [x, y, z] = sample.position_m.to_array();
        let [qx, qy, qz, qw] = sample.attitude.to_array();
        let [vx, vy, vz] = sample.velocity_m_s.to_array();
        let (time_s, regime) = (sample.time_s, sample.regime.name());
        let row = writeln!(
            self.out,
            "{drop},{time_s:.6},{x:.6},{y:.6},{z:.6},{qx:.6},{qy:.6},{qz:.6},{qw:.6},{vx:.6},{vy:.6},{vz:.6},{regime}"
        );
        row.map_err(|error| write_error(self.out.get_ref().destination(), &error))
    }

    /// Completes the table under its own name.
    ///
    /// # Errors
    /// What the system says, named with the path.
    pub(super) fn finish(mut self) -> anyhow::Result<()> {
        let path = self.out.get_ref().destination().to_owned();
        self.out.flush().map_err(|error| write_error(&path, &error))?;
        self.out.into_inner().map_err(|error| write_error(&path, error.error()))?.finish()
    }
}
