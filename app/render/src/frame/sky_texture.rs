// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Maps of radiance as textures.

use half::f16;

use crate::light::EnvironmentMap;

/// Format of radiance in kcd/m².
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

/// A texture whose mips are `levels`, each half as wide and as high as the one before.
pub(crate) fn radiance_texture(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    label: &str,
    levels: &[&EnvironmentMap],
) -> wgpu::TextureView {
    let extent = |map: &EnvironmentMap| {
        let (width, height) = map.size();
        let edge = |edge: usize| u32::try_from(edge).unwrap_or(u32::MAX);
        wgpu::Extent3d { width: edge(width), height: edge(height), depth_or_array_layers: 1 }
    };
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: extent(levels[0]),
        mip_level_count: u32::try_from(levels.len()).unwrap_or(1),
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: FORMAT,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    for (mip_level, level) in (0u32..).zip(levels) {
        let half = |value: f32| f16::from_f32(value.min(f16::MAX.to_f32())).to_bits();
        let texels: Vec<[u16; 4]> =
            level.pixels().iter().map(|color| [color.x, color.y, color.z, 1.0].map(half)).collect();
        let size = extent(level);
        queue.write_texture(
            wgpu::TexelCopyTextureInfo { mip_level, ..texture.as_image_copy() },
            bytemuck::cast_slice(&texels),
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(8 * size.width),
                rows_per_image: None,
            },
            size,
        );
    }
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
