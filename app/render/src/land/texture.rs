// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The land as shaders read it: a texel for every grid point of the hills.

use glam::Vec2;
use windfall_core::terrain::Hills;
use windfall_core::{NO_WATER_M, shared_struct};

use super::Land;

/// Grid points to each side whose mean a point is compared with to distinguish hollows from knolls.
const NEIGHBOURHOOD: i64 = 3;
/// Height in metres below or above that mean at which a place is altogether a hollow or a knoll.
const HOLLOW_M: f32 = 0.6;

shared_struct! {
    /// Size of the hills, and how high the ground and the water lie.
    pub(crate) struct LandUniform {
        /// Cells per metre, 0 on level ground.
        cells_per_m: f32,
        /// Cells along an edge.
        cells: u32,
        /// Height of the ground at the origin.
        base_m: f32,
        /// Height of the water, or [`NO_WATER_M`].
        water_m: f32,
        /// Centre x, z of the paving.
        paved_center_m: [f32; 2],
        /// Half of its edges; 0 without paving.
        paved_half_m: [f32; 2],
        /// Share to which all that lies and stands there is wet.
        wet: f32,
        /// Unused.
        unused: f32,
        /// Unused.
        unused_pair: [f32; 2],
    }
}

impl LandUniform {
    pub(crate) fn of(land: &Land) -> Self {
        let (cells_per_m, cells) = land.hills().map_or((0.0, 1), |hills| (1.0 / hills.cell_m, hills.cells));
        let paving = land.paving();
        Self {
            cells_per_m,
            cells,
            base_m: land.base_m(),
            water_m: land.water_m().unwrap_or(NO_WATER_M),
            paved_center_m: paving.map_or(Vec2::ZERO, |paving| paving.center_m).to_array(),
            paved_half_m: paving.map_or(Vec2::ZERO, |paving| paving.half_m).to_array(),
            wet: land.wet(),
            unused: 0.0,
            unused_pair: [0.0; 2],
        }
    }
}

/// Height above the origin's in metres, rise along x and along z, and how much of a hollow (1) or a knoll (-1) a grid
/// point is; row by row.
pub(crate) fn land_texels(hills: &Hills) -> Vec<[f32; 4]> {
    let cells = i64::from(hills.cells);
    let points = (0..cells).flat_map(|z| (0..cells).map(move |x| (x, z)));
    let texel = |(x, z): (i64, i64)| {
        let rise = |a: f32, b: f32| (b - a) * 0.5 / hills.cell_m;
        let around = [(-NEIGHBOURHOOD, 0), (NEIGHBOURHOOD, 0), (0, -NEIGHBOURHOOD), (0, NEIGHBOURHOOD)];
        let mean = 0.25 * around.iter().map(|(dx, dz)| hills.at(x + dx, z + dz)).sum::<f32>();
        [
            hills.at(x, z),
            rise(hills.at(x - 1, z), hills.at(x + 1, z)),
            rise(hills.at(x, z - 1), hills.at(x, z + 1)),
            ((mean - hills.at(x, z)) / HOLLOW_M).clamp(-1.0, 1.0),
        ]
    };
    points.map(texel).collect()
}

/// The texture of the land; one texel for level ground.
pub(crate) fn land_texture(device: &wgpu::Device, queue: &wgpu::Queue, land: &Land) -> wgpu::TextureView {
    let view = grid_texture(device, "hills", wgpu::TextureFormat::Rgba32Float, land);
    let texels = land.hills().map_or_else(|| vec![[0.0; 4]], land_texels);
    write_grid(queue, &view, &texels);
    view
}

/// A texture with a texel for every grid point of the hills; one texel for level ground.
pub(crate) fn grid_texture(
    device: &wgpu::Device,
    label: &str,
    format: wgpu::TextureFormat,
    land: &Land,
) -> wgpu::TextureView {
    let cells = land.hills().map_or(1, |hills| hills.cells);
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width: cells, height: cells, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

/// Fills such a texture, row by row.
pub(crate) fn write_grid<const N: usize>(queue: &wgpu::Queue, view: &wgpu::TextureView, texels: &[[f32; N]]) {
    let texture = view.texture();
    let bytes: &[u8] = bytemuck::cast_slice(texels.as_flattened());
    let bytes_per_row = u32::try_from(bytes.len()).unwrap_or(u32::MAX) / texture.height();
    let layout =
        wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(bytes_per_row), rows_per_image: None };
    queue.write_texture(texture.as_image_copy(), bytes, layout, texture.size());
}

#[cfg(test)]
mod tests {
    use windfall_core::scene::Terrain;

    use super::*;

    #[test]
    fn texels_tell_slopes_and_hollows() {
        let hills = Hills::grow(&Terrain { levels: 5, ..Terrain::default() });
        let texels = land_texels(&hills);
        let lowest = texels.iter().min_by(|a, b| a[0].total_cmp(&b[0])).expect("texels");
        let highest = texels.iter().max_by(|a, b| a[0].total_cmp(&b[0])).expect("texels");
        assert!(lowest[3] > 0.0 && highest[3] < 0.0, "a hollow at {lowest:?}, a knoll at {highest:?}");
        for axis in [1, 2] {
            let sum: f32 = texels.iter().map(|texel| texel[axis]).sum();
            assert!(sum.abs() < 1.0e-2, "round the torus rises cancel: {sum}");
            assert!(texels.iter().any(|texel| texel[axis] > 0.05), "there are slopes along axis {axis}");
        }
    }
}
