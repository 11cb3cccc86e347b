// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Ways of particles: a `BasisCurves` prim for each population that keeps samples of them, a curve for every particle that has any.

use std::io::{self, Write};

use glam::Vec3;
use windfall_core::particle::{HistoryRun, history_runs, way_of};
use windfall_core::scene::{Look, Particles};
use windfall_core::{Scene, World};

use super::particles::EMPTY;
use super::samples::{Handle, Samples};
use super::text;
use crate::export::Frame;
use crate::export::names::prim_names;
use crate::run::live_particle::LiveParticle;

/// The attributes of the curves of all populations.
#[derive(Debug)]
pub(super) struct HistorySamples {
    populations: Vec<CurveAttributes>,
}

/// The attributes of the curves of a population.
#[derive(Debug)]
struct CurveAttributes {
    /// Number of the population.
    population: usize,
    run: HistoryRun,
    look: Look,
    counts: Handle,
    points: Handle,
    widths: Handle,
    ids: Handle,
    colors: Handle,
    opacities: Handle,
    extent: Handle,
}

/// A place on the way of a particle.
#[derive(Clone, Copy, Debug)]
struct HistoryPoint {
    place_m: [f32; 3],
    /// Share that is left of the width at the head.
    left: f32,
}

impl HistorySamples {
    pub(super) fn declare(samples: &mut Samples, scene: &Scene) -> Self {
        let names = prim_names(scene);
        let populations = history_runs(scene).into_iter().map(|(population, run)| {
            let name = &names[population];
            let mut declare = |declaration| samples.declare(&format!("World/Histories/{name}"), declaration);
            CurveAttributes {
                population,
                run,
                look: scene.particles[population].look.clone(),
                counts: declare("int[] curveVertexCounts"),
                points: declare("point3f[] points"),
                widths: declare("float[] widths"),
                ids: declare("int64[] primvars:windfall:id"),
                colors: declare("color3f[] primvars:displayColor"),
                opacities: declare("float[] primvars:displayOpacity"),
                extent: declare("float3[] extent"),
            }
        });
        Self { populations: populations.collect() }
    }

    pub(super) fn add(&self, samples: &mut Samples, frame: &Frame<'_>) {
        for attributes in &self.populations {
            attributes.add(samples, frame);
        }
    }
}

impl CurveAttributes {
    fn add(&self, samples: &mut Samples, frame: &Frame<'_>) {
        let particles = frame.particles_of(self.population).iter();
        let ways = particles.map(|one| (one, way_points(frame.world, &self.run, one)));
        // A curve has two ends.
        let ways: Vec<_> = ways.filter(|(_, way)| way.len() > 1).collect();
        let points = || ways.iter().flat_map(|(_, way)| way);
        let ribbon_width = self.look.ribbon.map_or(1.0, |ribbon| ribbon.width);
        let looks = ways.iter().map(|(one, _)| self.look.sample(one.age_share));
        let widths: Vec<f32> = ways
            .iter()
            .zip(looks.clone())
            .flat_map(|((one, way), look)| {
                let head_m = one.size_m * look.size * ribbon_width;
                way.iter().map(move |point| head_m * point.left)
            })
            .collect();
        let number = frame.number;
        samples.add(self.counts, number, |out| text::numbers(out, ways.iter().map(|(_, way)| way.len())));
        samples.add(self.points, number, |out| text::vectors(out, points().map(|point| point.place_m)));
        samples.add(self.widths, number, |out| text::numbers(out, &widths));
        samples.add(self.ids, number, |out| text::numbers(out, ways.iter().map(|(one, _)| one.id)));
        let colors = looks.clone().map(|look| look.color.to_array());
        samples.add(self.colors, number, |out| text::vectors(out, colors));
        let opacities = ways
            .iter()
            .zip(looks)
            .flat_map(|((_, way), look)| way.iter().map(move |point| look.opacity * point.left));
        samples.add(self.opacities, number, |out| text::numbers(out, opacities));
        let boxes = points().zip(&widths).map(|(point, width_m)| {
            let (place, reach) = (Vec3::from(point.place_m), Vec3::splat(0.5 * width_m));
            [place - reach, place + reach]
        });
        let extent = boxes.reduce(|[low, high], [from, to]| [low.min(from), high.max(to)]);
        let extent = extent.unwrap_or(EMPTY).map(|corner| corner.to_array());
        samples.add(self.extent, number, |out| text::vectors(out, extent));
    }
}

/// The place of a particle and the samples of its way, from its head to its end.
fn way_points(world: &World, run: &HistoryRun, particle: &LiveParticle) -> Vec<HistoryPoint> {
    let (slot, now) = (run.first + particle.slot, world.clock.step());
    let age = now.wrapping_sub(world.particles.motion[slot as usize].birth);
    let length = age.min((run.samples - 1) * run.every_steps).max(1) as f32;
    let samples = way_of(run, &world.particles, &world.history, slot, now);
    let older = samples.filter(|sample| sample.time != now).map(|sample| HistoryPoint {
        place_m: sample.position,
        left: (1.0 - now.wrapping_sub(sample.time) as f32 / length).max(0.0),
    });
    std::iter::once(HistoryPoint { place_m: particle.position_m, left: 1.0 }).chain(older).collect()
}

/// Writes the prims.
pub(super) fn write_histories(out: &mut impl Write, scene: &Scene) -> io::Result<()> {
    let keeps = |population: &Particles| population.history.is_some();
    if !scene.particles.iter().any(keeps) {
        return Ok(());
    }
    writeln!(out, "def Scope \"Histories\"\n{{")?;
    let names = prim_names(scene);
    for (name, population) in names.iter().zip(&scene.particles).filter(|(_, one)| keeps(one)) {
        let shown = text::quoted(&population.name);
        // Ways that are not drawn are there to be read.
        let is_drawn = population.look.ribbon.is_some();
        let purpose = if is_drawn { "" } else { "uniform token purpose = \"guide\"\n" };
        write!(
            out,
            "def BasisCurves \"{name}\" (\ndisplayName = {shown}\n)\n{{\n\
            uniform token basis = \"catmullRom\"\n\
            float[] widths (\ninterpolation = \"vertex\"\n)\n\
            int64[] primvars:windfall:id (\ninterpolation = \"uniform\"\n)\n\
            color3f[] primvars:displayColor (\ninterpolation = \"uniform\"\n)\n\
            float[] primvars:displayOpacity (\ninterpolation = \"vertex\"\n)\n\
            uniform token type = \"cubic\"\nuniform token wrap = \"pinned\"\n{purpose}}}\n"
        )?;
    }
    writeln!(out, "}}")
}
