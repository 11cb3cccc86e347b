// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The leaf store: a struct of arrays of records, the same bytes on every backend.

use crate::device::leaf::record::{
    Attitude, Drift, Identity, Place, STATE_ATTACHED, STATE_DORMANT, STATE_FALLING, Schedule, leaf_state,
    lies, phase_is_float, spin_is_float,
};
use crate::store::{Column, Field, FieldKind};

/// State of a leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LeafState {
    /// Not let go yet.
    Dormant,
    /// Riding a branch.
    Attached,
    /// In the air.
    Falling,
    /// On the ground.
    Resting,
}

impl LeafState {
    /// Name in tables: `dormant`, `attached`, `falling` or `resting`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Dormant => "dormant",
            Self::Attached => "attached",
            Self::Falling => "falling",
            Self::Resting => "resting",
        }
    }
}

impl Place {
    /// State of the leaf.
    pub fn state(&self) -> LeafState {
        match leaf_state(self.bits) {
            STATE_DORMANT => LeafState::Dormant,
            STATE_ATTACHED => LeafState::Attached,
            STATE_FALLING => LeafState::Falling,
            _ => LeafState::Resting,
        }
    }
}

crate::columns! {
    /// All leaves of a world. Index = slot.
    pub struct Leaves("leaves") {
        /// Position and flags.
        pub place: Place,
        /// Residual velocity and phase.
        pub drift: Drift,
        /// Orientation.
        pub attitude: Attitude,
        /// Next event and motion parameters.
        pub schedule: Schedule,
        /// Velocity of the air that the leaf meets while it falls, packed by
        /// [`wind_pack`](crate::device::wind::packed::wind_pack); of others it means nothing. Hot, but written once in an interval.
        pub air: [u32; 2],
        /// Identity.
        pub identity: Identity,
    }
    /// The records of one leaf.
    row LeafMut;
    /// A run of leaves whose columns can be split.
    run LeavesMut;
    kinds leaf_kind;
}

/// Bytes of one leaf, over all columns.
pub const LEAF_BYTES: usize = Leaves::ROW_BYTES;

/// Bytes that one step of one leaf moves between two events: place and drift are read and written, attitude is
/// written, schedule and air are read. Writing air, identity, and an attitude that blends, come in few steps and do not
/// count.
pub const HOT_BYTES_PER_STEP: usize = 2 * (size_of::<Place>() + size_of::<Drift>())
    + size_of::<Attitude>()
    + size_of::<Schedule>()
    + size_of::<[u32; 2]>();

/// Meaning of the words of a field of a leaf: those reused by leaves on twigs and by bodies hold floats there.
fn leaf_kind(leaves: &Leaves, slot: usize, column: &Column, field: &Field) -> FieldKind {
    let place = &leaves.place[slot];
    let is_float = match field.name {
        "phase" => phase_is_float(place.bits),
        "rate" => spin_is_float(place.bits) || lies(place.bits),
        "heading" => spin_is_float(place.bits),
        // The high bits of both words are those of floats.
        _ => field.kind == FieldKind::Float || column.name == "air",
    };
    if is_float { FieldKind::Float } else { FieldKind::Integer }
}
