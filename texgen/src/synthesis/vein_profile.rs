// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Difference of veins from the tissue beside them: measured on an example, painted on a target.

use super::smooth::local_mean;
use super::structure::Structure;
use super::vein_field::VeinSpot;
use crate::lab::{self, Lab};
use crate::math::floor_i32;

/// Reach of a vein to either side as a share of √A.
pub(crate) const REACH: f32 = 0.022;
/// Steps from the middle of a vein to its reach.
const STEPS: usize = 12;
/// Steps across a vein, from the side away from the leaf's tip to the side towards it.
const ACROSS: usize = 2 * STEPS + 1;
/// Steps from the root outward.
const ALONG: usize = 4;
/// Ranks that are distinguished: main and lateral.
const RANKS: usize = 2;
/// Pixels that a step of the profile needs to count fully against the mean of its rank.
const ENOUGH: f32 = 30.0;
/// Share of a lateral's difference that a vein of the third rank shows.
const FINE: f32 = 0.2;
/// Width of such a vein against a lateral's.
const FINE_WIDTH: f32 = 0.5;

/// Colour of veins relative to tissue, by rank, way from the root and place across.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct VeinProfile {
    delta: [[[Lab; ACROSS]; ALONG]; RANKS],
    /// Mean half width by rank as a share of √A.
    pub(crate) radius: [f32; RANKS],
}

impl VeinProfile {
    /// Measures the veins of an example.
    pub(crate) fn measure(leaf: &Structure, colour: &[Lab]) -> Self {
        let beside = |i: usize| leaf.inside.data[i] && leaf.vein[i].distance > 0.8 * REACH * leaf.unit;
        let tissue = local_mean(leaf, colour, 0.05 * leaf.unit, beside);
        let mut sum = [[[([0.0_f32; 3], 0.0_f32); ACROSS]; ALONG]; RANKS];
        let mut radius = [(0.0_f32, 0.0_f32); RANKS];
        for at in leaf.pixels() {
            let spot = &leaf.vein[at];
            let reference = tissue[at];
            if spot.distance > REACH * leaf.unit || reference == [0.0; 3] || leaf.margin[at] < 0.008 {
                continue;
            }
            let rank = rank_of(spot.order);
            let delta = lab::sub(colour[at], reference);
            let across = (spot.signed / (REACH * leaf.unit) * STEPS as f32).round() + STEPS as f32;
            let across = usize::try_from(floor_i32(across)).unwrap_or(0).min(ACROSS - 1);
            let along = usize::try_from(floor_i32(spot.along * ALONG as f32)).unwrap_or(0).min(ALONG - 1);
            let cell = &mut sum[rank][along][across];
            cell.0 = lab::add(cell.0, delta);
            cell.1 += 1.0;
            radius[rank].0 += spot.radius / leaf.unit;
            radius[rank].1 += 1.0;
        }
        let mut delta = [[[[0.0; 3]; ACROSS]; ALONG]; RANKS];
        for rank in 0..RANKS {
            for across in 0..ACROSS {
                let all = (0..ALONG).fold(([0.0; 3], 0.0), |all, along| {
                    let (colour, count) = sum[rank][along][across];
                    (lab::add(all.0, colour), all.1 + count)
                });
                let mean = lab::scale(all.0, 1.0 / all.1.max(1.0));
                for along in 0..ALONG {
                    let (colour, count) = sum[rank][along][across];
                    let own = lab::add(colour, lab::scale(mean, ENOUGH));
                    delta[rank][along][across] = lab::scale(own, 1.0 / (count + ENOUGH));
                }
            }
        }
        let radius = radius.map(|(sum, count)| if count > 0.0 { sum / count } else { 0.005 });
        Self { delta, radius }
    }

    /// Difference to tissue beside a vein; `unit` is √A in the pixels of the spot.
    pub(crate) fn at(&self, spot: &VeinSpot, unit: f32) -> Lab {
        let width = if spot.order > 2 { FINE_WIDTH } else { 1.0 };
        let place = spot.signed / (REACH * unit * width);
        if place.abs() >= 1.0 {
            return [0.0; 3];
        }
        // The last steps fade, so that no rim shows.
        let fade = ((1.0 - place.abs()) * 4.0).min(1.0);
        let strength = if spot.order > 2 { FINE * fade } else { fade };
        let across = (place + 1.0) * STEPS as f32;
        let along = (spot.along * ALONG as f32 - 0.5).clamp(0.0, (ALONG - 1) as f32);
        let table = &self.delta[rank_of(spot.order)];
        let (x, y) = (floor_i32(across), floor_i32(along));
        let (fx, fy) = (across - x as f32, along - y as f32);
        let cell = |x: i32, y: i32| {
            let x = usize::try_from(x).unwrap_or(0).min(ACROSS - 1);
            table[usize::try_from(y).unwrap_or(0).min(ALONG - 1)][x]
        };
        let mix = |a: Lab, b: Lab, t: f32| lab::add(lab::scale(a, 1.0 - t), lab::scale(b, t));
        let low = mix(cell(x, y), cell(x + 1, y), fx);
        let high = mix(cell(x, y + 1), cell(x + 1, y + 1), fx);
        lab::scale(mix(low, high, fy), strength)
    }
}

/// Row of the table for a vein's rank.
fn rank_of(order: u8) -> usize {
    usize::from(order > 1)
}
