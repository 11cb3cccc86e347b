// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Bind group 1: shadows, shade, noise and the sky.

use super::fire_light;
use super::noise::{NOISE_SIZE, noise_mips};
use super::sky_texture::radiance_texture;
use super::sunlit_air;
use crate::gpu::pipeline::{FILTERABLE, sampler_entry, texture_entry, uniform_entry};
use crate::gpu::upload;
use crate::light::{Daylight, prefiltered};

/// Bind group of `light.wgsl`.
#[derive(Debug)]
pub(crate) struct LightGroup {
    pub(crate) layout: wgpu::BindGroupLayout,
    pub(crate) group: wgpu::BindGroup,
    /// The same group without the sunlit air, for the pass that finds it.
    pub(crate) without_air: wgpu::BindGroup,
    no_air: wgpu::TextureView,
    /// Shadow maps, shade map, noise, snow map and sunlit air.
    views: [(u32, wgpu::TextureView); 5],
    skies: [wgpu::TextureView; 2],
    /// Lights of fires.
    pub(crate) fires: wgpu::Buffer,
    samplers: [(u32, wgpu::Sampler); 4],
}

impl LightGroup {
    pub(crate) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        [shadow_maps, sunlit_air]: [&wgpu::TextureView; 2],
        [shade_map, snow_map]: [&wgpu::TextureView; 2],
        daylight: &Daylight,
    ) -> Self {
        let flat = wgpu::TextureViewDimension::D2;
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("light"),
            entries: &[
                texture_entry(0, wgpu::TextureSampleType::Depth, wgpu::TextureViewDimension::D2Array),
                sampler_entry(1, wgpu::SamplerBindingType::Comparison),
                texture_entry(2, FILTERABLE, flat),
                sampler_entry(3, wgpu::SamplerBindingType::Filtering),
                texture_entry(4, FILTERABLE, flat),
                sampler_entry(5, wgpu::SamplerBindingType::Filtering),
                texture_entry(6, FILTERABLE, flat),
                texture_entry(7, FILTERABLE, flat),
                sampler_entry(8, wgpu::SamplerBindingType::Filtering),
                texture_entry(9, FILTERABLE, flat),
                uniform_entry(10),
                texture_entry(11, FILTERABLE, wgpu::TextureViewDimension::D3),
            ],
        });
        let linear = wgpu::SamplerDescriptor {
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        };
        let compare = Some(wgpu::CompareFunction::LessEqual);
        let repeat = wgpu::AddressMode::Repeat;
        let around = wgpu::SamplerDescriptor { address_mode_u: repeat, ..linear.clone() };
        let repeating = wgpu::SamplerDescriptor { address_mode_v: repeat, ..around.clone() };
        let samplers = [
            (1, device.create_sampler(&wgpu::SamplerDescriptor { compare, ..linear.clone() })),
            (3, device.create_sampler(&linear)),
            (5, device.create_sampler(&repeating)),
            (8, device.create_sampler(&around)),
        ];
        let noise = noise_view(device, queue);
        let views = [(0, shadow_maps), (2, shade_map), (4, &noise), (6, snow_map), (11, sunlit_air)]
            .map(|(binding, view)| (binding, view.clone()));
        let skies = skies(device, queue, daylight);
        let fires = fire_light::buffer(device);
        let no_air = sunlit_air::grid(device, false);
        let [group, without_air] = bind(device, &layout, (&views, &no_air, &fires), &samplers, &skies);
        Self { layout, group, without_air, no_air, views, skies, fires, samplers }
    }

    /// Takes over another sky.
    pub(crate) fn set_sky(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, daylight: &Daylight) {
        self.skies = skies(device, queue, daylight);
        self.rebind(device);
    }

    /// Takes over other shadow maps.
    pub(crate) fn set_shadow_maps(&mut self, device: &wgpu::Device, maps: &wgpu::TextureView) {
        self.views[0].1 = maps.clone();
        self.rebind(device);
    }

    fn rebind(&mut self, device: &wgpu::Device) {
        [self.group, self.without_air] =
            bind(device, &self.layout, (&self.views, &self.no_air, &self.fires), &self.samplers, &self.skies);
    }
}

/// The sky as it is seen, and as surfaces of rising roughness mirror it, without the sun.
fn skies(device: &wgpu::Device, queue: &wgpu::Queue, daylight: &Daylight) -> [wgpu::TextureView; 2] {
    let mirrored = prefiltered(&daylight.sky);
    let mirrored: Vec<_> = mirrored.iter().collect();
    [("sky", vec![&daylight.seen]), ("mirrored sky", mirrored)]
        .map(|(label, levels)| radiance_texture(device, queue, label, &levels))
}

/// The group with the last of the views, and with `no_air` in its place.
fn bind(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    (views, no_air, fires): (&[(u32, wgpu::TextureView); 5], &wgpu::TextureView, &wgpu::Buffer),
    samplers: &[(u32, wgpu::Sampler)],
    [seen, mirrored]: &[wgpu::TextureView; 2],
) -> [wgpu::BindGroup; 2] {
    let view =
        |binding, view| wgpu::BindGroupEntry { binding, resource: wgpu::BindingResource::TextureView(view) };
    let samplers = samplers.iter().map(|(binding, sampler)| wgpu::BindGroupEntry {
        binding: *binding,
        resource: wgpu::BindingResource::Sampler(sampler),
    });
    let [fixed @ .., (air_binding, air)] = views;
    let fixed = fixed.iter().map(|(binding, texture)| view(*binding, texture));
    let fires = wgpu::BindGroupEntry { binding: 10, resource: fires.as_entire_binding() };
    let shared: Vec<_> = fixed.chain([view(7, seen), view(9, mirrored), fires]).chain(samplers).collect();
    [air, no_air].map(|air| {
        let entries = [&shared[..], &[view(*air_binding, air)]].concat();
        device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("light"),
            layout,
            entries: &entries,
        })
    })
}

fn noise_view(device: &wgpu::Device, queue: &wgpu::Queue) -> wgpu::TextureView {
    let mips = noise_mips();
    let layer: Vec<&[u8]> = mips.iter().map(Vec::as_slice).collect();
    let size_px = u32::try_from(NOISE_SIZE).unwrap_or(1);
    upload::texture(device, queue, "noise", wgpu::TextureFormat::Rgba8Unorm, size_px, &layer)
}
