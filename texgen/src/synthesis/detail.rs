// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The detail layer: what superpixels lack, copied patch by patch from places of the examples that lie alike, turned
//! into the frame of the nearest vein and joined along seams of least difference (Efros and Freeman 2001).

mod patch;
mod seam;

use glam::Vec2;

use super::choose::Match;
use super::exemplar::Exemplar;
use super::structure::Structure;
use crate::lab::{self, Lab};
use crate::math::floor_i32;
use crate::plane::Plane;
use crate::rng::Rng;
use patch::{Frame, Patch};

/// Side of a patch as a share of the example's √A.
pub(crate) const PATCH: f32 = 0.13;
/// Share of a patch that lies over what is there already.
const OVERLAP: f32 = 0.34;
/// Places that are tried for each patch.
const TRIES: u32 = 40;
/// Steps of structural distance that are kept apart.
const DISTANCE_BINS: usize = 8;
/// Upper ends of the steps of distance to a vein, as shares of √A.
const VEIN_BINS: [f32; 3] = [0.018, 0.036, 0.06];
/// Distance to the margin, as a share of √A, below which a place is marginal.
const MARGINAL: f32 = 0.035;
/// Weight of lying alike against fitting the neighbours, per √A of difference.
const PLACE_WEIGHT: f32 = 2500.0;

/// Energy of a patch against the usual above which it counts as a blemish, or holds a vein that nobody marked.
const BLEMISH: f32 = 1.5;
/// Weight of the energy beyond that.
const BLEMISH_WEIGHT: f32 = 2.0;

/// Pixels of an example by how they lie: structural distance, distance to a vein, marginal or not.
pub(crate) struct SourceBins(Vec<Vec<usize>>);

/// Number of the bin for a way of lying.
fn bin(distance: f32, vein: f32, margin: f32) -> usize {
    let far = usize::try_from(floor_i32(distance * DISTANCE_BINS as f32)).unwrap_or(0).min(DISTANCE_BINS - 1);
    let beside = VEIN_BINS.iter().filter(|&&end| vein > end).count();
    (far * (VEIN_BINS.len() + 1) + beside) * 2 + usize::from(margin < MARGINAL)
}

impl SourceBins {
    /// Sorts the pixels of an example.
    pub(crate) fn new(leaf: &Structure) -> Self {
        let mut bins = vec![Vec::new(); DISTANCE_BINS * (VEIN_BINS.len() + 1) * 2];
        for at in leaf.pixels() {
            bins[bin(leaf.distance[at], leaf.vein[at].distance / leaf.unit, leaf.margin[at])].push(at);
        }
        Self(bins)
    }

    /// A pixel that lies like a place, or nearly so.
    fn draw(&self, place: usize, rng: &mut Rng) -> Option<usize> {
        let step = (VEIN_BINS.len() + 1) * 2;
        let row = place / step * step;
        // First the same bin, then other distances from the root, then anything.
        let others = (1..DISTANCE_BINS).flat_map(|away| {
            let up = place.checked_add(away * step).filter(|&i| i < self.0.len());
            [up, place.checked_sub(away * step)].into_iter().flatten()
        });
        let found = std::iter::once(place)
            .chain(others)
            .chain(row..(row + step).min(self.0.len()))
            .chain(0..self.0.len())
            .find(|&i| self.0[i].len() > 3 || (i != place && !self.0[i].is_empty()))?;
        let list = &self.0[found];
        let last = u32::try_from(list.len() - 1).unwrap_or(u32::MAX);
        list.get(rng.integer(0, last) as usize).copied()
    }
}

/// Layer of the examples to copy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Layer {
    /// Everything that superpixels lack, at the scale of the leaf.
    Residual,
    /// The finest part, pixel for pixel: grain for pictures of more pixels than the examples have.
    Grain,
}

impl Layer {
    fn of(self, example: &Exemplar) -> &Plane<Lab> {
        match self {
            Self::Residual => &example.residual,
            Self::Grain => &example.grain,
        }
    }
}

