// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Particles: a `Points` prim for each population. What is not alive in a frame is not in its arrays.

use std::io::{self, Write};

use glam::Vec3;
use windfall_core::Scene;
use windfall_core::scene::Look;

use super::samples::{Handle, Samples};
use super::text;
use crate::export::Frame;
use crate::export::blob_mesh::is_blobs;
use crate::export::names::prim_names;
use crate::run::live_particle::LiveParticle;

/// Extent of no points: turned inside out, so that it adds nothing to a box. `UsdGeomPoints::ComputeExtent` has the largest numbers there
/// are in it; these are smaller, since readers interpolate between frames, in which the largest become infinite.
pub(super) const EMPTY: [Vec3; 2] = [Vec3::splat(1e18), Vec3::splat(-1e18)];

/// The attributes of all populations, in the order of the scene.
#[derive(Debug)]
pub(super) struct ParticleSamples {
    populations: Vec<PointAttributes>,
}

/// The attributes of the points of a population.
#[derive(Debug)]
struct PointAttributes {
    points: Handle,
    velocities: Handle,
    widths: Handle,
    ids: Handle,
    ages: Handle,
    colors: Handle,
    opacities: Handle,
    extent: Handle,
    look: Look,
}

impl ParticleSamples {
    pub(super) fn declare(samples: &mut Samples, scene: &Scene) -> Self {
        let populations = prim_names(scene).into_iter().zip(&scene.particles).map(|(name, population)| {
            let mut declare = |declaration| samples.declare(&format!("World/Particles/{name}"), declaration);
            PointAttributes {
                points: declare("point3f[] points"),
                velocities: declare("vector3f[] velocities"),
                widths: declare("float[] widths"),
                ids: declare("int64[] ids"),
                ages: declare("float[] primvars:windfall:age"),
                colors: declare("color3f[] primvars:displayColor"),
                opacities: declare("float[] primvars:displayOpacity"),
                extent: declare("float3[] extent"),
                look: population.look.clone(),
            }
        });
        Self { populations: populations.collect() }
    }

    pub(super) fn add(&self, samples: &mut Samples, frame: &Frame<'_>) {
        for (population, attributes) in self.populations.iter().enumerate() {
            attributes.add(samples, frame.number, frame.particles_of(population));
        }
    }
}

impl PointAttributes {
    fn add(&self, samples: &mut Samples, number: u32, particles: &[LiveParticle]) {
        let all = || particles.iter();
        samples.add(self.points, number, |out| text::vectors(out, all().map(|one| one.position_m)));
        samples.add(self.velocities, number, |out| text::vectors(out, all().map(|one| one.velocity_m_s)));
        samples.add(self.widths, number, |out| text::numbers(out, all().map(|one| one.size_m)));
        samples.add(self.ids, number, |out| text::numbers(out, all().map(|one| one.id)));
        samples.add(self.ages, number, |out| text::numbers(out, all().map(|one| one.age_s)));
        let looks = || all().map(|one| self.look.sample(one.age_share));
        samples.add(self.colors, number, |out| text::vectors(out, looks().map(|look| look.color.to_array())));
        samples.add(self.opacities, number, |out| text::numbers(out, looks().map(|look| look.opacity)));
        let boxes = all().map(|one| {
            let (place, reach) = (Vec3::from(one.position_m), Vec3::splat(0.5 * one.size_m));
            [place - reach, place + reach]
        });
        let extent = boxes.reduce(|[low, high], [from, to]| [low.min(from), high.max(to)]);
        let extent = extent.unwrap_or(EMPTY).map(|corner| corner.to_array());
        samples.add(self.extent, number, |out| text::vectors(out, extent));
    }
}

/// Writes the prims.
pub(super) fn write_populations(out: &mut impl Write, scene: &Scene) -> io::Result<()> {
    if scene.particles.is_empty() {
        return Ok(());
    }
    writeln!(out, "def Scope \"Particles\"\n{{")?;
    for (name, population) in prim_names(scene).iter().zip(&scene.particles) {
        let shown = text::quoted(&population.name);
        // What has a mesh besides is not drawn twice.
        let purpose = if is_blobs(population) { "uniform token purpose = \"guide\"\n" } else { "" };
        write!(
            out,
            "def Points \"{name}\" (\ndisplayName = {shown}\n)\n{{\n\
            float[] primvars:windfall:age (\ninterpolation = \"vertex\"\n)\n\
            color3f[] primvars:displayColor (\ninterpolation = \"vertex\"\n)\n\
            float[] primvars:displayOpacity (\ninterpolation = \"vertex\"\n)\n{purpose}}}\n"
        )?;
    }
    writeln!(out, "}}")
}
