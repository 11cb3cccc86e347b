// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Map from above of what snow does to other things, a texel for each of its cells: ground that melted snow has soaked, and leaves that hang beneath snow.

use windfall_core::CompiledScene;
use windfall_core::blocks::NEVER;
use windfall_core::device::terrain::snow::SNOW_CELLS_PER_M;
use windfall_core::device::tree::branch_snow::{crown_square, crown_squares};
use windfall_core::layout::Uint4;
use windfall_wgpu::BedColumn;

use crate::gpu::pipeline::{buffer_entry, layout, uniform_entry};
use crate::gpu::shaders::compile;
use crate::gpu::upload;

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rg8Unorm;

/// The map and its pipeline. Without snow it is a bare texel, which no shader reads.
#[derive(Debug)]
pub(crate) struct SnowMap {
    pub(crate) view: wgpu::TextureView,
    /// Corner of least x and z of its rectangle in metres.
    pub(crate) corner_m: [f32; 2],
    /// Reciprocals of the edges of the rectangle in metres.
    pub(crate) per_m: [f32; 2],
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    segments: wgpu::Buffer,
}

/// The segments of trees by the square metre beneath them: a word for each square and one more, where its segments begin and those of the last end; then of
/// each segment its row and the area with which it catches snow.
fn segments_of(compiled: &CompiledScene) -> Vec<u32> {
    let snow = &compiled.block().snow;
    let rows = &compiled.tables()[snow.first_branch_row as usize..][..snow.branches as usize];
    let mut found: Vec<[u32; 3]> = (0..)
        .zip(rows)
        .filter(|(_, Uint4([cell, ..]))| *cell != NEVER)
        .map(|(row, Uint4([cell, area, ..]))| [crown_square(snow, *cell), row, *area])
        .collect();
    found.sort_unstable();
    let squares = if snow.branches == 0 { 0 } else { crown_squares(snow) };
    let starts = (0..=squares).map(|square| found.partition_point(|[of, ..]| *of < square));
    let starts = starts.map(|start| u32::try_from(start).unwrap_or(u32::MAX));
    starts.chain(found.iter().flat_map(|[_, row, area]| [*row, *area])).collect()
}

impl SnowMap {
    pub(crate) fn new(device: &wgpu::Device, queue: &wgpu::Queue, compiled: Option<&CompiledScene>) -> Self {
        let snow = compiled.map(|compiled| &compiled.block().snow);
        let size = snow.map_or([1; 2], |snow| [snow.columns, snow.lines]);
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("snow map"),
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
            label: Some("snow map"),
            entries: &[
                uniform_entry(0),
                buffer_entry(1, storage, wgpu::ShaderStages::FRAGMENT),
                buffer_entry(2, storage, wgpu::ShaderStages::FRAGMENT),
            ],
        });
        let shader = compile(device, &super::shaders(), "scenery/snow_map");
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("snow map"),
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
        let segments = compiled.map_or_else(|| vec![0], segments_of);
        let usage = wgpu::BufferUsages::STORAGE;
        let first = snow.map_or([0; 2], |snow| [snow.first_column, snow.first_line]);
        Self {
            view: texture.create_view(&wgpu::TextureViewDescriptor::default()),
            corner_m: first.map(|first| first.cast_signed() as f32 / SNOW_CELLS_PER_M),
            per_m: size.map(|cells| SNOW_CELLS_PER_M / cells as f32),
            pipeline,
            layout: group_layout,
            segments: upload::buffer(
                device,
                queue,
                "segments under snow",
                usage,
                bytemuck::cast_slice(&segments),
            ),
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
            label: Some("snow map"),
            layout: &self.layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: grids.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: bed.buffer.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 2, resource: self.segments.as_entire_binding() },
            ],
        });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("snow map"),
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
