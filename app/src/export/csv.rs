// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A table of comma-separated values: a row for every leaf of every frame.

use std::fmt::Write as _;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use windfall_core::leaf::LeafState;

use super::frame::state_name;
use super::{Exporter, Frame, FrameLeaf};
use crate::files::{OutputFile, write_error};

const HEADER: &str =
    "frame,step,time_s,leaf,id,state,primitive,species,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s,qx,qy,qz,qw,size_m\n";

/// Bytes of a row, about.
pub(super) const ROW_BYTES: u64 = 170;

/// A table in the making.
#[derive(Debug)]
pub(super) struct CsvExport {
    out: BufWriter<OutputFile>,
    row: String,
}

impl CsvExport {
    /// Begins the table.
    pub(super) fn start(path: &Path) -> anyhow::Result<Self> {
        let mut out = BufWriter::new(OutputFile::create(path)?);
        out.write_all(HEADER.as_bytes()).map_err(|error| write_error(path, &error))?;
        Ok(Self { out, row: String::new() })
    }

    fn failed(&self, error: &io::Error) -> anyhow::Error {
        write_error(self.out.get_ref().destination(), error)
    }
}

impl Exporter for CsvExport {
    fn push(&mut self, frame: &Frame<'_>) -> anyhow::Result<()> {
        write_frame(&mut self.out, &mut self.row, frame).map_err(|error| self.failed(&error))
    }

    fn finish(mut self: Box<Self>) -> anyhow::Result<PathBuf> {
        self.out.flush().map_err(|error| self.failed(&error))?;
        let path = self.out.get_ref().destination().to_owned();
        self.out.into_inner().map_err(|error| write_error(&path, error.error()))?.finish()?;
        Ok(path)
    }
}

/// Writes the rows of a frame.
fn write_frame(out: &mut impl Write, row: &mut String, frame: &Frame<'_>) -> io::Result<()> {
    let species: Vec<String> =
        frame.world.environment.scene().species.iter().map(|species| field(&species.name)).collect();
    let sizes: Vec<f32> =
        frame.world.environment.scene().species.iter().map(|species| species.size_m).collect();
    let moment = format!("{},{},{:.6}", frame.number, frame.world.clock.step(), frame.world.clock.seconds());
    for leaf in frame.leaves {
        row.clear();
        row.push_str(&moment);
        let name = species.get(leaf.species).map_or("", String::as_str);
        write_row(row, leaf, name, sizes.get(leaf.species).copied().unwrap_or(0.0));
        out.write_all(row.as_bytes())?;
    }
    Ok(())
}

/// The rest of a row. A dormant leaf is nowhere yet: nothing but its state is told.
fn write_row(row: &mut String, leaf: &FrameLeaf, species: &str, species_m: f32) {
    // Writing to a String cannot fail.
    let _ = write!(row, ",{},{},{},", leaf.slot, leaf.id, state_name(leaf.state));
    if leaf.state == LeafState::Dormant {
        row.push_str(",,,,,,,,,,,,\n");
        return;
    }
    row.push_str(leaf.motion);
    row.push(',');
    row.push_str(species);
    for number in leaf.position_m.iter().chain(&leaf.velocity_m_s).chain(&leaf.quaternion) {
        let _ = write!(row, ",{number}");
    }
    let _ = writeln!(row, ",{}", leaf.size * species_m);
}

/// Text as a field of the table: in quotes if it would not stay one otherwise (RFC 4180).
fn field(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

#[cfg(test)]
mod tests {
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
    fn a_full_disk_is_told_by_every_writer() {
        let world = World::build(&Scene::default()).expect("a scene");
        let mut observer = Observer::default();
        let frame = observer.look(&world, 0);
        let full =
            |result: io::Result<()>| result.map_err(|error| error.kind()) == Err(io::ErrorKind::StorageFull);
        for room in [0, 100, 4000] {
            assert!(
                full(write_frame(&mut Small(room), &mut String::new(), &frame)),
                "{room} bytes of a table"
            );
            assert!(full(super::super::ply::write_frame(&mut Small(room), &frame)), "{room} bytes of points");
        }
        assert!(write_frame(&mut Small(usize::MAX), &mut String::new(), &frame).is_ok(), "with room");
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
        for state in [LeafState::Dormant, LeafState::Falling] {
            let mut row = "0,0,0".to_owned();
            write_row(&mut row, &leaf(state), &field("maple"), 0.5);
            assert_eq!(row.matches(',').count(), HEADER.matches(',').count(), "{row}");
            assert_eq!(row.ends_with(",1\n"), state == LeafState::Falling, "size in metres: {row}");
        }
        assert_eq!(field("a \"b\", c"), "\"a \"\"b\"\", c\"", "quoted");
    }
}
