// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Finds a leaf's state at any moment of a fall through still air, without stepping there.

use super::store::LeafMut;
use crate::arith::math::exponential;
use crate::arith::quaternion::Quat;
use crate::arith::vector::Vec3;
use crate::blocks::NEVER;
use crate::context::Context;
use crate::device::leaf::cone_spiral::{cone_of, cone_table_phase, winds};
use crate::device::leaf::fall::{Glide, glide_of, response_of, spin_advance};
use crate::device::leaf::fly::flight_write;
use crate::device::leaf::join::leaf_join;
use crate::device::leaf::own::{motion_params, on_grid, own_advance, own_orientation, own_period, own_rate};
use crate::device::leaf::record::{Drift, landed_bits, leaf_source, leaf_species, leaf_stage, with_blend};
use crate::device::leaf::settle::{flatten, flatten_on};
use crate::device::motion::feature::{STAGE_COUNT, stage_end};
use crate::device::terrain::ground::{ground_rest, ground_slope};
use crate::flight::drop_table::DropTable;

/// Refinements of the moment of landing.
const LANDING_ROUNDS: u32 = 6;
/// Speed in m/s below which a drift carries no leaf to the next point of the grid, whatever its time constant.
const SLOWEST_M_S: f32 = 1e-20;

/// Moves a synthesised leaf that has just been let go on to its state `elapsed` steps later, as a fall through still air gives it;
/// on the ground, flat and still, if that fall is over. Orientation is that of the stage, without the short blend after
/// a join.
pub fn leaf_seek(cx: &Context<'_>, leaf: &mut LeafMut<'_>, elapsed: u32) {
    let goal = u64::from(elapsed) << 16;
    let mut glide = glide_of(leaf.place, leaf.drift);
    let mut now = 0;
    loop {
        let end = stage_end_after(cx, leaf);
        let part = end.min(goal) - now;
        let next = glide_long(cx, leaf, glide, part);
        if part > 0 && above_rest(cx, next.position) < 0.0 {
            let (landing, landed) = landing_within(cx, leaf, glide, (part, next));
            arrive(cx, leaf, landed, now + landing);
            rest(cx, leaf);
            return;
        }
        glide = next;
        if end >= goal {
            break;
        }
        now = end;
        glide = leaf_join(cx, leaf, glide);
    }
    arrive(cx, leaf, glide, goal);
}

/// Moves a leaf that flies as a body on like one of the precomputed drops of its kind.
fn leaf_seek_flight(cx: &Context<'_>, table: &DropTable, leaf: &mut LeafMut<'_>, elapsed: u32) {
    if elapsed == 0 {
        return;
    }
    let start = Vec3::from(leaf.place.position);
    let height = above_rest(cx, start).max(0.0);
    let (mut flight, is_down) = table.look_up(cx, leaf.identity.id, elapsed, height);
    flight.position = start + flight.position;
    flight_write(leaf, flight);
    if is_down || above_rest(cx, flight.position) < 0.0 {
        rest(cx, leaf);
    }
}

/// Moves a leaf of any species on from its release.
pub(crate) fn leaf_seek_any(
    cx: &Context<'_>,
    tables: &[Option<DropTable>],
    leaf: &mut LeafMut<'_>,
    elapsed: u32,
) {
    match &tables[leaf_species(leaf.place.bits) as usize] {
        Some(table) => leaf_seek_flight(cx, table, leaf, elapsed),
        None => leaf_seek(cx, leaf, elapsed),
    }
}

/// Height in metres above a leaf that rests there.
fn above_rest(cx: &Context<'_>, place: Vec3) -> f32 {
    place.y - ground_rest(cx, place.x, place.z)
}

/// Time from release to the end of a leaf's stage in 2^-16 steps.
fn stage_end_after(cx: &Context<'_>, leaf: &LeafMut<'_>) -> u64 {
    let seed = cx.scene.seed;
    let stage = leaf_stage(leaf.identity.appearance);
    if stage + 1 < STAGE_COUNT && !winds(leaf.place.bits) {
        u64::from(stage_end(seed, leaf.identity.id, leaf.identity.fall_time, stage))
    } else {
        u64::MAX
    }
}

/// Time within the stage that begins with `glide` at which the leaf comes to the ground, and the leaf there. `late` is a time
/// when it is below. The fall is nearly uniform: its end is bracketed and refined by the secant through the bracket's ends.
fn landing_within(cx: &Context<'_>, leaf: &LeafMut<'_>, glide: Glide, late: (u64, Glide)) -> (u64, Glide) {
    let height = |glide: Glide| f64::from(above_rest(cx, glide.position));
    let (mut early, mut early_height) = (0, height(glide).max(0.0));
    let (mut late, mut landed) = late;
    let mut late_height = height(landed).min(-1e-9);
    for _ in 0..LANDING_ROUNDS {
        if late - early <= 1 {
            break;
        }
        let share = early_height / (early_height - late_height);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "share is between 0 and 1"
        )]
        let middle = early + ((late - early) as f64 * share) as u64;
        let tried = glide_long(cx, leaf, glide, middle);
        let found = height(tried);
        if found > 0.0 {
            (early, early_height) = (middle, found);
            late_height *= 0.5;
        } else {
            (late, late_height, landed) = (middle, found.min(-1e-9), tried);
            early_height *= 0.5;
        }
    }
    (late, landed)
}

