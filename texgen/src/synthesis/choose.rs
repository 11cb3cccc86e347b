// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Chooses for every region of the target a region of an example, and for every superpixel one of that region.

use super::exemplar::{Exemplar, Region, describe_regions};
use super::structure::{Place, Structure};
use crate::lab::{self, Lab};
use crate::rng::Rng;

/// Weight of a difference of area: 5 % of the blade halve the likeness.
const AREA_WEIGHT: f32 = 400.0;
/// Share of all example regions that may be drawn.
const CANDIDATE_SHARE: f32 = 0.2;
/// Superpixels of the matched region that come into question, nearest by structure first.
const NEAREST: usize = 12;
/// Number of them that are drawn, to keep the one nearest in colour to the parent.
const DRAWN: usize = 4;

/// Least distance of a leaf's mean colour from every example's, as a share of their mean distance.
const AWAY: f32 = 0.32;
/// Draws to get there.
const MEAN_TRIES: u32 = 16;

/// Part of an example that a region of the target takes after.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Match {
    /// Index of the example.
    pub(crate) exemplar: usize,
    /// Region of that example.
    region: u32,
}

/// Shares that one leaf takes from each example.
#[derive(Clone, Debug)]
pub(crate) struct Shares {
    /// Weight of each example for regions, detail and veins; they sum to 1. One example leads.
    pub(crate) weights: Vec<f32>,
    /// Weight of each example in the leaf's mean colour; they sum to 1, and some may be below 0.
    pub(crate) mean: Vec<f32>,
}

/// Draws what one leaf takes from each example. Its mean colour lies off the leader's, towards another example or
/// away from it: leaves that average their examples would all look alike, and those that do not would be copies.
pub(crate) fn draw_shares(means: &[Lab], rng: &mut Rng) -> Shares {
    let count = means.len();
    let last = u32::try_from(count.saturating_sub(1)).unwrap_or(0);
    let lead = rng.integer(0, last) as usize;
    let weights: Vec<f32> =
        (0..count).map(|index| if index == lead { 1.0 } else { rng.range(0.02, 0.1) }).collect();
    let sum: f32 = weights.iter().sum();
    let weights = weights.into_iter().map(|weight| weight / sum.max(1e-6)).collect();
    let gap = |a: Lab, b: Lab| lab::distance_squared(a, b).sqrt();
    let pairs = (0..count).flat_map(|i| (0..i).map(move |j| gap(means[i], means[j])));
    let spread = pairs.sum::<f32>() / ((count * count.saturating_sub(1)) as f32 / 2.0).max(1.0);
    let mut best: (f32, Vec<f32>) = (-1.0, Vec::new());
    for _ in 0..MEAN_TRIES {
        let other = (lead + rng.integer(1, last.max(1)) as usize) % count.max(1);
        let towards = if rng.chance(0.5) { rng.range(0.3, 0.5) } else { -rng.range(0.3, 0.45) };
        let mut mean = vec![0.0; count];
        mean[lead] = 1.0 - towards;
        mean[other] += towards;
        let colour = means
            .iter()
            .zip(&mean)
            .fold([0.0; 3], |sum, (colour, &share)| lab::add(sum, lab::scale(*colour, share)));
        let nearest = means.iter().map(|&other| gap(colour, other)).fold(f32::INFINITY, f32::min);
        if nearest > best.0 {
            best = (nearest, mean);
        }
        if nearest > AWAY * spread {
            break;
        }
    }
    Shares { weights, mean: best.1 }
}

/// Matches the regions of the target.
pub(crate) fn match_regions(
    target: &Structure,
    exemplars: &[Exemplar],
    weights: &[f32],
    rng: &mut Rng,
) -> Vec<Match> {
    let all: Vec<(Match, Region)> = exemplars
        .iter()
        .enumerate()
        .flat_map(|(exemplar, example)| {
            (0_u32..)
                .zip(&example.regions)
                .map(move |(region, described)| (Match { exemplar, region }, *described))
        })
        .collect();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a share of a count")]
    let fifth = (CANDIDATE_SHARE * all.len() as f32).ceil() as usize;
    let keep = fifth.max(2);
    describe_regions(target)
        .iter()
        .map(|region| {
            let mut likely: Vec<(f32, Match)> = all
                .iter()
                .map(|(found, described)| {
                    (likeness(region, described) * weights[found.exemplar] + 1e-6, *found)
                })
                .collect();
            likely.sort_by(|a, b| b.0.total_cmp(&a.0));
            likely.truncate(keep);
            let total: f32 = likely.iter().map(|(p, _)| p).sum();
            let mut left = rng.unit() * total;
            let drawn = likely.iter().find(|(p, _)| {
                left -= p;
                left <= 0.0
            });
            drawn.or(likely.last()).map_or(Match { exemplar: 0, region: 0 }, |(_, found)| *found)
        })
        .collect()
}

