// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Units of slots to which nothing happens for a while, so that steps pass them by. Derived from the state, not part of it.

use std::sync::atomic::{AtomicU32, Ordering};

/// Slots of a unit.
pub(crate) const UNIT: usize = 64;

/// Steps before which nothing happens to the leaves of a unit: none falls, slides or lies down, and none has an event. 0 where
/// that is not known.
#[derive(Debug)]
pub(crate) struct QuietUnits {
    units: Vec<AtomicU32>,
    /// The same of all units together.
    all: AtomicU32,
}

impl QuietUnits {
    /// Units for so many slots, nothing known of any.
    pub(crate) fn new(slots: usize) -> Self {
        let units = (0..slots.div_ceil(UNIT)).map(|_| AtomicU32::new(0)).collect();
        Self { units, all: AtomicU32::new(0) }
    }

    /// Forgets all that is known, after the state or the scene has changed.
    pub(crate) fn forget(&self) {
        self.units.iter().chain([&self.all]).for_each(|until| set_quiet(until, 0));
    }

    /// Forgets about the unit of a slot.
    #[inline(always)]
    pub(crate) fn wake(&self, slot: u32) {
        set_quiet(&self.units[slot as usize / UNIT], 0);
        set_quiet(&self.all, 0);
    }

    /// Returns true if nothing happens to any leaf up to a step.
    pub(crate) fn are_all_quiet(&self, last: u32) -> bool {
        if !is_quiet(&self.all, last) && are_quiet(&self.units, last) {
            let earliest = self.units.iter().map(|until| until.load(Ordering::Relaxed)).min();
            set_quiet(&self.all, earliest.unwrap_or(0));
        }
        is_quiet(&self.all, last)
    }

    /// All units.
    pub(crate) fn units(&self) -> &[AtomicU32] {
        &self.units
    }

    /// Units of the slots before one that begins a unit or is behind the last, and of those from it on.
    pub(crate) fn split_at(&self, slot: usize) -> (&[AtomicU32], &[AtomicU32]) {
        self.units.split_at(slot.div_ceil(UNIT))
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

/// Slots of those units, which have so many slots together, to which something may happen in a step.
#[inline(always)]
pub(crate) fn stirring_slots(units: &[AtomicU32], step: u32, slots: usize) -> impl Iterator<Item = usize> {
    let stirring = units.iter().enumerate().filter(move |(_, until)| !is_quiet(until, step));
    stirring.flat_map(move |(unit, _)| unit * UNIT..slots.min((unit + 1) * UNIT))
}
