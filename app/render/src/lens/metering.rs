// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Adaptation of the lens to brightness: a weighted mean of what was metered at a few moments before a frame.
//!
//! The mean has an end: beyond [`memory_s`] nothing of the past counts. So any frame of a clip comes out to the bit from the few
//! frames before it that are metered, and a clip can be drawn in parts or gone on with. Weights rise smoothly from nothing and fall again,
//! `u²·exp(-3u/τ)` of an age `u`, whose mean is the time constant τ: exposure neither jumps nor jerks when a moment is added.

use windfall_core::scene::Exposure;
use windfall_core::shared_constants;

use crate::frame::lens_moment::LensMoment;

/// Moments in a time constant.
const MOMENTS_PER_CONSTANT: f64 = 4.0;
/// Time constants after which a moment is forgotten: it would weigh a twentieth of a percent together with all before it.
const MEMORY_CONSTANTS: f64 = 4.0;
/// Shorter time constants than this, in seconds, adapt at once.
const SHORTEST_S: f32 = 1.0e-3;
/// Part of the time between two moments by which a frame may come too early for one, so that rounding of its time does not matter.
const EARLY: f64 = 1.0e-6;

shared_constants! {
    /// Moments that the device keeps, in turns: all that count, and a few more.
    pub(crate) const METERED_MOMENTS: u32 = 20;
}

/// Seconds before a frame in which metered frames count for its exposure; none if it is set by hand or adapts at once.
pub fn memory_s(exposure: &Exposure) -> Option<f64> {
    constant_s(exposure).map(|constant_s| MEMORY_CONSTANTS * constant_s)
}

/// Returns true if later frames need what is metered at this one.
pub fn is_metered(exposure: &Exposure, moment: LensMoment) -> bool {
    constant_s(exposure).is_some_and(|constant_s| !moments(constant_s, moment).is_empty())
}

/// Work of the device with what it meters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Metering {
    /// First place in turn that is written.
    pub(crate) first: u32,
    /// Number of places that are written.
    pub(crate) count: u32,
    /// Weight of each place in the mean, in fours.
    pub(crate) weights: [[f32; 4]; METERED_MOMENTS as usize / 4],
}

impl Metering {
    pub(crate) fn new(exposure: &Exposure, moment: LensMoment) -> Self {
        let Some(constant_s) = constant_s(exposure).filter(|_| moment.clock_s > 0.0) else {
            let mut weights = [[0.0; 4]; METERED_MOMENTS as usize / 4];
            weights[0][0] = 1.0;
            return Self { first: 0, count: 1, weights };
        };
        let written = moments(constant_s, moment);
        let count = (written.end - written.start).min(METERED_MOMENTS.into());
        Self {
            first: place(written.end - count),
            #[expect(clippy::cast_possible_truncation, reason = "at most METERED_MOMENTS")]
            count: count as u32,
            weights: weights(constant_s, moment.clock_s),
        }
    }
}

/// Time constant of adaptation in seconds.
fn constant_s(exposure: &Exposure) -> Option<f64> {
    match *exposure {
        Exposure::Auto { adaptation_s, .. } if adaptation_s >= SHORTEST_S => Some(adaptation_s.into()),
        Exposure::Auto { .. } | Exposure::Manual { .. } => None,
    }
}

/// Numbers of the moments that fall between the frame before and this one; the first is that of time zero.
fn moments(constant_s: f64, moment: LensMoment) -> std::ops::Range<u64> {
    if moment.clock_s <= 0.0 {
        return 0..1;
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "not below zero")]
    let until =
        |time_s: f64| (time_s.max(0.0) * MOMENTS_PER_CONSTANT / constant_s + EARLY).floor() as u64 + 1;
    until(moment.clock_s - moment.since_s)..until(moment.clock_s)
}

/// Place in turn of a moment.
#[expect(clippy::cast_possible_truncation, reason = "less than METERED_MOMENTS")]
fn place(moment: u64) -> u32 {
    (moment % u64::from(METERED_MOMENTS)) as u32
}

/// Weights of the moments before `clock_s`. Before time zero the lens saw what it saw then.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small numbers, not below zero")]
fn weights(constant_s: f64, clock_s: f64) -> [[f32; 4]; METERED_MOMENTS as usize / 4] {
    let interval_s = constant_s / MOMENTS_PER_CONSTANT;
    let last = (clock_s / interval_s + EARLY).floor();
    let mut sums = [0.0_f64; METERED_MOMENTS as usize];
    for back in 0..(MEMORY_CONSTANTS * MOMENTS_PER_CONSTANT) as u32 {
        let number = last - f64::from(back);
        let age_s = (clock_s - number * interval_s).max(0.0);
        sums[place(number.max(0.0) as u64) as usize] += age_s * age_s * (-3.0 * age_s / constant_s).exp();
    }
    let total: f64 = sums.iter().sum();
    let mut weights = [[0.0; 4]; METERED_MOMENTS as usize / 4];
    for (weight, sum) in weights.as_flattened_mut().iter_mut().zip(sums) {
        *weight = (sum / total) as f32;
    }
    weights
}

