// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/wind/turbulence.wgsl
//!
//! Turbulence: a periodic box of velocities, interpolated linearly in each direction.
//!
//! A component is packed into 16 bits. A row of the table holds the three components of a node and of the next one along
//! the wind, so that a leaf reads four rows of 16 bytes, and the box takes one megabyte. Packing moves a velocity by at most
//! 8e-5 of its standard deviation.

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
    /// Nodes of the box, a row of the table each.
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
    let row = |index: usize| {
        let columns = TURBULENCE_X as usize;
        let next = index / columns * columns + (index + 1) % columns;
        let [start, end] = [index, next].map(|node| nodes[node].map(turbulence_pack));
        let [along, up, across] = [0, 1, 2].map(|part| start[part] | (end[part] << 16));
        Uint4([along, up, across, 0])
    };
    (0..TURBULENCE_NODES as usize).map(row).collect()
}

/// Row of the node at the start of an edge.
#[inline(always)]
fn turbulence_index<W: Word>(column: W, level: W, layer: W) -> W {
    ((layer & (TURBULENCE_Z - 1)) << 11) | ((level & (TURBULENCE_Y - 1)) << 6) | (column & (TURBULENCE_X - 1))
}

/// A component on an edge along the wind, in packed units.
#[inline(always)]
fn turbulence_component<W: Word>(edge: W, along: W::Real) -> W::Real {
    let (start, end) = turbulence_unpack(edge);
    start + along * (end - start)
}

/// Velocity on an edge along the wind, in packed units.
#[inline(always)]
fn turbulence_edge<W: Word>(cx: &Context<'_>, index: W, along: W::Real) -> Vec3<W::Real> {
    let rows = &cx.tables[cx.scene.wind.first_turbulence_row as usize..];
    let [x, y, z, _] = index.look_up_words(bytemuck::cast_slice(rows));
    Vec3::new(turbulence_component(x, along), turbulence_component(y, along), turbulence_component(z, along))
}

/// Turbulent velocity of unit variance at a place in the wind's frame (along, up, across in metres).
#[inline(always)]
pub fn wind_turbulence<R: Real>(cx: &Context<'_>, moment: &MomentBlock, place: Vec3<R>) -> Vec3<R> {
    let cells = Vec3::from(cx.scene.wind.cells_per_m);
    let x = place.x * cells.x - moment.turbulence_offset;
    turbulence_in_cells(cx, Vec3::new(x, place.y * cells.y, place.z * cells.z))
}

/// The same at a place so many cells from the box's origin.
#[inline(always)]
pub fn turbulence_in_cells<R: Real>(cx: &Context<'_>, cells: Vec3<R>) -> Vec3<R> {
    let Vec3 { x, y, z } = cells;
    let kx = x.floor();
    let ky = y.floor();
    let kz = z.floor();
    let t = Vec3::new(x - kx, y - ky, z - kz);
    let column = kx.to_whole();
    let level = ky.to_whole();
    let layer = kz.to_whole();
    let above = level.plus(level.all(1));
    let beyond = layer.plus(layer.all(1));
    let a = turbulence_edge(cx, turbulence_index(column, level, layer), t.x);
    let b = turbulence_edge(cx, turbulence_index(column, above, layer), t.x);
    let c = turbulence_edge(cx, turbulence_index(column, level, beyond), t.x);
    let d = turbulence_edge(cx, turbulence_index(column, above, beyond), t.x);
    let near = a + (b - a) * t.y;
    let far = c + (d - c) * t.y;
    (near + (far - near) * t.z) * t.x.all(TURBULENCE_UNIT)
}
