// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Blobs: a `Mesh` prim for each population that is drawn so, with other corners and faces in every frame.

use std::io::{self, Write};

use glam::Vec3;
use windfall_core::Scene;

use super::particles::EMPTY;
use super::prototypes::NORMAL_PLACES;
use super::samples::{Handle, Samples};
use super::text;
use crate::export::Frame;
use crate::export::blob_mesh::{BlobMesh, blob_mesh, is_blobs};
use crate::export::names::prim_names;

/// Decimal places of corners in metres, of velocities and colours.
const PLACES: i32 = 5;

/// The attributes of all blobs.
#[derive(Debug)]
pub(super) struct BlobSamples {
    populations: Vec<MeshAttributes>,
}

/// The attributes of the mesh of a population.
#[derive(Debug)]
struct MeshAttributes {
    /// Number of the population.
    population: usize,
    points: Handle,
    normals: Handle,
    velocities: Handle,
    colors: Handle,
    counts: Handle,
    indices: Handle,
    extent: Handle,
}

impl BlobSamples {
    pub(super) fn declare(samples: &mut Samples, scene: &Scene) -> Self {
        let blobs = prim_names(scene).into_iter().zip(&scene.particles).enumerate();
        let populations = blobs.filter(|(_, (_, population))| is_blobs(population));
        let populations = populations.map(|(population, (name, _))| {
            let mut declare = |declaration| samples.declare(&format!("World/Blobs/{name}"), declaration);
            MeshAttributes {
                population,
                points: declare("point3f[] points"),
                normals: declare("normal3f[] normals"),
                velocities: declare("vector3f[] velocities"),
                colors: declare("color3f[] primvars:displayColor"),
                counts: declare("int[] faceVertexCounts"),
                indices: declare("int[] faceVertexIndices"),
                extent: declare("float3[] extent"),
            }
        });
        Self { populations: populations.collect() }
    }

    pub(super) fn add(&self, samples: &mut Samples, frame: &Frame<'_>) {
        let scene = frame.world.compiled.scene();
        for attributes in &self.populations {
            let particles = frame.particles_of(attributes.population);
            let mesh = blob_mesh(&scene.particles[attributes.population], particles);
            attributes.add(samples, frame.number, &mesh);
        }
    }
}

impl MeshAttributes {
    fn add(&self, samples: &mut Samples, number: u32, mesh: &BlobMesh) {
        let mut vectors = |handle, values: &[Vec3], places| {
            let values = values.iter().map(|value| value.to_array());
            samples.add(handle, number, |out| text::rounded(out, values, places));
        };
        vectors(self.points, &mesh.positions_m, PLACES);
        vectors(self.normals, &mesh.normals, NORMAL_PLACES);
        vectors(self.velocities, &mesh.velocities_m_s, PLACES);
        vectors(self.colors, &mesh.colors, PLACES);
        let counts = mesh.triangles.iter().map(|triangle| triangle.len());
        samples.add(self.counts, number, |out| text::numbers(out, counts));
        samples.add(self.indices, number, |out| text::numbers(out, mesh.triangles.as_flattened()));
        let boxes = mesh.positions_m.iter().map(|at| [*at, *at]);
        let extent = boxes.reduce(|[low, high], [from, to]| [low.min(from), high.max(to)]);
        let extent = extent.unwrap_or(EMPTY).map(|corner| corner.to_array());
        samples.add(self.extent, number, |out| text::rounded(out, extent, PLACES));
    }
}

/// Writes the prims.
pub(super) fn write_blobs(out: &mut impl Write, scene: &Scene) -> io::Result<()> {
    if !scene.particles.iter().any(is_blobs) {
        return Ok(());
    }
    writeln!(out, "def Scope \"Blobs\"\n{{")?;
    let names = prim_names(scene);
    for (name, population) in
        names.iter().zip(&scene.particles).filter(|(_, population)| is_blobs(population))
    {
        let shown = text::quoted(&population.name);
        write!(
            out,
            "def Mesh \"{name}\" (\ndisplayName = {shown}\n)\n{{\n\
            normal3f[] normals (\ninterpolation = \"vertex\"\n)\n\
            color3f[] primvars:displayColor (\ninterpolation = \"vertex\"\n)\n\
            uniform token subdivisionScheme = \"none\"\n}}\n"
        )?;
    }
    writeln!(out, "}}")
}
