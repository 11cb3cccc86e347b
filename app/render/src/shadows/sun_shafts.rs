// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Shafts of light in haze: finds the share of sunlight that reaches the air between the eye and each place in the view.
//!
//! # Source
//! A grid of columns and slices filled front to back: Wronski, "Volumetric fog" (SIGGRAPH 2014).

use crate::frame::group::FrameGroup;
use crate::frame::light_group::LightGroup;
use crate::frame::sunlit_air::{SHAFT_COLUMNS, SHAFT_GROUP_SIZE, SHAFT_ROWS, SHARE_FORMAT};
use crate::gpu::pipeline::layout;
use crate::gpu::shaders::compile;

/// The pipeline, and the grid that it fills.
#[derive(Debug)]
pub(crate) struct SunShafts {
    pipeline: wgpu::ComputePipeline,
    grid: wgpu::BindGroup,
}

impl SunShafts {
    /// The pass that fills `grid`, the one of `light`.
    pub(crate) fn new(
        device: &wgpu::Device,
        frame: &FrameGroup,
        light: &LightGroup,
        grid: &wgpu::TextureView,
    ) -> Self {
        let stored = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("shafts"),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::COMPUTE,
                ty: wgpu::BindingType::StorageTexture {
                    access: wgpu::StorageTextureAccess::WriteOnly,
                    format: SHARE_FORMAT,
                    view_dimension: wgpu::TextureViewDimension::D3,
                },
                count: None,
            }],
        });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("shafts"),
            layout: Some(&layout(device, &[&frame.layout, &light.layout, &stored].map(Some))),
            module: &compile(device, &super::shaders(), "shadows/sun_shafts"),
            entry_point: Some("main"),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants: &frame.overrides(),
                ..Default::default()
            },
            cache: None,
        });
        let grid = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("shafts"),
            layout: &stored,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: wgpu::BindingResource::TextureView(grid),
            }],
        });
        Self { pipeline, grid }
    }

    /// Fills the grid for the view of a frame, when its shadow maps are drawn.
    pub(crate) fn fill(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        (frame, light): (&FrameGroup, &LightGroup),
        timestamp_writes: Option<wgpu::ComputePassTimestampWrites<'_>>,
    ) {
        let mut pass = encoder
            .begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("shafts"), timestamp_writes });
        pass.set_pipeline(&self.pipeline);
        for (number, group) in (0u32..).zip([&frame.group, &light.without_air, &self.grid]) {
            pass.set_bind_group(number, group, &[]);
        }
        let [across, down] = [SHAFT_COLUMNS, SHAFT_ROWS].map(|count| count.div_ceil(SHAFT_GROUP_SIZE));
        pass.dispatch_workgroups(across, down, 1);
    }
}
