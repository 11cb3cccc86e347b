// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Tracks of single leaves as a table of comma-separated values.

use std::fmt::Write as _;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use clap::Args;
use windfall_core::leaf::{LeafMotion, LeafState, LeafView};
use windfall_core::{Context, World};

use crate::files::{OutputFile, write_error};
use crate::run::parse::whole;

const HEADER: &str =
    "step,time_s,leaf,id,state,primitive,species,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s,qx,qy,qz,qw\n";

/// Which tracks to write.
#[derive(Clone, Debug, Args)]
pub(crate) struct TrackArguments {
    /// Write the tracks of single leaves to this CSV file.
    #[arg(long, value_name = "FILE.csv")]
    tracks: Option<PathBuf>,
    /// Write tracks at every step whose number is a multiple of this.
    #[arg(long, value_name = "N", default_value = "1", requires = "tracks",
        value_parser = whole::<u32, 1, 1_000_000_000>)]
    track_every: u32,
    /// Write the tracks of the first so many leaves.
    #[arg(long, value_name = "N", default_value = "100", requires = "tracks",
        value_parser = whole::<u32, 1, { u32::MAX as u64 }>)]
    track_leaves: u32,
}

impl TrackArguments {
    /// Begins the file, if there is to be one.
    ///
    /// # Errors
    /// Whatever would keep the file from being written.
    pub(crate) fn create(&self) -> anyhow::Result<Option<Tracks>> {
        let Some(path) = &self.tracks else { return Ok(None) };
        Tracks::create(path, self.track_every, self.track_leaves as usize).map(Some)
    }
}

/// A table in the making: one row for each leaf and sampled step.
#[derive(Debug)]
pub(crate) struct Tracks {
    out: BufWriter<OutputFile>,
    every: u32,
    leaves: usize,
    row: String,
}

impl Tracks {
    /// Begins a table of the first `leaves` leaves at every step whose number is a multiple of `every`, at least 1.
    ///
    /// # Errors
    /// Whatever would keep the file from being written.
    pub(crate) fn create(path: &Path, every: u32, leaves: usize) -> anyhow::Result<Self> {
        let mut out = BufWriter::new(OutputFile::create(path)?);
        out.write_all(HEADER.as_bytes()).map_err(|error| write_error(path, &error))?;
        Ok(Self { out, every, leaves, row: String::new() })
    }

    /// Where the table will lie.
    pub(crate) fn destination(&self) -> &Path {
        self.out.get_ref().destination()
    }

    /// Number of steps from `step` to the next that is sampled; 0 if it is that step itself.
    pub(crate) fn wait(&self, step: u32) -> u32 {
        match step % self.every {
            0 => 0,
            past => self.every - past,
        }
    }

    /// Adds the rows of one step.
    ///
    /// # Errors
    /// What the system says, named with the path.
    pub(crate) fn sample(&mut self, world: &World) -> anyhow::Result<()> {
        let step = world.step_block();
        let cx = world.context(&step);
        (0..world.leaves.len().min(self.leaves)).try_for_each(|slot| self.add(world, &cx, slot))
    }

    /// Adds the row of one leaf, at the step of a context.
    ///
    /// # Errors
    /// What the system says, named with the path.
    pub(crate) fn add(&mut self, world: &World, cx: &Context<'_>, slot: usize) -> anyhow::Result<()> {
        self.row.clear();
        write_row(&mut self.row, world, slot, &world.leaves.view(cx, slot));
        self.out.write_all(self.row.as_bytes()).map_err(|error| self.failed(&error))
    }

    /// Completes the table under its own name.
    ///
    /// # Errors
    /// What the system says, named with the path.
    pub(crate) fn finish(mut self) -> anyhow::Result<()> {
        self.out.flush().map_err(|error| self.failed(&error))?;
        let path = self.destination().to_owned();
        self.out.into_inner().map_err(|error| write_error(&path, error.error()))?.finish()
    }

    fn failed(&self, error: &io::Error) -> anyhow::Error {
        write_error(self.destination(), error)
    }
}

/// One row. Of a dormant leaf it holds but the state; only a falling one has a primitive motion.
fn write_row(row: &mut String, world: &World, slot: usize, leaf: &LeafView) {
    let name = match leaf.state {
        LeafState::Dormant => "dormant",
        LeafState::Attached => "attached",
        LeafState::Falling => "falling",
        LeafState::Resting => "resting",
    };
    let (step, time_s, id) = (world.clock.step(), world.clock.seconds(), leaf.id);
    // Writing to a String cannot fail.
    let _ = write!(row, "{step},{time_s:.6},{slot},{id},{name},");
    if leaf.state == LeafState::Dormant {
        row.push_str(",,,,,,,,,,,\n");
        return;
    }
    if let Some(LeafMotion::Primitive(primitive)) = leaf.motion {
        row.push_str(primitive.code());
    }
    row.push(',');
    let species = world.environment.scene().species.get(leaf.species);
    row.push_str(&field(species.map_or("", |species| &species.name)));
    let numbers = leaf.position.to_array().into_iter().chain(leaf.velocity.to_array());
    for number in numbers.chain(leaf.attitude.to_array()) {
        let _ = write!(row, ",{number}");
    }
    row.push('\n');
}

/// Text as a field of the table: in quotes if it would not stay one otherwise (RFC 4180).
pub(crate) fn field(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_has_as_many_fields_as_the_header() {
        let scene = windfall_core::Scene::preset("autumn-park").expect("a preset");
        let world = World::build(&scene).expect("valid");
        let step = world.step_block();
        let cx = world.context(&step);
        let mut row = String::new();
        for slot in (0..world.leaves.len()).step_by(97) {
            row.clear();
            write_row(&mut row, &world, slot, &world.leaves.view(&cx, slot));
            assert_eq!(row.matches(',').count(), HEADER.matches(',').count(), "{row}");
        }
        let dormant = LeafView { state: LeafState::Dormant, ..world.leaves.view(&cx, 0) };
        row.clear();
        write_row(&mut row, &world, 0, &dormant);
        assert_eq!(row.matches(',').count(), HEADER.matches(',').count(), "{row}");
    }

    #[test]
    fn odd_names_stay_one_field() {
        assert_eq!(field("maple"), "maple", "plain");
        assert_eq!(field("a \"b\", c"), "\"a \"\"b\"\", c\"", "quoted");
    }
}
