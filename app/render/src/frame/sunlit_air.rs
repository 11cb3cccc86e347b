// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Grid of the air before the eye, in columns of the view and slices by distance.

use windfall_core::shared_constants;

shared_constants! {
    /// Columns of the view from left to right, and from top to bottom.
    pub(crate) const SHAFT_COLUMNS: u32 = 160;
    pub(crate) const SHAFT_ROWS: u32 = 90;
    /// Slices by the square root of the distance.
    pub(crate) const SHAFT_SLICES: u32 = 48;
    /// Distance of the farthest from the eye in metres, about as far as the shadow maps reach.
    pub(crate) const SHAFT_REACH_M: f32 = 90.0;
    /// Edge of a workgroup of columns.
    pub(crate) const SHAFT_GROUP_SIZE: u32 = 8;
}

/// Format of shares of sunlight: the only one with fewer than 32 bits that every device filters and stores.
pub(crate) const SHARE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Least share of light of the horizon that the air within reach adds, below which shafts are not drawn.
const LEAST_VEIL: f32 = 0.02;

/// A grid; of a single cell where it is not used.
pub(crate) fn grid(device: &wgpu::Device, is_used: bool) -> wgpu::TextureView {
    let [width, height, depth_or_array_layers] =
        if is_used { [SHAFT_COLUMNS, SHAFT_ROWS, SHAFT_SLICES] } else { [1; 3] };
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some("sunlit air"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D3,
        format: SHARE_FORMAT,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::STORAGE_BINDING,
        view_formats: &[],
    });
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

/// Returns true if haze of an optical depth per metre shows shafts of light.
pub(crate) fn is_seen(haze_per_m: f32, sun_illuminance: f32) -> bool {
    sun_illuminance > 0.0 && 1.0 - (-haze_per_m * SHAFT_REACH_M).exp() > LEAST_VEIL
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shafts_need_haze_and_a_sun() {
        let haze_per_m = |visibility_m: f32| 3.912 / visibility_m;
        assert!(is_seen(haze_per_m(900.0), 10.0), "a hazy evening");
        assert!(!is_seen(haze_per_m(50_000.0), 10.0), "clear air");
        assert!(!is_seen(haze_per_m(900.0), 0.0), "no sun");
    }
}
