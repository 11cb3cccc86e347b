// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Texture by example: paints a target blade in the manner of example leaves (after Qian et al. 2019).
//!
//! Both are described by their structure ([`structure`]): how far each pixel lies from the root by way of the veins,
//! regions between veins, superpixels of five levels. Regions and superpixels of the target take their colour from
//! those of the examples that lie alike ([`choose`]), a smoothing pass blends them ([`smooth`]), patches bring back
//! the texture that mean colours lack ([`detail`]), and veins are painted last ([`vein_profile`]).

mod choose;
mod detail;
mod exemplar;
mod regions;
mod smooth;
mod snap;
mod stages;
mod structural;
mod structure;
mod superpixels;
#[cfg(test)]
mod tests;
pub(crate) mod vein_field;
mod vein_profile;

use glam::Vec2;
use image::RgbImage;
use rayon::prelude::{IntoParallelRefIterator, ParallelIterator};

use crate::distance::nearest_seed;
use crate::lab::{self, Lab};
use crate::plane::Plane;
use crate::rng::Rng;
use crate::{Blade, Specimen, TexgenError, VeinGraph};
use choose::{choose_levels, draw_shares, match_regions};
use detail::{Layer, match_spread, quilt};
use exemplar::{Exemplar, paint_level};
use smooth::smooth;
pub use stages::Stage;
use structure::{STRUCTURAL_ORDERS, Scaled, Structure};
use vein_field::VeinField;

/// Least √A of the working grid where the target has as much.
const LEAST_WORKING_UNIT: f32 = 192.0;
/// Strength of grain that the examples are too small to show, against the grain they show: least and most.
const GRAIN: (f32, f32) = (0.0, 0.6);
/// Least distance, in pixels of the target, between pixels of the working grid for grain to be added.
const GRAIN_FROM: f32 = 1.35;

/// Share of the differences between regions that is kept.
const REGION_TONE: f32 = 0.75;
/// Bounds of the correction of contrast between superpixels, and of the last one of all contrast.
const BASE_GAIN: (f32, f32) = (0.6, 1.9);
const GAIN: (f32, f32) = (0.85, 1.12);

/// A painter that has studied its examples.
pub struct Painter {
    exemplars: Vec<Exemplar>,
}

/// A painted blade.
#[derive(Clone, Debug)]
pub struct Painted {
    /// Colour of every pixel; outside the blade that of the nearest pixel inside.
    pub colour: RgbImage,
    /// Intermediate pictures in the order of the work; empty unless asked for.
    pub stages: Vec<Stage>,
}

impl Painter {
    /// Studies examples.
    ///
    /// # Errors
    /// [`TexgenError`] without any example, or if one is too small or not as large as its mask.
    pub fn new(examples: &[Specimen]) -> Result<Self, TexgenError> {
        if examples.is_empty() {
            return Err(TexgenError::out_of_range("examples.len()", 0, "1 or more"));
        }
        let exemplars = examples.par_iter().map(Exemplar::new).collect::<Result<_, _>>()?;
        Ok(Self { exemplars })
    }

    /// Mean colour of all examples.
    pub(crate) fn mean(&self) -> Lab {
        lab::mean(self.exemplars.iter().map(|example| example.mean))
    }

    /// Paints a blade; equal arguments give equal bytes. With `show_stages` the intermediate pictures are kept.
    ///
    /// # Errors
    /// [`TexgenError::OutOfRange`] for a blade of too few pixels.
    pub fn paint(
        &self,
        blade: &Blade,
        veins: &VeinGraph,
        seed: u64,
        show_stages: bool,
    ) -> Result<Painted, TexgenError> {
        let rng = Rng::new(seed);
        let full = Scaled::new("target", blade, veins, 1.0)?;
        let known = self.exemplars.iter().map(|example| example.structure.unit).fold(0.0, f32::max);
        let factor = (known.max(LEAST_WORKING_UNIT) / full.unit()).min(1.0);
        let target = Structure::new(&Scaled::new("target", blade, veins, factor)?);
        let means: Vec<Lab> = self.exemplars.iter().map(|example| example.mean).collect();
        let shares = draw_shares(&means, &mut rng.fork(1));
        let weights = &shares.weights;
        let matches = match_regions(&target, &self.exemplars, weights, &mut rng.fork(2));
        let mean = self.blend(&shares.mean, |example| example.mean);
        let levels = choose_levels(&target, &self.exemplars, &matches, mean, &rng.fork(3));
        let finest = levels.len() - 1;
        let flat = paint_level(&target, finest, |number| levels[finest][number]);
        let flat = evened(&target, flat);
        let mut base = smooth(&target, &flat);
        let found = lab::mean(target.pixels().map(|at| base[at]));
        let deviation = lab::deviation(found, target.pixels().map(|at| base[at]));
        let gain = gain(self.blend(weights, |example| example.base_deviation), deviation, BASE_GAIN);
        for at in target.pixels() {
            base[at] = std::array::from_fn(|i| found[i] + (base[at][i] - found[i]) * gain[i]);
        }
        let mut detail = quilt(&target, &self.exemplars, &matches, Layer::Residual, 1.0, &rng.fork(4));
        match_spread(&target, &self.exemplars, weights, &mut detail);
        let grain = (1.0 / factor > GRAIN_FROM)
            .then(|| quilt(&target, &self.exemplars, &matches, Layer::Grain, 1.0 / factor, &rng.fork(5)));
        let grain_strength = rng.fork(6).range(GRAIN.0, GRAIN.1);
        let stages = if show_stages {
            stages::collect(blade, &full.veins, &target, &levels, &base, &detail)
        } else {
            Vec::new()
        };
        let tissue = Layers {
            base: extended(&target, base),
            detail: extended(&target, detail.data),
            grain,
            grain_strength,
            factor,
        };
        let colour = self.compose(&full, &tissue, weights, mean);
        Ok(Painted { colour, stages })
    }

