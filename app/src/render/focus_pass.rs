// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Depth of field, from depth and resolved light.

use super::fullscreen::{Fullscreen, light_texture};
use super::lens_group::{LensGroup, MAX_BLUR};
use super::pipeline::{texture_entry, uniform_entry};
use super::targets::{HDR_FORMAT, Targets};
use super::tile::Tile;

/// Format of radii of circles of confusion, in pixels.
const CIRCLE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R16Float;

/// `Focus` of `focus.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
struct FocusUniform {
    corner: [i32; 2],
    block: i32,
    unused: i32,
}

/// The three steps: radii from depth, their largest in blocks, and the gathering.
#[derive(Debug)]
pub(super) struct FocusPass {
    circle: Fullscreen,
    largest: Fullscreen,
    gather: Fullscreen,
    layout: wgpu::BindGroupLayout,
    uniform: wgpu::Buffer,
}

/// What pictures of one size need.
#[derive(Debug)]
pub(super) struct FocusChain {
    /// Light in focus and out of it.
    pub(super) result: wgpu::TextureView,
    circles: wgpu::TextureView,
    widest: wgpu::TextureView,
    /// By what they write: what a pass writes it must not have bound.
    circle: wgpu::BindGroup,
    largest: wgpu::BindGroup,
    gather: wgpu::BindGroup,
    block: u32,
}

impl FocusPass {
    pub(super) fn new(device: &wgpu::Device, lens: &LensGroup) -> Self {
        let unfiltered = wgpu::TextureSampleType::Float { filterable: false };
        let dimension = wgpu::TextureViewDimension::D2;
        let mut depth = texture_entry(1, wgpu::TextureSampleType::Depth, dimension);
        depth.ty = wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Depth,
            view_dimension: dimension,
            multisampled: true,
        };
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("focus"),
            entries: &[
                uniform_entry(0),
                depth,
                texture_entry(2, unfiltered, dimension),
                texture_entry(3, unfiltered, dimension),
                texture_entry(4, unfiltered, dimension),
            ],
        });
        let pipeline = |entry, format| {
            let source = ("focus", include_str!("shaders/focus.wgsl"), entry);
            Fullscreen::new(device, lens, &layout, source, format, &[])
        };
        Self {
            circle: pipeline("circle", CIRCLE_FORMAT),
            largest: pipeline("largest", CIRCLE_FORMAT),
            gather: pipeline("gather", HDR_FORMAT),
            uniform: device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("focus"),
                size: size_of::<FocusUniform>() as u64,
                usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            }),
            layout,
        }
    }

    /// Textures for `targets`; what is gathered is `light`.
    pub(super) fn chain(
        &self,
        device: &wgpu::Device,
        targets: &Targets,
        light: &wgpu::TextureView,
    ) -> FocusChain {
        let (width, height) = targets.size;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a small positive number"
        )]
        let block = (MAX_BLUR * height as f32).ceil().max(1.0) as u32;
        let view = |label, (width, height)| {
            let texture = device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: CIRCLE_FORMAT,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
                view_formats: &[],
            });
            texture.create_view(&wgpu::TextureViewDescriptor::default())
        };
        let circles = view("circles of confusion", targets.size);
        let widest = view("largest circles", (width.div_ceil(block), height.div_ceil(block)));
        let none = view("no circles", (1, 1));
        let bind = |circles: &wgpu::TextureView, widest: &wgpu::TextureView| {
            let entry = |binding, view| wgpu::BindGroupEntry {
                binding,
                resource: wgpu::BindingResource::TextureView(view),
            };
            device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("focus"),
                layout: &self.layout,
                entries: &[
                    wgpu::BindGroupEntry { binding: 0, resource: self.uniform.as_entire_binding() },
                    entry(1, &targets.depth),
                    entry(2, circles),
                    entry(3, widest),
                    entry(4, light),
                ],
            })
        };
        FocusChain {
            result: light_texture(device, "focused light", targets.size),
            circle: bind(&none, &none),
            largest: bind(&circles, &none),
            gather: bind(&circles, &widest),
            circles,
            widest,
            block,
        }
    }

    /// Takes the depth of a tile that has just been drawn.
    pub(super) fn take_depth(
        &self,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        lens: &LensGroup,
        chain: &FocusChain,
        tile: &Tile,
    ) {
        let whole = |number: u32| i32::try_from(number).unwrap_or(i32::MAX);
        let corner = [whole(tile.corner.0), whole(tile.corner.1)];
        let uniform = FocusUniform { corner, block: whole(chain.block), unused: 0 };
        queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&uniform));
        let (groups, area) = ([&lens.group, &chain.circle], (tile.corner, tile.inside));
        self.circle.draw_part(encoder, groups, &chain.circles, area);
    }

    /// Fills the chain's result.
    pub(super) fn draw<'a>(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        timestamps: [Option<wgpu::RenderPassTimestampWrites<'a>>; 2],
        lens: &LensGroup,
        chain: &FocusChain,
    ) {
        let [begin, end] = timestamps;
        self.largest.draw(encoder, begin, [&lens.group, &chain.largest], &chain.widest, None);
        self.gather.draw(encoder, end, [&lens.group, &chain.gather], &chain.result, None);
    }
}
