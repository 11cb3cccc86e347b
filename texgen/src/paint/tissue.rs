// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Colour of each spot of a leaf: how far its own autumn has come, and what that does to its pigments.

use glam::Vec2;

use super::canvas::Spot;
use crate::math::{lerp, smoothstep};
use crate::rng::Rng;
use crate::season::Pigments;
use crate::{Shape, noise, season};

/// Linear sRGB colour.
type Linear = [f32; 3];

/// Junction of blade and petiole.
const BASE: Vec2 = Vec2::new(0.0, -1.0);

/// Character of one leaf's colouring.
pub(super) struct Tissue {
    shape: Shape,
    /// Season from 0 (green) to 1 (brown).
    season: f32,
    seed: u64,
    /// Factor on red.
    blush: f32,
    /// Unevenness of the season.
    patchiness: f32,
    /// Delay of the season along the veins.
    lingering: f32,
    /// Width of the dead border in leaf units.
    scorch: f32,
    /// Amount of small dark spots, 0..=1.
    specks: f32,
    /// Direction in which the season is ahead.
    drift: Vec2,
    /// Factor on all pigments: pale or deep leaves.
    depth: f32,
    /// Factor on brown: bleached or dark dry leaves.
    brownness: f32,
}

impl Tissue {
    /// Draws the character of a leaf.
    pub(super) fn draw(shape: Shape, season: f32, rng: &mut Rng) -> Self {
        let late = smoothstep(0.35, 0.95, season);
        let (lingering, scorch) = match shape {
            Shape::Maple => (0.2, 0.05),
            Shape::JapaneseMaple => (0.1, 0.03),
            Shape::Oak => (0.22, 0.05),
            Shape::Birch => (0.16, 0.035),
            Shape::Beech => (0.26, 0.05),
            Shape::Hornbeam => (0.22, 0.045),
            Shape::Linden => (0.2, 0.06),
            Shape::Ginkgo => (0.05, 0.02),
        };
        let blush = if shape == Shape::Maple {
            // Some maples stay yellow, others turn all red.
            lerp(0.05, 1.9, rng.unit())
        } else {
            1.0 + 0.4 * rng.bell()
        };
        Self {
            shape,
            season,
            seed: rng.bits(),
            blush,
            patchiness: rng.range(0.6, 1.3),
            lingering: lingering * rng.range(0.5, 1.5),
            scorch: scorch * late * rng.range(0.0, 2.0),
            specks: if rng.chance(0.25 + 0.5 * late) {
                rng.range(0.2, 1.0) * lerp(0.4, 1.0, late)
            } else {
                0.0
            },
            drift: Vec2::from_angle(rng.range(0.0, std::f32::consts::TAU)) * rng.range(0.0, 0.09),
            depth: 1.0 + 0.14 * rng.bell(),
            brownness: rng.range(0.6, 1.3),
        }
    }

    /// Linear colour of a spot.
    pub(super) fn colour(&self, spot: &Spot) -> Linear {
        let age = self.age(spot);
        let mut pigments = self.living(spot, age);
        self.kill(spot, &mut pigments);
        let veined = self.veined(spot, age, pigments);
        let blade = veined.albedo();
        // The blade bulges between its veins; the renderer lights it, so only a hint is painted.
        let shade = 1.0 + 0.06 * spot.slope;
        // The petiole goes on into the ribs and only slowly takes their colour.
        let into_ribs = 0.7 * spot.strokes[0] * (-spot.at.distance(BASE) / 0.3).exp();
        let stem_share = spot.petiole.max(into_ribs);
        let stem = if stem_share > 0.0 { self.stem(spot) } else { blade };
        std::array::from_fn(|i| lerp(blade[i] * shade, stem[i], stem_share).clamp(0.0, 1.0))
    }

    /// Season at a spot.
    fn age(&self, spot: &Spot) -> f32 {
        let season = self.season;
        // Leaves are most uneven in mid autumn.
        let unevenness = lerp(0.3, 1.0, 1.0 - (2.0 * season - 1.0).abs().powi(2));
        let at = self.along_veins(spot.at);
        let patches = noise::fractal(self.seed, at * 1.6, 3) * 0.17 * self.patchiness;
        let blotches = noise::fractal(self.seed ^ 0x10, at * 5.0, 2) * 0.06 * self.patchiness;
        // The margin by the petiole is no older than the petiole.
        let from_base = spot.at.distance(BASE);
        let rim = 0.13 * (-spot.margin / 0.14).exp() * smoothstep(0.1, 0.7, from_base);
        let green = self.lingering * (-spot.vein / 0.055).exp();
        season + unevenness * (patches + blotches + rim - green + self.drift.dot(spot.at) + 0.03)
    }

    /// Plane in which patches are round: a fan's run along its veins.
    fn along_veins(&self, at: Vec2) -> Vec2 {
        if self.shape != Shape::Ginkgo {
            return at;
        }
        let offset = at - BASE;
        Vec2::new(offset.x.atan2(offset.y) * 2.6, offset.length() * 0.5)
    }

