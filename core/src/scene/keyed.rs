// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Numbers that follow keys in time.
//!
//! Between keys every number follows a monotone cubic (Steffen, "A simple method for monotonic interpolation in one dimension",
//! Astronomy and Astrophysics 239, 1990): its rate has no jumps, and it goes beyond no key. Before the first key and after the last it
//! stands still.

/// A key: a time in seconds and the numbers then.
pub(crate) type Key<const N: usize> = (f64, [f64; N]);

/// Numbers at a time by keys whose times increase; `None` without keys.
pub(crate) fn numbers_at<const N: usize>(keys: &[Key<N>], time_s: f64) -> Option<[f64; N]> {
    let (first, last) = (keys.first()?, keys.last()?);
    let time_s = time_s.clamp(first.0, last.0);
    let after = keys.partition_point(|key| key.0 <= time_s).clamp(1, keys.len().max(2) - 1);
    let (Some(a), Some(b)) = (keys.get(after - 1), keys.get(after)) else {
        return Some(first.1);
    };
    let span_s = b.0 - a.0;
    let part = (time_s - a.0) / span_s;
    let before = after.checked_sub(2).and_then(|index| keys.get(index));
    let beyond = keys.get(after + 1);
    Some(std::array::from_fn(|index| {
        let (from, to) = (a.1[index], b.1[index]);
        let slope = (to - from) / span_s;
        // At its ends it starts and stops.
        let begin = before.map_or(0.0, |key| {
            let before_s = a.0 - key.0;
            steffen((from - key.1[index]) / before_s, slope, before_s, span_s)
        });
        let end = beyond.map_or(0.0, |key| {
            let beyond_s = key.0 - b.0;
            steffen(slope, (key.1[index] - to) / beyond_s, span_s, beyond_s)
        });
        hermite(part, from, to, begin * span_s, end * span_s)
    }))
}

/// Rate at a key between two spans of these slopes and lengths: equation 11 of Steffen 1990.
fn steffen(slope: f64, next_slope: f64, length: f64, next_length: f64) -> f64 {
    let parabola = (slope * next_length + next_slope * length) / (length + next_length);
    (slope.signum() + next_slope.signum()) * slope.abs().min(next_slope.abs()).min(0.5 * parabola.abs())
}

/// Cubic from `from` to `to` whose slopes at its ends are `begin` and `end`.
fn hermite(t: f64, from: f64, to: f64, begin: f64, end: f64) -> f64 {
    let (square, cube) = (t * t, t * t * t);
    from + (3.0 * square - 2.0 * cube) * (to - from)
        + (cube - 2.0 * square + t) * begin
        + (cube - square) * end
}
