// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Motion blur: draws leaves out along their ways, from those, depth and resolved light.

use windfall_core::shared_struct;

use super::blur_group::BlurGroup;
use super::fullscreen::{Fullscreen, light_texture, number_texture};
use super::group::{LensGroup, MAX_BLUR, Shot, blur_block};
use crate::gpu::targets::{HDR_FORMAT, Targets, WAY_FORMAT};
use crate::gpu::tile::Tile;

shared_struct! {
    /// The tile whose ways are taken.
    pub(crate) struct ShutterUniform {
        /// Corner of the tile in the picture.
        corner_px: [i32; 2],
        /// Edge of a block.
        block_px: i32,
        /// Most pixels a way is long to either side.
        max_px: f32,
    }
}

/// The three steps: ways and distances, the longest way in blocks, and the gathering.
#[derive(Debug)]
pub(crate) struct ShutterPass {
    take: Fullscreen,
    longest: Fullscreen,
    gather: Fullscreen,
    group: BlurGroup,
}

/// Resources for pictures of one size.
#[derive(Debug)]
pub(crate) struct ShutterChain {
    /// Light with all ways drawn out.
    pub(crate) result: wgpu::TextureView,
    ways: wgpu::TextureView,
    longest_ways: wgpu::TextureView,
    /// By what they write.
    take: wgpu::BindGroup,
    longest: wgpu::BindGroup,
    gather: wgpu::BindGroup,
    block: u32,
}

impl ShutterPass {
    pub(crate) fn new(device: &wgpu::Device, lens: &LensGroup) -> Self {
        let group = BlurGroup::new(device, "shutter", size_of::<ShutterUniform>(), 4);
        let pipeline = |entry, format| {
            let source = ("lens/shutter_pass", entry);
            Fullscreen::new(device, lens, &group.layout, source, format, &[])
        };
        Self {
            take: pipeline("take", HDR_FORMAT),
            longest: pipeline("block_longest", WAY_FORMAT),
            gather: pipeline("gather", HDR_FORMAT),
            group,
        }
    }

    /// Textures for `targets`; nothing if nobody draws ways into them.
    pub(crate) fn chain(&self, device: &wgpu::Device, targets: &Targets) -> Option<ShutterChain> {
        let drawn = targets.ways.as_ref()?;
        let (width, height) = targets.size;
        let block = blur_block(height);
        let view = |label, format, size| number_texture(device, label, format, size);
        let ways = view("ways", HDR_FORMAT, targets.size);
        let longest_ways = view("longest ways", WAY_FORMAT, (width.div_ceil(block), height.div_ceil(block)));
        let none = view("no ways", WAY_FORMAT, (1, 1));
        let (depth, light) = (&targets.depth, &targets.resolved);
        let bind = |ways, longest| self.group.bind(device, depth, &[&drawn.resolved, ways, longest, light]);
        Some(ShutterChain {
            result: light_texture(device, "light while the shutter is open", targets.size),
            take: bind(&none, &none),
            longest: bind(&ways, &none),
            gather: bind(&ways, &longest_ways),
            ways,
            longest_ways,
            block,
        })
    }

    /// Takes ways and depth of a tile that has just been drawn.
    pub(crate) fn take(
        &self,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        lens: &LensGroup,
        chain: &ShutterChain,
        (tile, shot): (&Tile, &Shot),
    ) {
        let whole = |number: u32| i32::try_from(number).unwrap_or(i32::MAX);
        let uniform = ShutterUniform {
            corner_px: [whole(tile.corner.0), whole(tile.corner.1)],
            block_px: whole(chain.block),
            max_px: MAX_BLUR * shot.size.1 as f32,
        };
        queue.write_buffer(&self.group.uniform, 0, bytemuck::bytes_of(&uniform));
        let area = (tile.corner, tile.inside);
        self.take.draw_part(encoder, [&lens.group, &chain.take], &chain.ways, area);
    }

    /// Fills the chain's result.
    pub(crate) fn draw<'a>(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        timestamps: [Option<wgpu::RenderPassTimestampWrites<'a>>; 2],
        lens: &LensGroup,
        chain: &ShutterChain,
    ) {
        let [begin, end] = timestamps;
        self.longest.draw(encoder, begin, [&lens.group, &chain.longest], &chain.longest_ways, None);
        self.gather.draw(encoder, end, [&lens.group, &chain.gather], &chain.result, None);
    }
}
