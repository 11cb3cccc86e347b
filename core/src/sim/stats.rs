// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/measure.wgsl
//!
//! Counts over a world: integers only, so their sum does not depend on order.

use crate::device::flight::regime::REGIME_COUNT;
use crate::device::leaf::record::{STATE_FALLING, flies, leaf_primitive, leaf_regime, leaf_state};
use crate::leaf::{Leaves, Place};
use crate::motion::{PRIMITIVE_COUNT, Primitive};

crate::shared_constants! {
    /// Number of counters.
    pub const COUNTER_COUNT: u32 = 24;
    /// First counter of the primitive motions of falling leaves.
    pub const COUNTER_PRIMITIVE: u32 = 4;
    /// Counter of leaves with a position that is not a finite number.
    pub const COUNTER_BROKEN: u32 = 12;
    /// First counter of the regimes of leaves that fly as bodies.
    pub const COUNTER_REGIME: u32 = 16;
    /// Bits of infinity; a float whose bits without sign reach them is not finite.
    pub const INFINITY_BITS: u32 = 0x7f80_0000;
}

/// Counts over a world at one step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stats {
    /// Step index the counts belong to.
    pub step: u32,
    /// Counts over all leaves.
    pub leaves: LeafStats,
}

/// Counts over all leaves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LeafStats {
    /// Leaves not let go yet.
    pub dormant: u32,
    /// Leaves on branches.
    pub attached: u32,
    /// Leaves in the air.
    pub falling: u32,
    /// Leaves on the ground.
    pub resting: u32,
    /// Falling leaves that are synthesised, by primitive motion, in the order of [`Primitive::ALL`].
    pub primitives: [u32; PRIMITIVE_COUNT],
    /// Falling leaves that fly as bodies, by regime: steady, flutter, tumble, chaotic, helical, spiral, autorotation.
    pub regimes: [u32; REGIME_COUNT as usize],
    /// Leaves whose position is not a finite number: always zero unless something is wrong.
    pub broken: u32,
}

/// Counters that one leaf adds to: its state, its motion or regime if it falls (else none), and whether it is broken.
#[inline(always)]
pub fn leaf_counters(place: &Place) -> [u32; 3] {
    let state = leaf_state(place.bits);
    let motion = if flies(place.bits) {
        COUNTER_REGIME + leaf_regime(place.bits)
    } else {
        COUNTER_PRIMITIVE + leaf_primitive(place.bits)
    };
    let bits = place.position.map(|x| x.to_bits() & 0x7fff_ffff);
    let broken = bits[0] >= INFINITY_BITS || bits[1] >= INFINITY_BITS || bits[2] >= INFINITY_BITS;
    [
        state,
        if state == STATE_FALLING { motion } else { COUNTER_COUNT },
        if broken { COUNTER_BROKEN } else { COUNTER_COUNT },
    ]
}

impl Stats {
    /// Counts over leaves.
    pub fn of(leaves: &Leaves, step: u32) -> Self {
        let mut counters = [0; COUNTER_COUNT as usize];
        for place in &leaves.place {
            for counter in leaf_counters(place) {
                if counter < COUNTER_COUNT {
                    counters[counter as usize] += 1;
                }
            }
        }
        Self::from_counters(&counters, step)
    }

    /// The same without so many rows that hold no leaf.
    #[must_use]
    pub fn without_unused(mut self, rows: u32) -> Self {
        self.leaves.dormant -= rows;
        self
    }

    /// Counts from the raw counters of a kernel.
    pub fn from_counters(counters: &[u32; COUNTER_COUNT as usize], step: u32) -> Self {
        let leaves = LeafStats {
            dormant: counters[0],
            attached: counters[1],
            falling: counters[2],
            resting: counters[3],
            primitives: Primitive::ALL
                .map(|primitive| counters[(COUNTER_PRIMITIVE + primitive as u32) as usize]),
            regimes: core::array::from_fn(|index| counters[COUNTER_REGIME as usize + index]),
            broken: counters[COUNTER_BROKEN as usize],
        };
        Self { step, leaves }
    }
}

impl LeafStats {
    /// Leaves that have been let go or ride a branch: all but the dormant ones.
    pub fn total(&self) -> u32 {
        self.attached + self.falling + self.resting
    }
}
