// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/wind/turbulence.wgsl
//!
//! Turbulence: a periodic box of velocities, interpolated linearly in each direction.

use crate::context::Context;
use crate::kernel::vector::{Vec3, vec3_lerp};

crate::shared_constants! {
    /// Cells of the box along the wind, a power of two.
    pub const TURBULENCE_X: u32 = 64;
    /// Cells upwards, a power of two.
    pub const TURBULENCE_Y: u32 = 32;
    /// Cells across the wind, a power of two.
    pub const TURBULENCE_Z: u32 = 32;
}

#[inline(always)]
fn turbulence_node(cx: &Context<'_>, ix: u32, iy: u32, iz: u32) -> Vec3 {
    let x = ix & (TURBULENCE_X - 1);
    let y = iy & (TURBULENCE_Y - 1);
    let z = iz & (TURBULENCE_Z - 1);
    let node =
        cx.wind[(cx.environment.wind.tables.0[2] + ((z * TURBULENCE_Y + y) * TURBULENCE_X + x)) as usize].0;
    Vec3::new(node[0], node[1], node[2])
}

/// Turbulent velocity of unit variance at a place in the wind's frame (along, up, across in metres).
#[expect(clippy::cast_possible_truncation, reason = "a whole number in range")]
#[inline(always)]
pub fn wind_turbulence(cx: &Context<'_>, place: Vec3) -> Vec3 {
    let cells = cx.environment.wind.cells.0;
    let x = place.x * cells[0] - cx.step.offsets.0[1];
    let y = place.y * cells[1];
    let z = place.z * cells[2];
    let kx = x.floor();
    let ky = y.floor();
    let kz = z.floor();
    let ix = (kx as i32) as u32;
    let iy = (ky as i32) as u32;
    let iz = (kz as i32) as u32;
    let tx = x - kx;
    let ty = y - ky;
    let tz = z - kz;
    let ix1 = ix.wrapping_add(1);
    let iy1 = iy.wrapping_add(1);
    let iz1 = iz.wrapping_add(1);
    let a = vec3_lerp(turbulence_node(cx, ix, iy, iz), turbulence_node(cx, ix1, iy, iz), tx);
    let b = vec3_lerp(turbulence_node(cx, ix, iy1, iz), turbulence_node(cx, ix1, iy1, iz), tx);
    let c = vec3_lerp(turbulence_node(cx, ix, iy, iz1), turbulence_node(cx, ix1, iy, iz1), tx);
    let d = vec3_lerp(turbulence_node(cx, ix, iy1, iz1), turbulence_node(cx, ix1, iy1, iz1), tx);
    vec3_lerp(vec3_lerp(a, b, ty), vec3_lerp(c, d, ty), tz)
}
