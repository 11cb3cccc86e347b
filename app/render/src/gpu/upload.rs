// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Textures and buffers filled once.

/// A buffer with `bytes` in it, rounded up to four bytes and never empty.
pub(crate) fn buffer(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    label: &str,
    usage: wgpu::BufferUsages,
    bytes: &[u8],
) -> wgpu::Buffer {
    let size = (bytes.len() as u64).next_multiple_of(4).max(16);
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size,
        usage: usage | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    queue.write_buffer(&buffer, 0, bytes);
    buffer
}

/// A square four-byte-per-texel texture with its mips.
pub(crate) fn texture(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    label: &str,
    format: wgpu::TextureFormat,
    size_px: u32,
    mips: &[&[u8]],
) -> wgpu::TextureView {
    let texture = filled(device, queue, label, format, size_px, &[mips.to_vec()]);
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

/// An array of square four-byte-per-texel textures from `layers[layer][mip]`, viewed as an array.
pub(crate) fn texture_array(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    label: &str,
    format: wgpu::TextureFormat,
    size_px: u32,
    layers: &[Vec<&[u8]>],
) -> wgpu::TextureView {
    filled(device, queue, label, format, size_px, layers).create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        ..Default::default()
    })
}

fn filled(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    label: &str,
    format: wgpu::TextureFormat,
    size_px: u32,
    layers: &[Vec<&[u8]>],
) -> wgpu::Texture {
    let mip_level_count = u32::try_from(layers[0].len()).unwrap_or(1);
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d {
            width: size_px,
            height: size_px,
            depth_or_array_layers: u32::try_from(layers.len()).unwrap_or(1),
        },
        mip_level_count,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    for (z, mips) in (0u32..).zip(layers) {
        for (mip_level, bytes) in (0u32..).zip(mips) {
            let edge = (size_px >> mip_level).max(1);
            queue.write_texture(
                wgpu::TexelCopyTextureInfo {
                    texture: &texture,
                    mip_level,
                    origin: wgpu::Origin3d { x: 0, y: 0, z },
                    aspect: wgpu::TextureAspect::All,
                },
                bytes,
                wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(4 * edge),
                    rows_per_image: None,
                },
                wgpu::Extent3d { width: edge, height: edge, depth_or_array_layers: 1 },
            );
        }
    }
    texture
}
