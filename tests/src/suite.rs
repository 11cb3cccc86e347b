// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Parity of any simulator with the oracle: what a backend of anybody's must pass. [`worlds`] makes the worlds,
//! [`check`] drives a simulator through one of them.

use windfall_core::{Contract, SimError, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};

use crate::compare::{LONG_OTHERS, LONG_POSITION_M, LONG_QUATERNION, difference};
use crate::strategies::{
    flying_scene, hilly_scene, littered_scene, smooth_scene, varied_scene, wooded_scene,
};

/// Steps of a check: in several submissions of different lengths.
const BATCHES: [u32; 4] = [1, 2, 60, 137];

/// A world to check a simulator in.
#[derive(Debug)]
pub struct Case {
    /// Distinguishing features of it.
    pub name: &'static str,
    /// Its state at time zero.
    pub world: World,
    /// True if rounding errors stay small in it, so that positions can be compared under the tolerant contract.
    pub is_smooth: bool,
}

impl Case {
    /// Returns true if there are trees in it.
    pub fn has_trees(&self) -> bool {
        !self.world.compiled.forest().is_empty()
    }
}

/// All worlds, of about `leaves` leaves each.
///
/// # Panics
/// If a scene of this crate is not valid.
pub fn worlds(leaves: u32) -> Vec<Case> {
    let case = |name, scene, is_smooth| {
        let world = World::build(&scene).expect("the scenes of the suite are valid");
        Case { name, world, is_smooth }
    };
    let dt_s = 1.0 / 60.0;
    vec![
        case("a smooth wind", smooth_scene(31, leaves, 3.0, dt_s), true),
        case("turbulence and every motion", varied_scene(32, leaves, 3.0, dt_s), false),
        case("bodies and trees", flying_scene(33, leaves, 3.0, dt_s), false),
        case("hills", hilly_scene(varied_scene(34, leaves, 3.0, dt_s)), false),
        case("litter", littered_scene(36, leaves, 5.0, dt_s), false),
        case("trees", wooded_scene(35, leaves, 6.0, dt_s), false),
    ]
}

/// Drives the simulator that `make` makes, and the oracle, through a world, and compares states, clocks and counts as its
/// contract asks for. Also hands it its state back, and a world of another size, which it has to refuse.
///
/// # Errors
/// One line that says what is not as it should be.
pub fn check<S: Simulator>(
    case: &Case,
    make: impl FnOnce(&World) -> Result<S, SimError>,
) -> Result<(), String> {
    let name = case.name;
    let failed = |error: SimError| format!("{name}: {error}");
    let mut oracle = CpuSimulator::new(&case.world, CpuOptions::default()).map_err(failed)?;
    let mut candidate = make(&case.world).map_err(failed)?;
    let info = candidate.info();
    if info.sizes != case.world.sizes() {
        return Err(format!("{name}: sizes {:?} for a world of {:?}", info.sizes, case.world.sizes()));
    }
    let (mut expected, mut found) = (case.world.clone(), case.world.clone());
    for count in BATCHES {
        for simulator in [&mut oracle as &mut dyn Simulator, &mut candidate] {
            simulator.step(count).map_err(failed)?;
            simulator.sync().map_err(failed)?;
        }
        oracle.read_state(&mut expected).map_err(failed)?;
        candidate.read_state(&mut found).map_err(failed)?;
        if candidate.clock() != oracle.clock() || found.clock != expected.clock {
            return Err(format!(
                "{name}: the clock is {:?}, should be {:?}",
                candidate.clock(),
                oracle.clock()
            ));
        }
        let counts = candidate.stats().map_err(failed)?;
        if counts != found.stats() {
            return Err(format!("{name}: counts {counts:?} of a state of {:?}", found.stats()));
        }
        agree(case, info.contract, &expected, &found)
            .map_err(|reason| format!("{name}, after {} steps: {reason}", found.clock.step()))?;
    }
    // What has been read can be written, and goes on from there.
    candidate.write_state(&case.world).map_err(failed)?;
    candidate.step(1).map_err(failed)?;
    oracle.write_state(&case.world).map_err(failed)?;
    oracle.step(1).map_err(failed)?;
    oracle.read_state(&mut expected).map_err(failed)?;
    candidate.read_state(&mut found).map_err(failed)?;
    agree(case, info.contract, &expected, &found)
        .map_err(|reason| format!("{name}, after its state was written back: {reason}"))?;
    let mut other = case.world.compiled.scene().clone();
    other.sources[0].count += 1;
    let other = World::build(&other).map_err(|error| error.to_string())?;
    match candidate.write_state(&other) {
        Err(SimError::Size { .. }) => Ok(()),
        other => Err(format!("{name}: a world of another size gives {other:?}; should be SimError::Size")),
    }
}

