// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Simulated time.

/// Simulated time: a step index times a fixed step, and the way the mean wind has come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clock {
    step: u32,
    dt_s: f32,
    wind_travel_m: f64,
}

impl Clock {
    /// Time zero.
    pub fn new(dt_s: f32) -> Self {
        Self { step: 0, dt_s, wind_travel_m: 0.0 }
    }

    /// A moment read from a checkpoint.
    pub fn at(step: u32, dt_s: f32, wind_travel_m: f64) -> Self {
        Self { step, dt_s, wind_travel_m }
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
        f64::from(self.step) * f64::from(self.dt_s)
    }

    /// Metres that the mean wind has travelled since the start.
    pub fn wind_travel_m(&self) -> f64 {
        self.wind_travel_m
    }

    /// One step on, in which the mean wind travels so far.
    pub(crate) fn advance(&mut self, wind_travel_m: f64) {
        self.step = self.step.wrapping_add(1);
        self.wind_travel_m += wind_travel_m;
    }
}
