// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Meters the picture on the device and sets the exposure.

use windfall_core::shared_constants;

use super::group::LensGroup;
use super::metering::METERED_MOMENTS;
use crate::gpu::pipeline::{buffer_entry, layout};
use crate::gpu::shaders::compile;

shared_constants! {
    /// Invocations per workgroup, and workgroups that measure.
    const EXPOSURE_GROUP_SIZE: u32 = 256;
}

/// The two steps of metering: sums of groups of pixels, then their sum and what follows from it.
#[derive(Debug)]
pub(crate) struct ExposurePass {
    measure: wgpu::ComputePipeline,
    adapt: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
    sums: wgpu::Buffer,
    metered: wgpu::Buffer,
}

impl ExposurePass {
    pub(crate) fn new(device: &wgpu::Device, lens: &LensGroup) -> Self {
        let storage = wgpu::BufferBindingType::Storage { read_only: false };
        let bind_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("exposure"),
            entries: &[
                wgpu::BindGroupLayoutEntry {
                    binding: 0,
                    visibility: wgpu::ShaderStages::COMPUTE,
                    ty: wgpu::BindingType::Texture {
                        sample_type: wgpu::TextureSampleType::Float { filterable: false },
                        view_dimension: wgpu::TextureViewDimension::D2,
                        multisampled: false,
                    },
                    count: None,
                },
                buffer_entry(1, storage, wgpu::ShaderStages::COMPUTE),
                buffer_entry(2, storage, wgpu::ShaderStages::COMPUTE),
                buffer_entry(3, storage, wgpu::ShaderStages::COMPUTE),
            ],
        });
        let module = compile(device, &super::shaders(), "lens/exposure_pass");
        let pipeline_layout = layout(device, &[Some(&lens.uniform_layout), Some(&bind_layout)]);
        let pipeline = |entry| {
            device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(entry),
                layout: Some(&pipeline_layout),
                module: &module,
                entry_point: Some(entry),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            })
        };
        let buffer = |label, count: u32| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: u64::from(count) * 4,
                usage: wgpu::BufferUsages::STORAGE,
                mapped_at_creation: false,
            })
        };
        let (sums, metered) = (buffer("exposure", EXPOSURE_GROUP_SIZE), buffer("metered", METERED_MOMENTS));
        Self { measure: pipeline("measure"), adapt: pipeline("adapt"), layout: bind_layout, sums, metered }
    }

    /// Binds the picture to meter.
    pub(crate) fn bind(
        &self,
        device: &wgpu::Device,
        lens: &LensGroup,
        light: &wgpu::TextureView,
    ) -> wgpu::BindGroup {
        device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("exposure"),
            layout: &self.layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(light) },
                wgpu::BindGroupEntry { binding: 1, resource: self.sums.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 2, resource: lens.exposure.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 3, resource: self.metered.as_entire_binding() },
            ],
        })
    }

    pub(crate) fn run(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        timestamps: Option<wgpu::ComputePassTimestampWrites<'_>>,
        lens: &LensGroup,
        group: &wgpu::BindGroup,
    ) {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("exposure"),
            timestamp_writes: timestamps,
        });
        pass.set_bind_group(0, &lens.uniform_group, &[]);
        pass.set_bind_group(1, group, &[]);
        pass.set_pipeline(&self.measure);
        pass.dispatch_workgroups(EXPOSURE_GROUP_SIZE, 1, 1);
        pass.set_pipeline(&self.adapt);
        pass.dispatch_workgroups(1, 1, 1);
    }
}
