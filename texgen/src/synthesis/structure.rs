// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A leaf's structure on a working grid: what example and target are matched by.

use glam::Vec2;

use super::regions::{OUTSIDE, regions};
use super::structural::structural_distance;
use super::superpixels::{Feature, Superpixels, superpixels};
use super::vein_field::{VeinField, VeinSpot, with_midrib};
use crate::distance::nearest_seed;
use crate::math::floor_i32;
use crate::plane::Plane;
use crate::{Blade, Mask, TexgenError, VeinGraph};

/// Highest rank of the veins that bound regions and carry structural distance.
pub(crate) const STRUCTURAL_ORDERS: std::ops::RangeInclusive<u8> = 0..=2;
/// Levels of the pyramid.
pub(crate) const LEVELS: u32 = 5;
/// Superpixels of the coarsest level; each finer one has four times as many.
const COARSEST: usize = 60;
/// A superpixel has at least this many pixels.
const FEWEST_PIXELS: usize = 30;
/// Fewest pixels of a blade that can be an example or a target.
const FEWEST_BLADE_PIXELS: usize = 64;

/// Everything about a blade and its veins that texture depends on.
pub(crate) struct Structure {
    /// √A in pixels of the working grid.
    pub(crate) unit: f32,
    /// Blade on the working grid.
    pub(crate) inside: Plane<bool>,
    /// Normalised structural distance.
    pub(crate) distance: Vec<f32>,
    /// Distance to the margin as a share of √A.
    pub(crate) margin: Vec<f32>,
    /// Nearest vein; distances in pixels of the working grid.
    pub(crate) vein: Vec<VeinSpot>,
    /// Vein-bounded region of each pixel.
    pub(crate) region: Plane<u32>,
    /// Number of regions.
    pub(crate) region_count: usize,
    /// Superpixels from coarse to fine.
    pub(crate) levels: Vec<Superpixels>,
}

/// A blade and its veins brought to a working grid.
#[derive(Clone, Debug)]
pub(crate) struct Scaled {
    /// The blade.
    pub(crate) blade: Blade,
    /// The veins; a straight midrib if there were none.
    pub(crate) veins: VeinGraph,
}

impl Scaled {
    /// Scales a blade and its veins by `factor`, 1 or less.
    ///
    /// # Errors
    /// [`TexgenError::OutOfRange`] for a blade that is too small or a picture of the wrong size.
    pub(crate) fn new(
        name: &str,
        blade: &Blade,
        veins: &VeinGraph,
        factor: f32,
    ) -> Result<Self, TexgenError> {
        let mask = &blade.mask;
        let pixels = mask.width as usize * mask.height as usize;
        if mask.inside.len() != pixels {
            let field = format!("{name}: mask pixels");
            return Err(TexgenError::out_of_range(field, mask.inside.len(), "width times height"));
        }
        let area = mask.area();
        if area < FEWEST_BLADE_PIXELS {
            return Err(TexgenError::out_of_range(format!("{name}: blade pixels"), area, "64 or more"));
        }
        let scale = |size: u32| -> u32 {
            let scaled = (size as f32 * factor).ceil();
            u32::try_from(floor_i32(scaled)).unwrap_or(1).max(1)
        };
        let mut small = Mask::empty(scale(mask.width), scale(mask.height));
        for y in 0..small.height {
            for x in 0..small.width {
                let at = |i: u32| floor_i32((i as f32 + 0.5) / factor);
                small.inside[y as usize * small.width as usize + x as usize] = mask.contains(at(x), at(y));
            }
        }
        let blade = Blade {
            mask: small,
            outline: blade.outline.iter().map(|p| *p * factor).collect(),
            root: blade.root * factor,
            tip: blade.tip * factor,
            confidence: blade.confidence,
        };
        let mut veins = veins.clone();
        for node in &mut veins.nodes {
            node.position *= factor;
            node.radius *= factor;
        }
        let unit = (blade.mask.area().max(1) as f32).sqrt();
        let veins = with_midrib(&blade, &veins, unit);
        Ok(Self { blade, veins })
    }

    /// √A in pixels.
    pub(crate) fn unit(&self) -> f32 {
        (self.blade.mask.area().max(1) as f32).sqrt()
    }
}

