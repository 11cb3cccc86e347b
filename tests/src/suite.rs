// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Parity of any simulator with the oracle: what a backend of anybody's must pass. [`worlds`] makes the worlds,
//! [`check`] drives a simulator through one of them.

use windfall_core::{Contract, SimError, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};

use crate::compare::{Difference, LONG_POSITION_M, LONG_QUATERNION, STEP_SEGMENT, difference};
use crate::strategies::{flying_scene, hilly_scene, smooth_scene, varied_scene, wooded_scene};

/// Steps of a check: in several submissions of different lengths.
const BATCHES: [u32; 4] = [1, 2, 60, 137];

/// A world to check a simulator in.
#[derive(Debug)]
pub struct Case {
    /// What is special about it.
    pub name: &'static str,
    /// Its state at time zero.
    pub world: World,
    /// Whether rounding errors stay small in it, so that positions can be compared under the tolerant contract.
    pub is_smooth: bool,
}

impl Case {
    /// Whether there are trees in it.
    pub fn has_trees(&self) -> bool {
        !self.world.environment.forest().is_empty()
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
        agree(case, info.contract, &difference(&expected, &found))
            .map_err(|reason| format!("{name}, after {} steps: {reason}", found.clock.step()))?;
    }
    // What has been read can be written, and goes on from there.
    candidate.write_state(&case.world).map_err(failed)?;
    candidate.step(1).map_err(failed)?;
    oracle.write_state(&case.world).map_err(failed)?;
    oracle.step(1).map_err(failed)?;
    oracle.read_state(&mut expected).map_err(failed)?;
    candidate.read_state(&mut found).map_err(failed)?;
    agree(case, info.contract, &difference(&expected, &found))
        .map_err(|reason| format!("{name}, after its state was written back: {reason}"))?;
    let mut other = case.world.environment.scene().clone();
    other.sources[0].count += 1;
    let other = World::build(&other).map_err(|error| error.to_string())?;
    match candidate.write_state(&other) {
        Err(SimError::Size { .. }) => Ok(()),
        other => Err(format!("{name}: a world of another size gives {other:?}; should be SimError::Size")),
    }
}

/// Whether states are as near to each other as a contract promises.
fn agree(case: &Case, contract: Contract, found: &Difference) -> Result<(), String> {
    let is_near = match (contract, case.is_smooth) {
        (Contract::Exact, _) => found.is_none(),
        (Contract::Tolerant, true) => {
            found.is_finite()
                && found.leaves().integer_rows == 0
                && found.leaves().largest("place.position") <= LONG_POSITION_M
                && found.leaves().largest("attitude.quaternion") <= LONG_QUATERNION
        }
        // Elsewhere rounding errors grow, but not within a few steps.
        (Contract::Tolerant, false) => {
            found.is_finite()
                && found.leaves().largest("place.position") <= 0.5
                && found.segments().largest("base") <= 100.0 * STEP_SEGMENT
        }
    };
    if is_near {
        Ok(())
    } else {
        Err(format!("too far from the oracle under the {contract} contract: {found:?}"))
    }
}
