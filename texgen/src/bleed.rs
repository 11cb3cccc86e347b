// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Carries the colour of the edge outward over everything transparent, so that filtering never mixes in a colour
//! that is not the leaf's.

use image::RgbaImage;

/// Fills the colour of every texel with zero alpha from its nearest opaque neighbours; alpha stays.
pub(crate) fn bleed(image: &mut RgbaImage) {
    let (width, height) = image.dimensions();
    let stride = width as usize;
    let index = |x: u32, y: u32| y as usize * stride + x as usize;
    let mut known: Vec<bool> = image.pixels().map(|texel| texel[3] > 0).collect();
    let neighbours = |x: u32, y: u32| {
        let (left, right) = (x.saturating_sub(1), (x + 1).min(width - 1));
        let (top, bottom) = (y.saturating_sub(1), (y + 1).min(height - 1));
        (top..=bottom).flat_map(move |ny| (left..=right).map(move |nx| (nx, ny)))
    };
    let mut queued = known.clone();
    let mut wave: Vec<(u32, u32)> = Vec::new();
    let mut reach = |known: &[bool], from: &mut dyn Iterator<Item = (u32, u32)>| {
        let mut next = Vec::new();
        for (x, y) in from {
            for (nx, ny) in neighbours(x, y) {
                if !queued[index(nx, ny)] && !known[index(nx, ny)] {
                    queued[index(nx, ny)] = true;
                    next.push((nx, ny));
                }
            }
        }
        next
    };
    let mut opaque = (0..height)
        .flat_map(|y| (0..width).map(move |x| (x, y)))
        .filter(|(x, y)| known[index(*x, *y)])
        .collect::<Vec<_>>()
        .into_iter();
    wave.extend(reach(&known, &mut opaque));
    while !wave.is_empty() {
        // A whole ring is averaged before any of it counts as known, so the order of texels does not matter.
        let colours: Vec<[u8; 3]> = wave
            .iter()
            .map(|&(x, y)| {
                let mut sum = [0_u32; 3];
                let mut count = 0;
                for (nx, ny) in neighbours(x, y).filter(|(nx, ny)| known[index(*nx, *ny)]) {
                    let texel = image.get_pixel(nx, ny);
                    for (total, channel) in sum.iter_mut().zip(texel.0) {
                        *total += u32::from(channel);
                    }
                    count += 1;
                }
                sum.map(|total| u8::try_from((total + count / 2) / count.max(1)).unwrap_or(u8::MAX))
            })
            .collect();
        for (&(x, y), colour) in wave.iter().zip(colours) {
            image.get_pixel_mut(x, y).0[..3].copy_from_slice(&colour);
            known[index(x, y)] = true;
        }
        wave = reach(&known, &mut wave.into_iter());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgba;

    #[test]
    fn one_texel_colours_the_whole_image() {
        let mut image = RgbaImage::new(16, 16);
        image.put_pixel(3, 5, Rgba([200, 100, 50, 255]));
        bleed(&mut image);
        for (x, y, texel) in image.enumerate_pixels() {
            assert_eq!(texel.0[..3], [200, 100, 50], "colour at {x}, {y}");
            assert_eq!(texel[3] > 0, (x, y) == (3, 5), "alpha stays as it was at {x}, {y}");
        }
    }

    #[test]
    fn edges_keep_their_own_colour() {
        let mut image = RgbaImage::new(32, 32);
        for y in 8..24 {
            image.put_pixel(12, y, Rgba([220, 40, 20, 255]));
            image.put_pixel(20, y, Rgba([20, 160, 40, 128]));
        }
        bleed(&mut image);
        assert_eq!(image.get_pixel(11, 16).0, [220, 40, 20, 0], "left of the red edge");
        assert_eq!(image.get_pixel(21, 16).0, [20, 160, 40, 0], "right of the green edge");
    }

    #[test]
    fn an_empty_image_is_left_alone() {
        let mut image = RgbaImage::new(4, 4);
        bleed(&mut image);
        assert!(image.pixels().all(|texel| texel.0 == [0; 4]), "nothing to bleed");
    }
}
