// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Map from above of the ground that melted snow has soaked, a texel for each cell of snow.

use windfall_core::blocks::SnowBlock;
use windfall_core::device::terrain::snow::SNOW_CELLS_PER_M;
use windfall_wgpu::BedColumn;

use crate::gpu::pipeline::{buffer_entry, layout, uniform_entry};
use crate::gpu::shaders::compile;

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R8Unorm;

/// The map and its pipeline. Without snow it is a dry texel, which no shader reads.
#[derive(Debug)]
pub(crate) struct WetMap {
    pub(crate) view: wgpu::TextureView,
    /// Corner of least x and z of its rectangle in metres.
    pub(crate) corner_m: [f32; 2],
    /// Reciprocals of the edges of the rectangle in metres.
    pub(crate) per_m: [f32; 2],
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
}

impl WetMap {
    pub(crate) fn new(device: &wgpu::Device, snow: Option<&SnowBlock>) -> Self {
        let size = snow.map_or([1; 2], |snow| [snow.columns, snow.lines]);
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("wet map"),
            size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: FORMAT,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::RENDER_ATTACHMENT,
            view_formats: &[],
        });
        let storage = wgpu::BufferBindingType::Storage { read_only: true };
        let group_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("wet map"),
            entries: &[uniform_entry(0), buffer_entry(1, storage, wgpu::ShaderStages::FRAGMENT)],
        });
        let shader = compile(device, &super::shaders(), "scenery/wet_map");
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("wet map"),
            layout: Some(&layout(device, &[Some(&group_layout)])),
            vertex: wgpu::VertexState {
                module: &shader,
                entry_point: Some("vertex"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &shader,
                entry_point: Some("fragment"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(FORMAT.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        let first = snow.map_or([0; 2], |snow| [snow.first_column, snow.first_line]);
        Self {
            view: texture.create_view(&wgpu::TextureViewDescriptor::default()),
            corner_m: first.map(|first| first.cast_signed() as f32 / SNOW_CELLS_PER_M),
            per_m: size.map(|cells| SNOW_CELLS_PER_M / cells as f32),
            pipeline,
            layout: group_layout,
        }
    }

    /// Draws the map of a bed; without one it stays as it is. `grids` is the uniform of the snow.
    pub(crate) fn draw(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        grids: &wgpu::Buffer,
        bed: Option<&BedColumn<'_>>,
    ) {
        let Some(bed) = bed else { return };
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("wet map"),
            layout: &self.layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: grids.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: bed.buffer.as_entire_binding() },
            ],
        });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("wet map"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    store: wgpu::StoreOp::Store,
                },
            })],
            ..Default::default()
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.draw(0..3, 0..1);
    }
}
