// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! An array of structs, stepped leaf after leaf on one thread.

use windfall_core::device::leaf::advance::leaf_advance;
use windfall_core::device::leaf::air::{air_is_sampled, leaf_sample_air};
use windfall_core::leaf::{Attitude, Drift, Identity, LeafMut, Leaves, Place, Schedule};
use windfall_core::{Clock, CompiledScene, World, oracle};

/// Everything about one leaf.
#[derive(Clone, Copy, Debug)]
struct Leaf {
    place: Place,
    drift: Drift,
    attitude: Attitude,
    schedule: Schedule,
    air: [u32; 2],
    identity: Identity,
}

/// Leaves as objects, the way most particle systems begin.
#[derive(Clone, Debug)]
pub(crate) struct ArrayOfStructs {
    compiled: CompiledScene,
    clock: Clock,
    leaves: Vec<Leaf>,
}

impl ArrayOfStructs {
    /// Bytes of one leaf.
    pub(crate) const LEAF_BYTES: usize = size_of::<Leaf>();

    /// The leaves of a world.
    pub(crate) fn new(world: &World) -> Self {
        let columns = &world.leaves;
        let leaves = (0..columns.len())
            .map(|slot| Leaf {
                place: columns.place[slot],
                drift: columns.drift[slot],
                attitude: columns.attitude[slot],
                schedule: columns.schedule[slot],
                air: columns.air[slot],
                identity: columns.identity[slot],
            })
            .collect();
        Self { compiled: world.compiled.clone(), clock: world.clock, leaves }
    }

    /// Moves every leaf through `count` steps.
    pub(crate) fn step(&mut self, count: u32) {
        let Self { compiled, clock, leaves } = self;
        oracle::each_step(compiled, clock, count, |cx| {
            for (slot, leaf) in (0..).zip(&mut *leaves) {
                let Leaf { place, drift, attitude, schedule, air, identity } = leaf;
                let mut leaf = LeafMut { place, drift, attitude, schedule, air, identity };
                if air_is_sampled(cx, slot) {
                    leaf_sample_air(cx, &mut leaf);
                }
                leaf_advance(cx, &mut leaf);
            }
        });
    }

    /// Writes the leaves into columns of as many.
    pub(crate) fn read(&self, leaves: &mut Leaves) {
        for (slot, leaf) in self.leaves.iter().enumerate() {
            leaves.place[slot] = leaf.place;
            leaves.drift[slot] = leaf.drift;
            leaves.attitude[slot] = leaf.attitude;
            leaves.schedule[slot] = leaf.schedule;
            leaves.air[slot] = leaf.air;
            leaves.identity[slot] = leaf.identity;
        }
    }
}
