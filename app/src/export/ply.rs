// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A folder of point clouds: a binary little-endian PLY file for every frame, a vertex for every leaf that is somewhere, and another
//! beside it with a vertex for every living particle, a third with the surface of those that are drawn as blobs, and one with that of the
//! snow that lies.

use std::fmt::Write as _;
use std::io::{self, BufWriter, Write};
use std::iter;
use std::path::PathBuf;

use glam::{Quat, Vec3};
use windfall_core::leaf::LeafState;

use super::blob_mesh::{blob_mesh, is_blobs};
use super::snow_mesh::{SNOW, SnowMesh, cover};
use super::{Exporter, Frame, FrameLeaf, Job};
use crate::files::{OutputFile, OutputFolder, UnfinishedWork, WriteError};

/// Floats of a leaf's vertex, in their order.
const FLOATS: [&str; 14] =
    ["x", "y", "z", "nx", "ny", "nz", "vx", "vy", "vz", "qx", "qy", "qz", "qw", "size"];

/// Bytes of a leaf's vertex: the floats, its number, state and species.
pub(super) const VERTEX_BYTES: u64 = 4 * FLOATS.len() as u64 + 4 + 1 + 1;

/// Floats of a particle's vertex, in their order.
const PARTICLE_FLOATS: [&str; 8] = ["x", "y", "z", "vx", "vy", "vz", "size", "age"];

/// Bytes of a particle's vertex: the floats, its number, state and population.
pub(super) const PARTICLE_BYTES: u64 = 4 * PARTICLE_FLOATS.len() as u64 + 4 + 1 + 1;

/// Floats of a corner of blobs, in their order.
const BLOB_FLOATS: [&str; 6] = ["x", "y", "z", "nx", "ny", "nz"];

/// Bytes of a slot of blobs, about: of their mesh, while they touch.
pub(super) const BLOB_BYTES: u64 = 6_000;

/// Floats of a corner of snow, in their order.
const SNOW_FLOATS: [&str; 7] = ["x", "y", "z", "nx", "ny", "nz", "depth"];

/// Bytes of a cell of snow: a corner with its colour, and two triangles.
pub(super) const SNOW_BYTES: u64 = 4 * SNOW_FLOATS.len() as u64 + 4 + 2 * (1 + 3 * 4);

/// Point clouds in the making.
#[derive(Debug)]
pub(super) struct PlyExport {
    work: UnfinishedWork,
    next: u32,
}

impl PlyExport {
    /// Begins the folder, or goes on behind the frames that are there.
    pub(super) fn start(job: &Job<'_>) -> anyhow::Result<Self> {
        // Finds what is wrong with the place.
        drop(OutputFolder::create(job.path)?);
        let work = UnfinishedWork::open(job.path, job.identity, job.restart)?;
        let is_there = |number: &u32| work.part(&file_name("frame", *number)).is_some();
        let frames = job.frames;
        let next = (frames.first..=frames.last).find(|number| !is_there(number)).unwrap_or(frames.last + 1);
        Ok(Self { work, next })
    }

    /// Writes a file of this kind.
    fn write(
        &self,
        kind: &str,
        frame: &Frame<'_>,
        write: impl FnOnce(&mut BufWriter<OutputFile>, &Frame<'_>) -> io::Result<()>,
    ) -> Result<(), WriteError> {
        let path = self.work.parts().join(file_name(kind, frame.number));
        let mut out = BufWriter::new(OutputFile::create(&path)?);
        let written =
            write(&mut out, frame).and_then(|()| out.into_inner().map_err(|error| error.into_error()));
        written.map_err(WriteError::at(self.work.destination()))?.finish()
    }
}

/// Name of a file of a frame.
fn file_name(kind: &str, number: u32) -> String {
    format!("{kind}_{number:06}.ply")
}

impl Exporter for PlyExport {
    fn next(&self) -> Option<u32> {
        Some(self.next)
    }

    /// Leaves last: they say that the frame is complete.
    fn push(&mut self, frame: &Frame<'_>) -> anyhow::Result<()> {
        let scene = frame.world.compiled.scene();
        if !scene.particles.is_empty() {
            self.write("particles", frame, write_particles)?;
        }
        if scene.particles.iter().any(is_blobs) {
            self.write("blobs", frame, write_blobs)?;
        }
        if scene.weather.is_some() {
            self.write("snow", frame, write_snow)?;
        }
        self.write("frame", frame, write_frame)?;
        self.next = frame.number + 1;
        Ok(())
    }

    /// Moves the folder into place; into one that is already there, frame by frame. Whatever else lies there stays.
    fn finish(self: Box<Self>) -> anyhow::Result<PathBuf> {
        let path = self.work.destination().to_owned();
        self.work.finish_in_folder("")?;
        Ok(path)
    }
}

/// Begins a header: format, time, and the names of what vertices have a number of.
fn head<'a>(frame: &Frame<'_>, note: &str, kind: &str, names: impl Iterator<Item = &'a String>) -> String {
    let mut header = "ply\nformat binary_little_endian 1.0\n".to_owned();
    // Writing to a String cannot fail.
    let _ = writeln!(header, "comment frame {}", frame.number);
    let _ = writeln!(header, "comment time_s {:.6}", frame.world.clock.seconds());
    let _ = writeln!(header, "comment y is up; metres, m/s; {note}");
    for (number, name) in names.enumerate() {
        let plain: String = name.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        let _ = writeln!(header, "comment {kind} {number} {plain}");
    }
    header
}

/// Adds the number of vertices and the floats of each.
fn declare(header: &mut String, count: usize, floats: &[&str]) {
    // Writing to a String cannot fail.
    let _ = writeln!(header, "element vertex {count}");
    for float in floats {
        let _ = writeln!(header, "property float {float}");
    }
}