impl Structure {
    /// Analyses a blade.
    pub(crate) fn new(leaf: &Scaled) -> Self {
        let blade = &leaf.blade;
        let (width, height) = (blade.mask.width as usize, blade.mask.height as usize);
        let inside = Plane { width, height, data: blade.mask.inside.clone() };
        let unit = leaf.unit();
        let straight = with_midrib(blade, &VeinGraph::default(), unit);
        let field = VeinField::new(blade, &leaf.veins, STRUCTURAL_ORDERS, unit)
            .or_else(|| VeinField::new(blade, &straight, STRUCTURAL_ORDERS, unit));
        let nowhere = VeinSpot {
            distance: unit,
            signed: unit,
            direction: Vec2::NEG_Y,
            normal: Vec2::X,
            radius: 0.0,
            along: 0.0,
            order: 1,
        };
        let spot = |i: usize| field.as_ref().map_or(nowhere, |field| field.spot(i));
        let vein: Vec<VeinSpot> = (0..width * height).map(spot).collect();
        let (rim, _) = nearest_seed(width, height, |i| !inside.data[i]);
        let border = |i: usize| {
            let (x, y) = (i % width, i / width);
            x.min(y).min(width - 1 - x).min(height - 1 - y) as f32 + 1.0
        };
        let margin_px: Vec<f32> = (0..width * height).map(|i| rim.data[i].min(border(i))).collect();
        let is_vein: Vec<bool> = vein.iter().map(|spot| spot.distance <= spot.radius.max(0.8)).collect();
        let root = nearest_inside(&inside, blade.root);
        let distance = structural_distance(&inside, &is_vein, root).data;
        let vein_px: Vec<f32> = vein.iter().map(|spot| spot.distance).collect();
        let (region, region_count) = regions(&inside, &vein_px, &margin_px, unit);
        let feature: Vec<Feature> =
            (0..width * height).map(|i| [100.0 * distance[i], 30.0 * vein_px[i] / unit]).collect();
        let area = blade.mask.area();
        let levels = (0..LEVELS)
            .map(|level| (COARSEST << (2 * level)).min(area / FEWEST_PIXELS).max(1))
            .map(|wanted| superpixels(&inside, &feature, wanted))
            .collect();
        let margin = margin_px.into_iter().map(|px| px / unit).collect();
        Self { unit, inside, distance, margin, vein, region, region_count, levels }
    }

    /// Pixels of the blade.
    pub(crate) fn pixels(&self) -> impl Iterator<Item = usize> {
        (0..self.inside.data.len()).filter(|&i| self.inside.data[i])
    }

    /// Structural distance of each superpixel of a level, averaged, its region, and its distance to the margin.
    pub(crate) fn places(&self, level: &Superpixels) -> Vec<Place> {
        let mut sums = vec![(0.0_f32, 0.0_f32, 0.0_f32, 0.0_f32); level.count];
        let mut votes: Vec<Vec<(u32, u32)>> = vec![Vec::new(); level.count];
        for at in self.pixels() {
            let number = level.label.data[at] as usize;
            let sum = &mut sums[number];
            sum.0 += self.distance[at];
            sum.1 += self.vein[at].distance / self.unit;
            sum.2 += self.margin[at];
            sum.3 += 1.0;
            let region = self.region.data[at];
            match votes[number].iter_mut().find(|(voted, _)| *voted == region) {
                Some((_, count)) => *count += 1,
                None => votes[number].push((region, 1)),
            }
        }
        let mean = |(distance, vein, margin, count): (f32, f32, f32, f32)| {
            [distance, vein, margin].map(|sum| sum / count.max(1.0))
        };
        sums.into_iter()
            .map(mean)
            .zip(votes)
            .map(|([distance, vein, margin], votes)| {
                let most = votes.iter().max_by_key(|(region, count)| (*count, OUTSIDE - *region));
                Place { distance, vein, margin, region: most.map_or(0, |(region, _)| *region) }
            })
            .collect()
    }
}

/// Place of a superpixel within a leaf.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// Mean structural distance.
    pub(crate) distance: f32,
    /// Mean distance to the nearest vein as a share of √A.
    pub(crate) vein: f32,
    /// Mean distance to the margin as a share of √A.
    pub(crate) margin: f32,
    /// Region that holds most of it.
    pub(crate) region: u32,
}

/// The blade's pixel nearest to a point.
fn nearest_inside(inside: &Plane<bool>, p: Vec2) -> usize {
    let distance = |i: usize| inside.centre(i).distance_squared(p);
    (0..inside.data.len())
        .filter(|&i| inside.data[i])
        .min_by(|&a, &b| distance(a).total_cmp(&distance(b)))
        .unwrap_or(0)
}
