// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Turns resolved light into the picture.

use super::frame::FrameGroup;
use super::pipeline::{COMMON, layout, shader, texture_entry};
use super::targets::Targets;

/// The tone mapping pipeline.
#[derive(Debug)]
pub(super) struct TonemapPass {
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    source: wgpu::BindGroup,
}

impl TonemapPass {
    pub(super) fn new(
        device: &wgpu::Device,
        frame: &FrameGroup,
        targets: &Targets,
        format: wgpu::TextureFormat,
    ) -> Self {
        let unfiltered = wgpu::TextureSampleType::Float { filterable: false };
        let source_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("tone map"),
            entries: &[texture_entry(0, unfiltered, wgpu::TextureViewDimension::D2)],
        });
        let module = shader(device, "tone map", &[COMMON, include_str!("shaders/tonemap.wgsl")]);
        let encode = [("ENCODE_GAMMA", if format.is_srgb() { 0.0 } else { 1.0 })];
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("tone map"),
            layout: Some(&layout(device, &[Some(&frame.layout), Some(&source_layout)])),
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
                entry_point: Some("fragment"),
                compilation_options: wgpu::PipelineCompilationOptions {
                    constants: &encode,
                    ..Default::default()
                },
                targets: &[Some(format.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        let source = source_group(device, &source_layout, targets);
        Self { pipeline, layout: source_layout, source }
    }

    /// Reads from new targets.
    pub(super) fn rebind(&mut self, device: &wgpu::Device, targets: &Targets) {
        self.source = source_group(device, &self.layout, targets);
    }

    /// Fills the part of `output` with this corner and size.
    pub(super) fn draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
        frame: &FrameGroup,
        output: &wgpu::TextureView,
        ((left, top), (width, height)): ((u32, u32), (u32, u32)),
    ) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("tone map"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: output,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                    store: wgpu::StoreOp::Store,
                },
            })],
            depth_stencil_attachment: None,
            timestamp_writes: timestamps,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        pass.set_viewport(left as f32, top as f32, width as f32, height as f32, 0.0, 1.0);
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &frame.group, &[]);
        pass.set_bind_group(1, &self.source, &[]);
        pass.draw(0..3, 0..1);
    }
}

fn source_group(device: &wgpu::Device, layout: &wgpu::BindGroupLayout, targets: &Targets) -> wgpu::BindGroup {
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("tone map"),
        layout,
        entries: &[wgpu::BindGroupEntry {
            binding: 0,
            resource: wgpu::BindingResource::TextureView(&targets.resolved),
        }],
    })
}
