// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/terrain/ground.wgsl
//!
//! The ground as kernels sample it: level, or the hills' table interpolated linearly in each direction; water and litter on it.

use crate::arith::lane::{Mask, Real, Word};
use crate::arith::math::{inverse_sqrt, reciprocal};
use crate::arith::quaternion::{Quat, quat_normalize};
use crate::arith::vector::Vec3;
use crate::context::Context;
use crate::device::terrain::litter::{
    LITTER_CELLS_PER_M, LITTER_UNIT_M, ground_cover, litter_cell, litter_corners,
};
use crate::device::terrain::snow::{SNOW_CELLS_PER_M, SnowBetween, snow_between};

crate::shared_constants! {
    /// Directions in which litter is searched for its steepest drop.
    pub const DROP_DIRECTIONS: u32 = 8;
    /// Root of a half.
    pub const ROOT_HALF: f32 = std::f32::consts::FRAC_1_SQRT_2;
}

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

/// Height of hills or water in metres above the ground at the origin; zero on level ground.
#[inline(always)]
pub fn ground_bare<R: Real>(cx: &Context<'_>, x: R, z: R) -> R {
    if !cx.scene.has_terrain() {
        return x.all(0.0);
    }
    ground_relief(cx, x, z).max(x.all(cx.scene.water_relief_m))
}

/// Returns true if there is water at a place.
#[inline(always)]
pub fn ground_is_water<R: Real>(cx: &Context<'_>, x: R, z: R) -> R::Mask {
    if cx.scene.has_terrain() {
        return ground_relief(cx, x, z).less_than(x.all(cx.scene.water_relief_m));
    }
    x.all(cx.scene.ground_height_m).less_than(x.all(cx.scene.surface_height_m))
}

/// Height in m of a leaf that lies on the ground at a place, whatever the water above it. Only where there is litter.
#[inline(always)]
pub fn ground_bottom(cx: &Context<'_>, x: f32, z: f32) -> f32 {
    let relief = if cx.scene.has_terrain() { ground_relief(cx, x, z) } else { 0.0 };
    relief + cx.scene.litter.bottom_m
}

/// Height of what leaves lie on, hills or water, or the litter and snow there, in metres above the ground at the origin.
#[inline(always)]
pub fn ground_surface<R: Real>(cx: &Context<'_>, x: R, z: R) -> R {
    let bare = ground_bare(cx, x, z);
    if cx.has_litter() { bare + ground_cover(cx, x, z) } else { bare }
}

/// Height of a leaf that rests at a place in metres.
#[inline(always)]
pub fn ground_rest<R: Real>(cx: &Context<'_>, x: R, z: R) -> R {
    ground_surface(cx, x, z) + cx.scene.rest_height_m
}

/// Height in m of the centre of a leaf that lies at a place and reaches so far down, over ground or litter on which a leaf rests at
/// `rest`: it sinks into litter, not into the ground.
#[inline(always)]
pub fn lying_over<R: Real>(cx: &Context<'_>, x: R, z: R, reach: R, rest: R) -> R {
    let bare = ground_bare(cx, x, z) + cx.scene.rest_height_m;
    (bare + reach).max(rest)
}

/// The same over what is there.
#[inline(always)]
pub fn lying_height<R: Real>(cx: &Context<'_>, x: R, z: R, reach: R) -> R {
    lying_over(cx, x, z, reach, ground_rest(cx, x, z))
}

/// Returns true if a leaf at a place has come to the ground. Most are above all hills: nothing is read for those.
#[inline(always)]
pub fn ground_met<R: Real>(cx: &Context<'_>, place: Vec3<R>) -> R::Mask {
    let low = place.y.less_than(place.y.all(cx.scene.highest_rest_m));
    if !cx.scene.has_relief() || !low.any() {
        return low;
    }
    place.y.less_than(ground_rest(cx, place.x, place.z))
}

/// Rise of the hills at a place along x and z, under water too; none on level ground.
#[inline(always)]
pub fn ground_rise(cx: &Context<'_>, x: f32, z: f32) -> [f32; 2] {
    if !cx.scene.has_terrain() {
        return [0.0, 0.0];
    }
    let cell = ground_cell(cx, x, z);
    let [a, b, c, d] = cell.corners;
    let near = b - a;
    let west = c - a;
    [
        (near + cell.z * ((d - c) - near)) * cx.scene.hill_cells_per_m,
        (west + cell.x * ((d - b) - west)) * cx.scene.hill_cells_per_m,
    ]
}

