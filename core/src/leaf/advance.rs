// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/advance.wgsl
//!
//! One step of one leaf: the whole of its life in one place.

use super::fall::leaf_fall;
use super::record::{SOURCE_MASK, SOURCE_SHIFT, STATE_DORMANT, STATE_FALLING, STATE_MASK, STATE_RESTING};
use super::release::leaf_release;
use super::settle::leaf_settle;
use super::store::LeafMut;
use crate::context::Context;

/// Moves one leaf through one step.
#[inline(always)]
pub fn leaf_advance(cx: &Context<'_>, leaf: &mut LeafMut<'_>) {
    let step = cx.step.index.0[0];
    if step >= leaf.course.event {
        let source = (leaf.identity.look >> SOURCE_SHIFT) & SOURCE_MASK;
        let lifetime = cx.environment.sources[source as usize].timing.0[3];
        if (leaf.place.bits & STATE_MASK) == STATE_DORMANT {
            leaf_release(cx, leaf, leaf.identity.id, source, step);
        } else if lifetime != 0 && step.wrapping_sub(leaf.identity.release) >= lifetime {
            leaf_release(cx, leaf, leaf.identity.id.wrapping_add(cx.environment.seed.0[2]), source, step);
        }
    }
    let state = leaf.place.bits & STATE_MASK;
    if state == STATE_FALLING {
        leaf_fall(cx, leaf);
    } else if state == STATE_RESTING {
        leaf_settle(cx, leaf);
    }
}
