// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Makes a pixel of the picture of every sample, where light is shaded more coarsely than pixels.

use windfall_core::shared_struct;

use super::fullscreen::Fullscreen;
use super::group::LensGroup;
use crate::gpu::pipeline::{texture_entry, uniform_entry};
use crate::gpu::targets::{HDR_FORMAT, Targets};
use crate::gpu::tile::Tile;

shared_struct! {
    /// The tile whose samples are taken.
    pub(crate) struct SampleUniform, padding 8 {
        /// Corner of the tile in the picture.
        corner_px: [i32; 2],
    }
}

/// The pass and its uniform block.
#[derive(Debug)]
pub(crate) struct SamplePass {
    pass: Fullscreen,
    layout: wgpu::BindGroupLayout,
    uniform: wgpu::Buffer,
}

impl SamplePass {
    pub(crate) fn new(device: &wgpu::Device, lens: &LensGroup) -> Self {
        let unfiltered = wgpu::TextureSampleType::Float { filterable: false };
        let mut samples = texture_entry(1, unfiltered, wgpu::TextureViewDimension::D2);
        if let wgpu::BindingType::Texture { multisampled, .. } = &mut samples.ty {
            *multisampled = true;
        }
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("samples"),
            entries: &[uniform_entry(0), samples],
        });
        let uniform = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("samples"),
            size: size_of::<SampleUniform>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let source = ("lens/sample_pass", "fragment");
        Self { pass: Fullscreen::new(device, lens, &layout, source, HDR_FORMAT, &[]), layout, uniform }
    }

    /// The samples of `targets`, bound to become pixels.
    pub(crate) fn bind(&self, device: &wgpu::Device, targets: &Targets) -> wgpu::BindGroup {
        device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("samples"),
            layout: &self.layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: self.uniform.as_entire_binding() },
                wgpu::BindGroupEntry {
                    binding: 1,
                    resource: wgpu::BindingResource::TextureView(&targets.color),
                },
            ],
        })
    }

    /// Fills a tile of `picture` that has just been drawn.
    pub(crate) fn draw(
        &self,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        lens: &LensGroup,
        (samples, picture): (&wgpu::BindGroup, &wgpu::TextureView),
        tile: &Tile,
    ) {
        let whole = |number: u32| i32::try_from(number).unwrap_or(i32::MAX);
        let corner_px = [whole(tile.corner.0), whole(tile.corner.1)];
        queue.write_buffer(
            &self.uniform,
            0,
            bytemuck::bytes_of(&SampleUniform { corner_px, padding: [0; 8] }),
        );
        self.pass.draw_part(encoder, [&lens.group, samples], picture, (tile.corner, tile.inside));
    }
}
