// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Steps worlds in plain loops: what every simulator is compared with.

use super::world::World;
use crate::clock::Clock;
use crate::compile::CompiledScene;
use crate::context::Context;
use crate::device::leaf::advance::leaf_advance;
use crate::device::leaf::air::{air_is_sampled, leaf_sample_air};
use crate::device::leaf::fly::leaf_fly;
use crate::device::leaf::stack::{leaf_changes_litter, leaf_stack};
use crate::device::leaf::strike::leaf_push;
use crate::device::leaf::wake::{cover_is_due, leaf_check_cover, leaf_wake, wake_is_due};

/// Steps the leaves of a world one after another. Trees, and the leaves that hang on them, stay as they are.
pub fn step(world: &mut World, count: u32) {
    let World { compiled, clock, leaves, branches: _, bed } = world;
    each_step(compiled, clock, count, |cx| {
        let bare = cx;
        let cx = &cx.over(&bed.words);
        for (slot, mut leaf) in (0..).zip(leaves.as_mut().iter_mut()) {
            if air_is_sampled(cx, slot) {
                leaf_sample_air(cx, &mut leaf);
            }
            leaf_advance(cx, &mut leaf);
            leaf_fly(cx, &mut leaf);
            if cx.scene.has_living_litter() {
                leaf_push(cx, &mut leaf);
            }
            if cx.scene.has_living_litter() && cover_is_due(cx, slot) {
                leaf_check_cover(cx, &mut leaf);
            }
            if cx.scene.has_living_litter() && wake_is_due(cx, slot) {
                leaf_wake(cx, &mut leaf);
            }
        }
        for mut leaf in leaves.as_mut().iter_mut() {
            if leaf_changes_litter(leaf.place.bits) {
                let change = leaf_stack(bare, &mut leaf);
                bed.apply(&bare.scene.litter, &change);
            }
        }
    });
}

/// Calls `advance` with what kernels see in each of `count` steps, and moves the clock on.
pub fn each_step(
    compiled: &CompiledScene,
    clock: &mut Clock,
    count: u32,
    mut advance: impl FnMut(&Context<'_>),
) {
    for _ in 0..count {
        let block = compiled.step_block(clock);
        advance(&compiled.context(&block));
        compiled.advance(clock);
    }
}
