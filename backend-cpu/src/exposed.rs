// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves in the litter that the wind may reach, so that steps pass the others by. Derived from the state, not part of it.

use std::sync::atomic::{AtomicU64, Ordering};

use crate::quiet::UNIT;

/// A bit for each leaf of a unit of slots: set for all in the litter that nothing covers, and maybe for others.
#[derive(Debug)]
pub(crate) struct ExposedLeaves(Vec<AtomicU64>);

impl ExposedLeaves {
    /// Bits for so many slots, nothing known of any.
    pub(crate) fn new(slots: usize) -> Self {
        const { assert!(UNIT == u64::BITS as usize, "a bit for each leaf of a unit") };
        Self((0..slots.div_ceil(UNIT)).map(|_| AtomicU64::new(u64::MAX)).collect())
    }

    /// Forgets all that is known, after the state or the scene has changed.
    pub(crate) fn forget(&self) {
        self.0.iter().for_each(|unit| unit.store(u64::MAX, Ordering::Relaxed));
    }

    /// Notes a leaf that has come to lie.
    pub(crate) fn add(&self, slot: usize) {
        self.0[slot / UNIT].fetch_or(1 << (slot % UNIT), Ordering::Relaxed);
    }

    /// Notes all of the unit that begins with a slot.
    pub(crate) fn set(&self, first: usize, bits: u64) {
        self.0[first / UNIT].store(bits, Ordering::Relaxed);
    }

    /// Bits of the unit that begins with a slot.
    pub(crate) fn of_unit(&self, first: usize) -> u64 {
        self.0[first / UNIT].load(Ordering::Relaxed)
    }
}