/// Writes the state of a leaf `elapsed` (2^-16 steps) after its release.
fn arrive(cx: &Context<'_>, leaf: &mut LeafMut<'_>, glide: Glide, elapsed: u64) {
    #[expect(clippy::cast_possible_truncation, reason = "whole steps of a fall fit a word")]
    let steps = (elapsed >> 16) as u32;
    let bits = with_blend(leaf.place.bits, 0);
    let spin =
        spin_advance(bits, leaf.schedule.heading, response_of(cx, bits).fastest_spin).wrapping_sub(bits);
    leaf.place.bits = bits.wrapping_add(spin.wrapping_mul(steps));
    leaf.place.position = glide.position.to_array();
    *leaf.drift = Drift { velocity: glide.drift.to_array(), phase: glide.phase };
    let attitude = own_orientation(cx, leaf.place.bits, glide.phase, leaf.schedule.heading);
    leaf.attitude.quaternion = attitude.to_array();
}

/// Any length of time within one stage, in still air.
fn glide_long(cx: &Context<'_>, leaf: &LeafMut<'_>, glide: Glide, part_q16: u64) -> Glide {
    let compiled = cx.scene;
    let (bits, params) = (leaf.place.bits, motion_params(*leaf.schedule));
    let response = response_of(cx, bits);
    let rate = u128::from(own_rate(cx, params.rate));
    let turned = (rate * u128::from(part_q16)) >> 16;
    #[expect(clippy::cast_possible_truncation, reason = "the low word is the phase, the rest whole periods")]
    let (periods, low) = ((turned >> 32) as u64 as f32, turned as u32);
    let end = glide.phase.wrapping_add(low);
    let periods =
        if winds(bits) { cone_periods(cx, bits, params.heading, glide.phase, end) } else { periods };
    let own = own_advance(cx, bits, params, glide.phase, end) + own_period(cx, bits, params) * periods;
    #[expect(clippy::cast_possible_truncation, reason = "seconds in single precision")]
    let elapsed = (part_q16 as f64 / 65536.0 * f64::from(compiled.dt_s)) as f32;
    let kept = exponential(-elapsed * response.inv_time_constant);
    let drift = Vec3::from(glide.drift.to_array().map(|drift| fade(drift, kept)));
    let tau = response.time_constant_s;
    let spent = on_grid(glide.drift * tau) - on_grid(drift * tau);
    Glide { position: glide.position + (own + spent), drift, phase: end }
}

/// Whole periods of the table of a cone spiral between two ages, but for the one that [`own_advance`] sees. An age lasts longer than any
/// fall through still air.
fn cone_periods(cx: &Context<'_>, bits: u32, heading: u32, start: u32, end: u32) -> f32 {
    let rate = u64::from(cone_of(cx, bits).table_rate);
    let passed = ((u64::from(end) * rate) >> 16) - ((u64::from(start) * rate) >> 16);
    let first = cone_table_phase(cx, bits, start, heading);
    let periods = (u64::from(first) + passed) >> 32;
    let seen = u64::from(cone_table_phase(cx, bits, end, heading) < first);
    (periods - seen) as f32
}

/// Drift left over, none if it is too slow to move a leaf: numbers too small to be normal take a hundred times as long.
fn fade(drift: f32, kept: f32) -> f32 {
    let left = f64::from(drift) * f64::from(kept);
    if left.abs() < f64::from(SLOWEST_M_S) { 0.0 } else { drift * kept }
}

/// Lays a leaf down where it is.
fn rest(cx: &Context<'_>, leaf: &mut LeafMut<'_>) {
    let lifetime = cx.scene.sources[leaf_source(leaf.identity.appearance) as usize].lifetime_steps;
    let [x, _, z] = leaf.place.position;
    leaf.place.position[1] = ground_rest(cx, x, z);
    leaf.place.bits = landed_bits(leaf.place.bits);
    *leaf.drift = Drift { velocity: [0.0; 3], phase: cx.scene.settle_steps };
    let before = Quat::from(leaf.attitude.quaternion);
    let is_hilly = cx.scene.has_terrain();
    let flat = if is_hilly { flatten_on(ground_slope(cx, x, z), before, 0.0) } else { flatten(before, 0.0) };
    leaf.attitude.quaternion = flat.to_array();
    leaf.schedule.event = if lifetime == 0 { NEVER } else { leaf.identity.release.wrapping_add(lifetime) };
}
