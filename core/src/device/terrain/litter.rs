// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/terrain/litter.wgsl
//!
//! The height of litter: integers at the nodes of a grid, interpolated linearly in each direction.
//!
//! A leaf that comes to lie adds its volume to the four nodes around it, and takes the same integers away when it leaves: sums of
//! integers do not depend on the order of leaves. No leaf lies in the outermost cells, so that heights end at zero.

use crate::arith::lane::{Mask, Real, Word};
use crate::context::Context;
use crate::device::terrain::snow::snow_height;

crate::shared_constants! {
    /// Cells of litter per metre.
    pub const LITTER_CELLS_PER_M: f32 = 8.0;
    /// Metres of height per unit.
    pub const LITTER_UNIT_M: f32 = 1.0 / 1_048_576.0;
    /// Height in m up to which leaves raise litter.
    pub const LITTER_HIGHEST_M: f32 = 2.0;
    /// Height in m above the ground from which on the wind does not rise over litter; below half of it, it rises by all of its height.
    pub const LITTER_WIND_M: f32 = 2.0;
    /// Weights of a node in each direction sum to this.
    pub const LITTER_WEIGHT: f32 = 256.0;
}

/// A place between four nodes.
#[derive(Clone, Copy, Debug)]
pub struct LitterCell<R: Real = f32> {
    /// Number of the node with the lowest coordinates.
    pub node: R::Word,
    /// True where there is a cell.
    pub is_inside: R::Mask,
    /// True where leaves lie down in it.
    pub bears: R::Mask,
    /// Share of the way along x.
    pub x: R,
    /// Share of the way along z.
    pub z: R,
}

/// Heights that a leaf adds to the four nodes around it: the first, its next along x, and the same one line further along z.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LitterShares {
    /// Number of the first node.
    pub node: u32,
    /// Units of height.
    pub heights: [u32; 4],
}

/// The cell at a place. Only where there is litter.
#[inline(always)]
pub fn litter_cell<R: Real>(cx: &Context<'_>, x: R, z: R) -> LitterCell<R> {
    let litter = &cx.scene.litter;
    let u = x * LITTER_CELLS_PER_M;
    let v = z * LITTER_CELLS_PER_M;
    let ku = u.floor();
    let kv = v.floor();
    let column = ku.to_whole();
    let line = kv.to_whole();
    let column = column.minus(column.all(litter.first_column));
    let line = line.minus(line.all(litter.first_line));
    let is_inside = column.less_than(column.all(litter.columns)) & line.less_than(line.all(litter.lines));
    let one = column.all(1);
    let bears = column.minus(one).less_than(column.all(litter.columns - 2))
        & line.minus(one).less_than(line.all(litter.lines - 2));
    let node = line.times(line.all(litter.columns + 1)).plus(column);
    LitterCell { node: is_inside.select(node, node.all(0)), is_inside, bears, x: u - ku, z: v - kv }
}

/// Height at a node in units.
#[inline(always)]
fn litter_node<W: Word>(cx: &Context<'_>, node: W) -> W::Real {
    node.look_up_word(cx.litter).to_real()
}

/// Heights at the corners of a cell in units, zero outside: along x, then along z.
#[inline(always)]
pub fn litter_corners<R: Real>(cx: &Context<'_>, cell: &LitterCell<R>) -> [R; 4] {
    let next = cell.node.all(1);
    let far = cell.node.plus(cell.node.all(cx.scene.litter.columns + 1));
    let none = cell.x.all(0.0);
    [
        cell.is_inside.select_real(litter_node(cx, cell.node), none),
        cell.is_inside.select_real(litter_node(cx, cell.node.plus(next)), none),
        cell.is_inside.select_real(litter_node(cx, far), none),
        cell.is_inside.select_real(litter_node(cx, far.plus(next)), none),
    ]
}

/// Height of litter at a place in m; zero without litter.
#[inline(always)]
pub fn litter_height<R: Real>(cx: &Context<'_>, x: R, z: R) -> R {
    if !cx.has_litter() {
        return x.all(0.0);
    }
    let cell = litter_cell(cx, x, z);
    let [a, b, c, d] = litter_corners(cx, &cell);
    let near = a + cell.x * (b - a);
    let far = c + cell.x * (d - c);
    (near + cell.z * (far - near)) * LITTER_UNIT_M
}

/// Height in m of the litter at a place and of the snow on it. Only where there is litter.
#[inline(always)]
pub fn ground_cover<R: Real>(cx: &Context<'_>, x: R, z: R) -> R {
    let litter = litter_height(cx, x, z);
    if cx.has_snow() { litter + snow_height(cx, x, z) } else { litter }
}

/// Height in m above the surface that the wind blows over, of a place at a height above the ground.
#[inline(always)]
pub fn above_litter<R: Real>(cx: &Context<'_>, above_ground: R, x: R, z: R) -> R {
    let low = above_ground.less_than(above_ground.all(LITTER_WIND_M));
    if !low.any() {
        return above_ground;
    }
    let fading = above_ground.all(2.0) - above_ground * (2.0 / LITTER_WIND_M);
    let share = fading.max(above_ground.all(0.0)).min(above_ground.all(1.0));
    above_ground - share * ground_cover(cx, x, z)
}

/// Heights that a leaf of some volume, in units of height over a cell, adds around its place. They sum to the volume.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "whole weights up to 256; as in WGSL"
)]
#[inline(always)]
pub fn litter_shares(cx: &Context<'_>, volume: u32, x: f32, z: f32) -> LitterShares {
    let cell = litter_cell(cx, x, z);
    let (right, far) = ((cell.x * LITTER_WEIGHT) as u32, (cell.z * LITTER_WEIGHT) as u32);
    let (left, near) = (LITTER_WEIGHT as u32 - right, LITTER_WEIGHT as u32 - far);
    let first = (volume * left * near) >> 16;
    let second = (volume * right * near) >> 16;
    let third = (volume * left * far) >> 16;
    LitterShares { node: cell.node, heights: [first, second, third, volume - first - second - third] }
}
