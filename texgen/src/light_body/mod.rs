// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Light bodies that are no leaves: an outline and a plain painter for each, one variation per seed.

mod feather;
mod paper;
mod plate;
mod samara;

use glam::Vec2;
use image::RgbaImage;

use crate::math::{srgb_from_linear, to_byte};
use crate::raster::{Frame, coverage};
use crate::rng::Rng;
use crate::{TexgenError, bleed};

/// A light body that is no leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LightBody {
    /// Small contour feather: a vane on a shaft, quill down.
    Feather,
    /// Torn scrap of ruled white paper.
    Paper,
    /// Plain disc.
    Plate,
    /// A maple's seed: a nut below, one wing above.
    Samara,
}

/// A body on paper: what it covers, and how its places are coloured.
struct Drawn {
    /// The body without stalks: a closed polygon, counter-clockwise.
    outline: Vec<Vec2>,
    /// Other parts: polygons of the same turning.
    extras: Vec<Vec<Vec2>>,
    /// Linear colour of a place.
    colour: Box<dyn Fn(Vec2) -> [f32; 3]>,
}

/// Empty border around a body, as a share of the picture's side.
const BORDER: f32 = 0.02;
/// Places along each side of a texel whose colours are averaged.
const SAMPLES: u16 = 2;

impl LightBody {
    /// Every body, in declaration order.
    pub const ALL: [Self; 4] = [Self::Feather, Self::Paper, Self::Plate, Self::Samara];

    /// Its outline without stalks, in leaf coordinates: a closed polygon, counter-clockwise.
    pub fn outline(self, seed: u64) -> Vec<Vec2> {
        self.draw(seed).outline
    }

    /// Paints it upright on a transparent ground; equal arguments give equal bytes. Colour runs on past the edge.
    ///
    /// # Errors
    /// [`TexgenError::OutOfRange`] unless `size_px` is a power of two from 16 to 4096.
    pub fn paint(self, size_px: u32, seed: u64) -> Result<RgbaImage, TexgenError> {
        if !size_px.is_power_of_two() || !(16..=4096).contains(&size_px) {
            return Err(TexgenError::out_of_range("size_px", size_px, "a power of two from 16 to 4096"));
        }
        let drawn = self.draw(seed);
        let polygons: Vec<&[Vec2]> =
            [&drawn.outline].into_iter().chain(&drawn.extras).map(Vec::as_slice).collect();
        let points = polygons.iter().flat_map(|polygon| polygon.iter().copied());
        let size = size_px as usize;
        let frame = Frame::around(points, size, BORDER * size_px as f32);
        let covered = coverage(&polygons, frame);
        let colour = |x: u32, y: u32| {
            let mut sum = [0.0; 3];
            for part in 0..SAMPLES * SAMPLES {
                let inside = |step: u16| (f32::from(step) + 0.5) / f32::from(SAMPLES);
                let at =
                    Vec2::new(x as f32, y as f32) + Vec2::new(inside(part % SAMPLES), inside(part / SAMPLES));
                let one = (drawn.colour)(frame.to_leaf(at));
                sum = std::array::from_fn(|channel| sum[channel] + one[channel]);
            }
            sum.map(|channel| channel / f32::from(SAMPLES * SAMPLES))
        };
        let mut image = RgbaImage::from_fn(size_px, size_px, |x, y| {
            match to_byte(covered[y as usize * size + x as usize]) {
                0 => image::Rgba([0; 4]),
                alpha => {
                    let [r, g, b] = colour(x, y).map(srgb_from_linear);
                    image::Rgba([r, g, b, alpha])
                }
            }
        });
        bleed::bleed(&mut image);
        Ok(image)
    }

    fn draw(self, seed: u64) -> Drawn {
        let rng = Rng::new(seed);
        match self {
            Self::Feather => feather::draw(&rng),
            Self::Paper => paper::draw(&rng),
            Self::Plate => plate::draw(),
            Self::Samara => samara::draw(&rng),
        }
    }
}

/// Mixes two colours.
fn mix(a: [f32; 3], b: [f32; 3], share: f32) -> [f32; 3] {
    std::array::from_fn(|channel| a[channel] + (b[channel] - a[channel]) * share)
}

/// 1 on a line, 0 farther from it than its half width.
fn line(distance: f32, half_width: f32) -> f32 {
    1.0 - crate::math::smoothstep(0.4 * half_width, half_width, distance.abs())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::{ProptestConfig, any, prop_assert, proptest};

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(32))]
        #[test]
        fn any_body_can_be_painted(seed in any::<u64>(), which in 0..LightBody::ALL.len()) {
            let body = LightBody::ALL[which];
            let image = body.paint(128, seed).expect("an allowed size");
            prop_assert!(image == body.paint(128, seed).expect("an allowed size"), "equal seeds, equal bytes");
            let covered = image.pixels().map(|texel| f32::from(texel[3]) / 255.0).sum::<f32>();
            prop_assert!((0.08..0.95).contains(&(covered / 16_384.0)), "{body:?} covers {covered}");
            let edge = (0..128).flat_map(|i| [(i, 0), (0, i), (i, 127), (127, i)]);
            prop_assert!(edge.clone().all(|(x, y)| image.get_pixel(x, y)[3] == 0), "a free border");
            // The polygon runs counter-clockwise, and the picture shows it and little besides.
            let outline = body.outline(seed);
            let next = outline.iter().cycle().skip(1);
            let area = outline.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum::<f32>() / 2.0;
            prop_assert!(area > 0.1, "{body:?} turns the other way: {area}");
            let drawn = body.draw(seed);
            let points = drawn.extras.iter().chain([&drawn.outline]).flatten().copied();
            let scale = Frame::around(points, 128, BORDER * 128.0).scale;
            let share = covered / (area * scale * scale);
            prop_assert!((0.98..1.12).contains(&share), "{body:?}: {share} of its outline is covered");
        }
    }

    #[test]
    fn bodies_differ_in_colour() {
        let mean = |body: LightBody| {
            let image = body.paint(64, 1).expect("an allowed size");
            let inside: Vec<_> = image.pixels().filter(|texel| texel[3] > 127).collect();
            let sum = |channel: usize| inside.iter().map(|texel| f32::from(texel[channel])).sum::<f32>();
            [0, 1, 2].map(|channel| sum(channel) / inside.len() as f32)
        };
        let [paper_r, _, paper_b] = mean(LightBody::Paper);
        assert!(paper_r.min(paper_b) > 200.0 && (paper_r - paper_b).abs() < 25.0, "paper is white");
        let [plate_r, plate_g, plate_b] = mean(LightBody::Plate);
        assert!(plate_r > 1.8 * plate_g.max(plate_b), "the plate is red");
        let [seed_r, seed_g, seed_b] = mean(LightBody::Samara);
        assert!(seed_r > seed_g && seed_g > seed_b, "the seed is brown");
    }

    #[test]
    fn sizes_are_checked() {
        assert!(LightBody::Paper.paint(100, 1).is_err(), "no power of two");
        assert!(LightBody::Paper.paint(8, 1).is_err(), "too small");
    }
}