/// Equation 1 of the source, with its terms made comparable: overlap of the ranges of structural distance, lowered by
/// the difference of the shares of area.
fn likeness(a: &Region, b: &Region) -> f32 {
    let overlap = (a.range.1.min(b.range.1) - a.range.0.max(b.range.0)).max(0.0);
    let union = (a.range.1.max(b.range.1) - a.range.0.min(b.range.0)).max(1e-4);
    let gap = a.share - b.share;
    overlap / union / (1.0 + AREA_WEIGHT * gap * gap)
}

/// Colours of the target's superpixels, level after level. Colours of examples are moved by the difference of the
/// examples' means to `mean`, so that regions of several leaves go together.
pub(crate) fn choose_levels(
    target: &Structure,
    exemplars: &[Exemplar],
    matches: &[Match],
    mean: Lab,
    rng: &Rng,
) -> Vec<Vec<Lab>> {
    let members: Vec<Vec<Vec<Vec<usize>>>> = exemplars.iter().map(by_region).collect();
    let mut chosen: Vec<Vec<Lab>> = Vec::new();
    for (level, superpixels) in target.levels.iter().enumerate() {
        let mut rng = rng.fork(level as u64);
        let parents = chosen.last().map(|colours| parent_colours(target, level, colours));
        let places = target.places(superpixels);
        let colours = places.iter().enumerate().map(|(number, place)| {
            let found = matches[place.region as usize];
            let example = &exemplars[found.exemplar];
            let shift = lab::sub(mean, example.mean);
            let pool = &example.levels[level];
            let region = &members[found.exemplar][level][found.region as usize];
            let everything: Vec<usize>;
            let candidates = if region.is_empty() {
                everything = (0..pool.len()).collect();
                &everything
            } else {
                region
            };
            let nearest = nearest(place, pool, candidates);
            let draw = |rng: &mut Rng| {
                let last = u32::try_from(nearest.len().saturating_sub(1)).unwrap_or(0);
                nearest.get(rng.integer(0, last) as usize).map_or(example.mean, |&i| pool[i].1)
            };
            let colour = match &parents {
                None => draw(&mut rng),
                Some(parents) => {
                    let wanted = lab::sub(parents[number], shift);
                    let drawn: [Lab; DRAWN] = std::array::from_fn(|_| draw(&mut rng));
                    let far = |colour: &Lab| lab::distance_squared(*colour, wanted);
                    drawn.into_iter().reduce(|a, b| if far(&b) < far(&a) { b } else { a }).unwrap_or(wanted)
                }
            };
            lab::add(colour, shift)
        });
        let colours = colours.collect();
        chosen.push(colours);
    }
    chosen
}

/// Superpixels of an example by level and region.
fn by_region(example: &Exemplar) -> Vec<Vec<Vec<usize>>> {
    let collect = |level: &Vec<(Place, Lab)>| {
        let mut out = vec![Vec::new(); example.regions.len()];
        for (number, (place, _)) in level.iter().enumerate() {
            out[place.region as usize].push(number);
        }
        out
    };
    example.levels.iter().map(collect).collect()
}

/// The candidates whose place in the leaf is most like another's.
fn nearest(place: &Place, pool: &[(Place, Lab)], candidates: &[usize]) -> Vec<usize> {
    let gap = |i: usize| {
        let other = &pool[i].0;
        (place.distance - other.distance).abs()
            + 0.5 * (place.vein - other.vein).abs()
            + 0.25 * (place.margin - other.margin).abs()
    };
    let mut sorted: Vec<(f32, usize)> = candidates.iter().map(|&i| (gap(i), i)).collect();
    if sorted.len() > NEAREST {
        sorted.select_nth_unstable_by(NEAREST, |a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        sorted.truncate(NEAREST);
    }
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    sorted.into_iter().map(|(_, i)| i).collect()
}

/// For each superpixel of a level the mean colour of what lies under it one level coarser.
fn parent_colours(target: &Structure, level: usize, coarser: &[Lab]) -> Vec<Lab> {
    let mut sums = vec![([0.0_f32; 3], 0.0_f32); target.levels[level].count];
    for at in target.pixels() {
        let sum = &mut sums[target.levels[level].label.data[at] as usize];
        sum.0 = lab::add(sum.0, coarser[target.levels[level - 1].label.data[at] as usize]);
        sum.1 += 1.0;
    }
    sums.into_iter().map(|(sum, count)| lab::scale(sum, 1.0 / count.max(1.0))).collect()
}
