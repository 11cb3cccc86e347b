// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Tables of comma-separated values: a row for every leaf of every frame, and in a second one, beside it, for every living particle.

use std::io::Write;
use std::path::{Path, PathBuf};

use windfall_core::leaf::LeafState;

use super::{Exporter, Frame, FrameLeaf, Job};
use crate::files::{CsvFile, WriteError};
use crate::run::leaf_row::{LeafRow, header};
use crate::run::live_particle;

/// Columns before those of the leaf or the particle.
const BEFORE: [&str; 3] = ["frame", "step", "time_s"];
/// Columns behind those of the leaf.
const AFTER: [&str; 1] = ["size_m"];

/// Bytes of a row of a leaf, about.
pub(super) const ROW_BYTES: u64 = 170;
/// Bytes of a row of a particle, about.
pub(super) const PARTICLE_BYTES: u64 = 130;

/// Tables in the making.
#[derive(Debug)]
pub(super) struct CsvExport {
    leaves: CsvFile,
    /// That of particles, if the scene has any.
    particles: Option<CsvFile>,
}

impl CsvExport {
    /// Begins the tables.
    pub(super) fn start(job: &Job<'_>) -> anyhow::Result<Self> {
        let leaves = CsvFile::create(job.path, &header(&BEFORE, &AFTER))?;
        let has_particles = !job.scene.particles.is_empty();
        let begin = || CsvFile::create(&particle_path(job.path), &live_particle::header(&BEFORE));
        Ok(Self { leaves, particles: has_particles.then(begin).transpose()? })
    }
}

/// The table of particles beside that of leaves.
fn particle_path(path: &Path) -> PathBuf {
    let mut name = path.file_stem().unwrap_or_default().to_owned();
    name.push("_particles.csv");
    path.with_file_name(name)
}

impl Exporter for CsvExport {
    fn push(&mut self, frame: &Frame<'_>) -> anyhow::Result<()> {
        write_frame(&mut self.leaves, frame)?;
        if let Some(table) = &mut self.particles {
            write_particles(table, frame)?;
        }
        Ok(())
    }

    fn finish(self: Box<Self>) -> anyhow::Result<PathBuf> {
        let path = self.leaves.destination().to_owned();
        self.particles.map(CsvFile::finish).transpose()?;
        self.leaves.finish()?;
        Ok(path)
    }
}

/// Writes the rows of the leaves of a frame.
fn write_frame<W: Write>(table: &mut CsvFile<W>, frame: &Frame<'_>) -> Result<(), WriteError> {
    let species = &frame.world.compiled.scene().species;
    for leaf in frame.leaves {
        begin_row(table, frame);
        let (name, size_m) =
            species.get(leaf.species).map_or(("", 0.0), |species| (&*species.name, species.size_m));
        write_leaf(table, leaf, name, size_m)?;
    }
    Ok(())
}

/// Writes the rows of the particles of a frame.
fn write_particles<W: Write>(table: &mut CsvFile<W>, frame: &Frame<'_>) -> Result<(), WriteError> {
    let populations = &frame.world.compiled.scene().particles;
    frame.particles.iter().try_for_each(|particle| {
        begin_row(table, frame);
        particle.write(&populations[particle.population].name, table)
    })
}

/// Writes what the rows of a frame begin with.
fn begin_row<W: Write>(table: &mut CsvFile<W>, frame: &Frame<'_>) {
    let clock = &frame.world.clock;
    table.field(frame.number).field(clock.step()).field(format_args!("{:.6}", clock.seconds()));
}

/// Writes the rest of a row of a leaf. A dormant leaf has no place yet: all fields behind its state are empty.
fn write_leaf<W: Write>(
    table: &mut CsvFile<W>,
    leaf: &FrameLeaf,
    species: &str,
    species_m: f32,
) -> Result<(), WriteError> {
    let row = LeafRow {
        slot: leaf.slot,
        id: leaf.id,
        state: leaf.state,
        motion: leaf.motion,
        species,
        position_m: leaf.position_m,
        velocity_m_s: leaf.velocity_m_s,
        attitude: leaf.quaternion,
    };
    row.write(table);
    if leaf.state == LeafState::Dormant {
        return table.empty(AFTER.len()).end_row();
    }
    table.field(leaf.size * species_m).end_row()
}

#[cfg(test)]
mod tests {
    use std::io;

    use windfall_core::{Scene, World};

    use super::*;
    use crate::export::Observer;

    /// A disk with little room.
    struct Small(usize);

    impl Write for Small {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            let room = self.0.checked_sub(bytes.len()).ok_or(io::ErrorKind::StorageFull)?;
            self.0 = room;
            Ok(bytes.len())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn a_full_disk_is_an_error_of_every_writer() {
        let world = World::build(&Scene::default()).expect("a scene");
        let mut observer = Observer::default();
        let frame = observer.look(&world, 0);
        let table = |room| {
            let mut table = CsvFile::new(Small(room), Path::new("a.csv"), &header(&BEFORE, &AFTER))?;
            write_frame(&mut table, &frame)?;
            table.flush()
        };
        for room in [0, 100, 4000] {
            let error = table(room).expect_err("too little room").to_string();
            assert!(
                error.contains(&io::ErrorKind::StorageFull.to_string()),
                "{room} bytes of a table: {error}"
            );
            let points = super::super::ply::write_frame(&mut Small(room), &frame);
            let kind = points.expect_err("too little room").kind();
            assert_eq!(kind, io::ErrorKind::StorageFull, "{room} bytes of points");
        }
        assert!(table(usize::MAX).is_ok(), "with room");
    }

    #[test]
    fn every_row_has_as_many_fields_as_the_header() {
        let leaf = |state| FrameLeaf {
            slot: 1,
            id: 2,
            state,
            motion: "SD",
            species: 0,
            position_m: [1.0, 2.0, 3.0],
            quaternion: [0.0, 0.0, 0.0, 1.0],
            velocity_m_s: [0.0; 3],
            size: 2.0,
            appearance: 0,
        };
        let mut table = CsvFile::new(Vec::new(), Path::new("a.csv"), &header(&BEFORE, &AFTER)).expect("room");
        for state in [LeafState::Dormant, LeafState::Falling] {
            table.field(0).field(0).field(0);
            write_leaf(&mut table, &leaf(state), "maple", 0.5).expect("as long as the header");
        }
    }
}
