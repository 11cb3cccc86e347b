// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The state of all segments: columns of records, the same bytes on every backend.

use super::forest::first_three;
use super::record::BRANCH_COLUMNS;
use crate::device::tree::sway::Body;

crate::columns! {
    /// All segments of a world. Index = row, see [`Forest`](super::Forest).
    ///
    /// The columns of four stand in the order of `BRANCH_TURN`, `BRANCH_RATE` and so on.
    pub struct Branches("segments") {
        /// Rotation of the joint relative to rest, in the frame of its segment: unit quaternion x, y, z, w.
        pub turn: [f32; 4],
        /// Rate of the joint in rad/s, in the frame of its segment; one unused.
        pub rate: [f32; 4],
        /// Place of the joint in m; one unused.
        pub base: [f32; 4],
        /// Orientation of the segment: unit quaternion x, y, z, w from its frame to the world's.
        pub pose: [f32; 4],
        /// Velocity of the joint in m/s; one unused.
        pub velocity: [f32; 4],
        /// Angular velocity of the segment in rad/s; one unused.
        pub spin: [f32; 4],
        /// Velocity of the air in m/s at the end of a limb, sampled once for an interval of a few steps, and one unused. Twigs feel the
        /// air of the limb that they grow from.
        pub air: [f32; 4],
        /// Leaves that hang on the segment.
        pub leaf_count: u32,
    }
    /// The records of one segment.
    row BranchMut;
    /// A run of segments whose columns can be split.
    run BranchesMut;
}

const _: () =
    assert!(Branches::COLUMNS.len() == BRANCH_COLUMNS as usize + 1, "seven columns of four, and the leaves");

impl Branches {
    /// Position, orientation and velocities of a segment.
    pub fn body(&self, row: usize) -> Body {
        Body {
            base: first_three(self.base[row]),
            pose: self.pose[row].into(),
            velocity: first_three(self.velocity[row]),
            spin: first_three(self.spin[row]),
        }
    }
}
