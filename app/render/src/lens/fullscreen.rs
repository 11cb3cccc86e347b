// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Passes that compute every pixel of a target from other pictures.

use super::group::LensGroup;
use crate::gpu::pipeline::layout;
use crate::gpu::shaders::compile;

/// Corner and size of a part of a target, in pixels.
pub(crate) type Area = ((u32, u32), (u32, u32));

/// A pipeline whose fragments come from one triangle over the target.
#[derive(Debug)]
pub(crate) struct Fullscreen {
    label: &'static str,
    pipeline: wgpu::RenderPipeline,
}

impl Fullscreen {
    /// Entry point `entry` of module `name`, into targets of `format`. Bind group 0 is the lens, 1 what `group` lays out.
    pub(crate) fn new(
        device: &wgpu::Device,
        lens: &LensGroup,
        group: &wgpu::BindGroupLayout,
        (name, entry): (&'static str, &str),
        format: wgpu::TextureFormat,
        constants: &[(&str, f64)],
    ) -> Self {
        let module = compile(device, &super::shaders(), name);
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(name),
            layout: Some(&layout(device, &[Some(&lens.layout), Some(group)])),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vertex"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some(entry),
                compilation_options: wgpu::PipelineCompilationOptions { constants, ..Default::default() },
                targets: &[Some(format.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        Self { label: name, pipeline }
    }

    /// Fills `area` of `target`, or all of it; elsewhere it becomes black.
    pub(crate) fn draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
        [lens, group]: [&wgpu::BindGroup; 2],
        target: &wgpu::TextureView,
        area: Option<Area>,
    ) {
        let black = wgpu::LoadOp::Clear(wgpu::Color::BLACK);
        self.pass(encoder, timestamps, [lens, group], (target, black), area);
    }

    /// Fills `area` of `target`, which keeps what it has elsewhere.
    pub(crate) fn draw_part(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        groups: [&wgpu::BindGroup; 2],
        target: &wgpu::TextureView,
        area: Area,
    ) {
        self.pass(encoder, None, groups, (target, wgpu::LoadOp::Load), Some(area));
    }

    fn pass(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
        [lens, group]: [&wgpu::BindGroup; 2],
        (target, load): (&wgpu::TextureView, wgpu::LoadOp<wgpu::Color>),
        area: Option<Area>,
    ) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(self.label),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: target,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
            })],
            depth_stencil_attachment: None,
            timestamp_writes: timestamps,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        if let Some(((left, top), (width, height))) = area {
            pass.set_viewport(left as f32, top as f32, width as f32, height as f32, 0.0, 1.0);
        }
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, lens, &[]);
        pass.set_bind_group(1, group, &[]);
        pass.draw(0..3, 0..1);
    }
}

/// A texture of light that a pass fills and others read.
pub(crate) fn light_texture(device: &wgpu::Device, label: &str, size: (u32, u32)) -> wgpu::TextureView {
    number_texture(device, label, crate::gpu::targets::HDR_FORMAT, size)
}

/// A texture of any numbers that a pass fills and others read.
pub(crate) fn number_texture(
    device: &wgpu::Device,
    label: &str,
    format: wgpu::TextureFormat,
    (width, height): (u32, u32),
) -> wgpu::TextureView {
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT
            | wgpu::TextureUsages::TEXTURE_BINDING
            | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

/// A sampler that mixes neighbours and keeps to the edge.
pub(crate) fn smooth_sampler(device: &wgpu::Device) -> wgpu::Sampler {
    device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("smooth"),
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        ..Default::default()
    })
}
