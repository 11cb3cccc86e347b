// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/advance.wgsl
//!
//! One step of one leaf: the whole of its life in one place. Steps in which something happens (a release, a join) are
//! few and long; kernels take them apart from the many short ones.

use super::fall::{leaf_fall, leaf_glide};
use super::fly::flies;
use super::join::leaf_fall_joining;
use super::record::{
    SOURCE_MASK, SOURCE_SHIFT, STATE_ATTACHED, STATE_DORMANT, STATE_FALLING, STATE_MASK, STATE_RESTING,
};
use super::release::{leaf_detach, leaf_release};
use super::settle::leaf_settle;
use super::store::LeafMut;
use crate::blocks::SOURCE_TREES;
use crate::context::Context;

/// Whether something happens to a leaf in this step.
#[inline(always)]
pub fn leaf_is_due(cx: &Context<'_>, leaf: &LeafMut<'_>) -> bool {
    cx.step.index >= leaf.course.event
}

/// Whether a leaf on the ground still slides or lies down.
#[inline(always)]
pub fn leaf_stirs(cx: &Context<'_>, leaf: &LeafMut<'_>) -> bool {
    let [x, _, z] = leaf.drift.velocity;
    leaf.drift.phase < cx.environment.settle_steps || ((x.to_bits() | z.to_bits()) << 1) != 0
}

/// One step of a leaf to which nothing happens in it: it goes on falling, or lies still. Other leaves are left alone, and
/// what flies as a body is left to [`leaf_fly`](super::fly::leaf_fly). Whether the step is done.
#[inline(always)]
pub fn leaf_advance_plain(cx: &Context<'_>, leaf: &mut LeafMut<'_>) -> bool {
    if leaf_is_due(cx, leaf) {
        return false;
    }
    let state = leaf.place.bits & STATE_MASK;
    if state == STATE_FALLING {
        return flies(leaf.place.bits) || leaf_glide(cx, leaf);
    }
    state != STATE_RESTING || !leaf_stirs(cx, leaf)
}

/// One step of a leaf that is due: it is released, its petiole has broken, or it comes to the end of a stage.
#[inline(always)]
pub fn leaf_advance_due(cx: &Context<'_>, leaf: &mut LeafMut<'_>) {
    let now = cx.step.index;
    let source = (leaf.identity.look >> SOURCE_SHIFT) & SOURCE_MASK;
    let lifetime = cx.environment.sources[source as usize].lifetime_steps;
    let state = leaf.place.bits & STATE_MASK;
    if state == STATE_ATTACHED {
        leaf_detach(cx, leaf, now);
    } else if state == STATE_DORMANT {
        leaf_release(cx, leaf, leaf.identity.id, source, now);
    } else if source != SOURCE_TREES && lifetime != 0 && now.wrapping_sub(leaf.identity.release) >= lifetime {
        leaf_release(cx, leaf, leaf.identity.id.wrapping_add(cx.environment.ids_per_life), source, now);
    }
    if (leaf.place.bits & STATE_MASK) == STATE_FALLING && !flies(leaf.place.bits) {
        leaf_fall_joining(cx, leaf);
    }
}

/// One step of any leaf. What flies as a body is left to [`leaf_fly`](super::fly::leaf_fly), which comes after.
#[inline(always)]
pub fn leaf_advance(cx: &Context<'_>, leaf: &mut LeafMut<'_>) {
    if leaf_is_due(cx, leaf) {
        leaf_advance_due(cx, leaf);
        return;
    }
    let state = leaf.place.bits & STATE_MASK;
    if state == STATE_FALLING && !flies(leaf.place.bits) {
        leaf_fall(cx, leaf);
    } else if state == STATE_RESTING {
        leaf_settle(cx, leaf);
    }
}
