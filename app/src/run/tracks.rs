// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Tracks of single leaves or particles as a table of comma-separated values.

use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::bail;
use clap::Args;
use serde_json::{Value, json};
use windfall_core::leaf::LeafView;
use windfall_core::{Context, Scene, World};

use super::leaf_row::{LeafRow, header};
use super::live_particle::{self, LiveParticle};
use crate::files::{CsvFile, OutputFile, WriteError};
use crate::run::parse::whole;
use crate::run::sharding::ShardArguments;

/// Columns before those of the leaf or the particle.
const BEFORE: [&str; 2] = ["step", "time_s"];

/// Options of tracks.
#[derive(Clone, Debug, Args)]
pub(crate) struct TrackArguments {
    /// Write the tracks of single leaves to this CSV file.
    #[arg(long, value_name = "FILE.csv")]
    tracks: Option<PathBuf>,
    /// Write tracks at every step whose number is a multiple of this.
    #[arg(long, value_name = "N", default_value = "1", requires = "tracks",
        value_parser = whole::<u32, 1, 1_000_000_000>)]
    track_every: u32,
    /// Write the tracks of the first so many leaves, or, with --population, of the particles in its first so many slots.
    #[arg(long, value_name = "N", default_value = "100", requires = "tracks",
        value_parser = whole::<u32, 1, { u32::MAX as u64 }>)]
    track_leaves: u32,
    /// Write the tracks of particles of this population in place of leaves: a row for each that is alive.
    #[arg(long, value_name = "NAME", requires = "tracks")]
    population: Option<String>,
}

impl TrackArguments {
    /// Path that the table of a shard will lie at, if there is to be one. Links stay links.
    ///
    /// # Errors
    /// Whatever would keep it from lying there.
    pub(crate) fn destination(&self, shard: &ShardArguments) -> Result<Option<PathBuf>, WriteError> {
        self.tracks
            .as_deref()
            .map(|path| Ok(OutputFile::create(&shard.path(path))?.destination().to_owned()))
            .transpose()
    }

    /// Begins the table for a scene in `part`, or goes on behind its first `kept` bytes; `destination` is the path that it will lie at.
    ///
    /// # Errors
    /// A population that the scene does not have; errors of the system.
    pub(crate) fn grow(
        &self,
        scene: &Scene,
        (part, destination): (&Path, &Path),
        kept: Option<u64>,
    ) -> anyhow::Result<Tracks<File>> {
        let header = match &self.population {
            None => header(&BEFORE, &[]),
            Some(_) => live_particle::header(&BEFORE),
        };
        let tracked = match &self.population {
            None => Tracked::Leaves(self.track_leaves),
            Some(name) => {
                Tracked::Particles { population: population(scene, name)?, most: self.track_leaves }
            }
        };
        Ok(Tracks {
            table: CsvFile::grow(part, destination, &header, kept)?,
            every: self.track_every,
            tracked,
        })
    }

    /// Everything that the table depends on, besides the scene.
    pub(crate) fn identity(&self) -> Value {
        json!({
            "tracks": self.tracks.is_some(),
            "track_every": self.track_every,
            "track_leaves": self.track_leaves,
            "population": self.population,
        })
    }
}

/// Number of a population by its name.
fn population(scene: &Scene, name: &str) -> anyhow::Result<usize> {
    let names: Vec<&str> = scene.particles.iter().map(|particles| particles.name.as_str()).collect();
    match names.iter().position(|known| *known == name) {
        Some(number) => Ok(number),
        None if names.is_empty() => bail!("--population is '{name}'; the scene has no particles"),
        None => bail!("--population is '{name}'; allowed: '{}'", names.join("', '")),
    }
}

/// Rows of a table.
#[derive(Debug)]
enum Tracked {
    /// The first so many leaves.
    Leaves(u32),
    /// Particles in the first slots of a population.
    Particles { population: usize, most: u32 },
}

/// A table in the making: one row for each leaf, or living particle, and sampled step.
#[derive(Debug)]
pub(crate) struct Tracks<W: Write = OutputFile> {
    table: CsvFile<W>,
    every: u32,
    tracked: Tracked,
}

