// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Holds the sort on the device to that of the standard library.

use super::{encoder, gpu, read};
use crate::gpu::radix_sort::RadixSort;

/// A pseudo-random word for each number.
fn word(number: u32) -> u32 {
    let bits = number.wrapping_mul(2_654_435_769);
    let bits = (bits ^ bits >> 15).wrapping_mul(2_246_822_519);
    bits ^ bits >> 13
}

/// Any number of pairs, ties in the order of their slots, in buffers as large as the scene has slots: elsewhere sorts broke above some number or
/// flickered (godot#67717, bevy_hanabi#183), and buffers overran (bevy_hanabi#493, #537).
#[test]
fn pairs_are_sorted_and_equal_keys_stay_in_order() {
    let gpu = gpu();
    let (device, queue) = (gpu.device(), gpu.queue());
    // Less than a block, a block and one more, and a million; all keys apart, many equal ones, all the same.
    for (count, mask) in [(1, u32::MAX), (1025, u32::MAX), (1_000_000, 0x00f0_0fff), (5000, 0)] {
        let pairs: Vec<[u32; 2]> = (0..count).map(|number| [word(number) & mask, number]).collect();
        let sort = RadixSort::new(device, queue, count);
        queue.write_buffer(&sort.pairs, 0, bytemuck::cast_slice(&pairs));
        let mut encoder = encoder(&gpu);
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        sort.run(&mut pass);
        drop(pass);
        queue.submit([encoder.finish()]);
        let found: Vec<[u32; 2]> = read(&gpu, &sort.pairs);
        let mut expected = pairs;
        expected.sort_by_key(|[key, _]| *key);
        let first = found.iter().zip(&expected).position(|(found, expected)| found != expected);
        assert_eq!(first, None, "{count} keys in {mask:#x}");
    }
}