    /// Pigments of living tissue.
    fn living(&self, spot: &Spot, age: f32) -> Pigments {
        let mut pigments = season::pigments(self.shape, age);
        let flush = noise::fractal(self.seed ^ 0x20, spot.at * 2.2, 3);
        pigments.anthocyanin *=
            self.blush * (1.0 + 0.55 * flush + 0.25 * (-spot.margin / 0.1).exp()).max(0.1);
        let mottle = 0.1 * noise::fractal(self.seed ^ 0x30, spot.at * 11.0, 2)
            + 0.05 * noise::value(self.seed ^ 0x31, spot.at * 45.0);
        // Dry leaves bleach and darken in blotches of every size.
        let stains = 0.28 * noise::fractal(self.seed ^ 0x32, self.along_veins(spot.at) * 3.0, 5);
        pigments.brown *= self.brownness * (1.0 + stains);
        pigments * (self.depth * (1.0 + mottle))
    }

    /// Adds a dead border and dead spots.
    fn kill(&self, spot: &Spot, pigments: &mut Pigments) {
        let dead = self.scorched(spot).max(self.speckled(spot));
        *pigments = *pigments * (1.0 - 0.75 * dead)
            + Pigments { brown: 1.5 * dead, carotenoid: 3.0 * dead, ..Pigments::default() };
    }

    /// Share of the dead border at a spot.
    fn scorched(&self, spot: &Spot) -> f32 {
        // Noise reaches 1.4.
        if spot.margin > self.scorch * (0.55 + 1.1 * 1.4) + 0.02 {
            return 0.0;
        }
        let ragged = noise::fractal(self.seed ^ 0x40, spot.at * 4.0, 3);
        let border = self.scorch * (0.55 + 1.1 * ragged);
        smoothstep(border + 0.02, border - 0.03, spot.margin) * smoothstep(0.0, 0.02, border)
    }

    /// Share of dead spots, large and small.
    fn speckled(&self, spot: &Spot) -> f32 {
        if self.specks <= 0.0 {
            return 0.0;
        }
        let gate = 0.35 + 0.65 * smoothstep(-0.2, 0.6, noise::value(self.seed ^ 0x52, spot.at * 2.0));
        let large = self.dots(0x50, spot.at * 4.0, 0.2, 0.2 * gate);
        let small = self.dots(0x51, spot.at * 10.0, 0.26, 0.32 * gate) * 0.7;
        large.max(small)
    }

    /// Scattered spots of up to a radius; `share` of the cells hold one.
    fn dots(&self, layer: u64, at: Vec2, radius: f32, share: f32) -> f32 {
        let share = share * self.specks;
        let cell = noise::cells(self.seed ^ layer, at);
        if cell.lot >= share {
            return 0.0;
        }
        let ragged = 1.0 + 0.4 * noise::value(self.seed ^ layer ^ 0x70, at * 5.0);
        let radius = radius * lerp(1.0, 0.35, cell.lot / share) * ragged;
        smoothstep(radius, radius * 0.5, cell.first)
    }

    /// Pigments with the veins drawn in: pale while the leaf lives, dark when it is dry.
    fn veined(&self, spot: &Spot, age: f32, tissue: Pigments) -> Pigments {
        let [primary, secondary, tertiary] = spot.strokes;
        let mut strength = primary.max(0.85 * secondary).max(0.42 * tertiary);
        if self.shape != Shape::Ginkgo {
            let cell = noise::cells(self.seed ^ 0x60, spot.at * 21.0);
            strength = strength.max(0.2 * smoothstep(0.14, 0.0, cell.second - cell.first));
        }
        let dry = smoothstep(0.45, 0.85, age);
        Pigments {
            chlorophyll: tissue.chlorophyll * (1.0 - 0.62 * strength),
            carotenoid: tissue.carotenoid * (1.0 - 0.25 * strength),
            anthocyanin: tissue.anthocyanin * (1.0 - 0.4 * strength),
            brown: tissue.brown + strength * lerp(0.01, 0.6, dry),
        }
    }

    /// Colour of the petiole.
    fn stem(&self, spot: &Spot) -> Linear {
        let season = self.season;
        let red = match self.shape {
            Shape::Maple | Shape::JapaneseMaple => 0.55,
            Shape::Birch | Shape::Beech => 0.2,
            Shape::Oak | Shape::Hornbeam | Shape::Linden | Shape::Ginkgo => 0.04,
        };
        let own = season::pigments(self.shape, season * 0.85);
        let pigments = Pigments {
            chlorophyll: 0.5 * own.chlorophyll,
            carotenoid: 0.6 * own.carotenoid,
            anthocyanin: 0.4 * own.anthocyanin * self.blush + 16.0 * red * lerp(0.5, 1.0, season),
            brown: 0.08 + 0.75 * own.brown + 0.3 * season,
        };
        let round = lerp(0.8, 1.1, smoothstep(0.0, 0.02, spot.margin));
        pigments.albedo().map(|c| c * round)
    }
}
