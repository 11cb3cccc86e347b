// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compiles jets at a moment.

use std::f64::consts::PI;

use glam::DVec3;

use crate::blocks::JetBlock;
use crate::convert::single;
use crate::device::wind::jet::{JET_SPREAD, WALL_JET_SPREAD};
use crate::scene::Jet;

/// Width b of a jet with the momentum of its nozzle and the speed there, in diameters: half of the root of 3.
const CORE_WIDTH: f64 = 0.866_025_403_784_438_6;
/// Distance in m of a bend that no jet reaches.
const NO_TURN_M: f64 = 1e6;
/// Smallest squared cosine of a descent for which the bent axis stays on the ground.
const LEAST_COSINE_SQUARED: f64 = 0.1;

/// Width b of the core of a jet in m.
pub(super) fn core_width_m(jet: &Jet) -> f64 {
    CORE_WIDTH * f64::from(jet.nozzle_m)
}

/// A jet at a time over ground of the height that `ground` gives at a place, if there is ground: as level as there, wherever
/// the jet gets to.
pub(super) fn jet_block(jet: &Jet, time_s: f64, ground: impl Fn(DVec3) -> Option<f64>) -> JetBlock {
    let mut block: JetBlock = bytemuck::Zeroable::zeroed();
    let Some(pose) = jet.pose(time_s) else { return block };
    let width_m = core_width_m(jet);
    let strength = pose.speed_m_s * width_m;
    let heading = DVec3::new(pose.axis.x, 0.0, pose.axis.z).normalize_or_zero();
    let vector = |v: DVec3| v.to_array().map(single);
    block.nozzle_m = vector(pose.at_m);
    block.width_m = single(width_m);
    block.axis = vector(pose.axis);
    block.strength_m2_s = single(strength);
    block.heading = vector(heading);
    block.turn_start_m = single(NO_TURN_M);
    block.middle_m = block.nozzle_m;
    block.middle_m2 = single(width_m * width_m);
    block.diameters_per_m = single(1.0 / f64::from(jet.nozzle_m));
    let drop = -pose.axis.y;
    let Some(ground_m) = ground(pose.at_m).filter(|_| drop > 0.0) else { return block };
    let height_m = (pose.at_m.y - ground_m).max(0.0);
    let meeting_m = height_m / drop;
    if meeting_m >= NO_TURN_M {
        return block;
    }
    let meeting_width_m = width_m.max(f64::from(JET_SPREAD) * meeting_m);
    // From where its rim meets the ground, and as far behind, but not from behind the nozzle.
    let half_turn_m = (meeting_width_m / drop).min(meeting_m).max(width_m);
    let cosine_squared = 1.0 - drop * drop;
    let off_axis = (DVec3::Y - pose.axis * pose.axis.y) * (drop / cosine_squared.max(LEAST_COSINE_SQUARED));
    block.turn_start_m = single(meeting_m - half_turn_m);
    block.half_turn_m = single(half_turn_m);
    block.turns_per_m = single(0.5 / half_turn_m);
    block.bend = vector(off_axis);
    block.middle_m = vector(pose.at_m + pose.axis * meeting_m);
    block.middle_m2 = single(meeting_width_m * meeting_width_m);
    let lost = 1.0 - libm::sqrt(cosine_squared.max(0.0));
    let wall = libm::sqrt(8.0 * lost / (9.0 * PI * f64::from(WALL_JET_SPREAD)));
    block.wall_m2_s = single(strength * wall);
    block
}