/// Checks that states are as near to each other as a contract promises.
fn agree(case: &Case, contract: Contract, expected: &World, found: &World) -> Result<(), String> {
    let apart = difference(expected, found);
    let is_near = match (contract, case.is_smooth) {
        (Contract::Exact, _) => apart.is_none(),
        (Contract::Tolerant, true) => {
            apart.is_finite()
                && apart.leaves().integer_rows <= expected.leaves.len() / LONG_OTHERS as usize
                && apart.leaves().largest("place.position") <= LONG_POSITION_M
                && apart.leaves().largest("attitude.quaternion") <= LONG_QUATERNION
        }
        // A leaf that lands or comes off a step earlier goes another way from then on, a twig that reaches its end stop
        // a step earlier too, and a body does so by rounding alone: no distance bounds a single path. Means stay.
        (Contract::Tolerant, false) => {
            apart.is_finite()
                && mean_segment_distance_m(expected, found) <= MEAN_SEGMENT_M
                && statistics_agree(expected, found)
        }
    };
    if is_near {
        Ok(())
    } else {
        let mean_m = mean_segment_distance_m(expected, found);
        Err(format!(
            "too far from the oracle under the {contract} contract: {apart:?}, segments by {mean_m:e} m on average"
        ))
    }
}

/// Largest share of leaves that may be in another state, under the tolerant contract.
const OTHER_STATES: f64 = 0.01;
/// Largest distance of the mean positions of all leaves in metres, under the tolerant contract.
const MEAN_POSITION_M: f64 = 0.01;

/// Largest mean distance of the segments' joints in metres, under the tolerant contract.
const MEAN_SEGMENT_M: f64 = 0.001;

/// Mean distance of the segments' joints in metres.
fn mean_segment_distance_m(expected: &World, found: &World) -> f64 {
    let (a, b) = (&expected.branches.base, &found.branches.base);
    let distance = |(a, b): (&[f32; 4], &[f32; 4])| {
        (0..3).map(|axis| f64::from(a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt()
    };
    a.iter().zip(b).map(distance).sum::<f64>() / a.len().max(1) as f64
}

/// Returns true if about as many leaves are in each state, and all together are at the same place, but for what chance does to the mean of ways that
/// have parted: three standard errors.
fn statistics_agree(expected: &World, found: &World) -> bool {
    let counts = |world: &World| {
        let stats = world.stats();
        [stats.leaves.dormant, stats.leaves.attached, stats.leaves.falling, stats.leaves.resting]
    };
    let count = expected.leaves.len() as f64;
    let mean = |world: &World| {
        let places = world.leaves.place.iter().map(|place| place.position.map(f64::from));
        places.fold([0.0; 3], |sum, place| [0, 1, 2].map(|axis| sum[axis] + place[axis] / count))
    };
    let (a, b) = (counts(expected), counts(found));
    let others = a.iter().zip(b).map(|(a, b)| a.abs_diff(b)).max().unwrap_or(0);
    let (a, b) = (mean(expected), mean(found));
    let apart_m = |axis: usize| (a[axis] - b[axis]).abs();
    let error_m = |axis: usize| {
        let places = expected.leaves.place.iter().zip(&found.leaves.place);
        let squares = places.map(|(a, b)| f64::from(a.position[axis] - b.position[axis]).powi(2));
        (squares.sum::<f64>() / count).sqrt() / count.sqrt()
    };
    f64::from(others) <= OTHER_STATES * count
        && (0..3).all(|axis| apart_m(axis) <= MEAN_POSITION_M + 3.0 * error_m(axis))
}
