// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! An example leaf taken apart: colours of its superpixels, its fine detail, its veins.

use super::detail::{PATCH, SourceBins};
use super::smooth::{local_mean, smooth};
use super::snap::snap;
use super::structure::{Place, Scaled, Structure};
use super::vein_profile::VeinProfile;
use crate::distance::nearest_seed;
use crate::lab::{self, Lab};
use crate::plane::Plane;
use crate::{Mask, Specimen, TexgenError};

/// Largest √A in pixels at which an example is studied.
const LARGEST_UNIT: f32 = 512.0;

/// Pixels at the margin whose colour is mixed with the ground's.
const RIM: f32 = 2.2;
/// Distance to the margin, as a share of √A, within which pale pixels are taken for ground shining through.
const PALE_RIM: f32 = 0.08;
/// A pale pixel has less than this share of the median chroma, and is not this much darker than the median.
const PALE_CHROMA: f32 = 0.8;
const PALE_LIGHT: f32 = 4.0;

/// Source of texture.
pub(crate) struct Exemplar {
    /// Structure on the example's working grid.
    pub(crate) structure: Structure,
    /// Superpixels of each level: where they lie and their mean colour without veins.
    pub(crate) levels: Vec<Vec<(Place, Lab)>>,
    /// Regions: range of structural distance from the 5th to the 95th percentile, share of the area.
    pub(crate) regions: Vec<Region>,
    /// Difference of the example from the smoothed superpixels, veins apart; zero outside.
    pub(crate) residual: Plane<Lab>,
    /// The finest part of the residual, about two pixels wide.
    pub(crate) grain: Plane<Lab>,
    /// Mean square of the residual around each pixel, over about a patch, and its median.
    pub(crate) energy: Vec<f32>,
    /// Median of the energy.
    pub(crate) usual_energy: f32,
    /// Pixels to copy detail from.
    pub(crate) sources: SourceBins,
    /// The example's veins.
    pub(crate) veins: VeinProfile,
    /// Mean colour of the blade.
    pub(crate) mean: Lab,
    /// Standard deviation of the smoothed superpixels.
    pub(crate) base_deviation: Lab,
    /// Standard deviation of the blade's colours.
    pub(crate) deviation: Lab,
}

/// Features by which regions are compared.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Region {
    /// 5th and 95th percentile of structural distance.
    pub(crate) range: (f32, f32),
    /// Share of the blade's area.
    pub(crate) share: f32,
}

impl Exemplar {
    /// Takes an example apart.
    ///
    /// # Errors
    /// [`TexgenError::OutOfRange`] for a blade of too few pixels or a picture whose size is not its mask's.
    pub(crate) fn new(specimen: &Specimen) -> Result<Self, TexgenError> {
        let size = specimen.picture.dimensions();
        let mask = &specimen.blade.mask;
        if size != (mask.width, mask.height) {
            let value = format!("{}x{}", size.0, size.1);
            let field = format!("{}: picture size", specimen.name);
            return Err(TexgenError::out_of_range(field, value, "the size of its mask"));
        }
        let unit = (mask.area() as f32).sqrt();
        let factor = (LARGEST_UNIT / unit.max(1.0)).min(1.0);
        let mut leaf = Scaled::new(&specimen.name, &specimen.blade, &specimen.veins, factor)?;
        let colour = shrunk(specimen, &leaf.blade.mask, factor);
        let unit = leaf.unit();
        snap(&mut leaf.veins, &colour, &leaf.blade.mask.inside, unit);
        let structure = Structure::new(&leaf);
        let colour = without_rim(&structure, colour.data);
        let veins = VeinProfile::measure(&structure, &colour);
        let tissue: Vec<Lab> = colour
            .iter()
            .zip(&structure.vein)
            .map(|(colour, spot)| lab::sub(*colour, veins.at(spot, structure.unit)))
            .collect();
        let levels: Vec<Vec<(Place, Lab)>> = structure
            .levels
            .iter()
            .map(|level| {
                let means = level_means(&structure, level, &tissue);
                structure.places(level).into_iter().zip(means).collect()
            })
            .collect();
        let flat =
            paint_level(&structure, structure.levels.len() - 1, |number| levels[levels.len() - 1][number].1);
        let base = smooth(&structure, &flat);
        let mut residual = vec![[0.0; 3]; tissue.len()];
        for at in structure.pixels() {
            residual[at] = lab::sub(tissue[at], base[at]);
        }
        let regions = describe_regions(&structure);
        let mean = lab::mean(structure.pixels().map(|at| colour[at]));
        let base_mean = lab::mean(structure.pixels().map(|at| base[at]));
        let base_deviation = lab::deviation(base_mean, structure.pixels().map(|at| base[at]));
        let deviation = lab::deviation(mean, structure.pixels().map(|at| colour[at]));
        let coarse = local_mean(&structure, &residual, 1.0, |at| structure.inside.data[at]);
        let (width, height) = (structure.inside.width, structure.inside.height);
        let grain = residual.iter().zip(coarse).map(|(fine, coarse)| lab::sub(*fine, coarse)).collect();
        let squares: Vec<Lab> = residual.iter().map(|colour| colour.map(|x| x * x)).collect();
        let around = 0.5 * PATCH * structure.unit;
        let energy = local_mean(&structure, &squares, around, |at| structure.inside.data[at]);
        let energy: Vec<f32> = energy.iter().map(|squares| squares.iter().sum()).collect();
        let mut sorted: Vec<f32> = structure.pixels().map(|at| energy[at]).collect();
        sorted.sort_by(f32::total_cmp);
        let usual_energy = sorted.get(sorted.len() / 2).copied().unwrap_or(0.0).max(1e-3);
        let residual = Plane { width, height, data: residual };
        let grain = Plane { width, height, data: grain };
        let sources = SourceBins::new(&structure);
        Ok(Self {
            structure,
            levels,
            regions,
            residual,
            grain,
            energy,
            usual_energy,
            sources,
            veins,
            mean,
            base_deviation,
            deviation,
        })
    }
}

