// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Speed of particles by themselves: sparks over the ground of a scene, in its wind.

use std::time::Instant;

use anyhow::bail;
use glam::Vec3;
use serde::Serialize;
use windfall_core::particle::HOT_BYTES_PER_STEP;
use windfall_core::scene::{
    Air, Direction, Meets, ObjectFriction, ParticleRelease, ParticleShape, Particles, Source, Spread,
};
use windfall_core::{Scene, World};

use super::contender::Approach;
use super::row::Floor;
use super::{Arguments, BATCHES, WARM_UP_STEPS, steps_of_a_batch};

/// Life of a spark in seconds.
const LIFE_S: f32 = 2.0;
/// Slots for each spark that is alive, besides those that births need.
const SLOTS: f32 = 1.02;
/// Fewest sparks.
const FEWEST: u32 = 4;

/// One measurement. The names of these fields are the keys of the JSON; they stay.
#[derive(Clone, Debug, Serialize)]
pub(super) struct SparkRow {
    backend: &'static str,
    adapter: String,
    scene: String,
    particles: u32,
    /// Steps of each timed batch.
    steps: u32,
    /// Of all of them; the median over the batches.
    ms_per_step: f64,
    particle_steps_per_s: f64,
    particle_steps_per_s_min: f64,
    particle_steps_per_s_max: f64,
    /// That have to come from memory or go there.
    bytes_per_particle_step: usize,
    /// Rate over what the memory's bandwidth would allow.
    floor_share: f64,
}

/// The wind and the ground of a scene with so many sparks, at least [`FEWEST`], and one leaf: a scene has a source of leaves.
pub(super) fn sparks(scene: &Scene, count: u32) -> Scene {
    let count = count.max(FEWEST);
    let mut bare = scene.clone();
    bare.sources = vec![Source { count: 1, ..Source::default() }];
    bare.trees.clear();
    bare.forces.clear();
    bare.particles = vec![Particles {
        name: "sparks".into(),
        count,
        from: ParticleShape::Disc { center_m: Vec3::Y, radius_m: 40.0, axis: Vec3::Y },
        direction: Direction::Cone { axis: Vec3::Y, half_angle_deg: 40.0 },
        release: ParticleRelease::Rate { per_s: (count - 2) as f32 / (SLOTS * LIFE_S), from_s: -LIFE_S },
        speed_m_s: Spread::Uniform(6.0, 2.0),
        life_s: Some(Spread::Constant(LIFE_S)),
        air: Air::Linear { time_s: Spread::Uniform(0.6, 0.2) },
        meets: Meets::Bounce { restitution: 0.5, friction: ObjectFriction::Coulomb(0.3) },
        ..Particles::default()
    }];
    bare
}

/// Measures a world of sparks with a backend; `None` for an approach that knows no particles. `expected` is the state after the warm-up
/// that all exact ones have to agree with.
///
/// # Errors
/// A lost device, or another state.
pub(super) fn measure(
    approach: &Approach,
    world: &World,
    arguments: &Arguments,
    floor: &Floor,
    expected: &mut Option<u64>,
) -> anyhow::Result<Option<SparkRow>> {
    if !matches!(approach, Approach::Device(_) | Approach::Fused(_)) {
        return Ok(None);
    }
    let mut contender = approach.take(world)?;
    let (backend, adapter) = contender.names();
    contender.step(WARM_UP_STEPS)?;
    if let Some(hash) = contender.exact_hash(world)?
        && *expected.get_or_insert(hash) != hash
    {
        bail!("{backend} on {adapter} comes to another state of particles than the others");
    }
    let steps = match arguments.steps {
        Some(steps) => steps,
        None => steps_of_a_batch(&mut contender)?,
    };
    let particles = world.compiled.scene().particle_count();
    let work = f64::from(particles) * f64::from(steps);
    let mut rates = [0.0; BATCHES];
    for rate in &mut rates {
        let start = Instant::now();
        contender.step(steps)?;
        *rate = work / start.elapsed().as_secs_f64().max(1e-9);
    }
    rates.sort_by(f64::total_cmp);
    let rate = rates[BATCHES / 2];
    Ok(Some(SparkRow {
        backend,
        adapter,
        scene: arguments.scene.clone(),
        particles,
        steps,
        ms_per_step: 1e3 * f64::from(particles) / rate,
        particle_steps_per_s: rate,
        particle_steps_per_s_min: rates[0],
        particle_steps_per_s_max: rates[BATCHES - 1],
        bytes_per_particle_step: HOT_BYTES_PER_STEP,
        floor_share: rate * HOT_BYTES_PER_STEP as f64 / floor.update_bandwidth_bytes_per_s,
    }))
}

impl SparkRow {
    /// One line for people.
    pub(super) fn line(&self) -> String {
        format!(
            "{:<11}{} sparks: {:.3} ms a step, {:.2e} particle-steps/s (lowest {:.2e}, highest {:.2e}), {:.0} % of the floor at {} bytes a \
             particle-step",
            self.backend,
            self.particles,
            self.ms_per_step,
            self.particle_steps_per_s,
            self.particle_steps_per_s_min,
            self.particle_steps_per_s_max,
            100.0 * self.floor_share,
            self.bytes_per_particle_step
        )
    }
}
