// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Bind group 1: shadows, shade and noise.

use super::pipeline::{FILTERABLE, sampler_entry, texture_entry};
use super::scenery::{NOISE_SIZE, noise_mips};
use super::upload;

/// What `light.wgsl` binds.
#[derive(Debug)]
pub(super) struct LightGroup {
    pub(super) layout: wgpu::BindGroupLayout,
    pub(super) group: wgpu::BindGroup,
}

impl LightGroup {
    pub(super) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        [shadow_map, wide_map]: [&wgpu::TextureView; 2],
        shade_map: &wgpu::TextureView,
    ) -> Self {
        let flat = wgpu::TextureViewDimension::D2;
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("light"),
            entries: &[
                texture_entry(0, wgpu::TextureSampleType::Depth, flat),
                sampler_entry(1, wgpu::SamplerBindingType::Comparison),
                texture_entry(2, FILTERABLE, flat),
                sampler_entry(3, wgpu::SamplerBindingType::Filtering),
                texture_entry(4, FILTERABLE, flat),
                sampler_entry(5, wgpu::SamplerBindingType::Filtering),
                texture_entry(6, wgpu::TextureSampleType::Depth, flat),
            ],
        });
        let linear = wgpu::SamplerDescriptor {
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        };
        let compare = Some(wgpu::CompareFunction::LessEqual);
        let shadow_sampler = device.create_sampler(&wgpu::SamplerDescriptor { compare, ..linear.clone() });
        let clamp_sampler = device.create_sampler(&linear);
        let repeat = wgpu::AddressMode::Repeat;
        let repeat_sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            address_mode_u: repeat,
            address_mode_v: repeat,
            ..linear
        });
        let noise = noise_view(device, queue);
        let views = [(0, shadow_map), (2, shade_map), (4, &noise), (6, wide_map)];
        let samplers = [(1, &shadow_sampler), (3, &clamp_sampler), (5, &repeat_sampler)];
        let views = views.map(|(binding, view)| wgpu::BindGroupEntry {
            binding,
            resource: wgpu::BindingResource::TextureView(view),
        });
        let samplers = samplers.map(|(binding, sampler)| wgpu::BindGroupEntry {
            binding,
            resource: wgpu::BindingResource::Sampler(sampler),
        });
        let entries: Vec<_> = views.into_iter().chain(samplers).collect();
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("light"),
            layout: &layout,
            entries: &entries,
        });
        Self { layout, group }
    }
}

fn noise_view(device: &wgpu::Device, queue: &wgpu::Queue) -> wgpu::TextureView {
    let mips = noise_mips();
    let layer: Vec<&[u8]> = mips.iter().map(Vec::as_slice).collect();
    let size_px = u32::try_from(NOISE_SIZE).unwrap_or(1);
    upload::texture(device, queue, "noise", wgpu::TextureFormat::Rgba8Unorm, size_px, &layer)
}
