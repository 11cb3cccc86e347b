// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws leaves: one instanced draw, cut out by coverage, in any order.

use windfall_wgpu::LeafColumns;

use super::frame::FrameGroup;
use super::leaf_kinds::LeafKinds;
use super::leaf_mesh::LeafMesh;
use super::leaf_record::record_constants;
use super::light_group::LightGroup;
use super::pipeline::{COMMON, LIGHT, ScenePipeline, shader};

/// WGSL from leaf columns to points on blades.
pub(super) const LEAF_SHAPE: &str = include_str!("shaders/leaf_shape.wgsl");

/// Leaves beyond which a frame uses the middle and the coarse grid, so that millions of leaves stay quick.
const DETAIL_LIMITS: [u32; 2] = [8_000, 400_000];

/// The leaf pipeline and its grids.
#[derive(Debug)]
pub(super) struct LeafPass {
    pipeline: wgpu::RenderPipeline,
    meshes: [LeafMesh; 3],
}

impl LeafPass {
    pub(super) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        frame: &FrameGroup,
        light: &LightGroup,
        kinds: &LeafKinds,
    ) -> Self {
        let text = [COMMON, LIGHT, &record_constants(), LEAF_SHAPE, include_str!("shaders/leaf.wgsl")];
        let shader = shader(device, "leaf", &text);
        let pipeline = ScenePipeline {
            label: "leaves",
            groups: &[Some(&frame.layout), Some(&light.layout), Some(&kinds.layout)],
            topology: wgpu::PrimitiveTopology::TriangleList,
            shader: &shader,
            buffers: &vertex_layouts(),
            blend: None,
            depth_write: true,
            alpha_to_coverage: true,
        }
        .build(device);
        let grid = |columns, rows| LeafMesh::grid(device, queue, columns, rows);
        Self { pipeline, meshes: [grid(4, 5), grid(2, 2), grid(1, 1)] }
    }

    /// Draws `leaves`; bind groups 0 and 1 are set.
    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, kinds: &LeafKinds, leaves: &LeafColumns<'_>) {
        let detail = DETAIL_LIMITS.iter().filter(|&&limit| leaves.leaf_count > limit).count();
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(2, &kinds.group, &[]);
        draw_instances(pass, leaves, &self.meshes[detail]);
    }
}

/// Binds the columns and a grid, and draws every leaf.
pub(super) fn draw_instances(pass: &mut wgpu::RenderPass<'_>, leaves: &LeafColumns<'_>, mesh: &LeafMesh) {
    if leaves.leaf_count == 0 {
        return;
    }
    let columns = [leaves.place, leaves.attitude, leaves.course, leaves.identity, &mesh.vertices];
    for (slot, column) in (0u32..).zip(columns) {
        pass.set_vertex_buffer(slot, column.slice(..));
    }
    pass.set_index_buffer(mesh.indices.slice(..), wgpu::IndexFormat::Uint16);
    pass.draw_indexed(0..mesh.index_count, 0, 0..leaves.leaf_count);
}

/// Four columns per leaf, then the grid per vertex.
pub(super) fn vertex_layouts() -> [wgpu::VertexBufferLayout<'static>; 5] {
    const PLACE: [wgpu::VertexAttribute; 1] = wgpu::vertex_attr_array![0 => Uint32x4];
    const ATTITUDE: [wgpu::VertexAttribute; 1] = wgpu::vertex_attr_array![1 => Float32x4];
    const COURSE: [wgpu::VertexAttribute; 1] = wgpu::vertex_attr_array![2 => Uint32x4];
    const IDENTITY: [wgpu::VertexAttribute; 1] = wgpu::vertex_attr_array![3 => Uint32x4];
    const GRID: [wgpu::VertexAttribute; 1] = wgpu::vertex_attr_array![4 => Float32x2];
    let instance = wgpu::VertexStepMode::Instance;
    let column = |attributes| wgpu::VertexBufferLayout { array_stride: 16, step_mode: instance, attributes };
    let step_mode = wgpu::VertexStepMode::Vertex;
    let grid = wgpu::VertexBufferLayout { array_stride: 8, step_mode, attributes: &GRID };
    [column(&PLACE), column(&ATTITUDE), column(&COURSE), column(&IDENTITY), grid]
}
