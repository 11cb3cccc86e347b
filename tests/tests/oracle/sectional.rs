// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The sectional model of a falling plate: paper of 70 g/m² tumbles as fast as its reference solutions, up to a chord
//! between 5.5 and 7.9 cm.

use std::f64::consts::TAU;

use ode_solvers::{Dopri5, SVector, System};
use windfall_tests::reference::SectionalPlate;

type State = SVector<f64, 6>;

/// Seconds thrown away at the start of a fall, then kept.
const SETTLE_S: f64 = 8.0;
const KEEP_S: f64 = 12.0;
/// Seconds between samples.
const SAMPLE_S: f64 = 0.01;

struct Fall(SectionalPlate);

impl System<f64, State> for Fall {
    fn system(&self, _time: f64, state: &State, slope: &mut State) {
        *slope = self.0.rates(&(*state).into()).into();
    }
}

/// Turning rates in rev/s of a paper plate that has settled.
fn turning(chord_m: f64) -> Vec<f64> {
    let plate = SectionalPlate { chord_m, areal_density_kg_m2: 0.07 };
    let start = State::from([0.1, -0.1, 0.5, 0.6, 0.0, 0.0]);
    let mut solver = Dopri5::new(Fall(plate), 0.0, SETTLE_S + KEEP_S, SAMPLE_S, start, 1e-8, 1e-8);
    solver.integrate().expect("the integration ends");
    let samples = solver.x_out().iter().zip(solver.y_out());
    samples.filter(|(time, _)| **time >= SETTLE_S).map(|(_, state)| state[2] / TAU).collect()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// A tumbling plate never turns back.
fn tumbles(turning: &[f64]) -> bool {
    let side = mean(turning).signum();
    turning.iter().all(|rate| rate * side > 0.0)
}

#[test]
fn small_plates_tumble_at_the_reference_rates() {
    for (chord_m, expected) in [(0.035, 3.54), (0.045, 2.92), (0.055, 2.51)] {
        let turning = turning(chord_m);
        assert!(tumbles(&turning), "{chord_m} m tumbles");
        let rate = mean(&turning).abs();
        assert!((rate / expected - 1.0).abs() < 0.005, "{chord_m} m: {rate} rev/s, expected {expected}");
    }
}

#[test]
fn a_plate_of_eight_centimetres_no_longer_tumbles() {
    assert!(!tumbles(&turning(0.079)));
}
