// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Common parts of the scene pass's pipelines.

use super::group::FrameGroup;
use crate::gpu::pipeline::layout;
use crate::gpu::targets::{DEPTH_FORMAT, HDR_FORMAT, SAMPLE_COUNT};

/// Settings in which one pipeline of the scene pass differs from the others.
pub(crate) struct ScenePipeline<'a> {
    pub(crate) label: &'a str,
    /// Bind group 0.
    pub(crate) frame: &'a FrameGroup,
    /// The bind groups after it.
    pub(crate) groups: &'a [&'a wgpu::BindGroupLayout],
    pub(crate) topology: wgpu::PrimitiveTopology,
    /// Leaves out triangles that are seen from behind, of closed surfaces.
    pub(crate) culls_back: bool,
    /// Module with an entry point `fragment`.
    pub(crate) shader: &'a wgpu::ShaderModule,
    /// Entry point of its vertices.
    pub(crate) vertex: &'a str,
    /// Values of the overrides that only this module has.
    pub(crate) constants: &'a [(&'a str, f64)],
    pub(crate) buffers: &'a [wgpu::VertexBufferLayout<'a>],
    pub(crate) blend: Option<wgpu::BlendState>,
    pub(crate) depth_write: bool,
    pub(crate) alpha_to_coverage: bool,
}

impl ScenePipeline<'_> {
    /// Builds the pipeline.
    pub(crate) fn build(&self, device: &wgpu::Device) -> wgpu::RenderPipeline {
        let groups = std::iter::once(&self.frame.layout).chain(self.groups.iter().copied()).map(Some);
        let layout = layout(device, &groups.collect::<Vec<_>>());
        let constants = [&self.frame.overrides()[..], self.constants].concat();
        let compilation_options =
            wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() };
        let buffers: Vec<_> = self.buffers.iter().cloned().map(Some).collect();
        device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(self.label),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: self.shader,
                entry_point: Some(self.vertex),
                compilation_options: compilation_options.clone(),
                buffers: &buffers,
            },
            primitive: wgpu::PrimitiveState {
                topology: self.topology,
                cull_mode: self.culls_back.then_some(wgpu::Face::Back),
                ..Default::default()
            },
            depth_stencil: Some(wgpu::DepthStencilState {
                format: DEPTH_FORMAT,
                depth_write_enabled: Some(self.depth_write),
                depth_compare: Some(wgpu::CompareFunction::GreaterEqual),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: wgpu::MultisampleState {
                count: SAMPLE_COUNT,
                mask: !0,
                alpha_to_coverage_enabled: self.alpha_to_coverage,
            },
            fragment: Some(wgpu::FragmentState {
                module: self.shader,
                entry_point: Some("fragment"),
                compilation_options,
                targets: &[Some(wgpu::ColorTargetState {
                    format: HDR_FORMAT,
                    blend: self.blend,
                    write_mask: wgpu::ColorWrites::ALL,
                })],
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}
