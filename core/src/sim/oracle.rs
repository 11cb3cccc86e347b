// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Steps worlds in plain loops: what every simulator is compared with.

use std::collections::BTreeMap;

use super::world::World;
use crate::clock::Clock;
use crate::compile::CompiledScene;
use crate::context::Context;
use crate::device::leaf::advance::leaf_advance;
use crate::device::leaf::air::{air_is_sampled, leaf_sample_air};
use crate::device::leaf::burn::{
    BURN_WORDS, burn_cell, cell_power, feeds_plume, fire_words, leaf_burn, leaf_heat_release,
};
use crate::device::leaf::collide::{COLLISION_WORDS, collision_cell, leaf_collide, own_sums};
use crate::device::leaf::fly::leaf_fly;
use crate::device::leaf::record::flies;
use crate::device::leaf::stack::{leaf_changes_litter, leaf_stack};
use crate::device::leaf::strike::leaf_push;
use crate::device::leaf::wake::{cover_is_due, leaf_check_cover, leaf_wake, wake_is_due};
use crate::leaf::{Burns, Leaves};
use crate::litter::snow::step_snow;
use crate::particle::{follow_leaves, keep_all, step_all};
use crate::scene::MAX_PLUMES;

/// Steps the particles and the leaves of a world one after another. Trees, and the leaves that hang on them, stay as they are.
pub fn step(world: &mut World, count: u32) {
    let World { compiled, clock, leaves, branches, bed, particles, tallies, history, burns } = world;
    each_step(compiled, clock, count, |cx| {
        let bare = cx;
        let mut fires = None;
        let cx = &cx.over(&bed.words);
        step_all(cx, compiled.carriers(), compiled.start_count(), particles, tallies);
        keep_all(cx, compiled.histories(), particles, history);
        if cx.scene.collides(cx.step.index) {
            collide(cx, leaves);
        }
        if cx.scene.heats(cx.step.index) {
            let fed = burn(cx, leaves, burns);
            fires = Some(fed);
        }
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
            if leaf_changes_litter(leaf.place.bits, leaf.drift.velocity.into()) {
                let change = leaf_stack(bare, &mut leaf);
                bed.apply(&bare.scene.litter, &change);
            }
        }
        for (fire, fed) in bed.fires_mut(bare.scene).iter_mut().zip(fires.iter().flatten()) {
            *fire = fire_words(fire[0], *fed);
        }
        if bare.scene.has_snow() {
            step_snow(bare, bed, branches, particles);
        }
        follow_leaves(bare, leaves, burns, particles);
    });
}

/// Lets the leaves that fly as bodies collide with each other.
fn collide(cx: &Context<'_>, leaves: &mut Leaves) {
    let mut cells = BTreeMap::<u32, [u32; COLLISION_WORDS as usize]>::new();
    for leaf in leaves.as_mut().iter_mut().filter(|leaf| flies(leaf.place.bits)) {
        let cell = collision_cell(cx, leaf.place.position.into());
        let velocity = leaf.drift.velocity.into();
        let own = own_sums(cx, &cell, leaf.place.bits, leaf.schedule.size, velocity);
        let own: [u32; COLLISION_WORDS as usize] = bytemuck::cast(own);
        let sums = cells.entry(cell.index).or_default();
        sums.iter_mut().zip(own).for_each(|(sum, own)| *sum = sum.wrapping_add(own));
    }
    for mut leaf in leaves.as_mut().iter_mut().filter(|leaf| flies(leaf.place.bits)) {
        let cell = collision_cell(cx, leaf.place.position.into());
        leaf_collide(cx, &mut leaf, &cell, &bytemuck::cast(cells[&cell.index]));
    }
}

/// Heats leaves, and lets those that are lit burn on. Returns the heat that feeds the fire of each plume.
fn burn(cx: &Context<'_>, leaves: &mut Leaves, burns: &mut Burns) -> [u32; MAX_PLUMES] {
    let mut fed = [0_u32; MAX_PLUMES];
    let mut cells = BTreeMap::<u32, [u32; BURN_WORDS as usize]>::new();
    for (leaf, burn) in leaves.as_mut().iter_mut().zip(&burns.burn) {
        let (place, size) = (leaf.place.position.into(), leaf.schedule.size);
        let heat = leaf_heat_release(cx, place, leaf.place.bits, size, burn);
        if heat.sums.count != 0 {
            let own: [u32; BURN_WORDS as usize] = bytemuck::cast(heat.sums);
            let sums = cells.entry(heat.index).or_default();
            sums.iter_mut().zip(own).for_each(|(sum, own)| *sum = sum.wrapping_add(own));
            for (fed, plume) in fed.iter_mut().zip(&cx.step.moments[0].plumes) {
                if feeds_plume(plume, place) {
                    *fed = fed.wrapping_add(heat.sums.power);
                }
            }
        }
    }
    for (slot, (mut leaf, burn)) in (0..).zip(leaves.as_mut().iter_mut().zip(&mut burns.burn)) {
        let cell = burn_cell(cx, leaf.place.position.into());
        let sums = cells.get(&cell.index).copied().unwrap_or_default();
        leaf_burn(cx, &mut leaf, slot, burn, cell_power(&cell, &bytemuck::cast(sums)));
    }
    fed
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
