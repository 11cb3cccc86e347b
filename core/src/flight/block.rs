// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A species as a body, as kernels read it.

crate::shared_constants! {
    /// Rows of four numbers in a body's block.
    pub const BODY_ROWS: u32 = 8;
    /// Row of the loads on a step.
    pub const BODY_LOAD_ROW: u32 = 6;
    /// Row that ends with what a lying leaf takes up.
    pub const BODY_LITTER_ROW: u32 = 7;
    /// Held any way round.
    pub const HOLD_RANDOM: u32 = 0;
    /// Held at the angle that the block says.
    pub const HOLD_TILTED: u32 = 1;
}

crate::shared_struct! {
    /// A species as a body, for a leaf of nominal size, per unit of mass. x is across the leaf, y its normal, z along it.
    pub struct BodyBlock {
        /// Density of the air over mass per area in 1/m.
        pub air_per_m: f32,
        /// Added mass over mass.
        pub added_mass: f32,
        /// Density of the air over mass per area times the half axis along.
        pub air_along: f32,
        /// Density of the air over mass per area times the half axis across.
        pub air_across: f32,
        /// Half axis along in m.
        pub half_along_m: f32,
        /// Half axis across in m.
        pub half_across_m: f32,
        /// Geometric mean of the half axes in m.
        pub half_mean_m: f32,
        /// Torque of twist in m.
        pub twist_m: f32,
        /// Slope of the lift of slip across relative to a disc's.
        pub lift_slope_across: f32,
        /// Slope of the lift of slip along relative to a disc's.
        pub lift_slope_along: f32,
        /// Inertia of the air over mass about x in m², which grows with the size.
        pub air_inertia_x_m2: f32,
        /// Inertia of the air over mass about z in m², which grows with the size.
        pub air_inertia_z_m2: f32,
        /// Inertia over mass about x, y, z in m².
        pub inertia_m2: [f32; 3],
        /// Damping of pitching.
        pub pitch_damping: f32,
        /// Centroid relative to the centre of mass in m.
        pub centroid_m: [f32; 3],
        /// Drag edge-on.
        pub edge_drag: f32,
        /// Half widths of the spread of the centroid in m.
        pub centroid_spread_m: [f32; 3],
        /// Half width of the spread of the torque of twist in m.
        pub twist_spread_m: f32,
        /// Load on a step per speed in s/m.
        pub load_per_speed: f32,
        /// Load on a step per spin in s.
        pub load_per_spin: f32,
        /// Ticks after which a fall without an event counts as idle.
        pub idle_timeout_ticks: f32,
        /// Pose before a release: [`HOLD_RANDOM`] or [`HOLD_TILTED`].
        pub hold_kind: u32,
        /// Tilt of that pose in 2^-16 turns.
        pub hold_tilt: u32,
        /// Half width of the spread of the tilt in 2^-16 turns.
        pub hold_spread: u32,
        /// Thickness in m by which a layer of such leaves raises litter.
        pub layer_m: f32,
        /// Volume of a lying leaf of nominal size, in units of height over a cell of litter.
        pub litter_units: f32,
    }
}

const _: () = assert!(
    core::mem::offset_of!(BodyBlock, load_per_speed) == BODY_LOAD_ROW as usize * 16,
    "the loads begin a row"
);
const _: () = assert!(
    core::mem::offset_of!(BodyBlock, layer_m) == BODY_LITTER_ROW as usize * 16 + 8,
    "layer and volume end a row"
);
const _: () = assert!(size_of::<BodyBlock>() == BODY_ROWS as usize * 16, "rows of four numbers");
