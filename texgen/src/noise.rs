// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Seeded noise on the plane.

use glam::Vec2;

use crate::math::floor_i32;
use crate::rng::{hash64, unit_from_hash};

/// Hash of a lattice cell.
fn cell_hash(seed: u64, x: i32, y: i32) -> u64 {
    let cell = (u64::from(x.cast_unsigned()) << 32) | u64::from(y.cast_unsigned());
    hash64(seed ^ cell.wrapping_mul(0x9fb2_1c65_1e98_df25))
}

/// Value noise in -1..1 with features about one unit wide.
pub(crate) fn value(seed: u64, p: Vec2) -> f32 {
    let (x, y) = (floor_i32(p.x), floor_i32(p.y));
    let f = p - Vec2::new(x as f32, y as f32);
    let f = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let corner = |dx: i32, dy: i32| unit_from_hash(cell_hash(seed, x + dx, y + dy));
    let low = corner(0, 0) + (corner(1, 0) - corner(0, 0)) * f.x;
    let high = corner(0, 1) + (corner(1, 1) - corner(0, 1)) * f.x;
    (low + (high - low) * f.y) * 2.0 - 1.0
}

/// Sum of octaves of value noise, each twice as fine and half as strong; about -1..1.
pub(crate) fn fractal(seed: u64, mut p: Vec2, octaves: u32) -> f32 {
    let (mut sum, mut strength, mut total) = (0.0, 1.0, 0.0);
    p = Vec2::new(0.89 * p.x - 0.45 * p.y, 0.45 * p.x + 0.89 * p.y);
    for octave in 0..octaves {
        sum += strength * value(seed.wrapping_add(u64::from(octave)), p);
        total += strength;
        strength *= 0.5;
        // Turning each octave hides the lattice.
        p = Vec2::new(1.6 * p.x - 1.2 * p.y, 1.2 * p.x + 1.6 * p.y) + Vec2::splat(17.3);
    }
    sum / total * 1.4
}

/// Scattered points, one a unit square, around a place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cells {
    /// Distance to the nearest point.
    pub(crate) first: f32,
    /// Distance to the second nearest; where it equals the first runs the wall between two cells.
    pub(crate) second: f32,
    /// Random number in 0..1 of the nearest point.
    pub(crate) lot: f32,
}

/// Cell noise (Worley 1996).
pub(crate) fn cells(seed: u64, p: Vec2) -> Cells {
    let (x, y) = (floor_i32(p.x), floor_i32(p.y));
    let (mut first, mut second, mut nearest) = (f32::MAX, f32::MAX, 0);
    for cy in y - 1..=y + 1 {
        for cx in x - 1..=x + 1 {
            let hash = cell_hash(seed, cx, cy);
            let other = hash64(hash);
            let offset = Vec2::new(unit_from_hash(hash), unit_from_hash(other));
            let distance = p.distance_squared(Vec2::new(cx as f32, cy as f32) + offset);
            if distance < first {
                (first, second, nearest) = (distance, first, other);
            } else if distance < second {
                second = distance;
            }
        }
    }
    Cells { first: first.sqrt(), second: second.sqrt(), lot: unit_from_hash(hash64(nearest)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn value_noise_is_bounded_and_continuous() {
        let mut last = value(5, Vec2::ZERO);
        for i in 1..2000_u16 {
            let now = value(5, Vec2::new(f32::from(i) * 0.01, 0.3));
            assert!(now.abs() <= 1.0, "value noise leaves -1..1 at step {i}: {now}");
            assert!((now - last).abs() < 0.06, "value noise jumps at step {i}");
            last = now;
        }
    }

    #[test]
    fn nearest_cell_comes_first() {
        for i in 0..100_u16 {
            let Cells { first, second, .. } = cells(9, Vec2::new(f32::from(i) * 0.37, f32::from(i) * 0.11));
            assert!(first <= second && second < 2.0, "cell distances out of order: {first}, {second}");
        }
    }
}
