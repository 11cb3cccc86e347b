// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Records of the segments of swaying trees: constants, columns of the state, and rows for the results of a pass.

crate::shared_constants! {
    /// Rows of four floats that the results of a pass take for a segment (see [`Work`]).
    pub const WORK_ROWS: u32 = 15;
    /// First row of the response of a segment's joint; the rows before hold what the segment passes on.
    pub const WORK_RESPONSE: u32 = 7;
    /// Column of joint rotations relative to rest.
    pub const BRANCH_TURN: u32 = 0;
    /// Column of joint rates.
    pub const BRANCH_RATE: u32 = 1;
    /// Column of joint positions.
    pub const BRANCH_BASE: u32 = 2;
    /// Column of orientations.
    pub const BRANCH_POSE: u32 = 3;
    /// Column of joint velocities.
    pub const BRANCH_VELOCITY: u32 = 4;
    /// Column of angular velocities.
    pub const BRANCH_SPIN: u32 = 5;
    /// Column of the air at the ends of limbs.
    pub const BRANCH_AIR: u32 = 6;
    /// Number of columns.
    pub const BRANCH_COLUMNS: u32 = 7;
    /// No segment.
    pub const NO_SEGMENT: u32 = 0xffff_ffff;
    /// Mark of a twig in place of its first child. A twig is a short segment without children that takes the wind at the end
    /// of its parent and has simpler equations than a limb, which is any other segment.
    pub const TWIG: u32 = 0xffff_fffe;
}

crate::shared_struct! {
    /// Constants of a segment.
    ///
    /// A segment's own frame has its origin at its lower joint and y along it. A joint's springs and rates are given in the
    /// frame of the segment above it.
    pub struct SegmentConstants, padding 8 {
        /// Rotation x, y, z, w at rest from the segment's frame to its parent's; to the world's for a trunk.
        pub rest: [f32; 4],
        /// Position of the joint in the parent's frame in m; in the world's for a trunk.
        pub offset: [f32; 3],
        /// Length in m.
        pub length: f32,
        /// Mass of the wood in kg.
        pub mass: f32,
        /// First moment of the wood about the joint in kg m.
        pub first_moment: f32,
        /// Moment of inertia of the wood about an axis across the segment through the joint in kg m².
        pub inertia_across: f32,
        /// Moment of inertia of the wood about the segment in kg m².
        pub inertia_along: f32,
        /// Mass in kg of one leaf of the state with all that it stands for.
        pub leaf_mass: f32,
        /// Drag force of the wood per squared wind speed across it, in N s²/m².
        pub wood_drag: f32,
        /// Drag force of one leaf per squared wind speed in light wind, in N s²/m².
        pub leaf_drag: f32,
        /// Inverse in s/m of the wind speed at which the leaves' drag is halved.
        pub leaf_yield: f32,
        /// Torque of the joint at rest in N m, which balances the weight of what grows above it.
        pub preload: [f32; 3],
        /// Damping torque per spring torque and rate, in s.
        pub damping: f32,
        /// Stiffness against bending in N m/rad.
        pub bending: f32,
        /// Stiffness against twisting in N m/rad.
        pub twisting: f32,
        /// Row of the parent; [`NO_SEGMENT`] for a trunk.
        pub parent: u32,
        /// Row of the first child; [`NO_SEGMENT`] if there is none, [`TWIG`] for a twig.
        pub first_child: u32,
        /// Row of the next child of the same parent, [`NO_SEGMENT`] for the last one. Twigs come before limbs.
        pub next_sibling: u32,
        /// Number of the tree.
        pub tree: u32,
    }
}

crate::shared_struct! {
    /// Level of a forest, which one dispatch steps.
    pub struct LevelBlock {
        /// Index of its first row in [`Forest::order`](super::Forest::order).
        pub first: u32,
        /// Number of rows.
        pub count: u32,
        /// Rows from one branch column to the next in their buffer.
        pub column_stride: u32,
        /// Zero; fills the block up to 16 bytes.
        pub unused: u32,
    }
}

crate::shared_struct! {
    /// Leaves of trees in a page, and the columns of the segments that carry them.
    pub struct CarryBlock {
        /// First slot of the page.
        pub first_slot: u32,
        /// Rows from one branch column to the next in their buffer.
        pub column_stride: u32,
        /// Zeros; fill the block up to 16 bytes.
        pub unused: [u32; 2],
    }
}

impl SegmentConstants {
    /// Returns true for a twig.
    pub fn is_twig(&self) -> bool {
        self.first_child == TWIG
    }
}

/// Children of row `row` of a batch whose first row is number `first` of the forest: twigs, then limbs. Rows are counted
/// from the batch's first.
#[inline(always)]
pub fn children_of(segments: &[SegmentConstants], first: u32, row: usize) -> impl Iterator<Item = usize> {
    let within = move |link: u32| (link < TWIG).then(|| (link - first) as usize);
    std::iter::successors(within(segments[row].first_child), move |child| {
        within(segments[*child].next_sibling)
    })
}

/// Results of the inward pass for one segment that the outward pass needs; [`crate::device::tree::sway::work`] packs them.
///
/// Limbs, twigs and the schemes that step joints one by one use the same rows for different records: at one typed record for
/// each, fewer segments would fit a binding of 128 MiB.
pub type Work = [[f32; 4]; WORK_ROWS as usize];

/// Bytes of memory traffic that a step needs for a segment: constants once, the joint and the body in both directions, the number
/// of leaves, and the air, which is sampled once for several steps and counted as read by every segment. The results of a thread's inward pass, and what its outward pass reads again, can stay in its cache.
pub const SEGMENT_BYTES_PER_STEP: usize =
    size_of::<SegmentConstants>() + (2 * BRANCH_AIR as usize + 1) * 16 + 4;
