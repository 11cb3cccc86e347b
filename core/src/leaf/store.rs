// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The leaf store: a struct of arrays of 16-byte records, the same bytes on every backend.

use super::record::{
    Attitude, Course, Drift, Identity, Place, STATE_ATTACHED, STATE_DORMANT, STATE_FALLING, STATE_MASK,
};

/// What a leaf is doing.
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

impl Place {
    /// What the leaf is doing.
    pub fn state(&self) -> LeafState {
        match self.bits & STATE_MASK {
            STATE_DORMANT => LeafState::Dormant,
            STATE_ATTACHED => LeafState::Attached,
            STATE_FALLING => LeafState::Falling,
            _ => LeafState::Resting,
        }
    }
}

/// All leaves of a world, one column per record. Index = slot.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Leaves {
    /// Where and what.
    pub place: Vec<Place>,
    /// Carried how.
    pub drift: Vec<Drift>,
    /// Turned how.
    pub attitude: Vec<Attitude>,
    /// Up to what.
    pub course: Vec<Course>,
    /// Who.
    pub identity: Vec<Identity>,
}

/// Bytes of one leaf, over all columns.
pub const LEAF_BYTES: usize = size_of::<Place>()
    + size_of::<Drift>()
    + size_of::<Attitude>()
    + size_of::<Course>()
    + size_of::<Identity>();

/// Bytes that one step of one leaf moves between two events: place and drift are read and written, attitude is
/// written, course is read. Identity, and an attitude that blends, are touched in few steps and do not count.
pub const HOT_BYTES_PER_STEP: usize =
    2 * (size_of::<Place>() + size_of::<Drift>()) + size_of::<Attitude>() + size_of::<Course>();

impl Leaves {
    /// `count` dormant leaves, all zero.
    pub fn zeroed(count: usize) -> Self {
        Self {
            place: vec![Place::default(); count],
            drift: vec![Drift::default(); count],
            attitude: vec![Attitude::default(); count],
            course: vec![Course::default(); count],
            identity: vec![Identity::default(); count],
        }
    }

    /// Number of slots.
    pub fn len(&self) -> usize {
        self.place.len()
    }

    /// Whether there are no slots.
    pub fn is_empty(&self) -> bool {
        self.place.is_empty()
    }

    /// All columns, to be split among threads.
    pub fn as_mut(&mut self) -> LeavesMut<'_> {
        LeavesMut {
            place: &mut self.place,
            drift: &mut self.drift,
            attitude: &mut self.attitude,
            course: &mut self.course,
            identity: &mut self.identity,
        }
    }

    /// The columns as bytes, in the order of the struct.
    pub fn columns(&self) -> [&[u8]; 5] {
        [
            bytemuck::cast_slice(&self.place),
            bytemuck::cast_slice(&self.drift),
            bytemuck::cast_slice(&self.attitude),
            bytemuck::cast_slice(&self.course),
            bytemuck::cast_slice(&self.identity),
        ]
    }

    /// The columns as bytes to be filled, in the order of the struct.
    pub fn columns_mut(&mut self) -> [&mut [u8]; 5] {
        [
            bytemuck::cast_slice_mut(&mut self.place),
            bytemuck::cast_slice_mut(&mut self.drift),
            bytemuck::cast_slice_mut(&mut self.attitude),
            bytemuck::cast_slice_mut(&mut self.course),
            bytemuck::cast_slice_mut(&mut self.identity),
        ]
    }
}

/// The records of one leaf.
#[derive(Debug)]
pub struct LeafMut<'a> {
    /// Where and what.
    pub place: &'a mut Place,
    /// Carried how.
    pub drift: &'a mut Drift,
    /// Turned how.
    pub attitude: &'a mut Attitude,
    /// Up to what.
    pub course: &'a mut Course,
    /// Who.
    pub identity: &'a mut Identity,
}

/// A run of leaves whose columns can be split.
#[derive(Debug)]
pub struct LeavesMut<'a> {
    /// Where and what.
    pub place: &'a mut [Place],
    /// Carried how.
    pub drift: &'a mut [Drift],
    /// Turned how.
    pub attitude: &'a mut [Attitude],
    /// Up to what.
    pub course: &'a mut [Course],
    /// Who.
    pub identity: &'a mut [Identity],
}

impl<'a> LeavesMut<'a> {
    /// Number of leaves.
    pub fn len(&self) -> usize {
        self.place.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.place.is_empty()
    }

    /// The first `count` leaves and the others.
    pub fn split_at(self, count: usize) -> (Self, Self) {
        let (place, place_rest) = self.place.split_at_mut(count);
        let (drift, drift_rest) = self.drift.split_at_mut(count);
        let (attitude, attitude_rest) = self.attitude.split_at_mut(count);
        let (course, course_rest) = self.course.split_at_mut(count);
        let (identity, identity_rest) = self.identity.split_at_mut(count);
        (
            Self { place, drift, attitude, course, identity },
            Self {
                place: place_rest,
                drift: drift_rest,
                attitude: attitude_rest,
                course: course_rest,
                identity: identity_rest,
            },
        )
    }

    /// One leaf's records.
    pub fn leaf_mut(&mut self, slot: usize) -> LeafMut<'_> {
        LeafMut {
            place: &mut self.place[slot],
            drift: &mut self.drift[slot],
            attitude: &mut self.attitude[slot],
            course: &mut self.course[slot],
            identity: &mut self.identity[slot],
        }
    }

    /// Leaf after leaf.
    pub fn iter_mut(&mut self) -> impl Iterator<Item = LeafMut<'_>> {
        let records = self.place.iter_mut().zip(self.drift.iter_mut()).zip(self.attitude.iter_mut());
        records.zip(self.course.iter_mut()).zip(self.identity.iter_mut()).map(
            |((((place, drift), attitude), course), identity)| LeafMut {
                place,
                drift,
                attitude,
                course,
                identity,
            },
        )
    }
}
