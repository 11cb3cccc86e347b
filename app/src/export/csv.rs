// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Tables of comma-separated values: a row for every leaf of every frame, and in a second one, beside it, for every living particle.

use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use windfall_core::leaf::LeafState;

use super::{Exporter, Frame, FrameLeaf, Job};
use crate::files::{CsvFile, OutputFile, UnfinishedWork, WriteError};
use crate::run::leaf_row::{LeafRow, header};
use crate::run::live_particle;

/// Columns before those of the leaf or the particle.
const BEFORE: [&str; 3] = ["frame", "step", "time_s"];
/// Columns behind those of the leaf.
const AFTER: [&str; 1] = ["size_m"];

/// Names of the tables while they are in the making.
const LEAVES: &str = "leaves.csv";
const PARTICLES: &str = "particles.csv";

/// Bytes of a row of a leaf, about.
pub(super) const ROW_BYTES: u64 = 170;
/// Bytes of a row of a particle, about.
pub(super) const PARTICLE_BYTES: u64 = 130;

/// Tables in the making.
#[derive(Debug)]
pub(super) struct CsvExport {
    work: UnfinishedWork,
    path: PathBuf,
    leaves: CsvFile<File>,
    /// That of particles, if the scene has any.
    particles: Option<CsvFile<File>>,
    next: u32,
}

/// Bytes of the tables up to a frame.
#[derive(Debug, Serialize, Deserialize)]
struct Written {
    /// The frame behind them.
    next: u32,
    leaves: u64,
    particles: u64,
}

impl CsvExport {
    /// Begins the tables, or goes on with them.
    pub(super) fn start(job: &Job<'_>) -> anyhow::Result<Self> {
        let beside = particle_path(job.path);
        let has_particles = !job.scene.particles.is_empty();
        // Finds what is wrong with the places. Links stay links.
        let path = OutputFile::create(job.path)?.destination().to_owned();
        has_particles.then(|| OutputFile::create(&beside)).transpose()?;
        let work = UnfinishedWork::open(job.path, job.identity, job.restart)?.by_progress();
        // A run that ended while it moved its tables begins anew.
        let bytes = |name| fs::metadata(work.parts().join(name)).map_or(0, |file| file.len());
        let is_whole = |kept: &Written| kept.leaves <= bytes(LEAVES) && kept.particles <= bytes(PARTICLES);
        let kept: Option<Written> = work.progress().filter(is_whole);
        let kept = kept.as_ref();
        let leaves_kept = kept.map(|kept| kept.leaves);
        let leaves =
            CsvFile::grow(&work.parts().join(LEAVES), job.path, &header(&BEFORE, &AFTER), leaves_kept)?;
        let begin = || {
            let part = work.parts().join(PARTICLES);
            CsvFile::grow(&part, &beside, &live_particle::header(&BEFORE), kept.map(|kept| kept.particles))
        };
        let particles = has_particles.then(begin).transpose()?;
        let next = kept.map_or(job.frames.first, |kept| kept.next);
        Ok(Self { work, path, leaves, particles, next })
    }
}

/// The table of particles beside that of leaves.
fn particle_path(path: &Path) -> PathBuf {
    let mut name = path.file_stem().unwrap_or_default().to_owned();
    name.push("_particles.csv");
    path.with_file_name(name)
}

impl Exporter for CsvExport {
    fn next(&self) -> Option<u32> {
        Some(self.next)
    }

    fn push(&mut self, frame: &Frame<'_>) -> anyhow::Result<()> {
        write_frame(&mut self.leaves, frame)?;
        if let Some(table) = &mut self.particles {
            write_particles(table, frame)?;
        }
        self.next = frame.number + 1;
        let particles = self.particles.as_mut().map_or(Ok(0), CsvFile::written)?;
        let written = Written { next: self.next, leaves: self.leaves.written()?, particles };
        Ok(self.work.note_progress(&written)?)
    }

    fn finish(mut self: Box<Self>) -> anyhow::Result<PathBuf> {
        if let Some(table) = &mut self.particles {
            table.complete()?;
            let to = particle_path(&self.path);
            fs::rename(self.work.parts().join(PARTICLES), &to).map_err(WriteError::at(&to))?;
        }
        self.leaves.complete()?;
        fs::rename(self.work.parts().join(LEAVES), &self.path).map_err(WriteError::at(&self.path))?;
        let Self { work, path, .. } = *self;
        work.finish();
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