/// Colours with those at the rim, where the ground behind the leaf shines through, taken from farther in.
fn without_rim(structure: &Structure, colour: Vec<Lab>) -> Vec<Lab> {
    let (width, height) = (structure.inside.width, structure.inside.height);
    let chroma = |at: usize| (colour[at][1] * colour[at][1] + colour[at][2] * colour[at][2]).sqrt();
    let median = |value: &dyn Fn(usize) -> f32| {
        let mut values: Vec<f32> = structure.pixels().map(value).collect();
        values.sort_by(f32::total_cmp);
        values.get(values.len() / 2).copied().unwrap_or(0.0)
    };
    let (usual_light, usual_chroma) = (median(&|at| colour[at][0]), median(&chroma));
    // Thin parts out of focus are paler over a wider rim.
    let pale = |at: usize| {
        structure.margin[at] < PALE_RIM
            && colour[at][0] > usual_light - PALE_LIGHT
            && chroma(at) < PALE_CHROMA * usual_chroma
    };
    let clean =
        |at: usize| structure.inside.data[at] && structure.margin[at] * structure.unit > RIM && !pale(at);
    let (_, nearest) = nearest_seed(width, height, clean);
    let from = |at: usize| colour.get(nearest.data[at] as usize).copied().unwrap_or(colour[at]);
    (0..colour.len()).map(|at| if structure.inside.data[at] { from(at) } else { [0.0; 3] }).collect()
}

/// Colours of a specimen on its working grid.
fn shrunk(specimen: &Specimen, blade: &Mask, factor: f32) -> Plane<Lab> {
    let (width, height) = (blade.width as usize, blade.height as usize);
    let picture = &specimen.picture;
    let mask = &specimen.blade.mask;
    let span = |i: usize, size: u32| {
        let edge = |i: usize| {
            let edge = crate::math::floor_i32(i as f32 / factor);
            u32::try_from(edge).unwrap_or(0).min(size - 1)
        };
        let from = edge(i);
        from..edge(i + 1).max(from + 1).min(size)
    };
    let data = (0..width * height)
        .map(|at| {
            if !blade.inside[at] {
                return [0.0; 3];
            }
            let columns = span(at % width, picture.width());
            let rows = span(at / width, picture.height());
            let covered = |x: u32, y: u32| mask.inside[y as usize * mask.width as usize + x as usize];
            let all = rows.flat_map(|y| columns.clone().map(move |x| (x, y)));
            let leaf: Vec<Lab> = all
                .filter(|&(x, y)| covered(x, y))
                .map(|(x, y)| lab::from_srgb(picture.get_pixel(x, y).0))
                .collect();
            lab::mean(leaf.into_iter())
        })
        .collect();
    Plane { width, height, data }
}

/// Mean colour of each superpixel.
fn level_means(structure: &Structure, level: &super::superpixels::Superpixels, colour: &[Lab]) -> Vec<Lab> {
    let mut sums = vec![([0.0_f32; 3], 0.0_f32); level.count];
    for at in structure.pixels() {
        let sum = &mut sums[level.label.data[at] as usize];
        sum.0 = lab::add(sum.0, colour[at]);
        sum.1 += 1.0;
    }
    sums.into_iter().map(|(sum, count)| lab::scale(sum, 1.0 / count.max(1.0))).collect()
}

/// Every pixel in the colour of its superpixel.
pub(crate) fn paint_level(structure: &Structure, level: usize, colour: impl Fn(usize) -> Lab) -> Vec<Lab> {
    let label = &structure.levels[level].label.data;
    label
        .iter()
        .map(|&number| if number == super::regions::OUTSIDE { [0.0; 3] } else { colour(number as usize) })
        .collect()
}

/// Ranges of structural distance and shares of the area.
pub(crate) fn describe_regions(structure: &Structure) -> Vec<Region> {
    let mut distances: Vec<Vec<f32>> = vec![Vec::new(); structure.region_count];
    for at in structure.pixels() {
        distances[structure.region.data[at] as usize].push(structure.distance[at]);
    }
    let area = structure.unit * structure.unit;
    distances
        .into_iter()
        .map(|mut distances| {
            distances.sort_by(f32::total_cmp);
            let last = distances.len().saturating_sub(1);
            let at = |percent: usize| distances.get(last * percent / 100).copied().unwrap_or(0.0);
            Region { range: (at(5), at(95)), share: distances.len() as f32 / area }
        })
        .collect()
}
