// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Exact Euclidean distance transform: for each pixel the nearest of given seed pixels, in two passes (after
//! Felzenszwalb and Huttenlocher 2012, with the seed kept).

use crate::plane::Plane;

/// Index of no seed.
pub(crate) const NO_SEED: u32 = u32::MAX;

/// Distance in pixels to the nearest seed and its index; infinite and [`NO_SEED`] without any seed.
pub(crate) fn nearest_seed(
    width: usize,
    height: usize,
    is_seed: impl Fn(usize) -> bool,
) -> (Plane<f32>, Plane<u32>) {
    let mut rows: Plane<u32> = Plane::filled(width, height, NO_SEED);
    let row_number = |y: usize| u32::try_from(y).unwrap_or(NO_SEED);
    // Nearest seed row above each pixel, then below, a row at a time.
    let mut last = vec![NO_SEED; width];
    for (y, row) in rows.data.chunks_exact_mut(width.max(1)).enumerate() {
        for (x, (slot, last)) in row.iter_mut().zip(&mut last).enumerate() {
            if is_seed(y * width + x) {
                *last = row_number(y);
            }
            *slot = *last;
        }
    }
    last.fill(NO_SEED);
    for (y, row) in (0..height).map(row_number).zip(rows.data.chunks_exact_mut(width.max(1))).rev() {
        for (slot, below) in row.iter_mut().zip(&mut last) {
            if *slot == y {
                *below = y;
            } else if *below != NO_SEED && (*slot == NO_SEED || *below - y < y - *slot) {
                *slot = *below;
            }
        }
    }
    let mut distance = Plane::filled(width, height, f32::INFINITY);
    let mut seeds = Plane::filled(width, height, NO_SEED);
    let mut envelope: Vec<(usize, f32)> = Vec::with_capacity(width);
    for y in 0..height {
        let row = &rows.data[y * width..(y + 1) * width];
        let depth = |x: usize| {
            let offset = row[x] as f32 - y as f32;
            offset * offset
        };
        envelope.clear();
        for x in (0..width).filter(|&x| row[x] != NO_SEED) {
            loop {
                let Some(&(centre, begin)) = envelope.last() else {
                    envelope.push((x, f32::NEG_INFINITY));
                    break;
                };
                let (a, b) = (centre as f32, x as f32);
                let meet = ((depth(x) + b * b) - (depth(centre) + a * a)) / (2.0 * (b - a));
                if meet > begin {
                    envelope.push((x, meet));
                    break;
                }
                envelope.pop();
            }
        }
        let mut k = 0;
        for x in 0..width {
            while envelope.get(k + 1).is_some_and(|&(_, begin)| begin < x as f32) {
                k += 1;
            }
            if let Some(&(centre, _)) = envelope.get(k) {
                let offset = x as f32 - centre as f32;
                distance.data[y * width + x] = (offset * offset + depth(centre)).sqrt();
                let seed = row[centre] as usize * width + centre;
                seeds.data[y * width + x] = u32::try_from(seed).unwrap_or(NO_SEED);
            }
        }
    }
    (distance, seeds)
}

/// Distance in pixels from each pixel of a square grid to the nearest seed; infinite without any seed.
pub(crate) fn to_seeds(size: usize, is_seed: impl Fn(usize) -> bool) -> Vec<f32> {
    nearest_seed(size, size, is_seed).0.data
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::{any, prop_assert, proptest};

    proptest! {
        #[test]
        fn agrees_with_trying_every_seed(
            width in 1_usize..24,
            height in 1_usize..24,
            bits in proptest::collection::vec(any::<u8>(), 576),
        ) {
            let seed = |i: usize| bits[i] < 8;
            let (distance, index) = nearest_seed(width, height, seed);
            for i in 0..width * height {
                let place = |i: usize| distance.centre(i);
                let best = (0..width * height).filter(|&j| seed(j))
                    .map(|j| place(i).distance(place(j))).fold(f32::INFINITY, f32::min);
                prop_assert!(distance.data[i] == best || (distance.data[i] - best).abs() < 1e-4);
                if best.is_finite() {
                    let found = index.data[i] as usize;
                    prop_assert!(seed(found) && (place(i).distance(place(found)) - best).abs() < 1e-4);
                }
            }
        }
    }
}
