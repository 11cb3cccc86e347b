// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Turns light into the picture.

use windfall_core::scene::ToneMap;
use windfall_core::shared_constants;

use super::fullscreen::{Area, Fullscreen, smooth_sampler};
use super::glare_pass::GlareChain;
use super::group::LensGroup;
use crate::gpu::pipeline::{FILTERABLE, sampler_entry, texture_entry, uniform_entry};

shared_constants! {
    /// Number of the linear curve.
    const CURVE_LINEAR: u32 = 0;
    /// Number of Reinhard's curve.
    const CURVE_REINHARD: u32 = 1;
    /// Number of the AgX curve.
    const CURVE_AGX: u32 = 2;
}

/// The tone mapping pipelines, one for each curve: a choice in the shader would cost a software adapter all three.
#[derive(Debug)]
pub(crate) struct TonemapPass {
    curves: [Fullscreen; 3],
    layout: wgpu::BindGroupLayout,
    sampler: wgpu::Sampler,
    pixels: wgpu::Buffer,
}

impl TonemapPass {
    pub(crate) fn new(device: &wgpu::Device, lens: &LensGroup, format: wgpu::TextureFormat) -> Self {
        let dimension = wgpu::TextureViewDimension::D2;
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("tone map"),
            entries: &[
                texture_entry(0, wgpu::TextureSampleType::Float { filterable: false }, dimension),
                texture_entry(1, FILTERABLE, dimension),
                sampler_entry(2, wgpu::SamplerBindingType::Filtering),
                uniform_entry(3),
            ],
        });
        let source = ("lens/tonemap_pass", "fragment");
        let encode = ("ENCODE", if format.is_srgb() { 0.0 } else { 1.0 });
        let curves = [CURVE_LINEAR, CURVE_REINHARD, CURVE_AGX].map(|curve| {
            Fullscreen::new(device, lens, &layout, source, format, &[encode, ("CURVE", f64::from(curve))])
        });
        let pixels = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("tone map"),
            size: size_of::<f32>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self { curves, layout, sampler: smooth_sampler(device), pixels }
    }

    /// Binds the radiance to turn into the picture.
    pub(crate) fn bind(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        light: &wgpu::TextureView,
        glare: &GlareChain,
    ) -> wgpu::BindGroup {
        queue.write_buffer(&self.pixels, 0, bytemuck::bytes_of(&(glare.pixels as f32)));
        let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
        device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("tone map"),
            layout: &self.layout,
            entries: &[
                entry(0, wgpu::BindingResource::TextureView(light)),
                entry(1, wgpu::BindingResource::TextureView(&glare.result)),
                entry(2, wgpu::BindingResource::Sampler(&self.sampler)),
                entry(3, self.pixels.as_entire_binding()),
            ],
        })
    }

    /// Fills the part of `output` with this corner and size, by the curve of `tone_map`.
    pub(crate) fn draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
        (tone_map, groups): (&ToneMap, [&wgpu::BindGroup; 2]),
        output: &wgpu::TextureView,
        area: Area,
    ) {
        let [linear, reinhard, agx] = &self.curves;
        let curve = match tone_map {
            ToneMap::Linear { .. } => linear,
            ToneMap::Reinhard { .. } => reinhard,
            ToneMap::AgX => agx,
        };
        curve.draw(encoder, timestamps, groups, output, Some(area));
    }
}
