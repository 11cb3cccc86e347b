// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/measure.wgsl
//!
//! Counts leaves by state and motion.

use rayon::prelude::*;
use windfall_core::leaf::Place;
use windfall_core::stats::{COUNTER_COUNT, leaf_counters};

use super::CHUNK;

type Counters = [u32; COUNTER_COUNT as usize];

/// Counters over all leaves; integer sums, so their order does not matter.
pub(crate) fn measure(places: &[Place]) -> Counters {
    let count = |chunk: &[Place]| {
        let mut counters = Counters::default();
        for counter in chunk.iter().flat_map(leaf_counters) {
            if counter < COUNTER_COUNT {
                counters[counter as usize] += 1;
            }
        }
        counters
    };
    let add = |a: Counters, b: Counters| std::array::from_fn(|index| a[index] + b[index]);
    places.par_chunks(CHUNK).map(count).reduce(Counters::default, add)
}