/// Slope of what leaves lie on at a place; none on water.
#[inline(always)]
pub fn ground_slope(cx: &Context<'_>, x: f32, z: f32) -> Slope {
    if cx.has_litter() {
        return steepest_slope(cx, x, z);
    }
    if !cx.scene.has_terrain() || ground_relief(cx, x, z) < cx.scene.water_relief_m {
        return Slope { x: 0.0, z: 0.0, gain: 1.0, inv_gain: 1.0 };
    }
    let [rise_x, rise_z] = ground_rise(cx, x, z);
    let gain = 1.0 + (rise_x * rise_x + rise_z * rise_z);
    Slope { x: rise_x, z: rise_z, gain, inv_gain: reciprocal(gain) }
}

/// Slope of litter: that of the steepest drop within one cell, in eight directions. Heaps whose leaves slide down the slope of the
/// interpolated surface instead grow into towers, on whose tops it is level.
fn steepest_slope(cx: &Context<'_>, x: f32, z: f32) -> Slope {
    let here = ground_surface(cx, x, z);
    let mut steepest = Slope { x: 0.0, z: 0.0, gain: 1.0, inv_gain: 1.0 };
    let mut least = 0.0;
    for number in 0..DROP_DIRECTIONS {
        let direction = drop_direction(number);
        let reach = 1.0 / LITTER_CELLS_PER_M;
        let there = ground_surface(cx, x + direction[0] * reach, z + direction[1] * reach);
        let rise = (there - here) * LITTER_CELLS_PER_M;
        if rise < least {
            let gain = 1.0 + rise * rise;
            least = rise;
            steepest =
                Slope { x: direction[0] * rise, z: direction[1] * rise, gain, inv_gain: reciprocal(gain) };
        }
    }
    steepest
}

/// Unit vector x, z of one of the directions in which litter is searched for its steepest drop.
#[inline(always)]
pub fn drop_direction(number: u32) -> [f32; 2] {
    let along = if (number & 2) == 0 { 1.0 } else { -1.0 };
    if number < 4 {
        return if (number & 1) == 0 { [along, 0.0] } else { [0.0, along] };
    }
    let across = if (number & 1) == 0 { ROOT_HALF } else { -ROOT_HALF };
    [along * ROOT_HALF, across]
}

/// Rise along x and z of what bodies strike: hills, litter and snow as they are interpolated; none on water.
#[inline(always)]
pub fn ground_gradient<R: Real>(cx: &Context<'_>, x: R, z: R) -> [R; 2] {
    let mut rise_x = x.all(0.0);
    let mut rise_z = x.all(0.0);
    if cx.scene.has_terrain() {
        let cell = ground_cell(cx, x, z);
        let [a, b, c, d] = cell.corners;
        let near = b - a;
        let west = c - a;
        let is_dry = x.all(cx.scene.water_relief_m).less_than(ground_relief(cx, x, z));
        let cells_per_m = is_dry.select_real(x.all(cx.scene.hill_cells_per_m), x.all(0.0));
        rise_x = (near + cell.z * ((d - c) - near)) * cells_per_m;
        rise_z = (west + cell.x * ((d - b) - west)) * cells_per_m;
    }
    if cx.has_litter() {
        let cell = litter_cell(cx, x, z);
        let [a, b, c, d] = litter_corners(cx, &cell);
        let near = b - a;
        let west = c - a;
        rise_x = rise_x + (near + cell.z * ((d - c) - near)) * (LITTER_UNIT_M * LITTER_CELLS_PER_M);
        rise_z = rise_z + (west + cell.x * ((d - b) - west)) * (LITTER_UNIT_M * LITTER_CELLS_PER_M);
    }
    if cx.has_litter() && cx.has_snow() {
        let SnowBetween { depths_m: [a, b, c, d], x, z } = snow_between(cx, x, z);
        let near = b - a;
        let west = c - a;
        rise_x = rise_x + (near + z * ((d - c) - near)) * SNOW_CELLS_PER_M;
        rise_z = rise_z + (west + x * ((d - b) - west)) * SNOW_CELLS_PER_M;
    }
    [rise_x, rise_z]
}

/// The shortest turn from upright to the ground's normal.
#[inline(always)]
pub fn ground_lean(slope: Slope) -> Quat {
    let up = inverse_sqrt(slope.gain);
    quat_normalize(Quat::new((-slope.z) * up, 0.0, slope.x * up, 1.0 + up))
}
