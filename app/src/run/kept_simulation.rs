// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A simulation whose state is kept from time to time, beside what it writes: a run that ends early is gone on with.

use std::fs;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};
use windfall_core::World;

use super::swaying::{KeptSwaying, Swaying};
use crate::files::{Identity, OutputFile, UnfinishedWork, WriteError};

/// Seconds from one state to the next, at least.
const SHORTEST: Duration = Duration::from_secs(2);
/// Least time from one state to the next, as a multiple of what keeping the last one took.
const PAUSES: u32 = 50;
/// Name of the table of tracks while it is in the making.
const TRACKS: &str = "tracks.csv";

/// A simulation in progress.
#[derive(Debug)]
pub(crate) struct KeptSimulation {
    work: UnfinishedWork,
    kept: Option<Kept>,
    /// Moment at which the last state was kept, and the time that took.
    last: (Instant, Duration),
}

/// Point that a run can go on from.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Kept {
    /// Steps of the run that are done.
    pub done: u32,
    /// Bytes of the table of tracks.
    pub tracks: u64,
    /// The trees in these steps.
    pub swaying: KeptSwaying,
}

impl KeptSimulation {
    /// Begins a simulation that writes `destination`, or goes on with one of the same identity.
    ///
    /// # Errors
    /// Unfinished work of another identity; another run that is at work; a path that cannot be written.
    pub(crate) fn open(destination: &Path, identity: &Identity, restart: bool) -> anyhow::Result<Self> {
        let work = UnfinishedWork::open(destination, identity, restart)?.by_progress();
        let bytes = |name: &str| fs::metadata(work.parts().join(name)).map_or(0, |file| file.len());
        let is_whole = |kept: &Kept| bytes(&state_name(kept.done)) > 0 && bytes(TRACKS) >= kept.tracks;
        let kept = work.progress().filter(is_whole);
        Ok(Self { work, kept, last: (Instant::now(), Duration::ZERO) })
    }

    /// Point to go on from.
    pub(crate) fn kept(&self) -> Option<&Kept> {
        self.kept.as_ref()
    }

    /// Path of the state there.
    pub(crate) fn state(&self) -> Option<PathBuf> {
        self.kept.as_ref().map(|kept| self.work.parts().join(state_name(kept.done)))
    }

    /// Path of the table of tracks while it is in the making.
    pub(crate) fn tracks(&self) -> PathBuf {
        self.work.parts().join(TRACKS)
    }

    /// Returns true if it is time to keep the state.
    pub(crate) fn is_due(&self) -> bool {
        let (when, took) = self.last;
        when.elapsed() >= SHORTEST.max(took * PAUSES)
    }

    /// Keeps the state after so many steps of the run; `tracks` are the bytes of the table of tracks.
    ///
    /// # Errors
    /// Errors of the system.
    pub(crate) fn keep(
        &mut self,
        world: &World,
        done: u32,
        tracks: u64,
        swaying: &Swaying,
    ) -> Result<(), WriteError> {
        let began = Instant::now();
        let before = self.state();
        write_checkpoint(world, OutputFile::create(&self.work.parts().join(state_name(done)))?)?;
        let kept = Kept { done, tracks, swaying: swaying.keep() };
        self.work.note_progress(&kept)?;
        self.kept = Some(kept);
        if let Some(before) = before.filter(|before| Some(before) != self.state().as_ref()) {
            // What cannot be removed goes with all the rest.
            let _ = fs::remove_file(before);
        }
        self.last = (Instant::now(), began.elapsed());
        Ok(())
    }

    /// Ends the work: all that it was for is written.
    pub(crate) fn finish(self) {
        self.work.finish();
    }
}

/// Name of the file of a state.
fn state_name(done: u32) -> String {
    format!("state_{done}")
}

/// Writes a state and completes its file.
///
/// # Errors
/// Errors of the system.
pub(crate) fn write_checkpoint(world: &World, file: OutputFile) -> Result<(), WriteError> {
    let path = file.destination().to_owned();
    let mut out = BufWriter::new(file);
    world.write_checkpoint(&mut out).and_then(|()| out.flush()).map_err(WriteError::at(&path))?;
    out.into_inner().map_err(|error| WriteError::at(&path)(error.into_error()))?.finish()
}
