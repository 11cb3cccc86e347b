// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A large picture's parts, which are drawn one after another.
//!
//! Multisampled targets take six times the memory of the resolved light, so only the scene is drawn by tiles, each with a
//! projection off the centre; all that follows works on the whole picture, and no seam can come of glare, focus or
//! exposure.

use glam::{Mat4, Vec2, Vec4};

/// A part of a picture. All tiles of a picture have the same size; the last ones may reach beyond its edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tile {
    /// Upper left corner in pixels of the picture.
    pub(crate) corner: (u32, u32),
    /// Part of the tile inside the picture, in pixels.
    pub(crate) inside: (u32, u32),
    /// Middle in clip coordinates of the whole picture.
    center: Vec2,
    /// Size relative to the whole picture.
    scale: Vec2,
    /// Number of tiles after it.
    pub(crate) left: u32,
}

impl Tile {
    /// Clip space of the whole picture to that of the tile.
    pub(crate) fn crop(&self) -> Mat4 {
        let (center, scale) = (self.center, self.scale);
        Mat4::from_cols(
            Vec4::new(1.0 / scale.x, 0.0, 0.0, 0.0),
            Vec4::new(0.0, 1.0 / scale.y, 0.0, 0.0),
            Vec4::new(0.0, 0.0, 1.0, 0.0),
            Vec4::new(-center.x / scale.x, -center.y / scale.y, 0.0, 1.0),
        )
    }

    /// Middle in clip coordinates of the whole picture, and size relative to it.
    pub(crate) fn clip_area(&self) -> ([f32; 2], [f32; 2]) {
        (self.center.to_array(), self.scale.to_array())
    }
}

/// Edges of tiles are multiples of this, so that a device takes the same pixels together for its derivatives.
const ALIGNMENT: u32 = 8;

/// Size of the tiles of a picture of `size` that have at most `tile_px` pixels, or are the smallest there are: halved across
/// their longer edge until they fit.
pub(crate) fn tile_size((width, height): (u32, u32), tile_px: u32) -> (u32, u32) {
    let (mut across, mut down) = (1, 1);
    loop {
        let part = |edge: u32, count: u32| match count {
            1 => edge,
            _ => edge.div_ceil(count).next_multiple_of(ALIGNMENT).min(edge),
        };
        let (tile_width, tile_height) = (part(width, across), part(height, down));
        let fits = u64::from(tile_width) * u64::from(tile_height) <= u64::from(tile_px);
        if fits || tile_width.max(tile_height) <= ALIGNMENT {
            return (tile_width, tile_height);
        }
        if tile_width >= tile_height { across *= 2 } else { down *= 2 }
    }
}

/// The tiles of a picture, row by row.
pub(crate) fn tiles(
    (width, height): (u32, u32),
    (tile_width, tile_height): (u32, u32),
) -> impl Iterator<Item = Tile> + use<> {
    let (across, down) = (width.div_ceil(tile_width), height.div_ceil(tile_height));
    let whole = Vec2::new(width as f32, height as f32);
    let size = Vec2::new(tile_width as f32, tile_height as f32);
    (0..across * down).map(move |number| {
        let corner = (number % across * tile_width, number / across * tile_height);
        let middle = 2.0 * (Vec2::new(corner.0 as f32, corner.1 as f32) + 0.5 * size) / whole;
        Tile {
            corner,
            inside: (tile_width.min(width - corner.0), tile_height.min(height - corner.1)),
            center: Vec2::new(middle.x - 1.0, 1.0 - middle.y),
            scale: size / whole,
            left: across * down - 1 - number,
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_cover_every_pixel_once() {
        for (size, tile_px) in
            [((7680, 4320), 4_000_000), ((101, 37), 100), ((5, 1), 8), ((640, 360), 1 << 24)]
        {
            let tile_size = tile_size(size, tile_px);
            assert!(tile_size.0 * tile_size.1 <= tile_px, "{size:?}: {tile_size:?}");
            let mut covered = vec![0u8; (size.0 * size.1) as usize];
            for tile in tiles(size, tile_size) {
                for y in tile.corner.1..tile.corner.1 + tile.inside.1 {
                    for x in tile.corner.0..tile.corner.0 + tile.inside.0 {
                        covered[(y * size.0 + x) as usize] += 1;
                    }
                }
            }
            assert!(covered.iter().all(|&count| count == 1), "{size:?} in tiles of {tile_size:?}");
        }
    }

    #[test]
    fn a_whole_picture_is_not_cropped_and_corners_meet() {
        let whole: Vec<Tile> = tiles((640, 360), (640, 360)).collect();
        assert_eq!(whole.len(), 1, "one tile");
        assert_eq!(whole[0].crop(), Mat4::IDENTITY, "as it is");
        let parts: Vec<Tile> = tiles((640, 360), (320, 180)).collect();
        let right_below = parts[3].crop();
        let corner = right_below * Vec4::new(0.0, 0.0, 0.3, 1.0);
        assert!(
            corner.abs_diff_eq(Vec4::new(-1.0, 1.0, 0.3, 1.0), 1.0e-6),
            "middle of the picture: {corner}"
        );
        assert_eq!(parts[3].left, 0, "the last one");
    }
}
