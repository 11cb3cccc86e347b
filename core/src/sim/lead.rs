// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Flight before time zero of particles that are born by then.

use std::sync::{Mutex, PoisonError};

use super::world::World;
use crate::clock::Clock;
use crate::compile::CompiledScene;
use crate::particle::{Generation, each_generation, keep_all, place_carriers, step_run, steps_to_sample};
use crate::threads::on_all;

/// Steps whose blocks are made at once.
const STEPS: u32 = 64;
/// Particles that a thread takes through them before it takes the next.
const RUN: usize = 1024;

/// Steps the particles of a world from the first birth of those that live at time zero, or of their parents, up to then. None of them
/// attract one another.
pub(super) fn lead_in(world: &mut World) {
    let World { compiled, clock, bed, particles, tallies, history, .. } = world;
    let lead = compiled.births().lead();
    let mut before = start(compiled, clock.dt_s(), lead);
    // Particles see how their parents have gone through the same step, and where carriers of forces begin it.
    let (mut carriers, mut starts) = (Vec::new(), vec![bytemuck::Zeroable::zeroed(); compiled.start_count()]);
    let sees_others = compiled.block().has_nests() || !compiled.carriers().is_empty();
    let most = if sees_others { 1 } else { STEPS };
    let mut left = lead;
    while left > 0 {
        let sampled = steps_to_sample(compiled.histories(), before.step()).unwrap_or(most);
        let count = left.min(most).min(sampled);
        left -= count;
        let blocks: Vec<_> = (0..count)
            .map(|_| {
                let block = compiled.step_block(&before);
                compiled.advance(&mut before);
                block
            })
            .collect();
        let steps: Vec<_> = blocks.iter().map(|block| compiled.context(block).over(&bed.words)).collect();
        if let [cx] = &steps[..] {
            place_carriers(cx, compiled.carriers(), particles, &mut carriers);
        }
        let steps: Vec<_> = steps.into_iter().map(|cx| cx.with_carriers(&carriers)).collect();
        let sums = Mutex::new(&mut tallies.count);
        each_generation(&compiled.block().populations, particles, &mut starts, |generation| {
            let runs = Mutex::new(runs_of(generation));
            let next = || runs.lock().unwrap_or_else(PoisonError::into_inner).next();
            on_all(|| {
                let mut counts = vec![0; sums.lock().unwrap_or_else(PoisonError::into_inner).len()];
                while let Some(mut run) = next() {
                    steps.iter().for_each(|cx| step_run(cx, &mut run, &[], &mut counts));
                }
                let mut sums = sums.lock().unwrap_or_else(PoisonError::into_inner);
                sums.iter_mut().zip(counts).for_each(|(sum, count)| *sum = sum.wrapping_add(count));
            });
        });
        if let Some(cx) = steps.last() {
            keep_all(cx, compiled.histories(), particles, history);
        }
    }
    let born = if lead > 0 { *before.born() } else { compiled.births().before(0) };
    *clock = clock.with_born(born);
}

/// The clock so many steps before time zero.
fn start(compiled: &CompiledScene, dt_s: f32, lead: u32) -> Clock {
    let travel_m = -f64::from(lead) * compiled.wind_travel_per_step_m();
    Clock::at(0u32.wrapping_sub(lead), dt_s, travel_m).with_born(compiled.births().before(-i64::from(lead)))
}

/// Runs of a generation, each small enough to stay in the cache.
fn runs_of(generation: Generation<'_>) -> impl Iterator<Item = Generation<'_>> {
    let mut rest = Some(generation);
    std::iter::from_fn(move || {
        let generation = rest.take().filter(|generation| !generation.particles.is_empty())?;
        let count = RUN.min(generation.particles.len());
        let (front, back) = generation.split_at(count);
        rest = Some(back);
        Some(front)
    })
}
