// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The textures a frame is drawn into before it is tone mapped.

use super::RenderError;

/// Samples per pixel: four is what every WebGPU adapter offers.
pub(super) const SAMPLE_COUNT: u32 = 4;
/// Format of light before tone mapping.
pub(super) const HDR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
/// Format of depth, reversed: 0 is infinity.
pub(super) const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Multisampled light and depth, and the resolved light.
#[derive(Debug)]
pub(super) struct Targets {
    pub(super) size: (u32, u32),
    pub(super) color: wgpu::TextureView,
    pub(super) depth: wgpu::TextureView,
    pub(super) resolved: wgpu::TextureView,
}

impl Targets {
    pub(super) fn new(device: &wgpu::Device, size: (u32, u32)) -> Result<Self, RenderError> {
        let limit = device.limits().max_texture_dimension_2d;
        let (width, height) = size;
        if width == 0 || height == 0 || width > limit || height > limit {
            return Err(RenderError::Size { width, height, limit });
        }
        let attachment = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let readable = attachment | wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST;
        let view = |label, format, sample_count, usage| {
            let texture = device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage,
                view_formats: &[],
            });
            texture.create_view(&wgpu::TextureViewDescriptor::default())
        };
        Ok(Self {
            size,
            color: view("light", HDR_FORMAT, SAMPLE_COUNT, attachment),
            depth: view("depth", DEPTH_FORMAT, SAMPLE_COUNT, attachment),
            resolved: view("resolved light", HDR_FORMAT, 1, readable),
        })
    }
}
