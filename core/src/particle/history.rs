// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The samples of the ways of particles: their store, their writing in a plain loop, and the way of one particle read from them.

use super::store::ParticleStore;
use crate::context::Context;
use crate::device::particle::history::{
    HistoryRun, HistorySample, history_counts, history_is_due, history_row, history_sample,
};
use crate::scene::{Particles, Scene};

crate::columns! {
    /// Samples of the ways of all particles that keep any, particle after particle. Those of one are a ring.
    pub struct HistoryStore("samples of ways") {
        /// The samples.
        pub sample: HistorySample,
    }
    /// One sample.
    row HistoryMut;
    /// A run of samples.
    run HistoriesMut;
}

impl HistoryStore {
    /// Number of rows for a scene.
    pub(crate) fn rows_of(scene: &Scene) -> usize {
        scene.particles.iter().map(samples_of).sum()
    }
}

/// Steps before time zero in which nothing happens yet, however early the first birth: those from then on are numbered.
const MOST_AHEAD_STEPS: u32 = 1 << 30;

/// Samples that a population keeps.
fn samples_of(particles: &Particles) -> usize {
    particles.history.map_or(0, |history| particles.count as usize * history.samples as usize)
}

/// The runs of a scene, and for each the number of its population.
pub fn history_runs(scene: &Scene) -> Vec<(usize, HistoryRun)> {
    let mut runs = Vec::new();
    let (mut first, mut first_sample) = (0, 0);
    for (number, particles) in scene.particles.iter().enumerate() {
        let count = particles.count;
        if let Some(history) = particles.history {
            let (samples, every_steps) = (history.samples, history.every_steps);
            let ahead_steps = MOST_AHEAD_STEPS.next_multiple_of(samples * every_steps);
            let run =
                HistoryRun { first, count, first_sample, samples, every_steps, ahead_steps, unused: [0; 2] };
            runs.push((number, run));
            first_sample += count * samples;
        }
        first += count;
    }
    runs
}

/// Steps from a time to the next at which samples are taken, at least one; `None` if none ever are.
pub fn steps_to_sample(runs: &[(usize, HistoryRun)], time: u32) -> Option<u32> {
    let left = |run: &HistoryRun| run.every_steps - time.wrapping_add(run.ahead_steps) % run.every_steps;
    runs.iter().map(|(_, run)| left(run)).min()
}

/// Takes the samples that are due at the end of a step.
pub(crate) fn keep_all(
    cx: &Context<'_>,
    runs: &[(usize, HistoryRun)],
    particles: &ParticleStore,
    history: &mut HistoryStore,
) {
    let time = cx.step.index.wrapping_add(1);
    for (_, run) in runs.iter().filter(|(_, run)| history_is_due(run, time)) {
        for among in 0..run.count {
            let place = &particles.place[(run.first + among) as usize];
            history.sample[history_row(run, among, time) as usize] = history_sample(place, time);
        }
    }
}

/// Samples of the way of the particle in a slot within its present life, the latest first, at a time. The last may be older than the ways that are drawn.
pub fn way_of<'a>(
    run: &'a HistoryRun,
    particles: &ParticleStore,
    history: &'a HistoryStore,
    slot: u32,
    time: u32,
) -> impl Iterator<Item = &'a HistorySample> {
    let birth = particles.motion[slot as usize].birth;
    let latest = time.wrapping_sub(time.wrapping_add(run.ahead_steps) % run.every_steps);
    let times = (0..run.samples).map(move |number| latest.wrapping_sub(number * run.every_steps));
    times.map_while(move |time| {
        let sample = &history.sample[history_row(run, slot - run.first, time) as usize];
        history_counts(sample, time, birth).then_some(sample)
    })
}
