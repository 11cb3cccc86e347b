// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Units of slots to which nothing happens for a while, so that steps pass them by. Derived from the state, not part of it.

use std::sync::atomic::{AtomicU32, Ordering};

/// Slots of a unit.
pub(crate) const UNIT: usize = 64;

/// Steps before which nothing happens to the leaves of a unit: none falls, slides or lies down, and none has an event. 0 where
/// that is not known.
#[derive(Debug)]
pub(crate) struct QuietUnits(Vec<AtomicU32>);

impl QuietUnits {
    /// Units for so many slots, nothing known of any.
    pub(crate) fn new(slots: usize) -> Self {
        Self((0..slots.div_ceil(UNIT)).map(|_| AtomicU32::new(0)).collect())
    }

    /// Forgets all that is known, after the state or the scene has changed.
    pub(crate) fn forget(&self) {
        self.0.iter().for_each(|until| until.store(0, Ordering::Relaxed));
    }

    /// Forgets about the unit of a slot.
    #[inline(always)]
    pub(crate) fn wake(&self, slot: u32) {
        self.0[slot as usize / UNIT].store(0, Ordering::Relaxed);
    }

    /// Units of the slots before one that begins a unit or is behind the last, and of those from it on.
    pub(crate) fn split_at(&self, slot: usize) -> (&[AtomicU32], &[AtomicU32]) {
        self.0.split_at(slot.div_ceil(UNIT))
    }
}

/// Returns true if nothing happens to a unit in a step.
#[inline(always)]
pub(crate) fn is_quiet(until: &AtomicU32, step: u32) -> bool {
    step < until.load(Ordering::Relaxed)
}

/// Returns true if nothing happens to any of these units up to a step.
pub(crate) fn are_quiet(units: &[AtomicU32], last: u32) -> bool {
    units.iter().all(|until| is_quiet(until, last))
}

/// Notes that nothing happens to a unit before a step.
#[inline(always)]
pub(crate) fn set_quiet(until: &AtomicU32, step: u32) {
    until.store(step, Ordering::Relaxed);
}
