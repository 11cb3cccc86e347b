// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws the leaves' shadows around what the camera looks at.

use windfall_wgpu::LeafColumns;

use super::frame::FrameGroup;
use super::leaf_kinds::LeafKinds;
use super::leaf_mesh::LeafMesh;
use super::leaf_pass::{LEAF_SHAPE, draw_instances, vertex_layouts};
use super::leaf_record::record_constants;
use super::pipeline::{COMMON, layout, shader};

/// Edge of the shadow map in texels; `light.wgsl` filters with this size.
pub(super) const SHADOW_SIZE: u32 = 2048;
const SHADOW_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// The shadow map and its pipeline.
#[derive(Debug)]
pub(super) struct ShadowPass {
    pub(super) map: wgpu::TextureView,
    pipeline: wgpu::RenderPipeline,
    mesh: LeafMesh,
}

impl ShadowPass {
    pub(super) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        frame: &FrameGroup,
        kinds: &LeafKinds,
    ) -> Self {
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("shadow map"),
            size: wgpu::Extent3d { width: SHADOW_SIZE, height: SHADOW_SIZE, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: SHADOW_FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        let text = [COMMON, &record_constants(), LEAF_SHAPE, include_str!("shaders/leaf_shadow.wgsl")];
        let module = shader(device, "leaf shadow", &text);
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("leaf shadows"),
            layout: Some(&layout(device, &[Some(&frame.layout), None, Some(&kinds.layout)])),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vertex"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &vertex_layouts().map(Some),
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: Some(wgpu::DepthStencilState {
                format: SHADOW_FORMAT,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::LessEqual),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("fragment"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[],
            }),
            multiview_mask: None,
            cache: None,
        });
        let map = texture.create_view(&wgpu::TextureViewDescriptor::default());
        Self { map, pipeline, mesh: LeafMesh::grid(device, queue, 1, 1) }
    }

    /// Draws all sets of leaves into the map.
    pub(super) fn draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
        frame: &FrameGroup,
        kinds: &LeafKinds,
        leaves: &[LeafColumns<'_>],
    ) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("shadows"),
            color_attachments: &[],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.map,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            timestamp_writes: timestamps,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &frame.group, &[]);
        pass.set_bind_group(2, &kinds.group, &[]);
        for columns in leaves {
            draw_instances(&mut pass, columns, &self.mesh);
        }
    }
}
