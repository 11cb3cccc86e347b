// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/solid/grid.wgsl
//!
//! Distance to a mesh: between the nodes of a grid of signed distances, linear along each axis.

use super::shape::{SolidAt, SolidDistance, row_vector};
use crate::arith::lane::Real;
use crate::arith::math::{inverse_sqrt, reciprocal};
use crate::arith::vector::{TINY_SQUARED, Vec3, vec3_dot};
use crate::context::Context;
use crate::layout::Uint4;

crate::shared_constants! {
    /// Rows before the distances of a grid: nodes along x, y and z, and the margin in m; place of the first node and edge of a cell in m.
    pub const GRID_ROWS: u32 = 2;
    /// Units of a distance in the edge of a cell.
    pub const GRID_UNITS: f32 = 256.0;
}

/// A place along one axis of a grid.
#[derive(Clone, Copy, Debug)]
pub struct GridAxis {
    /// Node before it.
    pub node: u32,
    /// Share of the cell after that node.
    pub share: f32,
    /// Distance in cells by which it is beyond the grid, below zero before the first node.
    pub beyond: f32,
}

/// A place so many cells from the first of some nodes.
#[inline(always)]
pub fn grid_axis(cells: f32, nodes: u32) -> GridAxis {
    let last = (nodes - 1) as f32;
    if cells <= 0.0 {
        return GridAxis { node: 0, share: 0.0, beyond: cells };
    }
    if last <= cells {
        return GridAxis { node: nodes - 2, share: 1.0, beyond: cells - last };
    }
    let before = cells.floor();
    GridAxis { node: before.to_whole(), share: cells - before, beyond: 0.0 }
}

/// Distance at a node, in units.
#[inline(always)]
pub fn grid_node(cx: &Context<'_>, first_row: u32, node: u32) -> f32 {
    let Uint4(words) = cx.tables[(first_row + GRID_ROWS + (node >> 3)) as usize];
    let word = words[((node >> 1) & 3) as usize];
    // The upper half keeps its sign as it moves down.
    let half = if (node & 1) == 0 { word << 16 } else { word };
    ((half as i32) >> 16) as f32
}

/// Edge of the cells of a mesh's grid in m.
#[inline(always)]
pub fn grid_cell_m(cx: &Context<'_>, solid: &SolidAt) -> f32 {
    let Uint4([_, _, _, cell]) = cx.tables[solid.first_row as usize + 1];
    f32::from_bits(cell)
}

/// Distance of a place in the frame of a mesh from its surface. Beyond the grid it is at least what lies between the two.
#[inline(always)]
pub fn grid_distance(cx: &Context<'_>, solid: &SolidAt, inner: Vec3) -> SolidDistance {
    let Uint4([nodes_x, nodes_y, nodes_z, margin]) = cx.tables[solid.first_row as usize];
    let cell_m = grid_cell_m(cx, solid);
    let cells = (inner - row_vector(cx.tables[solid.first_row as usize + 1])) * reciprocal(cell_m);
    let x = grid_axis(cells.x, nodes_x);
    let y = grid_axis(cells.y, nodes_y);
    let z = grid_axis(cells.z, nodes_z);
    let beyond = Vec3::new(x.beyond, y.beyond, z.beyond);
    let beyond_squared = vec3_dot(beyond, beyond);
    if TINY_SQUARED < beyond_squared {
        let inverse = inverse_sqrt(beyond_squared);
        let distance_m = beyond_squared * inverse * cell_m + f32::from_bits(margin);
        return SolidDistance { distance_m, normal: beyond * inverse };
    }
    let node = (z.node * nodes_y + y.node) * nodes_x + x.node;
    let line = nodes_x;
    let layer = nodes_x * nodes_y;
    let first = solid.first_row;
    let low = [
        grid_node(cx, first, node),
        grid_node(cx, first, node + line),
        grid_node(cx, first, node + layer),
        grid_node(cx, first, node + layer + line),
    ];
    let high = [
        grid_node(cx, first, node + 1),
        grid_node(cx, first, node + line + 1),
        grid_node(cx, first, node + layer + 1),
        grid_node(cx, first, node + layer + line + 1),
    ];
    // Along x, then y, then z; slopes along the way.
    let rise = [high[0] - low[0], high[1] - low[1], high[2] - low[2], high[3] - low[3]];
    let along = [
        low[0] + rise[0] * x.share,
        low[1] + rise[1] * x.share,
        low[2] + rise[2] * x.share,
        low[3] + rise[3] * x.share,
    ];
    let near = along[0] + (along[1] - along[0]) * y.share;
    let far = along[2] + (along[3] - along[2]) * y.share;
    let rise_near = rise[0] + (rise[1] - rise[0]) * y.share;
    let rise_far = rise[2] + (rise[3] - rise[2]) * y.share;
    let climb_near = along[1] - along[0];
    let climb_far = along[3] - along[2];
    let slope = Vec3::new(
        rise_near + (rise_far - rise_near) * z.share,
        climb_near + (climb_far - climb_near) * z.share,
        far - near,
    );
    let slope_squared = vec3_dot(slope, slope);
    let mut normal = Vec3::new(0.0, 1.0, 0.0);
    if TINY_SQUARED < slope_squared {
        normal = slope * inverse_sqrt(slope_squared);
    }
    let distance = near + (far - near) * z.share;
    SolidDistance { distance_m: distance * (cell_m * (1.0 / GRID_UNITS)), normal }
}
