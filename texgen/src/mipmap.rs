// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Mip chains of leaves: colour averaged in linear light by coverage, alpha scaled so that far leaves neither
//! shrink nor swell (after Castaño, "Computing alpha mipmaps", 2010). Petioles and other threads, which averaging would break into dots,
//! stay a texel wide.

use image::RgbaImage;

use crate::distance::nearest_seed;
use crate::math::{linear_from_srgb, srgb_from_linear, to_byte};

/// Weight of colour without alpha: enough to pass bled colour on, too little to tint the leaf.
const BLED_WEIGHT: f32 = 1e-4;
/// Levels with fewer texels keep the last scale: a share of so few texels says little.
const FEWEST_TEXELS: usize = 64;
/// Alpha, in bytes, from which a texel counts as covered.
const COVERED: u8 = 128;

/// Half width that threads of a picture do not exceed, as a share of its edge.
const THREAD: f32 = 1.0 / 85.0;
/// Edges in texels from which threads stay whole, and up to which they are as thin as they are: smaller leaves show shares of pixels.
const WHOLE_THREADS: [u32; 2] = [64, 8];

/// A level while it is averaged: linear colour and alpha, and alpha of threads alone.
struct Level {
    size: u32,
    texels: Vec<[f32; 4]>,
    threads: Vec<f32>,
}

/// All levels of a square image whose side is a power of two, from itself down to one texel.
pub(crate) fn chain(base: RgbaImage) -> Vec<RgbaImage> {
    let table: Vec<f32> = (0..=u8::MAX).map(linear_from_srgb).collect();
    let texels = base
        .pixels()
        .map(|texel| {
            let [r, g, b, a] = texel.0;
            let light = |byte: u8| table[usize::from(byte)];
            [light(r), light(g), light(b), f32::from(a) / 255.0]
        })
        .collect();
    let mut level = Level { size: base.width(), texels, threads: Vec::new() };
    let share = covered_share(&base);
    let mut levels = vec![base];
    let mut scale = 1.0;
    while level.size > 1 {
        level = level.halved();
        if level.threads.is_empty() {
            level.threads = level.find_threads();
        }
        if level.texels.len() >= FEWEST_TEXELS {
            scale = level.scale_for(share);
        }
        levels.push(level.to_image(scale));
    }
    levels
}

/// All levels of a square picture of plain numbers whose side is a power of two, each the average of four.
pub(crate) fn plain_chain(base: RgbaImage) -> Vec<RgbaImage> {
    let mut levels = vec![base];
    while let Some(fine) = levels.last().filter(|level| level.width() > 1) {
        let half = fine.width() / 2;
        let coarse = RgbaImage::from_fn(half, half, |x, y| {
            let sum = |channel: usize| {
                [(0, 0), (1, 0), (0, 1), (1, 1)]
                    .map(|(right, down)| u32::from(fine.get_pixel(2 * x + right, 2 * y + down)[channel]))
                    .iter()
                    .sum::<u32>()
            };
            image::Rgba(std::array::from_fn(|channel| {
                u8::try_from((sum(channel) + 2) / 4).unwrap_or(u8::MAX)
            }))
        });
        levels.push(coarse);
    }
    levels
}

/// Share of texels that count as covered.
pub(crate) fn covered_share(image: &RgbaImage) -> f32 {
    let covered = image.pixels().filter(|texel| texel[3] >= COVERED).count();
    covered as f32 / image.pixels().len() as f32
}

impl Level {
    /// The next level.
    fn halved(&self) -> Self {
        let half = self.size as usize / 2;
        let stride = self.size as usize;
        let texels = (0..half * half)
            .map(|i| {
                let corner = i / half * 2 * stride + i % half * 2;
                let mut sum = [0.0; 4];
                let mut weights = 0.0;
                for at in [corner, corner + 1, corner + stride, corner + stride + 1] {
                    let texel = self.texels[at];
                    let weight = texel[3] + BLED_WEIGHT;
                    for channel in 0..3 {
                        sum[channel] += texel[channel] * weight;
                    }
                    sum[3] += texel[3] / 4.0;
                    weights += weight;
                }
                [sum[0] / weights, sum[1] / weights, sum[2] / weights, sum[3]]
            })
            .collect();
        let widest = |corner: usize| {
            let four = [corner, corner + 1, corner + stride, corner + stride + 1];
            four.iter().map(|&at| self.threads[at]).fold(0.0, f32::max)
        };
        let threads = match self.threads.len() {
            0 => Vec::new(),
            _ => (0..half * half).map(|i| widest(i / half * 2 * stride + i % half * 2)).collect(),
        };
        Self { size: self.size / 2, texels, threads }
    }

    /// Factor on alpha with which a share of texels is covered.
    fn scale_for(&self, share: f32) -> f32 {
        let mut alphas: Vec<f32> = self.texels.iter().map(|texel| texel[3]).collect();
        alphas.sort_by(|a, b| b.total_cmp(a));
        let wanted = (0..alphas.len()).min_by(|&a, &b| {
            let error = |count: usize| (count as f32 / alphas.len() as f32 - share).abs();
            error(a).total_cmp(&error(b))
        });
        // Half way between the last texel to be covered and the first not to be.
        match wanted {
            Some(count) if count > 0 => {
                let threshold = (alphas[count - 1] + alphas[count]) / 2.0;
                (0.5 / threshold.max(0.05)).clamp(0.5, 4.0)
            }
            _ => 1.0,
        }
    }

