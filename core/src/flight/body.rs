// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/flight/body.wgsl
//!
//! What a leaf's shape and mass make of the air's forces: a species' block, scaled to a leaf and bent by its quirks.
//!
//! Everything is per unit of mass, and turning is told as a speed: spin times the leaf's size ratio. So most numbers are
//! the same for leaves of all sizes.

use super::block::BODY_ROWS;
use crate::context::Context;
use crate::kernel::lane::{Real, Word};
use crate::kernel::math::reciprocal;
use crate::kernel::vector::Vec3;
use crate::leaf::record::{
    HALF_MASK, QUIRK_MASK, QUIRK_MIDDLE, QUIRK_SHIFT, QUIRK_UNIT, SIZE_UNIT, SPECIES_MASK, SPECIES_SHIFT,
};

/// A leaf as a body, or eight of them. Turning speeds are spins times `size`.
#[derive(Clone, Copy, Debug)]
pub struct Body<R: Real = f32> {
    /// Size relative to the species', and its inverse.
    pub size: [R; 2],
    /// Density of the air over mass per area in 1/m; added mass over mass per size; the first times the half axes along
    /// and across.
    pub air: [R; 4],
    /// Half axes along and across and their geometric mean in m; torque of twist in m.
    pub reach: [R; 4],
    /// Slope of the lift of slip across and along relative to a disc's.
    pub slope: [R; 2],
    /// Damping of pitching; drag edge-on.
    pub own: [R; 2],
    /// Force over mass, per acceleration that it had without it, with which the air resists being pushed along the normal.
    pub resistance: R,
    /// Inverse inertia over mass about x, y, z in 1/m².
    pub ease: Vec3<R>,
    /// What turning about two axes makes of turning about the third, times the inverse size.
    pub gyration: Vec3<R>,
    /// Middle of the area from the centre of mass, for a leaf of nominal size, in m.
    pub arm: Vec3<R>,
}

/// One of four irregularities, -1 to 1.
#[inline(always)]
pub fn body_quirk<W: Word>(size: W, number: u32) -> W::Real {
    (((size >> (QUIRK_SHIFT + 4 * number)) & QUIRK_MASK).to_real() - QUIRK_MIDDLE) * QUIRK_UNIT
}

/// The body of a leaf with these bits and this size word.
#[inline(always)]
pub fn body_of<W: Word>(cx: &Context<'_>, bits: W, size: W) -> Body<W::Real> {
    let first = ((bits >> SPECIES_SHIFT) & SPECIES_MASK).times(bits.all(BODY_ROWS));
    let rows: &[[f32; 4]] = bytemuck::cast_slice(&cx.environment.bodies);
    let air = first.look_up(rows);
    let reach = first.plus(first.all(1)).look_up(rows);
    let slope = first.plus(first.all(2)).look_up(rows);
    let inertia = first.plus(first.all(3)).look_up(rows);
    let middle = first.plus(first.all(4)).look_up(rows);
    let quirks = first.plus(first.all(5)).look_up(rows);

    let ratio = (size & HALF_MASK).to_real() * SIZE_UNIT;
    let smallness = reciprocal(ratio);
    let x = inertia[0] + slope[2] * ratio;
    let y = inertia[1];
    let z = inertia[2] + slope[3] * ratio;
    let ease = Vec3::new(reciprocal(x), reciprocal(y), reciprocal(z));
    let gyration = Vec3::new(
        ((y - z) * ease.x) * smallness,
        ((z - x) * ease.y) * smallness,
        ((x - y) * ease.z) * smallness,
    );
    let arm = Vec3::new(
        middle[0] + body_quirk(size, 0) * quirks[0],
        middle[1] + body_quirk(size, 1) * quirks[1],
        middle[2] + body_quirk(size, 2) * quirks[2],
    );
    let added = air[1] * ratio;
    let swing = (arm.x * arm.x) * ease.z + (arm.z * arm.z) * ease.x;
    Body {
        size: [ratio, smallness],
        air,
        reach: [reach[0], reach[1], reach[2], reach[3] + body_quirk(size, 3) * quirks[3]],
        slope: [slope[0], slope[1]],
        own: [inertia[3], middle[3]],
        resistance: added * reciprocal((added + added * swing) + 1.0),
        ease,
        gyration,
        arm,
    }
}
