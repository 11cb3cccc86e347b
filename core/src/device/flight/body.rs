// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/flight/body.wgsl
//!
//! A leaf as a body under the air's forces: its species' block, scaled to its size and made asymmetric.
//!
//! Everything is per unit of mass, and turning is expressed as spin times the leaf's size ratio. So most numbers are the
//! same for leaves of all sizes.

use crate::arith::lane::{Real, Word};
use crate::arith::math::reciprocal;
use crate::arith::vector::Vec3;
use crate::context::Context;
use crate::device::leaf::record::{asymmetry, leaf_species, size_ratio};
use crate::flight::block::BODY_ROWS;
use crate::flight::coefficients::DAMPING_VISCOUS_M2_S;

/// A leaf as a body, or eight of them. Turning speeds are spins times `size_ratio`.
#[derive(Clone, Copy, Debug)]
pub struct LeafBody<R: Real = f32> {
    /// Size relative to the species'.
    pub size_ratio: R,
    /// Its inverse.
    pub inv_size_ratio: R,
    /// Density of the air over mass per area in 1/m.
    pub air_per_m: R,
    /// Added mass over mass, per size ratio.
    pub added_mass: R,
    /// Density of the air over mass per area times the half axis along.
    pub air_along: R,
    /// Density of the air over mass per area times the half axis across.
    pub air_across: R,
    /// Half axis along in m.
    pub half_along_m: R,
    /// Half axis across in m.
    pub half_across_m: R,
    /// Geometric mean of the half axes in m.
    pub half_mean_m: R,
    /// Torque of twist in m.
    pub twist_m: R,
    /// Torque about the length in m of a flow along it: the twist that its kind has makes the blade a screw.
    pub screw_m: R,
    /// Damping of turning by the air's viscosity, as a speed in m/s.
    pub viscous_m_s: R,
    /// Slope of the lift of slip across relative to a disc's.
    pub lift_slope_across: R,
    /// Slope of the lift of slip along relative to a disc's.
    pub lift_slope_along: R,
    /// Damping of pitching.
    pub pitch_damping: R,
    /// Drag edge-on.
    pub edge_drag: R,
    /// Force over mass, per acceleration that it had without it, with which the air resists being pushed along the normal.
    pub resistance: R,
    /// Inverse inertia over mass about x, y, z in 1/m².
    pub inv_inertia: Vec3<R>,
    /// Gyroscopic coupling: rate of turning about each axis per product of the turning about the two others, times the
    /// inverse size ratio.
    pub gyration: Vec3<R>,
    /// Centroid relative to the centre of mass, for a leaf of nominal size, in m.
    pub centroid: Vec3<R>,
}

/// Row of four numbers of the body of a species.
#[inline(always)]
pub fn body_row<W: Word>(cx: &Context<'_>, bits: W, row: u32) -> [W::Real; 4] {
    let first = leaf_species(bits).times(bits.all(BODY_ROWS));
    first.plus(first.all(row)).look_up(bytemuck::cast_slice(&cx.scene.bodies))
}

/// The body of a leaf with these bits and this size word.
#[inline(always)]
pub fn body_of<W: Word>(cx: &Context<'_>, bits: W, size: W) -> LeafBody<W::Real> {
    let [air_per_m, added_mass, air_along, air_across] = body_row(cx, bits, 0);
    let [half_along_m, half_across_m, half_mean_m, twist_m] = body_row(cx, bits, 1);
    let [lift_slope_across, lift_slope_along, air_inertia_x, air_inertia_z] = body_row(cx, bits, 2);
    let [inertia_x, inertia_y, inertia_z, pitch_damping] = body_row(cx, bits, 3);
    let [centroid_x, centroid_y, centroid_z, edge_drag] = body_row(cx, bits, 4);
    let [spread_x, spread_y, spread_z, twist_spread] = body_row(cx, bits, 5);

    let ratio = size_ratio(size);
    let inv_size_ratio = reciprocal(ratio);
    let x = inertia_x + air_inertia_x * ratio;
    let y = inertia_y;
    let z = inertia_z + air_inertia_z * ratio;
    let inv_inertia = Vec3::new(reciprocal(x), reciprocal(y), reciprocal(z));
    let gyration = Vec3::new(
        ((y - z) * inv_inertia.x) * inv_size_ratio,
        ((z - x) * inv_inertia.y) * inv_size_ratio,
        ((x - y) * inv_inertia.z) * inv_size_ratio,
    );
    let centroid = Vec3::new(
        centroid_x + asymmetry(size, 0) * spread_x,
        centroid_y + asymmetry(size, 1) * spread_y,
        centroid_z + asymmetry(size, 2) * spread_z,
    );
    let narrow = half_across_m * reciprocal(half_along_m);
    let added = added_mass * ratio;
    let swing = (centroid.x * centroid.x) * inv_inertia.z + (centroid.z * centroid.z) * inv_inertia.x;
    LeafBody {
        size_ratio: ratio,
        inv_size_ratio,
        air_per_m,
        added_mass,
        air_along,
        air_across,
        half_along_m,
        half_across_m,
        half_mean_m,
        twist_m: twist_m + asymmetry(size, 3) * twist_spread,
        screw_m: twist_m * (narrow * narrow),
        viscous_m_s: (reciprocal(half_mean_m) * inv_size_ratio) * DAMPING_VISCOUS_M2_S,
        lift_slope_across,
        lift_slope_along,
        pitch_damping,
        edge_drag,
        resistance: added * reciprocal((added + added * swing) + 1.0),
        inv_inertia,
        gyration,
        centroid,
    }
}
