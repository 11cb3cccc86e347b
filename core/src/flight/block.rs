// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A species as a body, as kernels read it.

use crate::layout::{Float4, Uint4};

crate::shared_constants! {
    /// Rows of four numbers in a body's block.
    pub const BODY_ROWS: u32 = 8;
    /// Held any way round.
    pub const HOLD_RANDOM: u32 = 0;
    /// Held at the angle that the block says.
    pub const HOLD_TILTED: u32 = 1;
}

crate::shared_struct! {
    /// A species as a body, for a leaf of nominal size, per unit of mass. x is across the leaf, y its normal, z along it.
    pub struct BodyBlock {
        /// Density of the air over mass per area in 1/m; added mass over mass; the first times the half axes along and
        /// across.
        pub air: Float4,
        /// Half axis along, half axis across, their geometric mean in m; torque of twist in m.
        pub reach: Float4,
        /// Slope of the lift of slip across and along relative to a disc's; inertia of the air over mass about x and z in
        /// m², for it grows with the cube of the size.
        pub slope: Float4,
        /// Inertia over mass about x, y, z in m²; damping of pitching.
        pub inertia: Float4,
        /// Middle of the area from the centre of mass in m; drag edge-on.
        pub arm: Float4,
        /// Half widths of the spread of that place and of the torque of twist.
        pub quirks: Float4,
        /// Load on a step per speed in s/m and per spin in s; ticks in which something happens to it if anything does;
        /// unused.
        pub load: Float4,
        /// How it is held before a release: kind, tilt and half width of its spread in 2^-16 turns; unused.
        pub hold: Uint4,
    }
}