    /// Weighted sum of a property of the examples.
    fn blend(&self, weights: &[f32], property: impl Fn(&Exemplar) -> Lab) -> Lab {
        let parts = self.exemplars.iter().zip(weights);
        parts.map(|(example, &weight)| lab::scale(property(example), weight)).fold([0.0; 3], lab::add)
    }

    /// Puts the layers together at full size and paints the veins.
    fn compose(&self, leaf: &Scaled, tissue: &Layers, weights: &[f32], mean: Lab) -> RgbImage {
        let (width, height) = (leaf.blade.mask.width as usize, leaf.blade.mask.height as usize);
        let unit = leaf.unit();
        let coarse = VeinField::new(&leaf.blade, &leaf.veins, STRUCTURAL_ORDERS, unit);
        let fine = VeinField::new(&leaf.blade, &leaf.veins, 3..=u8::MAX, unit);
        let inside = &leaf.blade.mask.inside;
        let vein = |field: &Option<VeinField<'_>>, at: usize| {
            let Some(field) = field else { return [0.0; 3] };
            let spot = field.spot(at);
            let parts = self.exemplars.iter().zip(weights);
            parts
                .map(|(example, &weight)| lab::scale(example.veins.at(&spot, unit), weight))
                .fold([0.0; 3], lab::add)
        };
        let mut colour: Vec<Lab> = (0..width * height)
            .map(|at| {
                if !inside[at] {
                    return [0.0; 3];
                }
                let p = Vec2::new((at % width) as f32 + 0.5, (at / width) as f32 + 0.5);
                let (main, small) = (vein(&coarse, at), vein(&fine, at));
                lab::add(tissue.at(p), lab::add(main, small))
            })
            .collect();
        let wanted = self.blend(weights, |example| example.deviation);
        let tissue = || (0..colour.len()).filter(|&at| inside[at]);
        let found = lab::mean(tissue().map(|at| colour[at]));
        let deviation = lab::deviation(found, tissue().map(|at| colour[at]));
        let gain = gain(wanted, deviation, GAIN);
        for colour in &mut colour {
            *colour = std::array::from_fn(|i| mean[i] + (colour[i] - found[i]) * gain[i]);
        }
        let (_, nearest) = nearest_seed(width, height, |at| inside[at]);
        let mut picture = RgbImage::new(leaf.blade.mask.width, leaf.blade.mask.height);
        for (at, pixel) in picture.pixels_mut().enumerate() {
            let from = if inside[at] { at } else { nearest.data[at] as usize };
            pixel.0 = lab::to_srgb(colour[from]);
        }
        picture
    }
}

/// The colours with smaller differences between whole regions: each was taken from another place, and steps as
/// large as that would show as facets.
fn evened(leaf: &Structure, mut colour: Vec<Lab>) -> Vec<Lab> {
    let mut sums = vec![([0.0_f32; 3], 0.0_f32); leaf.region_count];
    for at in leaf.pixels() {
        let sum = &mut sums[leaf.region.data[at] as usize];
        *sum = (lab::add(sum.0, colour[at]), sum.1 + 1.0);
    }
    let mean = lab::mean(leaf.pixels().map(|at| colour[at]));
    let offset = |(sum, count): (Lab, f32)| {
        lab::scale(lab::sub(mean, lab::scale(sum, 1.0 / count.max(1.0))), 1.0 - REGION_TONE)
    };
    let offsets: Vec<Lab> = sums.into_iter().map(offset).collect();
    for at in leaf.pixels() {
        colour[at] = lab::add(colour[at], offsets[leaf.region.data[at] as usize]);
    }
    colour
}

/// Factors that bring one spread of colours to another.
fn gain(wanted: Lab, found: Lab, (least, most): (f32, f32)) -> Lab {
    std::array::from_fn(|i| (wanted[i] / found[i].max(1e-3)).clamp(least, most))
}

/// The layers of tissue on the working grid.
struct Layers {
    base: Plane<Lab>,
    detail: Plane<Lab>,
    grain: Option<Plane<Lab>>,
    grain_strength: f32,
    /// Pixels of the working grid for a pixel of the target.
    factor: f32,
}

impl Layers {
    /// Colour of tissue at a pixel of the target.
    fn at(&self, p: Vec2) -> Lab {
        let q = p * self.factor;
        let sum = lab::add(self.base.sample_cubic(q), self.detail.sample_cubic(q));
        let Some(grain) = &self.grain else { return sum };
        let grain = grain.index_of(p).map_or([0.0; 3], |at| grain.data[at]);
        lab::add(sum, lab::scale(grain, self.grain_strength))
    }
}

/// A layer carried on past the margin, so that no value between pixels mixes in nothing.
fn extended(leaf: &Structure, layer: Vec<Lab>) -> Plane<Lab> {
    let (width, height) = (leaf.inside.width, leaf.inside.height);
    let (_, nearest) = nearest_seed(width, height, |at| leaf.inside.data[at]);
    let data = nearest.data.iter().map(|&seed| layer.get(seed as usize).copied().unwrap_or([0.0; 3]));
    Plane { width, height, data: data.collect() }
}
