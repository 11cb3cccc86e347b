// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Carries leaves that were painted after photos to another season.

use glam::Vec2;
use image::RgbImage;

use crate::math::{floor_i32, linear_from_srgb, srgb_from_linear};
use crate::synthesis::vein_field::VeinField;
use crate::{Blade, Shape, VeinGraph, noise, season};

/// Seasons whose change of colour is tabulated.
const STEPS: usize = 64;
/// Delay of the season along main and lateral veins, and its reach from them in √A.
const LINGERING: (f32, f32) = (0.2, 0.035);
/// Lead or delay of patches, and their number along √A.
const PATCHES: (f32, f32) = (0.15, 3.0);
/// A change of season as large as this is uneven in full.
const FULLY_UNEVEN: f32 = 0.35;

/// A change of season.
pub(super) struct Turning {
    /// Season to arrive at.
    to: f32,
    /// Unevenness, 0 to 1.
    unevenness: f32,
    /// Factor on linear light that leads to each of evenly spaced seasons.
    factors: Vec<[f32; 3]>,
}

impl Turning {
    /// A change of a kind of leaf from one season to another.
    pub(super) fn new(shape: Shape, from: f32, to: f32) -> Self {
        let start = season::pigments(shape, from);
        let factor =
            |step: usize| season::change(&start, &season::pigments(shape, step as f32 / STEPS as f32));
        let unevenness = ((to - from).abs() / FULLY_UNEVEN).min(1.0);
        Self { to, unevenness, factors: (0..=STEPS).map(factor).collect() }
    }

    /// Factor at a season.
    fn factor(&self, season: f32) -> [f32; 3] {
        let x = season.clamp(0.0, 1.0) * STEPS as f32;
        let below = usize::try_from(floor_i32(x)).unwrap_or(0).min(STEPS - 1);
        let share = x - below as f32;
        std::array::from_fn(|i| {
            let (a, b) = (self.factors[below][i], self.factors[below + 1][i]);
            a + (b - a) * share
        })
    }

    /// Turns one colour.
    pub(super) fn colour(&self, rgb: [u8; 3]) -> [u8; 3] {
        apply(rgb, self.factor(self.to))
    }

    /// Turns a painted blade: tissue far from veins first, some patches before others.
    pub(super) fn blade(&self, colour: &mut RgbImage, blade: &Blade, veins: &VeinGraph, seed: u64) {
        let unit = (blade.mask.area().max(1) as f32).sqrt();
        let field = VeinField::new(blade, veins, 0..=2, unit);
        let width = blade.mask.width as usize;
        for (at, pixel) in colour.pixels_mut().enumerate() {
            let place = Vec2::new((at % width) as f32, (at / width) as f32) / unit;
            let patches = PATCHES.0 * noise::fractal(seed ^ 0x7123, place * PATCHES.1, 3);
            let green = field.as_ref().map_or(0.0, |field| {
                LINGERING.0 * libm::expf(-field.spot(at).distance / (LINGERING.1 * unit))
            });
            let season = self.to + self.unevenness * (patches - green + 0.25 * LINGERING.0);
            pixel.0 = apply(pixel.0, self.factor(season));
        }
    }
}

/// A colour under changed light.
fn apply(rgb: [u8; 3], factor: [f32; 3]) -> [u8; 3] {
    std::array::from_fn(|i| srgb_from_linear((linear_from_srgb(rgb[i]) * factor[i]).min(1.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_change_changes_nothing_and_autumn_takes_the_green() {
        let still = Turning::new(Shape::Birch, 0.25, 0.25);
        let [r, g, b] = still.colour([90, 130, 60]);
        assert!(r.abs_diff(90) < 2 && g.abs_diff(130) < 2 && b.abs_diff(60) < 2, "{r} {g} {b}");
        let [r, g, _] = Turning::new(Shape::Birch, 0.0, 0.6).colour([60, 100, 40]);
        assert!(r > 105 && g < r + 15, "yellow: {r} {g}");
    }

    #[test]
    fn veins_keep_their_green_longest() {
        let blade = Shape::Beech.draw(128, 4).expect("an allowed size").blade;
        let veins =
            crate::VeinGrower::grow(&crate::growth::SpeciesVeins::of(Shape::Beech), &blade, 4).expect("room");
        let mut picture = RgbImage::from_pixel(128, 128, image::Rgb([60, 100, 40]));
        Turning::new(Shape::Beech, 0.0, 0.4).blade(&mut picture, &blade, &veins, 4);
        let unit = (blade.mask.area() as f32).sqrt();
        let field = VeinField::new(&blade, &veins, 0..=2, unit).expect("veins");
        let mean_red = |near: bool| {
            let of = |at: &usize| blade.mask.inside[*at] && (field.spot(*at).distance < 0.01 * unit) == near;
            let reds: Vec<f32> = (0..blade.mask.inside.len())
                .filter(of)
                .map(|at| f32::from(picture.as_raw()[at * 3]))
                .collect();
            reds.iter().sum::<f32>() / reds.len() as f32
        };
        assert!(mean_red(true) + 4.0 < mean_red(false), "{} {}", mean_red(true), mean_red(false));
    }
}
