// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Which leaves are drawn how: those of each tree together, coarser where they are far away.

use std::collections::BTreeMap;
use std::ops::Range;

use glam::Vec3;
use windfall_wgpu::LeafColumns;

use super::leaf_mesh::LeafMesh;
use super::stems::Stems;
use crate::trees::{Stand, StandingTree};

/// Leaves beyond which a frame uses the middle and the coarse grid, so that millions of leaves stay quick.
const DETAIL_LIMITS: [u32; 2] = [8_000, 400_000];
/// Distances from the camera to a crown, in metres, beyond which its leaves use them.
const DETAIL_M: [f32; 2] = [4.0, 28.0];
/// Columns and rows of the grids from fine to coarse.
const GRIDS: [(u16, u16); 3] = [(4, 5), (2, 2), (1, 1)];
/// Number of the coarsest grid.
const COARSEST: usize = GRIDS.len() - 1;

/// Leaves with neighbouring slots that are drawn alike.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct LeafPart {
    slots: Range<u32>,
    /// The tree they grew on.
    tree: Option<usize>,
    /// Leaves that each stands for.
    cluster: u32,
    /// Number of the grid.
    detail: usize,
}

impl LeafPart {
    /// Leaves of no tree.
    pub(super) fn loose(slots: Range<u32>) -> Self {
        let detail = detail(slots.len());
        Self { slots, tree: None, cluster: 1, detail }
    }

    /// All leaves of a world with a stand as seen from `eye_m`, `leaf_count` in all: tree by tree, then those of none.
    pub(super) fn of_world(stand: &Stand, leaf_count: u32, eye_m: Vec3) -> Vec<Self> {
        let mut end = 0;
        let part = |(index, tree): (usize, &StandingTree)| {
            let start = end;
            end += tree.leaves;
            let crown = &tree.crown;
            let distance_m = crown.center_m.distance(eye_m) - crown.radii_m.max_element();
            let far = DETAIL_M.iter().filter(|&&limit_m| distance_m > limit_m).count();
            let detail = far.max(detail(stand.leaf_count() as usize).min(1));
            Self { slots: start..end, tree: Some(index), cluster: tree.cluster, detail }
        };
        let mut parts: Vec<Self> = stand.trees.iter().enumerate().map(part).collect();
        parts.push(Self::loose(stand.leaf_count()..leaf_count.max(stand.leaf_count())));
        parts
    }
}

/// The grid for so many leaves.
fn detail(count: usize) -> usize {
    DETAIL_LIMITS.iter().filter(|&&limit| count > limit as usize).count()
}

/// Columns of leaves and the parts they are drawn in.
#[derive(Clone, Debug)]
pub(super) struct LeafSet<'a> {
    pub(super) columns: LeafColumns<'a>,
    pub(super) parts: &'a [LeafPart],
}

/// A grid of every detail for every number of leaves that one stands for.
#[derive(Debug)]
pub(super) struct LeafMeshes(BTreeMap<(usize, u32), LeafMesh>);

impl LeafMeshes {
    /// The meshes for leaves of no tree and for those of `stand`.
    pub(super) fn new(device: &wgpu::Device, queue: &wgpu::Queue, stand: &Stand) -> Self {
        let clusters = std::iter::once(1).chain(stand.trees.iter().map(|tree| tree.cluster));
        let mut meshes = BTreeMap::new();
        for cluster in clusters {
            for (detail, &(columns, rows)) in GRIDS.iter().enumerate() {
                meshes
                    .entry((detail, cluster))
                    .or_insert_with(|| LeafMesh::grid(device, queue, columns, rows, cluster));
            }
        }
        Self(meshes)
    }
}

/// How leaves are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LeafDetail {
    /// As each part says.
    Own,
    /// Flat: for shadows.
    Coarsest,
}

/// Binds columns, records of the trees and grids, and draws every leaf of a set.
pub(super) fn draw_leaves(
    pass: &mut wgpu::RenderPass<'_>,
    set: &LeafSet<'_>,
    stems: &Stems,
    meshes: &LeafMeshes,
    detail: LeafDetail,
) {
    let leaves = &set.columns;
    for (slot, column) in (0u32..).zip([leaves.place, leaves.attitude, leaves.course, leaves.identity]) {
        pass.set_vertex_buffer(slot, column.slice(..));
    }
    for part in set.parts {
        let slots = part.slots.start..part.slots.end.min(leaves.leaf_count);
        let number = if detail == LeafDetail::Coarsest { COARSEST } else { part.detail };
        let Some(mesh) = meshes.0.get(&(number, part.cluster)).filter(|_| !slots.is_empty()) else {
            continue;
        };
        pass.set_vertex_buffer(4, mesh.vertices.slice(..));
        pass.set_vertex_buffer(5, stems.of(part.tree));
        pass.set_index_buffer(mesh.indices.slice(..), wgpu::IndexFormat::Uint16);
        pass.draw_indexed(0..mesh.index_count, 0, slots);
    }
}

/// Four columns per leaf, then the grid per vertex, then the record of the tree.
pub(super) fn vertex_layouts() -> [wgpu::VertexBufferLayout<'static>; 6] {
    const PLACE: [wgpu::VertexAttribute; 1] = wgpu::vertex_attr_array![0 => Uint32x4];
    const ATTITUDE: [wgpu::VertexAttribute; 1] = wgpu::vertex_attr_array![1 => Float32x4];
    const COURSE: [wgpu::VertexAttribute; 1] = wgpu::vertex_attr_array![2 => Uint32x4];
    const IDENTITY: [wgpu::VertexAttribute; 1] = wgpu::vertex_attr_array![3 => Uint32x4];
    const GRID: [wgpu::VertexAttribute; 1] = wgpu::vertex_attr_array![4 => Float32x3];
    let instance = wgpu::VertexStepMode::Instance;
    let column = |attributes| wgpu::VertexBufferLayout { array_stride: 16, step_mode: instance, attributes };
    let step_mode = wgpu::VertexStepMode::Vertex;
    let grid = wgpu::VertexBufferLayout { array_stride: 12, step_mode, attributes: &GRID };
    [column(&PLACE), column(&ATTITUDE), column(&COURSE), column(&IDENTITY), grid, Stems::layout()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_leaves_and_far_ones_are_drawn_coarsely() {
        let grid = |count| LeafPart::loose(0..count).detail;
        assert_eq!([grid(8_000), grid(8_001), grid(400_001)], [0, 1, 2], "by their number");
    }
}
