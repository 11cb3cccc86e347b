// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/keep_history.wgsl
//!
//! Samples the ways of particles, chunk by chunk, in steps in which that is due.

use rayon::prelude::*;
use windfall_core::Context;
use windfall_core::device::particle::history::{HistoryRun, history_is_due, history_row, history_sample};
use windfall_core::particle::{HistoryStore, ParticleStore};

use super::CHUNK;

/// Writes the samples of all populations whose turn it is at the end of a step.
pub(crate) fn keep_history(
    cx: &Context<'_>,
    runs: &[(usize, HistoryRun)],
    particles: &ParticleStore,
    history: &mut HistoryStore,
) {
    let time = cx.step.index.wrapping_add(1);
    for (_, run) in runs.iter().filter(|(_, run)| history_is_due(run, time)) {
        let places = &particles.place[run.first as usize..][..run.count as usize];
        let samples = run.samples as usize;
        let rings = &mut history.sample[run.first_sample as usize..][..places.len() * samples];
        let at = (history_row(run, 0, time) - run.first_sample) as usize;
        let chunks = rings.par_chunks_mut(CHUNK * samples).zip(places.par_chunks(CHUNK));
        chunks.for_each(|(rings, places)| {
            for (ring, place) in rings.chunks_exact_mut(samples).zip(places) {
                ring[at] = history_sample(place, time);
            }
        });
    }
}