impl Tracks {
    /// Begins a table of the first `leaves` leaves at every step whose number is a multiple of `every`, at least 1.
    ///
    /// # Errors
    /// Whatever would keep the file from being written.
    pub(crate) fn create(path: &Path, every: u32, leaves: u32) -> anyhow::Result<Self> {
        let table = CsvFile::create(path, &header(&BEFORE, &[]))?;
        Ok(Self { table, every, tracked: Tracked::Leaves(leaves) })
    }

    /// Completes the table under its own name.
    ///
    /// # Errors
    /// Errors of the system, named with the path.
    pub(crate) fn finish(self) -> anyhow::Result<()> {
        Ok(self.table.finish()?)
    }
}

impl Tracks<File> {
    /// Writes all rows that are still waiting, and returns the bytes of the table.
    ///
    /// # Errors
    /// Errors of the system, named with the path.
    pub(crate) fn written(&mut self) -> Result<u64, WriteError> {
        self.table.written()
    }

    /// Brings the table to the disk.
    ///
    /// # Errors
    /// Errors of the system, named with the path.
    pub(crate) fn complete(&mut self) -> Result<(), WriteError> {
        self.table.complete()
    }
}

impl<W: Write> Tracks<W> {
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
    /// Errors of the system, named with the path.
    pub(crate) fn sample(&mut self, world: &World) -> anyhow::Result<()> {
        match self.tracked {
            Tracked::Leaves(leaves) => {
                let step = world.step_block();
                let cx = world.context(&step);
                let rows = world.compiled.shard_rows().leaves();
                let mut tracked = rows.take_while(|(_, slot)| *slot < leaves);
                tracked.try_for_each(|(row, slot)| {
                    Ok(write_row(&mut self.table, world, slot, &world.leaves.view(&cx, row))?)
                })
            }
            Tracked::Particles { population, most } => {
                let name = &world.compiled.scene().particles[population].name;
                LiveParticle::first_of(world, population, most).try_for_each(|particle| {
                    begin_row(&mut self.table, world);
                    Ok(particle.write(name, &mut self.table)?)
                })
            }
        }
    }

    /// Adds the row of one leaf, at the step of a context.
    ///
    /// # Errors
    /// Errors of the system, named with the path.
    pub(crate) fn add(&mut self, world: &World, cx: &Context<'_>, slot: usize) -> anyhow::Result<()> {
        // Scenes have far fewer leaves.
        let number = u32::try_from(slot).unwrap_or(u32::MAX);
        Ok(write_row(&mut self.table, world, number, &world.leaves.view(cx, slot))?)
    }
}

/// Writes what a row begins with.
fn begin_row<W: Write>(table: &mut CsvFile<W>, world: &World) {
    table.field(world.clock.step()).field(format_args!("{:.6}", world.clock.seconds()));
}

/// Writes the row of a leaf. Of a dormant leaf it holds but the state; only a falling one has a primitive motion.
fn write_row<W: Write>(
    table: &mut CsvFile<W>,
    world: &World,
    slot: u32,
    leaf: &LeafView,
) -> Result<(), WriteError> {
    begin_row(table, world);
    let species = world.compiled.scene().species.get(leaf.species);
    let row = LeafRow {
        slot,
        id: leaf.id,
        state: leaf.state,
        motion: leaf.motion_code(),
        species: species.map_or("", |species| &species.name),
        position_m: leaf.position.to_array(),
        velocity_m_s: leaf.velocity.to_array(),
        attitude: leaf.attitude.to_array(),
    };
    row.write(table);
    table.end_row()
}

#[cfg(test)]
mod tests {
    use windfall_core::leaf::LeafState;

    use super::*;

    #[test]
    fn every_row_has_as_many_fields_as_the_header() {
        let scene = Scene::preset("autumn-park").expect("a preset");
        let world = World::build(&scene).expect("valid");
        let step = world.step_block();
        let cx = world.context(&step);
        let mut table =
            CsvFile::new(Vec::new(), Path::new("tracks.csv"), &header(&BEFORE, &[])).expect("room");
        for slot in (0..scene.leaf_count()).step_by(97) {
            write_row(&mut table, &world, slot, &world.leaves.view(&cx, slot as usize))
                .expect("as long as the header");
        }
        let dormant = LeafView { state: LeafState::Dormant, ..world.leaves.view(&cx, 0) };
        write_row(&mut table, &world, 0, &dormant).expect("as long as the header");
    }
}
