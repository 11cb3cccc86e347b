// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/particle/history.wgsl
//!
//! Samples of the way of particles. The clock alone says which sample of a ring is written next, so all particles of a population have
//! samples of the same times, and each bears its time, by which one from before a birth is recognised: nothing is cleared.

use super::record::ParticlePlace;

crate::shared_record! {
    /// Place of a particle at a time. Written every few steps, and read by what draws and exports.
    pub struct HistorySample {
        /// Position in m.
        pub position: [f32; 3],
        /// Step before which it was there, two's complement.
        pub time: u32,
    }
}

crate::shared_struct! {
    /// Samples of the particles of a population.
    pub struct HistoryRun {
        /// First of the particles: its slot, or its place in a window of a device.
        pub first: u32,
        /// Number of them.
        pub count: u32,
        /// First sample of the first.
        pub first_sample: u32,
        /// Samples of each, one after another.
        pub samples: u32,
        /// Steps from one to the next.
        pub every_steps: u32,
        /// Steps added to times, whole rounds of the ring, so that none before time zero is negative.
        pub ahead_steps: u32,
        /// Zeros.
        pub unused: [u32; 2],
    }
}

/// Returns true if samples are taken at a time.
#[inline(always)]
pub fn history_is_due(run: &HistoryRun, time: u32) -> bool {
    time.wrapping_add(run.ahead_steps).is_multiple_of(run.every_steps)
}

/// Row of the sample that the particle on a place among those of its population has for a time.
#[inline(always)]
pub fn history_row(run: &HistoryRun, among: u32, time: u32) -> u32 {
    let number = time.wrapping_add(run.ahead_steps) / run.every_steps;
    run.first_sample + among * run.samples + number % run.samples
}

/// Sample of a particle.
#[inline(always)]
pub fn history_sample(place: &ParticlePlace, time: u32) -> HistorySample {
    HistorySample { position: place.position, time }
}

/// Returns true if a sample is that of a time, and not of another life than the one that began in the step `birth`.
#[inline(always)]
pub fn history_counts(sample: &HistorySample, time: u32, birth: u32) -> bool {
    sample.time == time && 0 < time.wrapping_sub(birth).cast_signed()
}
