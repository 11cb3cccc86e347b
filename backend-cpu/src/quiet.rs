// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves to which nothing happens for a while, so that steps pass them by. Derived from the state, not part of it.

use std::sync::atomic::{AtomicU32, AtomicU64, Ordering};

/// Slots of a unit.
pub(crate) const UNIT: usize = 64;

/// All slots of a unit.
const ALL: u64 = u64::MAX;

/// A unit of slots.
#[derive(Debug, Default)]
pub(crate) struct QuietUnit {
    /// A bit for each leaf that may be on its way: it falls, slides or lies down.
    stirring: AtomicU64,
    /// Step before which no other leaf of the unit has an event. 0 where that is not known, nor the bits.
    until: AtomicU32,
}

impl QuietUnit {
    /// Leaves to which something may happen in a step, a bit for each.
    #[inline(always)]
    pub(crate) fn stirring(&self, step: u32) -> u64 {
        if step < self.until.load(Ordering::Relaxed) { self.stirring.load(Ordering::Relaxed) } else { ALL }
    }

    /// Step before which no leaf without a bit has an event.
    #[inline(always)]
    pub(crate) fn until(&self) -> u32 {
        self.until.load(Ordering::Relaxed)
    }

    /// Notes which leaves are on their way, and the step before which no other has an event.
    #[inline(always)]
    pub(crate) fn set(&self, stirring: u64, until: u32) {
        self.stirring.store(stirring, Ordering::Relaxed);
        self.until.store(until, Ordering::Relaxed);
    }
}

/// All units.
#[derive(Debug)]
pub(crate) struct QuietUnits {
    /// Slot that the first unit begins with.
    first: u32,
    units: Vec<QuietUnit>,
    /// Step before which nothing happens to any leaf; 0 where that is not known.
    all: AtomicU32,
}

impl QuietUnits {
    /// Units for so many slots from `first` on, nothing known of any.
    pub(crate) fn new(first: u32, slots: usize) -> Self {
        const { assert!(UNIT == u64::BITS as usize, "a bit for each leaf of a unit") };
        let units = (0..slots.div_ceil(UNIT)).map(|_| QuietUnit::default()).collect();
        Self { first, units, all: AtomicU32::new(0) }
    }

    /// Forgets all that is known, after the state or the scene has changed.
    pub(crate) fn forget(&self) {
        self.units.iter().for_each(|unit| unit.set(0, 0));
        self.all.store(0, Ordering::Relaxed);
    }

    /// Notes that something may happen to the leaf of a slot.
    #[inline(always)]
    pub(crate) fn wake(&self, slot: u32) {
        let slot = (slot - self.first) as usize;
        self.units[slot / UNIT].stirring.fetch_or(1 << (slot % UNIT), Ordering::Relaxed);
        self.all.store(0, Ordering::Relaxed);
    }

    /// Returns true if nothing happens to any leaf up to a step.
    pub(crate) fn are_all_quiet(&self, last: u32) -> bool {
        if last >= self.all.load(Ordering::Relaxed) && are_quiet(&self.units, last) {
            let earliest = self.units.iter().map(QuietUnit::until).min();
            self.all.store(earliest.unwrap_or(0), Ordering::Relaxed);
        }
        last < self.all.load(Ordering::Relaxed)
    }

    /// All units.
    pub(crate) fn units(&self) -> &[QuietUnit] {
        &self.units
    }

    /// Units of the rows before one that begins a unit or is behind the last, and of those from it on.
    pub(crate) fn split_at(&self, row: usize) -> (&[QuietUnit], &[QuietUnit]) {
        self.units.split_at(row.div_ceil(UNIT))
    }
}

/// Returns true if nothing happens to any of these units up to a step.
pub(crate) fn are_quiet(units: &[QuietUnit], last: u32) -> bool {
    units.iter().all(|unit| unit.stirring(last) == 0)
}

/// Places of the bits that are set, the lowest first.
#[inline(always)]
pub(crate) fn places_of(mut bits: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let place = (bits != 0).then(|| bits.trailing_zeros() as usize);
        bits &= bits.wrapping_sub(1);
        place
    })
}

/// Slots of those units, which have so many slots together, to which something may happen in a step.
#[inline(always)]
pub(crate) fn stirring_slots(units: &[QuietUnit], step: u32, slots: usize) -> impl Iterator<Item = usize> {
    let of = move |(number, unit): (usize, &QuietUnit)| {
        places_of(unit.stirring(step)).map(move |place| number * UNIT + place)
    };
    units.iter().enumerate().flat_map(of).take_while(move |&slot| slot < slots)
}
