// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! SD: nearly straight down, with a little wandering sideways.

use std::f64::consts::TAU;

use glam::DVec3;

use super::constants::MotionConstants;
use super::path::{Moment, Path};
use crate::arith::rng::random;

/// Seconds until the wandering repeats.
const PERIOD_S: f64 = 8.0;
/// Harmonics of the wandering; the highest has 5 Hz.
const HARMONICS: u32 = 40;
/// Stream of random phases, apart from those of leaves.
const STREAM: u32 = 0x5344_0000;

/// Steady descent: `y = -U t`, and in x and z a velocity with the spectrum of an Ornstein-Uhlenbeck process, made
/// periodic as a Fourier series so that it has exact integrals and derivatives.
#[derive(Clone, Debug)]
pub struct SteadyDescent {
    descent_m_s: f64,
    /// Each harmonic, for x and for z.
    harmonics: Vec<[Harmonic; 2]>,
}

#[derive(Clone, Copy, Debug)]
struct Harmonic {
    /// Angular rate in rad/s.
    rate: f64,
    /// Amplitude of the velocity in m/s.
    amplitude: f64,
    /// Phase in radians, and its sine.
    phase: f64,
    sine: f64,
}

impl SteadyDescent {
    /// The motion for these constants; `seed` chooses the wandering.
    pub fn new(constants: &MotionConstants, seed: [u32; 2]) -> Self {
        let rate = |n: u32| TAU * f64::from(n) / PERIOD_S;
        let power = |n: u32| 1.0 / (1.0 + (rate(n) * constants.wander_s) * (rate(n) * constants.wander_s));
        let total: f64 = (1..=HARMONICS).map(power).sum();
        let harmonics = (1..=HARMONICS)
            .map(|n| {
                let amplitude = constants.wander_m_s * libm::sqrt(2.0 * power(n) / total);
                let words = random(seed, n, STREAM);
                [words[0], words[1]].map(|word| {
                    let phase = TAU * f64::from(word) / 4_294_967_296.0;
                    Harmonic { rate: rate(n), amplitude, phase, sine: libm::sin(phase) }
                })
            })
            .collect();
        Self { descent_m_s: constants.descent_m_s, harmonics }
    }
}

impl Path for SteadyDescent {
    fn period_s(&self) -> f64 {
        PERIOD_S
    }

    fn at(&self, time_s: f64) -> Moment {
        let mut moment = Moment {
            position: DVec3::new(0.0, -self.descent_m_s * time_s, 0.0),
            velocity: DVec3::new(0.0, -self.descent_m_s, 0.0),
            acceleration: DVec3::ZERO,
            turn: None,
        };
        for pair in &self.harmonics {
            for (axis, &Harmonic { rate, amplitude, phase, sine }) in
                [DVec3::X, DVec3::Z].into_iter().zip(pair)
            {
                let (sin, cos) = libm::sincos(rate * time_s + phase);
                moment.position += axis * (amplitude / rate * (sin - sine));
                moment.velocity += axis * (amplitude * cos);
                moment.acceleration -= axis * (amplitude * rate * sin);
            }
        }
        moment
    }
}
