// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Samples that a share of a pixel covers.

#import gpu/numbers

// Mask of a pixel's four samples of which something covers a share: as many as the share says on average over random words, others
// for each, so that things behind one another hide what is behind them all.
fn covered(share: f32, random: u32) -> u32 {
    let count = u32(share * 4.0 + unit_from(random));
    let first = random & 3u;
    let bits = ((1u << min(count, 4u)) - 1u) << first;
    return (bits | (bits >> 4u)) & 15u;
}
