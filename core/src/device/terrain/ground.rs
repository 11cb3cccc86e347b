// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/terrain/ground.wgsl
//!
//! The ground as kernels sample it: level, or the hills' table interpolated linearly in each direction; and water on it.

use crate::arith::lane::{Mask, Real, Word};
use crate::arith::math::{inverse_sqrt, reciprocal};
use crate::arith::quaternion::{Quat, quat_normalize};
use crate::arith::vector::Vec3;
use crate::context::Context;

/// The corners of the cell at a place, and the place within it.
struct Cell<R> {
    /// Heights at its corners in metres above the ground at the origin: along x, then along z.
    corners: [R; 4],
    /// Share of the way along x.
    x: R,
    /// Share of the way along z.
    z: R,
}

/// The slope of the ground at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slope {
    /// Rise along x.
    pub x: f32,
    /// Rise along z.
    pub z: f32,
    /// Squared area of the ground over each of its projection.
    pub gain: f32,
    /// The inverse of that.
    pub inv_gain: f32,
}

/// The cell at a place.
#[inline(always)]
fn ground_cell<R: Real>(cx: &Context<'_>, x: R, z: R) -> Cell<R> {
    let shift = cx.scene.hill_shift;
    let mask = (1 << shift) - 1;
    let u = x * cx.scene.hill_cells_per_m;
    let v = z * cx.scene.hill_cells_per_m;
    let ku = u.floor();
    let kv = v.floor();
    let index = ((kv.to_whole() & mask) << shift) | (ku.to_whole() & mask);
    let corners = index.look_up(bytemuck::cast_slice(&cx.tables[cx.scene.first_hill_row as usize..]));
    Cell { corners, x: u - ku, z: v - kv }
}

/// Height of the hills at a place in metres above the ground at the origin. Only where there are hills.
#[inline(always)]
pub fn ground_relief<R: Real>(cx: &Context<'_>, x: R, z: R) -> R {
    let cell = ground_cell(cx, x, z);
    let [a, b, c, d] = cell.corners;
    let near = a + cell.x * (b - a);
    let far = c + cell.x * (d - c);
    near + cell.z * (far - near)
}

/// Height of what leaves lie on, hills or water, in metres above the ground at the origin; zero on level
/// ground.
#[inline(always)]
pub fn ground_surface<R: Real>(cx: &Context<'_>, x: R, z: R) -> R {
    if !cx.scene.has_terrain() {
        return x.all(0.0);
    }
    ground_relief(cx, x, z).max(x.all(cx.scene.water_relief_m))
}

/// Height of a leaf that rests at a place in metres.
#[inline(always)]
pub fn ground_rest<R: Real>(cx: &Context<'_>, x: R, z: R) -> R {
    ground_surface(cx, x, z) + cx.scene.rest_height_m
}

/// Returns true if a leaf at a place has come to the ground. Most are above all hills: nothing is read for those.
#[inline(always)]
pub fn ground_met<R: Real>(cx: &Context<'_>, place: Vec3<R>) -> R::Mask {
    let low = place.y.less_than(place.y.all(cx.scene.highest_rest_m));
    if !cx.scene.has_terrain() || !low.any() {
        return low;
    }
    place.y.less_than(ground_rest(cx, place.x, place.z))
}

/// Slope of the ground at a place; none on water.
#[inline(always)]
pub fn ground_slope(cx: &Context<'_>, x: f32, z: f32) -> Slope {
    if !cx.scene.has_terrain() || ground_relief(cx, x, z) < cx.scene.water_relief_m {
        return Slope { x: 0.0, z: 0.0, gain: 1.0, inv_gain: 1.0 };
    }
    let cell = ground_cell(cx, x, z);
    let [a, b, c, d] = cell.corners;
    let near = b - a;
    let west = c - a;
    let rise_x = (near + cell.z * ((d - c) - near)) * cx.scene.hill_cells_per_m;
    let rise_z = (west + cell.x * ((d - b) - west)) * cx.scene.hill_cells_per_m;
    let gain = 1.0 + (rise_x * rise_x + rise_z * rise_z);
    Slope { x: rise_x, z: rise_z, gain, inv_gain: reciprocal(gain) }
}

/// The shortest turn from upright to the ground's normal.
#[inline(always)]
pub fn ground_lean(slope: Slope) -> Quat {
    let up = inverse_sqrt(slope.gain);
    quat_normalize(Quat::new((-slope.z) * up, 0.0, slope.x * up, 1.0 + up))
}
