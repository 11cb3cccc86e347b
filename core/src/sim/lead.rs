// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Flight before time zero of particles that are born by then.

use std::sync::{Mutex, PoisonError};

use super::world::World;
use crate::clock::Clock;
use crate::compile::CompiledScene;
use crate::particle::{ParticlesMut, each_generation, step_run};
use crate::threads::on_all;

/// Steps whose blocks are made at once.
const STEPS: u32 = 64;
/// Particles that a thread takes through them before it takes the next.
const RUN: usize = 1024;

/// Steps the particles of a world from the first birth of those that live at time zero, or of their parents, up to then. None of them
/// attract one another.
pub(super) fn lead_in(world: &mut World) {
    let World { compiled, clock, bed, particles, tallies, .. } = world;
    let lead = compiled.births().lead();
    let mut before = start(compiled, clock.dt_s(), lead);
    // Particles see how their parents have gone through the same step.
    let most = if compiled.block().has_nests() { 1 } else { STEPS };
    let mut left = lead;
    while left > 0 {
        let count = left.min(most);
        left -= count;
        let blocks: Vec<_> = (0..count)
            .map(|_| {
                let block = compiled.step_block(&before);
                compiled.advance(&mut before);
                block
            })
            .collect();
        let steps: Vec<_> = blocks.iter().map(|block| compiled.context(block).over(&bed.words)).collect();
        let sums = Mutex::new(&mut tallies.count);
        each_generation(&compiled.block().populations, particles, |parents, first, generation| {
            let runs = Mutex::new(runs_of(generation, first));
            let next = || runs.lock().unwrap_or_else(PoisonError::into_inner).next();
            on_all(|| {
                let mut counts = vec![0; sums.lock().unwrap_or_else(PoisonError::into_inner).len()];
                while let Some((first, mut run)) = next() {
                    steps.iter().for_each(|cx| step_run(cx, &mut run, parents, first, &[], &mut counts));
                }
                let mut sums = sums.lock().unwrap_or_else(PoisonError::into_inner);
                sums.iter_mut().zip(counts).for_each(|(sum, count)| *sum = sum.wrapping_add(count));
            });
        });
    }
    let born = if lead > 0 { *before.born() } else { compiled.births().before(0) };
    *clock = clock.with_born(born);
}

/// The clock so many steps before time zero.
fn start(compiled: &CompiledScene, dt_s: f32, lead: u32) -> Clock {
    let travel_m = -f64::from(lead) * compiled.wind_travel_per_step_m();
    Clock::at(0u32.wrapping_sub(lead), dt_s, travel_m).with_born(compiled.births().before(-i64::from(lead)))
}

/// Runs of slots from a first one on, each with its own first.
fn runs_of(particles: ParticlesMut<'_>, first: u32) -> impl Iterator<Item = (u32, ParticlesMut<'_>)> {
    let mut rest = Some((first, particles));
    std::iter::from_fn(move || {
        let (first, particles) = rest.take().filter(|(_, particles)| !particles.is_empty())?;
        let count = RUN.min(particles.len());
        let (front, back) = particles.split_at(count);
        #[expect(clippy::cast_possible_truncation, reason = "slots are counted in words")]
        let next = first + count as u32;
        rest = Some((next, back));
        Some((first, front))
    })
}
