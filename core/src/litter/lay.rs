// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Lays leaves down before time zero: those that have landed by then, and those that a scene strews.

use super::Bed;
use crate::arith::quaternion::{Quat, quat_multiply};
use crate::arith::rng::{mul_high, random, triangular, unit_float};
use crate::arith::vector::Vec3;
use crate::blocks::{NEVER, SOURCE_LITTER};
use crate::context::Context;
use crate::convert::len32;
use crate::device::flight::body::body_of;
use crate::device::flight::strike::{STRIKE_GAP_M, SolidGap, deepest_overlap};
use crate::device::leaf::launch::turn_about_y;
use crate::device::leaf::lie::{
    STREAM_LYING, flatten_to, leaf_lie_down, lying_tilt, own_friction, reach_down,
};
use crate::device::leaf::record::{STATE_RESTING, leaf_appearance, leaf_state, place_bits};
use crate::device::leaf::release::release_size_speed;
use crate::device::leaf::stack::{leaf_changes_litter, leaf_stack};
use crate::device::leaf::strike::{held_at_rest, is_borne, leaf_rest_on};
use crate::device::leaf::wake::leaf_check_cover;
use crate::device::motion::feature::{STREAM_PLACE, STREAM_TRAITS};
use crate::device::solid::near::solids_cell;
use crate::device::terrain::ground::{ground_lean, ground_rest, ground_slope, lying_height};
use crate::device::terrain::litter::{LITTER_CELLS_PER_M, litter_height};
use crate::leaf::{LeafMut, Leaves};
use crate::scene::Litter;

/// Random words that thin a bed out.
const STREAM_RIM: u32 = 37;
/// Most cells that a leaf slides down a heap before time zero.
const MOST_SLIDES: u32 = 64;

/// Strews the leaves that lie on the ground from the start, in the slots from `first` on: uniformly over the rectangle but for its
/// rim, where they thin out. Neighbours lie in neighbouring slots, so that those who visit them find the same heights again.
pub(crate) fn strew(cx: &Context<'_>, litter: &Litter, leaves: &mut Leaves, first: usize) {
    let mut run = leaves.as_mut().split_at(first).1;
    let mut places: Vec<(u32, f32, f32)> = (first..first + run.len())
        .map(|slot| {
            let (x, z) = strewn_place(cx, litter, len32(slot));
            (tile_of(litter, x, z), x, z)
        })
        .collect();
    places.sort_by_key(|&(tile, ..)| tile);
    for ((slot, leaf), (_, x, z)) in (first..).zip(run.iter_mut()).zip(places) {
        let id = len32(slot);
        let words = random(cx.scene.seed, id, STREAM_PLACE);
        let traits = random(cx.scene.seed, id, STREAM_TRAITS);
        let species = mul_high(words[3], cx.scene.species_count);
        leaf.identity.id = id;
        leaf.identity.appearance = leaf_appearance(traits[3], traits[0], SOURCE_LITTER);
        leaf.schedule.size = release_size_speed(&cx.scene.species[species as usize], traits).size;
        leaf.schedule.event = NEVER;
        leaf.place.position = [x, 0.0, z];
        leaf.place.bits = place_bits(STATE_RESTING, 0, 0, species, 0);
        leaf.attitude.quaternion = turn_about_y(words[2]).to_array();
    }
}

/// Place x, z in m of one of the leaves that are strewn.
fn strewn_place(cx: &Context<'_>, litter: &Litter, number: u32) -> (f32, f32) {
    let rim_m = litter.rim_m();
    let words = random(cx.scene.seed, number, STREAM_PLACE);
    let rims = random(cx.scene.seed, number, STREAM_RIM);
    let along = |word: u32, rim: u32, center_m: f32, edge_m: f32| {
        let within = (unit_float(word) - 0.5) * (edge_m - 2.0 * rim_m);
        center_m + (within + triangular(rim) as f32 * (rim_m / 65536.0))
    };
    (
        along(words[0], rims[0], litter.center_m.x, litter.size_m.x),
        along(words[1], rims[1], litter.center_m.y, litter.size_m.y),
    )
}