    /// Alpha where the level is thinner than a disc of [`THREAD`]: what opening it by that disc takes away, but for rims.
    fn find_threads(&self) -> Vec<f32> {
        let size = self.size as usize;
        let reach = THREAD * size as f32;
        let (depth, _) = nearest_seed(size, size, |at| self.texels[at][3] < 0.5);
        let (away, _) = nearest_seed(size, size, |at| depth.data[at] > reach);
        let rim = reach + 1.5;
        self.texels
            .iter()
            .zip(&away.data)
            .map(|(texel, &away)| if away > rim { texel[3] } else { 0.0 })
            .collect()
    }

    /// The level in bytes.
    fn to_image(&self, scale: f32) -> RgbaImage {
        let [own, whole, thin] =
            [self.size, WHOLE_THREADS[0], WHOLE_THREADS[1]].map(|edge| edge.ilog2() as f32);
        let wholeness = ((own - thin) / (whole - thin)).clamp(0.0, 1.0);
        RgbaImage::from_fn(self.size, self.size, |x, y| {
            let at = y as usize * self.size as usize + x as usize;
            let [r, g, b, a] = self.texels[at];
            let covered = a * scale;
            let alpha = covered.max(covered + (self.threads[at] - covered) * wholeness);
            image::Rgba([srgb_from_linear(r), srgb_from_linear(g), srgb_from_linear(b), to_byte(alpha)])
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgba;

    /// Thin spokes, which plain averaging would fade away.
    fn spokes() -> RgbaImage {
        RgbaImage::from_fn(128, 128, |x, y| {
            let bearing = (f64::from(y) - 63.5).atan2(f64::from(x) - 63.5);
            let radius = (f64::from(y) - 63.5).hypot(f64::from(x) - 63.5);
            let texels_inside = ((bearing * 9.0).sin() - 0.2) * radius / 9.0;
            #[expect(clippy::cast_possible_truncation, reason = "a share of a texel")]
            let alpha = to_byte(texels_inside as f32 + 0.5);
            Rgba([180, 120, 30, alpha])
        })
    }

    #[test]
    fn coverage_is_kept() {
        let levels = chain(spokes());
        assert_eq!(levels.len(), 8, "128 halves seven times");
        let share = covered_share(&levels[0]);
        for level in levels.iter().filter(|level| level.width() >= 8) {
            let found = covered_share(level);
            assert!((found - share).abs() < 0.02, "{} px: {found} covered, expected {share}", level.width());
        }
    }

    /// A disc on a slanted stalk, two and a half texels wide.
    fn lollipop() -> RgbaImage {
        RgbaImage::from_fn(256, 256, |x, y| {
            let (x, y) = (x as f32 - 127.5, y as f32 - 127.5);
            let on_stalk = y > 0.0 && (x - 0.4 * y).abs() < 1.25;
            let on_disc = x * x + (y + 40.0) * (y + 40.0) < 3600.0;
            Rgba([120, 60, 20, if on_stalk || on_disc { 255 } else { 0 }])
        })
    }

    #[test]
    fn a_petiole_is_not_broken_into_dots() {
        let levels = chain(lollipop());
        for level in levels.iter().filter(|level| (64..=128).contains(&level.width())) {
            let rows = level.width() * 5 / 8..level.width() - 1;
            let broken =
                rows.clone().filter(|&y| (0..level.width()).all(|x| level.get_pixel(x, y)[3] < COVERED));
            assert_eq!(broken.count(), 0, "at {} px of a side some rows show no stalk", level.width());
            let wide = rows.flat_map(|y| (0..level.width()).map(move |x| (x, y)));
            let texels = wide.filter(|&(x, y)| level.get_pixel(x, y)[3] >= COVERED).count();
            let rows = (level.width() * 3 / 8) as usize;
            assert!(texels <= 3 * rows.max(1), "{texels} texels in {rows} rows of {} px", level.width());
        }
        let far = &levels[levels.len() - 4];
        assert!((1..8).all(|y| (0..8).any(|x| far.get_pixel(x, y)[3] > 0)), "shares of it are left far away");
        let row = (0..8).map(|x| u32::from(far.get_pixel(x, 7)[3])).sum::<u32>();
        assert!(row < 64, "where all is a few texels it is as thin as it is: {row}");
    }

    #[test]
    fn colour_is_averaged_in_linear_light() {
        let checker = RgbaImage::from_fn(2, 2, |x, y| {
            let v = if (x + y) % 2 == 0 { 255 } else { 0 };
            Rgba([v, v, v, 255])
        });
        assert_eq!(
            chain(checker)[1].get_pixel(0, 0).0,
            [188, 188, 188, 255],
            "half of the light is sRGB 188"
        );
    }

    #[test]
    fn plain_numbers_keep_their_mean() {
        let ramp = RgbaImage::from_fn(4, 4, |x, y| {
            Rgba([u8::try_from(16 * x).expect("small"), u8::try_from(60 * y).expect("small"), 7, 255])
        });
        let levels = plain_chain(ramp);
        assert_eq!(levels.iter().map(RgbaImage::width).collect::<Vec<_>>(), [4, 2, 1], "halved to one texel");
        assert_eq!(levels[2].get_pixel(0, 0).0, [24, 90, 7, 255], "the mean of each channel");
    }

    #[test]
    fn transparent_colour_does_not_tint() {
        let half =
            RgbaImage::from_fn(2, 2, |x, _| if x == 0 { Rgba([200, 50, 0, 255]) } else { Rgba([0; 4]) });
        let texel = chain(half)[1].get_pixel(0, 0).0;
        assert_eq!(texel[..3], [200, 50, 0], "only covered texels count");
    }
}
