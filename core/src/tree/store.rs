// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The state of all segments: a struct of arrays of 16-byte records, the same bytes on every backend.

use super::forest::first_three;
use super::record::BRANCH_COLUMNS;
use super::sway::Body;
use crate::world::mix;

/// All segments of a world, one column per quantity. Index = row, see [`Forest`](super::Forest).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Branches {
    /// Rotation of the joint relative to rest, in the frame of its segment: unit quaternion x, y, z, w.
    pub turn: Vec<[f32; 4]>,
    /// Rate of the joint in rad/s, in the frame of its segment; one unused.
    pub rate: Vec<[f32; 4]>,
    /// Place of the joint in m; one unused.
    pub base: Vec<[f32; 4]>,
    /// Orientation of the segment: unit quaternion x, y, z, w from its frame to the world's.
    pub pose: Vec<[f32; 4]>,
    /// Velocity of the joint in m/s; one unused.
    pub velocity: Vec<[f32; 4]>,
    /// Angular velocity of the segment in rad/s; one unused.
    pub spin: Vec<[f32; 4]>,
    /// Leaves that hang on the segment.
    pub bearing: Vec<u32>,
}

impl Branches {
    /// `count` segments, all zero.
    pub fn zeroed(count: usize) -> Self {
        let column = vec![[0.0; 4]; count];
        Self {
            turn: column.clone(),
            rate: column.clone(),
            base: column.clone(),
            pose: column.clone(),
            velocity: column.clone(),
            spin: column,
            bearing: vec![0; count],
        }
    }

    /// Number of segments.
    pub fn len(&self) -> usize {
        self.turn.len()
    }

    /// Whether there are no segments.
    pub fn is_empty(&self) -> bool {
        self.turn.is_empty()
    }

    /// The columns of four, in the order of `BRANCH_TURN`, `BRANCH_RATE` and so on.
    pub fn columns(&self) -> [&[[f32; 4]]; BRANCH_COLUMNS as usize] {
        [&self.turn, &self.rate, &self.base, &self.pose, &self.velocity, &self.spin]
    }

    /// The same, to be filled.
    pub fn columns_mut(&mut self) -> [&mut [[f32; 4]]; BRANCH_COLUMNS as usize] {
        [&mut self.turn, &mut self.rate, &mut self.base, &mut self.pose, &mut self.velocity, &mut self.spin]
    }

    /// Where a segment is and how it moves.
    pub fn body(&self, row: usize) -> Body {
        Body {
            base: first_three(self.base[row]),
            pose: self.pose[row].into(),
            velocity: first_three(self.velocity[row]),
            spin: first_three(self.spin[row]),
        }
    }

    /// A fingerprint of all columns, as [`World::state_hash`](crate::World::state_hash) adds it up.
    pub(crate) fn hash(&self) -> u64 {
        let rows = 0..self.len();
        rows.fold(0, |sum, row| {
            let words = self.columns().map(|column| bytemuck::cast::<_, [u64; 2]>(column[row]));
            let start = mix(u64::from(self.bearing[row]), !(row as u64));
            sum.wrapping_add(words.as_flattened().iter().fold(start, |hash, &word| mix(hash, word)))
        })
    }

    /// All columns, to be split among threads.
    pub fn as_mut(&mut self) -> BranchesMut<'_> {
        BranchesMut {
            turn: &mut self.turn,
            rate: &mut self.rate,
            base: &mut self.base,
            pose: &mut self.pose,
            velocity: &mut self.velocity,
            spin: &mut self.spin,
            bearing: &mut self.bearing,
        }
    }
}

/// A run of rows whose columns can be split.
#[derive(Debug)]
pub struct BranchesMut<'a> {
    /// Rotations of joints.
    pub turn: &'a mut [[f32; 4]],
    /// Rates of joints.
    pub rate: &'a mut [[f32; 4]],
    /// Places of joints.
    pub base: &'a mut [[f32; 4]],
    /// Orientations.
    pub pose: &'a mut [[f32; 4]],
    /// Velocities of joints.
    pub velocity: &'a mut [[f32; 4]],
    /// Angular velocities.
    pub spin: &'a mut [[f32; 4]],
    /// Leaves that hang on each.
    pub bearing: &'a mut [u32],
}

impl<'a> BranchesMut<'a> {
    /// The first `count` rows and the others.
    pub fn split_at(self, count: usize) -> (Self, Self) {
        let (turn, turn_rest) = self.turn.split_at_mut(count);
        let (rate, rate_rest) = self.rate.split_at_mut(count);
        let (base, base_rest) = self.base.split_at_mut(count);
        let (pose, pose_rest) = self.pose.split_at_mut(count);
        let (velocity, velocity_rest) = self.velocity.split_at_mut(count);
        let (spin, spin_rest) = self.spin.split_at_mut(count);
        let (bearing, bearing_rest) = self.bearing.split_at_mut(count);
        (
            Self { turn, rate, base, pose, velocity, spin, bearing },
            Self {
                turn: turn_rest,
                rate: rate_rest,
                base: base_rest,
                pose: pose_rest,
                velocity: velocity_rest,
                spin: spin_rest,
                bearing: bearing_rest,
            },
        )
    }
}