#[cfg(test)]
mod tests {
    use super::*;

    fn auto(adaptation_s: f32) -> Exposure {
        Exposure::Auto { compensation_ev: 0.0, adaptation_s }
    }

    /// Luminance that a lens has adapted to after frames that meter `light`.
    fn adapted(exposure: &Exposure, frame_s: f64, numbers: &[u32], light: impl Fn(u32) -> f32) -> f32 {
        let (mut metered, mut adapted) = ([0.0; METERED_MOMENTS as usize], 0.0);
        for &number in numbers {
            let metering = Metering::new(exposure, LensMoment::of_frame(number, frame_s));
            for at in 0..metering.count {
                metered[((metering.first + at) % METERED_MOMENTS) as usize] = light(number);
            }
            let weights = metering.weights.as_flattened();
            adapted = weights.iter().zip(metered).map(|(weight, light)| weight * light).sum();
        }
        adapted
    }

    #[test]
    fn what_a_part_needs_gives_the_bits_of_the_whole() {
        let light = |number: u32| (f32::from(u16::try_from(number).expect("few")) * 0.37).sin();
        for (adaptation_s, fps) in
            [(0.8, 60.0), (0.8, 24.0), (0.1, 30.0), (3.0, 1.0), (0.8, 29.97), (60.0, 25.0)]
        {
            let (exposure, frame_s) = (auto(adaptation_s), 1.0 / fps);
            let memory_s = memory_s(&exposure).expect("it adapts");
            for last in [1, 7, 60, 400, 1999] {
                let whole: Vec<u32> = (0..=last).collect();
                let now_s = f64::from(last) * frame_s;
                let counts = |number: u32| {
                    let moment = LensMoment::of_frame(number, frame_s);
                    number == last || now_s - moment.clock_s < memory_s && is_metered(&exposure, moment)
                };
                let part: Vec<u32> = whole.iter().copied().filter(|&number| counts(number)).collect();
                assert!(part.len() <= 18, "{} frames for one", part.len());
                let (whole, part) =
                    (adapted(&exposure, frame_s, &whole, light), adapted(&exposure, frame_s, &part, light));
                assert_eq!(
                    whole.to_bits(),
                    part.to_bits(),
                    "{adaptation_s} s at {fps}, frame {last}: {whole} and {part}"
                );
            }
        }
    }

    #[test]
    fn exposure_follows_a_change_within_the_memory_and_without_jumps() {
        let (exposure, frame_s) = (auto(0.8), 1.0 / 60.0);
        let light = |number: u32| if number < 600 { 3.0 } else { 5.0 };
        let numbers: Vec<u32> = (0..900).collect();
        let way: Vec<f32> =
            (590..900).map(|end| adapted(&exposure, frame_s, &numbers[..=end], light)).collect();
        assert!((way[0] - 3.0).abs() < 1e-6, "settled: {}", way[0]);
        assert!(way.windows(2).all(|pair| (-1e-5..0.04).contains(&(pair[1] - pair[0]))), "no jump: {way:?}");
        assert!(
            (way[10 + 48] - 4.2).abs() < 0.2,
            "six tenths of the way after the time constant: {}",
            way[58]
        );
        assert!((way[10 + 205] - 5.0).abs() < 1e-6, "all of it after the memory: {}", way[215]);
    }

    #[test]
    fn the_first_frame_adapts_at_once_and_so_does_each_without_a_time_constant() {
        for exposure in [auto(0.8), auto(0.0)] {
            assert_eq!(adapted(&exposure, 0.1, &[0], |_| 7.25).to_bits(), 7.25_f32.to_bits(), "exactly");
        }
        assert_eq!(
            adapted(&auto(0.0), 0.1, &[0, 1, 2], |number| if number == 2 { 4.0 } else { 9.0 }),
            4.0,
            "at once"
        );
        assert_eq!(memory_s(&auto(0.0)), None, "nothing is remembered");
        assert_eq!(memory_s(&Exposure::Manual { ev100: 14.0 }), None, "set by hand");
    }
}
