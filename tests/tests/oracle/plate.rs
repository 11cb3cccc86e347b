// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The falling plate of Andersen, Pesavento and Wang: its regimes, periods and speeds as published solutions have them.

use std::f64::consts::PI;

use crate::common::{csv, field, number};
use ode_solvers::dop_shared::IntegrationError;
use ode_solvers::{Dop853, SVector, System};
use windfall_tests::reference::FallingPlate;

type State = SVector<f64, 6>;

/// Units of time thrown away at the start of a fall, then kept: eight of the longest periods or more each.
const SETTLE: f64 = 200.0;
const KEEP: f64 = 300.0;
/// Units of time between samples.
const SAMPLE: f64 = 0.01;
/// Half-turns that no fluttering plate makes.
const MANY: f64 = 4.0;

struct Fall(FallingPlate);

impl System<f64, State> for Fall {
    fn system(&self, _time: f64, state: &State, slope: &mut State) {
        *slope = self.0.rates(&(*state).into()).into();
    }
}

/// States of a fall from a small tilt, sampled evenly after it has settled.
fn fall(inertia: f64) -> Result<Vec<State>, IntegrationError> {
    let start = State::from([0.1, 0.1, 0.1, PI / 4.0, 0.0, 0.0]);
    let end = SETTLE + KEEP;
    let mut solver = Dop853::new(Fall(FallingPlate::new(inertia)), 0.0, end, SAMPLE, start, 1e-10, 1e-10);
    solver.integrate()?;
    let samples = solver.x_out().iter().zip(solver.y_out());
    Ok(samples.filter(|(time, _)| **time >= SETTLE).map(|(_, state)| *state).collect())
}

/// Samples before which `value` rises through zero, and those moments in units of time.
fn rises(values: &[f64]) -> Vec<(usize, f64)> {
    let pairs = values.windows(2).enumerate();
    pairs
        .filter(|(_, pair)| pair[0] < 0.0 && pair[1] >= 0.0)
        .map(|(row, pair)| (row, (row as f64 + pair[0] / (pair[0] - pair[1])) * SAMPLE))
        .collect()
}

struct Motion {
    half_turns: f64,
    /// Units of time from one repeat to the next.
    period: f64,
    /// Mean velocity over whole repeats, across and up.
    velocity: [f64; 2],
}

/// Cycles of `states`: swings of a plate that keeps its face up, else half-turns, `per_repeat` of them at a time.
fn motion(states: &[State], per_repeat: usize) -> Motion {
    let half_turns = (states[states.len() - 1][3] - states[0][3]) / PI;
    let phase = |pitch: f64| {
        if half_turns.abs() > MANY { (2.0 * pitch).sin() * half_turns.signum() } else { pitch.sin() }
    };
    let rises = rises(&states.iter().map(|state| phase(state[3])).collect::<Vec<_>>());
    let repeats = (rises.len() - 1) / per_repeat;
    let ((first, begin), (last, end)) = (rises[0], rises[repeats * per_repeat]);
    let travel = (states[last] - states[first]) / ((last - first) as f64 * SAMPLE);
    Motion { half_turns, period: (end - begin) / repeats as f64, velocity: [travel[4], travel[5]] }
}

#[test]
fn the_plate_falls_as_its_published_solutions() {
    let mut regimes = [0, 0];
    for row in csv(include_str!("../../data/model_reference_solutions.csv")) {
        if field(&row, "model") != "APW_2D_nondim" {
            continue;
        }
        let (input, regime) = (field(&row, "input"), field(&row, "regime"));
        let inertia: f64 = input.trim_start_matches("I*=").parse().expect("a number");
        let tumbling = regime.starts_with("tumble");
        let states = fall(inertia).unwrap_or_else(|error| panic!("{input}: {error}"));
        // A period-doubled tumble repeats after two half-turns.
        let motion = motion(&states, if regime.contains("full turn") { 2 } else { 1 });
        assert_eq!(tumbling, motion.half_turns.abs() > MANY, "{input}: {} half-turns", motion.half_turns);
        regimes[usize::from(tumbling)] += 1;

        let near = |what: &str, found: f64, expected: f64| {
            // The table rounds to three places.
            let allowed = 0.01 * expected + 5e-4;
            assert!((found - expected).abs() < allowed, "{input}: {what} {found}, expected {expected}");
        };
        if !field(&row, "period").is_empty() {
            near("period", motion.period, number(&row, "period"));
        }
        near("descent", -motion.velocity[1], number(&row, "mean_descent"));
        near("drift", motion.velocity[0].abs(), number(&row, "mean_drift"));
    }
    assert_eq!(regimes, [8, 3], "rows that flutter, rows that tumble");
}

#[test]
fn the_plate_stops_fluttering_at_the_published_moment_of_inertia() {
    let turns = |inertia: f64| motion(&fall(inertia).expect("it integrates"), 1).half_turns.abs() > MANY;
    assert!(!turns(1.21), "it flutters at 1.21");
    assert!(turns(1.225), "it tumbles at 1.225");
}
