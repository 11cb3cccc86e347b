// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A folder of point clouds: a binary little-endian PLY file for every frame, a vertex for every leaf that is somewhere.

use std::fmt::Write as _;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use glam::{Quat, Vec3};
use windfall_core::leaf::LeafState;

use super::{Exporter, Frame, FrameLeaf};
use crate::files::{OutputFolder, WriteError};

/// Floats of a vertex, in their order.
const FLOATS: [&str; 14] =
    ["x", "y", "z", "nx", "ny", "nz", "vx", "vy", "vz", "qx", "qy", "qz", "qw", "size"];

/// Bytes of a vertex: the floats, its number, state and species.
pub(super) const VERTEX_BYTES: u64 = 4 * FLOATS.len() as u64 + 4 + 1 + 1;

/// Point clouds in the making.
#[derive(Debug)]
pub(super) struct PlyExport {
    folder: OutputFolder,
}

impl PlyExport {
    /// Begins the folder.
    pub(super) fn start(path: &Path) -> anyhow::Result<Self> {
        Ok(Self { folder: OutputFolder::create(path)? })
    }
}

impl Exporter for PlyExport {
    fn push(&mut self, frame: &Frame<'_>) -> anyhow::Result<()> {
        let path = self.folder.partial().join(name(frame.number));
        let written = File::create(path).and_then(|file| {
            let mut out = BufWriter::new(file);
            write_frame(&mut out, frame)?;
            out.flush()
        });
        Ok(written.map_err(WriteError::at(self.folder.destination()))?)
    }

    /// Moves the folder into place; into one that is already there, frame by frame. Whatever else lies there stays.
    fn finish(self: Box<Self>) -> anyhow::Result<PathBuf> {
        let path = self.folder.destination().to_owned();
        self.folder.finish("")?;
        Ok(path)
    }
}

/// Name of a frame's file.
fn name(number: u32) -> String {
    format!("frame_{number:06}.ply")
}

/// Writes a whole file.
pub(super) fn write_frame(out: &mut impl Write, frame: &Frame<'_>) -> io::Result<()> {
    let species = &frame.world.compiled.scene().species;
    let present = || frame.leaves.iter().filter(|leaf| leaf.state != LeafState::Dormant);
    let mut header = "ply\nformat binary_little_endian 1.0\n".to_owned();
    // Writing to a String cannot fail.
    let _ = writeln!(header, "comment frame {}", frame.number);
    let _ = writeln!(header, "comment time_s {:.6}", frame.world.clock.seconds());
    header += "comment y is up; metres, m/s; size is a diameter; state: 1 attached, 2 falling, 3 resting\n";
    for (number, species) in species.iter().enumerate() {
        let plain: String = species.name.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        let _ = writeln!(header, "comment species {number} {plain}");
    }
    let _ = writeln!(header, "element vertex {}", present().count());
    for float in FLOATS {
        let _ = writeln!(header, "property float {float}");
    }
    header += "property uint id\nproperty uchar state\nproperty uchar species\nend_header\n";
    out.write_all(header.as_bytes())?;
    for leaf in present() {
        out.write_all(&vertex(leaf, species.get(leaf.species).map_or(0.0, |species| species.size_m)))?;
    }
    Ok(())
}

/// The bytes of a leaf.
fn vertex(leaf: &FrameLeaf, species_m: f32) -> Vec<u8> {
    let normal = (Quat::from_array(leaf.quaternion) * Vec3::Y).to_array();
    let parts =
        [&leaf.position_m[..], &normal, &leaf.velocity_m_s, &leaf.quaternion, &[leaf.size * species_m]];
    let mut bytes: Vec<u8> = parts.concat().into_iter().flat_map(f32::to_le_bytes).collect();
    bytes.extend(leaf.id.to_le_bytes());
    // A scene has at most 32 species.
    bytes.extend([leaf.state as u8, u8::try_from(leaf.species).unwrap_or(u8::MAX)]);
    bytes
}
