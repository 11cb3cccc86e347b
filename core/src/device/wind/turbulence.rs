// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/wind/turbulence.wgsl
//!
//! Turbulence: a periodic box of velocities, interpolated linearly in each direction.
//!
//! A component is packed into 16 bits. One row of the table holds along and up of the four nodes of a cell's lower z
//! face, another one across of all eight nodes, so that a leaf reads three rows of 16 bytes. Packing moves a velocity by
//! at most 8e-5 of its standard deviation.

use crate::arith::lane::{Real, Word};
use crate::arith::vector::Vec3;
use crate::blocks::MomentBlock;
use crate::context::Context;
use crate::layout::Uint4;

crate::shared_constants! {
    /// Cells of the box along the wind, a power of two.
    pub const TURBULENCE_X: u32 = 64;
    /// Cells upwards, a power of two.
    pub const TURBULENCE_Y: u32 = 32;
    /// Cells across the wind, a power of two.
    pub const TURBULENCE_Z: u32 = 32;
    /// Standard deviations that a packed unit stands for: 5 for 32767.
    pub const TURBULENCE_UNIT: f32 = 5.0 / 32767.0;
    /// Nodes of the box: rows of along and up, and behind them as many rows of across.
    pub const TURBULENCE_NODES: u32 = 65536;
}

/// A component of unit variance in 16 bits; beyond five standard deviations it is cut off.
#[expect(clippy::cast_possible_truncation, reason = "cut off to 16 bits just before")]
fn turbulence_pack(value: f32) -> u32 {
    libm::roundf((value / TURBULENCE_UNIT).clamp(-32767.0, 32767.0)) as i32 as u32 & 0xffff
}

/// Two packed components, the lower one first, in packed units.
#[inline(always)]
pub fn turbulence_unpack<W: Word>(word: W) -> (W::Real, W::Real) {
    ((word << 16).shift_signed(16).to_real(), word.shift_signed(16).to_real())
}

/// Table of the box. `nodes` are velocities, x running fastest, then y, then z.
pub(crate) fn turbulence_rows(nodes: &[[f32; 3]]) -> Vec<Uint4> {
    let node = |x: u32, y: u32, z: u32| {
        let (x, y, z) = (x % TURBULENCE_X, y % TURBULENCE_Y, z % TURBULENCE_Z);
        nodes[((z * TURBULENCE_Y + y) * TURBULENCE_X + x) as usize].map(turbulence_pack)
    };
    let place = |index: u32| {
        (index % TURBULENCE_X, index / TURBULENCE_X % TURBULENCE_Y, index / (TURBULENCE_X * TURBULENCE_Y))
    };
    let level = |index: u32| {
        let (x, y, z) = place(index);
        let at = |x, y| {
            let [along, up, _] = node(x, y, z);
            along | (up << 16)
        };
        Uint4([at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)])
    };
    let across = |index: u32| {
        let (x, y, z) = place(index);
        let at = |y, z| node(x, y, z)[2] | (node(x + 1, y, z)[2] << 16);
        Uint4([at(y, z), at(y + 1, z), at(y, z + 1), at(y + 1, z + 1)])
    };
    (0..TURBULENCE_NODES).map(level).chain((0..TURBULENCE_NODES).map(across)).collect()
}

/// Row of the node at the lower corner of a cell.
#[inline(always)]
fn turbulence_index<W: Word>(column: W, layer: W) -> W {
    ((layer & (TURBULENCE_Z - 1)) << 11) | column
}

/// Along and up on one z face of a cell, in packed units.
#[inline(always)]
fn turbulence_face<W: Word>(cx: &Context<'_>, index: W, along: W::Real, up: W::Real) -> (W::Real, W::Real) {
    let rows = &cx.tables[cx.scene.wind.first_turbulence_row as usize..];
    let [a, b, c, d] = index.look_up_words(bytemuck::cast_slice(rows));
    let (ax, ay) = turbulence_unpack(a);
    let (bx, by) = turbulence_unpack(b);
    let (cx, cy) = turbulence_unpack(c);
    let (dx, dy) = turbulence_unpack(d);
    let lower = (ax + along * (bx - ax), ay + along * (by - ay));
    let upper = (cx + along * (dx - cx), cy + along * (dy - cy));
    (lower.0 + up * (upper.0 - lower.0), lower.1 + up * (upper.1 - lower.1))
}

/// Across on an edge along the wind, in packed units.
#[inline(always)]
fn turbulence_edge<W: Word>(edge: W, along: W::Real) -> W::Real {
    let (start, end) = turbulence_unpack(edge);
    start + along * (end - start)
}

/// Across within a cell, in packed units.
#[inline(always)]
fn turbulence_across<W: Word>(cx: &Context<'_>, index: W, t: Vec3<W::Real>) -> W::Real {
    let rows = &cx.tables[(cx.scene.wind.first_turbulence_row + TURBULENCE_NODES) as usize..];
    let [a, b, c, d] = index.look_up_words(bytemuck::cast_slice(rows));
    let a = turbulence_edge(a, t.x);
    let b = turbulence_edge(b, t.x);
    let c = turbulence_edge(c, t.x);
    let d = turbulence_edge(d, t.x);
    let near = a + t.y * (b - a);
    let far = c + t.y * (d - c);
    near + t.z * (far - near)
}

/// Turbulent velocity of unit variance at a place in the wind's frame (along, up, across in metres).
#[inline(always)]
pub fn wind_turbulence<R: Real>(cx: &Context<'_>, moment: &MomentBlock, place: Vec3<R>) -> Vec3<R> {
    let cells = Vec3::from(cx.scene.wind.cells_per_m);
    let x = place.x * cells.x - moment.turbulence_offset;
    let y = place.y * cells.y;
    let z = place.z * cells.z;
    let kx = x.floor();
    let ky = y.floor();
    let kz = z.floor();
    let t = Vec3::new(x - kx, y - ky, z - kz);
    let column = ((ky.to_whole() & (TURBULENCE_Y - 1)) << 6) | (kx.to_whole() & (TURBULENCE_X - 1));
    let layer = kz.to_whole();
    let index = turbulence_index(column, layer);
    let near = turbulence_face(cx, index, t.x, t.y);
    let far = turbulence_face(cx, turbulence_index(column, layer.plus(layer.all(1))), t.x, t.y);
    let across = turbulence_across(cx, index, t);
    Vec3::new(
        (near.0 + t.z * (far.0 - near.0)) * TURBULENCE_UNIT,
        (near.1 + t.z * (far.1 - near.1)) * TURBULENCE_UNIT,
        across * TURBULENCE_UNIT,
    )
}
