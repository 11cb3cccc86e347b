// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Memory bandwidth of this machine in place: it bounds a leaf step from below.

use std::time::Instant;

/// Size of the array: far larger than any cache.
const BYTES: usize = 512 << 20;
/// Passes over it; the median counts.
const PASSES: usize = 5;

/// Bytes per second read and written, while every thread of `threads` changes its share of one array in place.
pub(super) fn update_bandwidth(threads: usize) -> f64 {
    let mut array = vec![1.0f32; BYTES / size_of::<f32>()];
    let share = array.len().div_ceil(threads);
    let mut rates = [0.0; PASSES];
    for rate in &mut rates {
        let start = Instant::now();
        std::thread::scope(|scope| {
            for part in array.chunks_mut(share) {
                scope.spawn(move || part.iter_mut().for_each(|value| *value = *value * 0.999 + 0.1));
            }
        });
        *rate = 2.0 * BYTES as f64 / start.elapsed().as_secs_f64();
    }
    rates.sort_by(f64::total_cmp);
    rates[PASSES / 2]
}