/// Adds the number of faces and ends a header.
fn declare_faces(header: &mut String, count: usize) {
    // Writing to a String cannot fail.
    let _ = writeln!(header, "element face {count}\nproperty list uchar uint vertex_indices\nend_header");
}

/// Writes a whole file of leaves.
pub(super) fn write_frame(out: &mut impl Write, frame: &Frame<'_>) -> io::Result<()> {
    let species = &frame.world.compiled.scene().species;
    let present = || frame.leaves.iter().filter(|leaf| leaf.state != LeafState::Dormant);
    let note = "size is a diameter; state: 1 attached, 2 falling, 3 resting";
    let mut header = head(frame, note, "species", species.iter().map(|species| &species.name));
    declare(&mut header, present().count(), &FLOATS);
    header += "property uint id\nproperty uchar state\nproperty uchar species\nend_header\n";
    out.write_all(header.as_bytes())?;
    for leaf in present() {
        out.write_all(&vertex(leaf, species.get(leaf.species).map_or(0.0, |species| species.size_m)))?;
    }
    Ok(())
}

/// Writes a whole file of particles.
fn write_particles(out: &mut impl Write, frame: &Frame<'_>) -> io::Result<()> {
    let populations = &frame.world.compiled.scene().particles;
    let note = "size is a diameter, age in seconds; state: 1 flying, 2 resting";
    let mut header = head(frame, note, "population", populations.iter().map(|population| &population.name));
    declare(&mut header, frame.particles.len(), &PARTICLE_FLOATS);
    header += "property uint id\nproperty uchar state\nproperty uchar population\nend_header\n";
    out.write_all(header.as_bytes())?;
    for particle in frame.particles {
        let parts = [&particle.position_m[..], &particle.velocity_m_s, &[particle.size_m, particle.age_s]];
        let floats: Vec<u8> = parts.concat().into_iter().flat_map(f32::to_le_bytes).collect();
        out.write_all(&floats)?;
        out.write_all(&particle.id.to_le_bytes())?;
        // A scene has at most 16 populations.
        let population = u8::try_from(particle.population).unwrap_or(u8::MAX);
        out.write_all(&[1 + u8::from(particle.is_resting), population])?;
    }
    Ok(())
}

/// Writes a whole file of the surface of blobs.
fn write_blobs(out: &mut impl Write, frame: &Frame<'_>) -> io::Result<()> {
    let populations = &frame.world.compiled.scene().particles;
    let meshes: Vec<_> = (0..)
        .zip(populations)
        .filter(|(_, population)| is_blobs(population))
        .map(|(number, population)| (number, blob_mesh(population, frame.particles_of(usize::from(number)))))
        .collect();
    let note = "reflectance is linear, of 255";
    let mut header = head(frame, note, "population", populations.iter().map(|population| &population.name));
    declare(&mut header, meshes.iter().map(|(_, mesh)| mesh.positions_m.len()).sum(), &BLOB_FLOATS);
    for color in ["red", "green", "blue", "population"] {
        // Writing to a String cannot fail.
        let _ = writeln!(header, "property uchar {color}");
    }
    let faces: usize = meshes.iter().map(|(_, mesh)| mesh.triangles.len()).sum();
    declare_faces(&mut header, faces);
    out.write_all(header.as_bytes())?;
    for (number, mesh) in &meshes {
        let corners = mesh.positions_m.iter().zip(&mesh.normals).zip(&mesh.colors);
        for ((place, normal), color) in corners {
            let floats = place.to_array().into_iter().chain(normal.to_array());
            out.write_all(&floats.flat_map(f32::to_le_bytes).collect::<Vec<u8>>())?;
            let [red, green, blue] = color.to_array().map(byte);
            out.write_all(&[red, green, blue, *number])?;
        }
    }
    let mut first = 0;
    for (_, mesh) in &meshes {
        write_triangles(out, &mesh.triangles, first)?;
        first += u32::try_from(mesh.positions_m.len()).unwrap_or(u32::MAX);
    }
    Ok(())
}

/// Writes a whole file of the surface of the snow that lies.
fn write_snow(out: &mut impl Write, frame: &Frame<'_>) -> io::Result<()> {
    let mesh = SnowMesh::of(frame.world);
    let note = "reflectance is linear, of 255; alpha is the share of the ground that snow hides, of 255";
    let mut header = head(frame, note, "", iter::empty());
    declare(&mut header, mesh.positions_m.len(), &SNOW_FLOATS);
    for color in ["red", "green", "blue", "alpha"] {
        // Writing to a String cannot fail.
        let _ = writeln!(header, "property uchar {color}");
    }
    declare_faces(&mut header, mesh.triangles.len());
    out.write_all(header.as_bytes())?;
    let [red, green, blue] = SNOW.color.map(byte);
    for ((place, normal), depth_m) in mesh.positions_m.iter().zip(&mesh.normals).zip(&mesh.depths_m) {
        let floats = place.iter().chain(normal).chain([depth_m]);
        out.write_all(&floats.flat_map(|float| float.to_le_bytes()).collect::<Vec<u8>>())?;
        out.write_all(&[red, green, blue, byte(cover(*depth_m))])?;
    }
    write_triangles(out, &mesh.triangles, 0)
}

/// Writes triangles whose corners begin with the number `first`.
fn write_triangles(out: &mut impl Write, triangles: &[[u32; 3]], first: u32) -> io::Result<()> {
    for triangle in triangles {
        out.write_all(&[3])?;
        triangle.iter().try_for_each(|corner| out.write_all(&(first + corner).to_le_bytes()))?;
    }
    Ok(())
}

/// A share as a byte.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 255")]
fn byte(share: f32) -> u8 {
    (255.0 * share.clamp(0.0, 1.0)).round() as u8
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