/// Fills a grid with `factor` times as many pixels a side as the target's working grid.
pub(crate) fn quilt(
    target: &Structure,
    exemplars: &[Exemplar],
    matches: &[Match],
    layer: Layer,
    factor: f32,
    rng: &Rng,
) -> Plane<Lab> {
    let size =
        |pixels: usize| usize::try_from(floor_i32((pixels as f32 * factor).ceil())).unwrap_or(1).max(1);
    let (width, height) = (size(target.inside.width), size(target.inside.height));
    let mut out: Plane<Lab> = Plane::filled(width, height, [0.0; 3]);
    let mut filled = vec![false; width * height];
    let example_unit = exemplars.iter().map(|example| example.structure.unit).fold(1.0, f32::max);
    // Pixels of the grid for a pixel of an example.
    let zoom = |example: &Exemplar| match layer {
        Layer::Residual => target.unit * factor / example.structure.unit,
        Layer::Grain => 1.0,
    };
    let patch_unit = match layer {
        Layer::Residual => target.unit * factor,
        Layer::Grain => example_unit,
    };
    let side = floor_i32((PATCH * patch_unit).max(6.0));
    let overlap = floor_i32((side as f32 * OVERLAP).max(2.0));
    let to_working = |p: Vec2| target.inside.index_of((p / factor).max(Vec2::ZERO));
    let extent = |pixels: usize| i32::try_from(pixels).unwrap_or(i32::MAX);
    let steps = |pixels: usize| {
        (0..).map(move |i| i * (side - overlap) - overlap).take_while(move |&at| at < extent(pixels))
    };
    for (row, top) in (0_u64..).zip(steps(height)) {
        for (column, left) in (0_u64..).zip(steps(width)) {
            let area = Patch { left, top, side, overlap };
            let Some(anchor) =
                area.anchor(width, height, |p| to_working(p).filter(|&at| target.inside.data[at]))
            else {
                continue;
            };
            let (centre, at) = anchor;
            let region = target.region.data[at] as usize;
            let example = &exemplars[matches[region].exemplar];
            let plane = layer.of(example);
            let spot = &target.vein[at];
            let place = bin(target.distance[at], spot.distance / target.unit, target.margin[at]);
            let mut rng = rng.fork((row << 32) | column);
            let tries = (0..TRIES).filter_map(|_| {
                let source = example.sources.draw(place, &mut rng)?;
                let frame = Frame {
                    target: (centre, spot.direction, spot.normal),
                    source: {
                        let spot = &example.structure.vein[source];
                        (example.structure.inside.centre(source), spot.direction, spot.normal)
                    },
                    scale: 1.0 / zoom(example),
                };
                let energy = example.energy[source] / example.usual_energy - BLEMISH;
                let mut cost = BLEMISH_WEIGHT * example.usual_energy * energy.max(0.0);
                cost += area.misfit(&out, &filled, plane, &frame);
                cost += PLACE_WEIGHT
                    * area.displacement(&frame, |p, q| {
                        let there = example.structure.inside.index_of(q)?;
                        if !example.structure.inside.data[there] {
                            return None;
                        }
                        let here = to_working(p).filter(|&at| target.inside.data[at])?;
                        let vein = target.vein[here].distance / target.unit
                            - example.structure.vein[there].distance / example.structure.unit;
                        let reach = super::vein_profile::REACH;
                        Some(vein.clamp(-reach, reach) * vein.clamp(-reach, reach))
                    });
                Some((cost, frame))
            });
            let best = tries.min_by(|a, b| a.0.total_cmp(&b.0));
            if let Some((_, frame)) = best {
                area.lay(&mut out, &mut filled, plane, &frame, &example.structure.inside);
            }
        }
    }
    out
}

/// Gives the layer of a target, in every step of structural distance, the spread of lightness and colour that its
/// examples have there.
pub(crate) fn match_spread(
    target: &Structure,
    exemplars: &[Exemplar],
    weights: &[f32],
    detail: &mut Plane<Lab>,
) {
    let wanted = exemplars
        .iter()
        .zip(weights)
        .map(|(example, &weight)| (weight, spread(&example.structure, &example.residual.data)))
        .fold([[0.0; 3]; DISTANCE_BINS], |mut sum, (weight, spread)| {
            for (sum, spread) in sum.iter_mut().zip(spread) {
                for channel in 0..3 {
                    sum[channel] += weight * spread[1][channel];
                }
            }
            sum
        });
    let found = spread(target, &detail.data);
    let gain: Vec<Lab> = wanted
        .iter()
        .zip(&found)
        .map(|(wanted, found)| std::array::from_fn(|i| (wanted[i] / found[1][i].max(1e-3)).clamp(0.5, 2.5)))
        .collect();
    for at in target.pixels() {
        let place = (target.distance[at] * DISTANCE_BINS as f32 - 0.5).clamp(0.0, (DISTANCE_BINS - 1) as f32);
        let low = usize::try_from(floor_i32(place)).unwrap_or(0);
        let high = (low + 1).min(DISTANCE_BINS - 1);
        let t = place - low as f32;
        for channel in 0..3 {
            let mean = found[low][0][channel] * (1.0 - t) + found[high][0][channel] * t;
            let gain = gain[low][channel] * (1.0 - t) + gain[high][channel] * t;
            detail.data[at][channel] = (detail.data[at][channel] - mean) * gain;
        }
    }
}

/// Mean and standard deviation of a layer by structural distance.
fn spread(leaf: &Structure, layer: &[Lab]) -> [[Lab; 2]; DISTANCE_BINS] {
    let mut sums = [([0.0_f32; 3], [0.0_f32; 3], 0.0_f32); DISTANCE_BINS];
    for at in leaf.pixels() {
        let far = usize::try_from(floor_i32(leaf.distance[at] * DISTANCE_BINS as f32)).unwrap_or(0);
        let sum = &mut sums[far.min(DISTANCE_BINS - 1)];
        sum.0 = lab::add(sum.0, layer[at]);
        sum.1 = lab::add(sum.1, layer[at].map(|x| x * x));
        sum.2 += 1.0;
    }
    sums.map(|(sum, squares, count)| {
        let mean = lab::scale(sum, 1.0 / count.max(1.0));
        let deviation =
            std::array::from_fn(|i| (squares[i] / count.max(1.0) - mean[i] * mean[i]).max(0.0).sqrt());
        [mean, deviation]
    })
}
