// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! CS: a spiral that opens as the leaf falls, on a bowl or a cone, while two opposite corners swing up and down.

use std::f64::consts::{FRAC_1_SQRT_2, TAU};

use glam::{DQuat, DVec3};

use super::constants::MotionConstants;
use super::table::{INTERVALS, PrimitiveTable};
use crate::arith::rng::random;
use crate::scene::ConeShape;

/// Swings of the corners in the period of the table.
pub const SWINGS_PER_TABLE: u32 = 4;
/// Harmonics of that period in the unevenness of the descent; the highest has three to a swing.
const HARMONICS: u32 = 12;
/// Stream of random phases, apart from those of leaves.
const STREAM: u32 = 0x4353_0000;
/// Times in a period at which the greatest unevenness is sought.
const SOUGHT: u32 = 4096;

/// Cone spiral, with `s = U t` the mean depth below the tip: radius `r = R sqrt(min(s/H, 1))` on a bowl, whose `r²/s` is constant, or
/// `R min(s/H, 1)` on a cone, angle `W t`, height `-U (t + e(t))` with a bounded periodic `e` of mean zero. Beyond the depth H the
/// radius stays R, so that no leaf is faster than `R W`. The blade turns about one of its diagonals by `A sin(V t)`: the corners off that
/// diagonal go up and down, and its area stays what it is.
///
/// Not periodic, as the other motions are: radius and angle follow from the time since release, and only height and
/// swing are a table.
#[derive(Clone, Debug)]
pub struct ConeSpiral {
    constants: MotionConstants,
    /// Of each harmonic its rate in rad/s, its amplitude as a share of U, its phase and the sine of that.
    harmonics: Vec<[f64; 4]>,
}

impl ConeSpiral {
    /// The motion for these constants; `seed` chooses the unevenness.
    pub fn new(constants: &MotionConstants, seed: [u32; 2]) -> Self {
        let mut spiral = Self { constants: *constants, harmonics: Vec::new() };
        let base = TAU / spiral.period_s();
        spiral.harmonics = (1..=HARMONICS)
            .map(|n| {
                let phase = TAU * f64::from(random(seed, n, STREAM)[0]) / 4_294_967_296.0;
                let rate = base * f64::from(n);
                [rate, 1.0 / libm::sqrt(f64::from(n)), phase, libm::sin(phase)]
            })
            .collect();
        let greatest = (0..SOUGHT)
            .map(|time| spiral.unevenness(spiral.period_s() * f64::from(time) / f64::from(SOUGHT)).abs())
            .fold(f64::MIN_POSITIVE, f64::max);
        for harmonic in &mut spiral.harmonics {
            harmonic[1] *= constants.cone_unevenness / greatest;
        }
        spiral
    }

    /// Period of the table of heights and swings in s.
    pub fn period_s(&self) -> f64 {
        f64::from(SWINGS_PER_TABLE) * TAU / self.constants.corner_swing_rad_s
    }

    /// Time from the tip to where a leaf sets off in s. From the tip of a bowl it would move outwards infinitely fast; here, where
    /// the bowl is as steep as one to one, as fast as it comes down, and from no farther than a quarter of the depth.
    pub fn start_s(&self) -> f64 {
        let constants = &self.constants;
        let depth_m = constants.cone_depth_m;
        let start_m = match constants.cone_shape {
            ConeShape::Bowl => {
                (constants.cone_radius_m * constants.cone_radius_m / (4.0 * depth_m)).min(0.25 * depth_m)
            }
            ConeShape::Cone => 0.0,
        };
        start_m / constants.descent_m_s
    }

    /// Descent speed at a time of the table beyond U, as a share of it.
    fn unevenness(&self, time_s: f64) -> f64 {
        self.harmonics
            .iter()
            .map(|[rate, amplitude, phase, _]| amplitude * libm::cos(rate * time_s + phase))
            .sum()
    }

    /// Height at a time of the table in m, from zero.
    fn height_m(&self, time_s: f64) -> f64 {
        let ahead = self.harmonics.iter().map(|[rate, amplitude, phase, sine]| {
            amplitude / rate * (libm::sin(rate * time_s + phase) - sine)
        });
        -self.constants.descent_m_s * (time_s + ahead.sum::<f64>())
    }

    /// Table of heights and swings over one period. The diagonal that the blade turns about is that of its x and z axes.
    pub fn table(&self) -> PrimitiveTable {
        let period_s = self.period_s();
        let times = || (0..=INTERVALS).map(|row| period_s * row as f64 / INTERVALS as f64);
        let swing = |time_s: f64| {
            let angle =
                self.constants.corner_swing_rad * libm::sin(self.constants.corner_swing_rad_s * time_s);
            let (sin, cos) = libm::sincos(0.5 * angle);
            DQuat::from_xyzw(FRAC_1_SQRT_2 * sin, 0.0, FRAC_1_SQRT_2 * sin, cos)
        };
        let down = |y: f64| (DVec3::Y * y).as_vec3().to_array();
        PrimitiveTable {
            period_s,
            displacement_m: times().map(|time_s| down(self.height_m(time_s))).collect(),
            orientation: times().map(|time_s| swing(time_s).as_quat().to_array()).collect(),
            velocity_m: times()
                .map(|time_s| down(-self.constants.descent_m_s * (1.0 + self.unevenness(time_s)) * period_s))
                .collect(),
        }
    }
}
