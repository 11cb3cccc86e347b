// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Depth of field, from depth and resolved light.

use windfall_core::shared_struct;

use super::blur_group::BlurGroup;
use super::fullscreen::{Fullscreen, light_texture, number_texture};
use super::group::{LensGroup, blur_block};
use crate::gpu::targets::{HDR_FORMAT, Targets};
use crate::gpu::tile::Tile;

/// Format of radii of circles of confusion, in pixels.
const CIRCLE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R16Float;

shared_struct! {
    /// The tile that is focused.
    pub(crate) struct FocusUniform, padding 4 {
        /// Corner of the tile in the picture.
        corner_px: [i32; 2],
        /// Edge of a block.
        block_px: i32,
    }
}

/// The three steps: radii from depth, their largest in blocks, and the gathering.
#[derive(Debug)]
pub(crate) struct FocusPass {
    circle: Fullscreen,
    largest: Fullscreen,
    gather: Fullscreen,
    group: BlurGroup,
}

/// Resources for pictures of one size.
#[derive(Debug)]
pub(crate) struct FocusChain {
    /// Light in focus and out of it.
    pub(crate) result: wgpu::TextureView,
    circles: wgpu::TextureView,
    widest: wgpu::TextureView,
    /// By what they write.
    circle: wgpu::BindGroup,
    largest: wgpu::BindGroup,
    gather: wgpu::BindGroup,
    block: u32,
}

impl FocusPass {
    pub(crate) fn new(device: &wgpu::Device, lens: &LensGroup) -> Self {
        let group = BlurGroup::new(device, "focus", size_of::<FocusUniform>(), 3);
        let pipeline = |entry, format| {
            let source = ("lens/focus_pass", entry);
            Fullscreen::new(device, lens, &group.layout, source, format, &[])
        };
        Self {
            circle: pipeline("circle", CIRCLE_FORMAT),
            largest: pipeline("largest", CIRCLE_FORMAT),
            gather: pipeline("gather", HDR_FORMAT),
            group,
        }
    }

    /// Textures for `targets`; what is gathered is `light`.
    pub(crate) fn chain(
        &self,
        device: &wgpu::Device,
        targets: &Targets,
        light: &wgpu::TextureView,
    ) -> FocusChain {
        let (width, height) = targets.size;
        let block = blur_block(height);
        let view = |label, size| number_texture(device, label, CIRCLE_FORMAT, size);
        let circles = view("circles of confusion", targets.size);
        let widest = view("largest circles", (width.div_ceil(block), height.div_ceil(block)));
        let none = view("no circles", (1, 1));
        let bind = |circles, widest| self.group.bind(device, &targets.depth, &[circles, widest, light]);
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
    pub(crate) fn take_depth(
        &self,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        lens: &LensGroup,
        chain: &FocusChain,
        tile: &Tile,
    ) {
        let whole = |number: u32| i32::try_from(number).unwrap_or(i32::MAX);
        let corner = [whole(tile.corner.0), whole(tile.corner.1)];
        let uniform = FocusUniform { corner_px: corner, block_px: whole(chain.block), padding: [0; 4] };
        queue.write_buffer(&self.group.uniform, 0, bytemuck::bytes_of(&uniform));
        let (groups, area) = ([&lens.group, &chain.circle], (tile.corner, tile.inside));
        self.circle.draw_part(encoder, groups, &chain.circles, area);
    }

    /// Fills the chain's result.
    pub(crate) fn draw<'a>(
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
