// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Height and normal of a leaf's upper side: the blade bulges between veins, veins lie in grooves and stand out of
//! them again as round ribs, the petiole is round.

use glam::{Vec2, Vec3};

use super::Dressed;
use super::petiole::StemSpot;
use crate::distance::nearest_seed;
use crate::lab;
use crate::math::{floor_i32, segment_distance};
use crate::synthesis::vein_field::VeinField;

/// Height of the bulge between veins as a share of √A.
const BULGE: f32 = 0.011;
/// Distance from a vein at which the bulge has risen by 63 %, as a share of √A.
const BULGE_REACH: f32 = 0.03;
/// Height of a vein's rib for its radius.
const RIB: f32 = 0.45;
/// Depth of the groove of fine veins as a share of √A.
const FINE_GROOVE: f32 = 0.0016;
/// Height of one step of lightness as a share of √A: grain that is painted is also felt.
const GRAIN: f32 = 0.000_22;
/// Range of heights as a share of √A.
const RANGE: f32 = 0.05;

/// Heights of a leaf, pixel by pixel.
pub(super) struct Relief {
    size: usize,
    unit: f32,
    /// Height in pixels.
    height: Vec<f32>,
    /// Place on the petiole.
    pub(super) stem: Vec<StemSpot>,
    /// Thickness by veins and petiole: 0 tissue only, 1 a strong midrib.
    pub(super) thickness: Vec<f32>,
}

impl Relief {
    /// Computes the relief of a painted leaf.
    pub(super) fn new(leaf: &Dressed<'_>, blade_cover: &[f32]) -> Self {
        let size = leaf.blade.mask.width as usize;
        let unit = (leaf.blade.mask.area().max(1) as f32).sqrt();
        let strong = VeinField::new(leaf.blade, leaf.veins, 0..=2, unit);
        let fine = VeinField::new(leaf.blade, leaf.veins, 3..=u8::MAX, unit);
        let inside = &leaf.blade.mask.inside;
        let (rim, _) = nearest_seed(size, size, |at| !inside[at]);
        let grain = grain(leaf, size);
        let stem = stem_spots(leaf, size);
        let mut height = vec![0.0; size * size];
        let mut thickness = vec![0.0_f32; size * size];
        for at in 0..size * size {
            if blade_cover[at] > 0.0 {
                let edge = (rim.data[at] / (0.02 * unit)).min(1.0);
                let (mut bulge, mut rib) = (1.0, 0.0);
                if let Some(field) = &strong {
                    let spot = field.spot(at);
                    let beyond = (spot.distance - spot.radius).max(0.0) / (BULGE_REACH * unit);
                    bulge = 1.0 - libm::expf(-beyond);
                    let round = 1.0 - (spot.distance / spot.radius.max(0.6)).powi(2);
                    rib = spot.radius * round.max(0.0).sqrt();
                }
                let groove = fine.as_ref().map_or(0.0, |field| {
                    let spot = field.spot(at);
                    libm::expf(-(spot.distance / (0.006 * unit)).powi(2))
                });
                height[at] = BULGE * unit * bulge * edge + RIB * rib - FINE_GROOVE * unit * groove
                    + GRAIN * unit * grain[at];
                thickness[at] = (rib / (0.014 * unit)).min(1.0).max(0.12 * groove);
            }
            if blade_cover[at] < 1.0 && stem[at].across <= 1.3 {
                let radius = 0.012 * unit;
                let round = (1.0 - stem[at].across * stem[at].across).max(0.0).sqrt();
                let share = 1.0 - blade_cover[at];
                height[at] = height[at] * (1.0 - share) + radius * round * share;
                thickness[at] = thickness[at] * (1.0 - share) + (0.6 + 0.4 * round) * share;
            }
        }
        Self { size, unit, height, stem, thickness }
    }

    /// Height as a share of the map's range.
    pub(super) fn height_share(&self, at: usize) -> f32 {
        0.5 + self.height[at] / (RANGE * self.unit)
    }

    /// Unit normal at a pixel, y up.
    pub(super) fn normal(&self, x: usize, y: usize) -> Vec3 {
        let at = |x: usize, y: usize| self.height[y.min(self.size - 1) * self.size + x.min(self.size - 1)];
        let dx = (at(x + 1, y) - at(x.saturating_sub(1), y)) / 2.0;
        let dy = (at(x, y + 1) - at(x, y.saturating_sub(1))) / 2.0;
        Vec3::new(-dx, dy, 1.0).normalize_or(Vec3::Z)
    }
}

/// Lightness of the picture against that of its surroundings.
fn grain(leaf: &Dressed<'_>, size: usize) -> Vec<f32> {
    let light: Vec<f32> = leaf.colour.pixels().map(|pixel| lab::from_srgb(pixel.0)[0]).collect();
    let blurred = |source: &[f32], step: usize| -> Vec<f32> {
        (0..size * size)
            .map(|at| {
                let place = if step == 1 { at % size } else { at / size };
                let before = if place > 1 { source[at - 2 * step] } else { source[at] };
                let after = if place + 2 < size { source[at + 2 * step] } else { source[at] };
                (before + 2.0 * source[at] + after) / 4.0
            })
            .collect()
    };
    let smooth = blurred(&blurred(&light, 1), size);
    light.iter().zip(smooth).map(|(light, smooth)| (light - smooth).clamp(-12.0, 12.0)).collect()
}

/// Place of every pixel on the petiole.
fn stem_spots(leaf: &Dressed<'_>, size: usize) -> Vec<StemSpot> {
    let mut spots = vec![StemSpot { across: f32::INFINITY, along: 1.0 }; size * size];
    let last = leaf.petiole.len().saturating_sub(1).max(1) as f32;
    let clamp = |x: f32| usize::try_from(floor_i32(x)).unwrap_or(0).min(size);
    for (index, pair) in leaf.petiole.windows(2).enumerate() {
        let ((a, from), (b, to)) = (pair[0], pair[1]);
        let reach = from.max(to) * 1.5 + 2.0;
        let (low, high) = (a.min(b) - reach, a.max(b) + reach);
        for y in clamp(low.y)..clamp(high.y + 1.0) {
            for x in clamp(low.x)..clamp(high.x + 1.0) {
                let p = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
                let (distance, t) = segment_distance(p, a, b);
                let across = distance / (from + (to - from) * t).max(0.5);
                let spot = &mut spots[y * size + x];
                if across < spot.across {
                    *spot = StemSpot { across, along: (index as f32 + t) / last };
                }
            }
        }
    }
    spots
}
