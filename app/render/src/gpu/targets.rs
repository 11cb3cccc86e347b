// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The textures a frame is drawn into before it is tone mapped.

use super::tile::{Tile, tile_size, tiles};
use crate::error::RenderError;

/// Samples per pixel: four is what every WebGPU adapter offers.
pub(crate) const SAMPLE_COUNT: u32 = 4;
/// Format of light before tone mapping.
pub(crate) const HDR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
/// Format of depth, reversed: 0 is infinity.
pub(crate) const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
/// Format of ways over the picture, in pixels; the last component is the part of a pixel that moves.
pub(crate) const WAY_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

/// Multisampled light and depth of a tile, and the resolved light of the picture. Most pictures are one tile.
#[derive(Debug)]
pub(crate) struct Targets {
    /// Size of the picture in pixels.
    pub(crate) size: (u32, u32),
    /// Edge of a shaded pixel in pixels of the picture: 1, or 2 for a sample in each.
    pub(crate) shading_px: u32,
    pub(crate) color: wgpu::TextureView,
    pub(crate) depth: wgpu::TextureView,
    pub(crate) resolved: wgpu::TextureView,
    /// Resolved light of a tile of a picture that has more than one.
    resolved_tile: Option<wgpu::TextureView>,
    /// Size of a tile in pixels of the picture.
    pub(crate) tile_size: (u32, u32),
    /// Largest motion in a tile while the shutter is open; only if the lens asks for it.
    pub(crate) ways: Option<Ways>,
}

/// Ways over a tile: of every sample, and of pixels on average.
#[derive(Debug)]
pub(crate) struct Ways {
    pub(crate) samples: wgpu::TextureView,
    pub(crate) resolved: wgpu::TextureView,
}

impl Targets {
    /// Targets of pictures of `size` pixels, of which at most `tile_px` are drawn at once and `shading_px` along each edge are
    /// shaded together, with room for ways or without.
    pub(crate) fn new(
        device: &wgpu::Device,
        size: (u32, u32),
        (tile_px, shading_px): (u32, u32),
        has_ways: bool,
    ) -> Result<Self, RenderError> {
        let limit = device.limits().max_texture_dimension_2d;
        let (width, height) = size;
        if width == 0 || height == 0 || width > limit || height > limit {
            return Err(RenderError::Size { width, height, limit });
        }
        let (across, down) = tile_size(size, tile_px);
        let tile_size = (across.next_multiple_of(shading_px), down.next_multiple_of(shading_px));
        let shaded_size = (tile_size.0 / shading_px, tile_size.1 / shading_px);
        let attachment = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let sampled = attachment | wgpu::TextureUsages::TEXTURE_BINDING;
        let readable = sampled | wgpu::TextureUsages::COPY_DST;
        let view = |label, format, (width, height), sample_count, usage| {
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
        let resolved_tile = (shading_px == 1 && tile_size != size).then(|| {
            view("resolved tile", HDR_FORMAT, tile_size, 1, attachment | wgpu::TextureUsages::COPY_SRC)
        });
        Ok(Self {
            size,
            shading_px,
            color: view("light", HDR_FORMAT, shaded_size, SAMPLE_COUNT, sampled),
            depth: view("depth", DEPTH_FORMAT, shaded_size, SAMPLE_COUNT, sampled),
            resolved: view("resolved light", HDR_FORMAT, size, 1, readable),
            resolved_tile,
            tile_size,
            ways: has_ways.then(|| Ways {
                samples: view("ways", WAY_FORMAT, shaded_size, SAMPLE_COUNT, attachment),
                resolved: view("resolved ways", WAY_FORMAT, shaded_size, 1, sampled),
            }),
        })
    }

    /// The tiles of the picture, one after another.
    pub(crate) fn tiles(&self) -> impl Iterator<Item = Tile> + use<> {
        tiles(self.size, self.tile_size)
    }

    /// Size of the whole picture in shaded pixels.
    pub(crate) fn shaded_size(&self) -> (u32, u32) {
        (self.size.0.div_ceil(self.shading_px), self.size.1.div_ceil(self.shading_px))
    }

    /// Resolve target of the scene pass; none where its samples become pixels.
    pub(crate) fn resolve(&self) -> Option<&wgpu::TextureView> {
        (self.shading_px == 1).then(|| self.resolved_tile.as_ref().unwrap_or(&self.resolved))
    }

    /// Puts a tile that has been resolved into its place in the picture.
    pub(crate) fn place(&self, encoder: &mut wgpu::CommandEncoder, tile: &Tile) {
        let Some(resolved_tile) = &self.resolved_tile else { return };
        let mut to = self.resolved.texture().as_image_copy();
        (to.origin.x, to.origin.y) = tile.corner;
        let (width, height) = tile.inside;
        let extent = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
        encoder.copy_texture_to_texture(resolved_tile.texture().as_image_copy(), to, extent);
    }
}
