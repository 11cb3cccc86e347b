// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/advance.wgsl
//!
//! One step of one leaf: the whole of its life in one place. Steps with an event (a release, a join) are few and long;
//! kernels take them apart from the many short ones.

use super::afloat::{leaf_drift, leaf_soak};
use super::air::leaf_sample_air;
use super::fall::{leaf_fall, leaf_fall_aloft};
use super::join::leaf_fall_joining;
use super::lie::leaf_settle_on_litter;
use super::record::{
    CHANGE_REMOVED, STATE_ATTACHED, STATE_DORMANT, STATE_FALLING, STATE_RESTING, flies, ground_steps,
    is_afloat, is_held, leaf_source, leaf_state, lies, with_litter_change,
};
use super::release::{leaf_detach, leaf_release};
use super::settle::{leaf_settle, recycling_step};
use crate::blocks::SOURCE_TREES;
use crate::context::Context;
use crate::leaf::LeafMut;

/// Returns true if a leaf has an event in this step.
#[inline(always)]
pub fn leaf_has_event(cx: &Context<'_>, leaf: &LeafMut<'_>) -> bool {
    cx.step.index >= leaf.schedule.event
}

/// Returns true if a leaf on the ground still slides or lies down, or drifts on water, or sinks.
#[inline(always)]
pub fn leaf_is_settling(cx: &Context<'_>, leaf: &LeafMut<'_>) -> bool {
    let [x, _, z] = leaf.drift.velocity;
    let slides = ((x.to_bits() | z.to_bits()) << 1) != 0;
    ground_steps(leaf.drift.phase) < cx.scene.settle_steps || slides
}

/// One step of a leaf without an event in it: it goes on falling, or lies still. Other leaves are left alone, and those
/// that fly as bodies are left to [`leaf_fly`](super::fly::leaf_fly). Returns true if the step is done.
#[inline(always)]
pub fn leaf_advance_plain(cx: &Context<'_>, leaf: &mut LeafMut<'_>) -> bool {
    if leaf_has_event(cx, leaf) {
        return false;
    }
    let state = leaf_state(leaf.place.bits);
    if state == STATE_FALLING {
        return flies(leaf.place.bits) || leaf_fall_aloft(cx, leaf);
    }
    state != STATE_RESTING || !leaf_is_settling(cx, leaf)
}

/// One step of a leaf with an event in it: it is let go, comes to the end of a stage, or is soaked. Let go, it samples the air at once.
#[inline(always)]
pub fn leaf_advance_event(cx: &Context<'_>, leaf: &mut LeafMut<'_>) {
    let now = cx.step.index;
    let source = leaf_source(leaf.identity.appearance);
    let lifetime = cx.scene.sources[source as usize].lifetime_steps;
    if lies(leaf.place.bits) && !is_held(leaf.place.bits) {
        if is_afloat(leaf.place.bits) && now < recycling_step(cx, leaf.identity) {
            leaf_soak(cx, leaf);
        } else {
            // The litter gives it back first.
            leaf.place.bits = with_litter_change(leaf.place.bits, CHANGE_REMOVED);
        }
        return;
    }
    let state = leaf_state(leaf.place.bits);
    let mut is_let_go = true;
    if state == STATE_ATTACHED {
        leaf_detach(cx, leaf, now);
    } else if state == STATE_DORMANT {
        leaf_release(cx, leaf, leaf.identity.id, source, now);
    } else if source != SOURCE_TREES && lifetime != 0 && now.wrapping_sub(leaf.identity.release) >= lifetime {
        leaf_release(cx, leaf, leaf.identity.id.wrapping_add(cx.scene.ids_per_life), source, now);
    } else {
        is_let_go = false;
    }
    if is_let_go {
        leaf_sample_air(cx, leaf);
    }
    if leaf_state(leaf.place.bits) == STATE_FALLING && !flies(leaf.place.bits) {
        leaf_fall_joining(cx, leaf);
    }
}

/// One step of any leaf, which has sampled the air if it is its turn. Those that fly as bodies are left to
/// [`leaf_fly`](super::fly::leaf_fly), which comes after.
#[inline(always)]
pub fn leaf_advance(cx: &Context<'_>, leaf: &mut LeafMut<'_>) {
    if leaf_has_event(cx, leaf) {
        leaf_advance_event(cx, leaf);
        return;
    }
    let state = leaf_state(leaf.place.bits);
    if state == STATE_FALLING && !flies(leaf.place.bits) {
        leaf_fall(cx, leaf);
    } else if state == STATE_RESTING && cx.has_litter() {
        if leaf_is_settling(cx, leaf) && lies(leaf.place.bits) {
            leaf_drift(cx, leaf);
        } else if leaf_is_settling(cx, leaf) {
            leaf_settle_on_litter(cx, leaf);
        }
    } else if state == STATE_RESTING {
        leaf_settle(cx, leaf);
    }
}