/// Number of the square metre that a place lies in, line by line.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 256 on a side")]
fn tile_of(litter: &Litter, x_m: f32, z_m: f32) -> u32 {
    let place = |at_m: f32, center_m: f32, edge_m: f32| (at_m - center_m + 0.5 * edge_m).max(0.0) as u32;
    let column = place(x_m, litter.center_m.x, litter.size_m.x);
    place(z_m, litter.center_m.y, litter.size_m.y) << 16 | column
}

/// Lays every leaf that rests into the bed, one after another.
pub(crate) fn lay_all(cx: &Context<'_>, leaves: &mut Leaves, bed: &mut Bed) {
    for mut leaf in leaves.as_mut().iter_mut() {
        if leaf_state(leaf.place.bits) != STATE_RESTING {
            continue;
        }
        lay(&cx.over(&bed.words), &mut leaf);
        if leaf_changes_litter(leaf.place.bits, leaf.drift.velocity.into()) {
            let change = leaf_stack(&cx.over(&bed.words), &mut leaf);
            bed.apply(&cx.scene.litter, &change);
        }
    }
    mark_covered(cx, leaves, bed);
}

/// Marks the leaves that others cover, or snow.
pub(crate) fn mark_covered(cx: &Context<'_>, leaves: &mut Leaves, bed: &Bed) {
    for mut leaf in leaves.as_mut().iter_mut() {
        leaf_check_cover(&cx.over(&bed.words), &mut leaf);
    }
}

/// Lets a leaf slide down to where it stays, and lays it down there in its own pose.
fn lay(cx: &Context<'_>, leaf: &mut LeafMut<'_>) {
    if cx.scene.has_solids() && lay_by_solids(cx, leaf) {
        return;
    }
    let words = random(cx.scene.seed, leaf.identity.id, STREAM_LYING);
    let [mut x, _, mut z] = leaf.place.position;
    let mut slope = ground_slope(cx, x, z);
    let mut friction = own_friction(cx, words, litter_height(cx, x, z));
    for _ in 0..MOST_SLIDES {
        let steep = slope.gain - 1.0;
        if steep <= friction * friction {
            break;
        }
        let way = Vec3::new(slope.x, 0.0, slope.z) * (1.0 / (libm::sqrtf(steep) * LITTER_CELLS_PER_M));
        (x, z) = (x - way.x, z - way.z);
        slope = ground_slope(cx, x, z);
        friction = own_friction(cx, words, litter_height(cx, x, z));
    }
    let lean = quat_multiply(ground_lean(slope), lying_tilt(cx, words));
    let pose = flatten_to(lean, Quat::from(leaf.attitude.quaternion), 0.0);
    let body = body_of(cx, leaf.place.bits, leaf.schedule.size);
    leaf.attitude.quaternion = pose.to_array();
    leaf.place.position = [x, lying_height(cx, x, z, reach_down(&body, pose)), z];
    leaf.drift.velocity = [0.0; 3];
    leaf.drift.phase = cx.scene.settle_steps;
    if cx.scene.has_living_litter() {
        leaf_lie_down(cx, leaf, slope, friction, words);
    }
}

/// Moves a leaf whose place is inside a solid part out of it. Returns true if that holds the leaf now.
fn lay_by_solids(cx: &Context<'_>, leaf: &mut LeafMut<'_>) -> bool {
    let pose = Quat::from(leaf.attitude.quaternion);
    let body = body_of(cx, leaf.place.bits, leaf.schedule.size);
    let [x, _, z] = leaf.place.position;
    leaf.place.position[1] = ground_rest(cx, x, z) + reach_down(&body, pose);
    for _ in 0..MOST_SLIDES {
        let place = Vec3::from(leaf.place.position);
        let overlap = deepest_overlap(cx, &body, pose, solids_cell(cx, place), place, 0.0);
        if overlap.number == NEVER {
            break;
        }
        let SolidGap { gap_m, normal, .. } = overlap.gap;
        let out = normal * -gap_m.min(-STRIKE_GAP_M);
        leaf.place.position = (place + out).to_array();
    }
    if !is_borne(cx, &body, pose, leaf.place.position.into()) {
        return false;
    }
    let held = held_at_rest(cx, leaf);
    if held.is_firm {
        leaf_rest_on(cx, leaf, &held.at_rest);
    }
    held.is_firm
}
