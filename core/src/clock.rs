// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Simulated time.

use crate::scene::MAX_POPULATIONS;

/// Simulated time: a step index times a fixed step, the way the mean wind has come, and the particles that have been born.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clock {
    step: u32,
    dt_s: f32,
    wind_travel_m: f64,
    born: [u64; MAX_POPULATIONS],
}

impl Clock {
    /// Time zero.
    pub fn new(dt_s: f32) -> Self {
        Self::at(0, dt_s, 0.0)
    }

    /// A moment before which no particles were born. Steps before time zero are two's complement.
    pub fn at(step: u32, dt_s: f32, wind_travel_m: f64) -> Self {
        Self { step, dt_s, wind_travel_m, born: [0; MAX_POPULATIONS] }
    }

    /// The same moment after so many births in each population.
    #[must_use]
    pub fn with_born(self, born: [u64; MAX_POPULATIONS]) -> Self {
        Self { born, ..self }
    }

    /// Index of the next step.
    pub fn step(&self) -> u32 {
        self.step
    }

    /// Length of a step in seconds.
    pub fn dt_s(&self) -> f32 {
        self.dt_s
    }

    /// Seconds since the start.
    pub fn seconds(&self) -> f64 {
        f64::from(self.step.cast_signed()) * f64::from(self.dt_s)
    }

    /// Metres that the mean wind has travelled since the start.
    pub fn wind_travel_m(&self) -> f64 {
        self.wind_travel_m
    }

    /// Particles born in each population so far.
    pub fn born(&self) -> &[u64; MAX_POPULATIONS] {
        &self.born
    }

    /// One step on, in which the mean wind travels so far and so many particles are born.
    pub(crate) fn advance(&mut self, wind_travel_m: f64, births: [u32; MAX_POPULATIONS]) {
        self.step = self.step.wrapping_add(1);
        self.wind_travel_m += wind_travel_m;
        for (born, births) in self.born.iter_mut().zip(births) {
            *born += u64::from(births);
        }
    }
}
