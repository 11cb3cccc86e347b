// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Wakes of what the air goes through or around on all sides: trees, and solid things that are slender or above the ground.
//!
//! # Model
//! A tree takes from the wind the momentum that its drag is: lidar scans of the wake of a solitary mature tree found there all but
//! 1 to 10 % of the force on its stem (Angelou, Mann and Dellwik, 2021, doi 10.1017/jfm.2021.275). The lack is spread as a Gaussian that widens
//! downwind and keeps its momentum, as behind a wind turbine (Bastankhah and Porté-Agel, 2014, doi 10.1016/j.renene.2014.01.002), with the
//! tree's own drag in place of the turbine's thrust. At the rim of the crown the wake is as wide as makes the air on its axis √(1 - c) of the free,
//! c the drag coefficient of the crown, as the momentum theory of a porous disc has it. The ground mirrors it.

use std::f64::consts::{SQRT_2, TAU};

use super::bluff::Footprint;
use super::shelter::{Node, ShelterGrid, ShelterWind};
use crate::motion::AIR_DENSITY;
use crate::tree::forest::Planted;
use crate::tree::{AttachmentKind, Forest};

/// Drag coefficient of solid things: an assumption between those of round and of angular ones.
const SOLID_DRAG: f64 = 1.0;
/// Length of their wakes in square roots of their areas.
pub(super) const SLENDER_LENGTHS: f64 = 12.0;
/// Length of a wake in heights of its tree. Without fading out, the axis behind a maple of 12 m would lack 2.5 % of the wind there.
pub(super) const WAKE_HEIGHTS: f64 = 7.0;
/// Half width of a wake in standard deviations; it lacks next to nothing beyond.
const MOST_SIDE: f64 = 4.0;
/// Part of the length in which the rest of a wake fades out.
const FADE_SHARE: f64 = 0.25;
/// Widening of a wake's standard deviation per metre: an assumption.
const SPREAD: f64 = 0.1;
/// Wind speed in m/s at which crowns have turned aside as far as the table assumes, so that it does not depend on the wind's speed.
const DRAG_SPEED_M_S: f64 = 5.0;
/// Largest drag coefficient of a crown: what the leaves of a dense one take from each other is not in the sum over them.
const MOST_DRAG: f64 = 0.8;
/// Way in heights of the tree that limbs sway out of its rim downwind.
pub(super) const SWAY_HEIGHTS: f64 = 0.2;

/// Wake of a tree, or of a solid thing that is slender or above the ground, in the frame of the wind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PorousWake {
    /// Downwind rim in m along the wind.
    rim_m: f64,
    /// Distance behind the rim in m at which the wake begins.
    gap_m: f64,
    /// Distance behind the rim in m at which nothing is left of it.
    length_m: f64,
    /// Middle in m across the wind.
    across_m: f64,
    /// Middle in m above the ground.
    height_m: f64,
    /// Standard deviations in m across and up at the rim.
    spread_m: [f64; 2],
    /// Drag area in m²: drag over dynamic pressure.
    drag_m2: f64,
}

/// Sums over the drag areas of a tree, which its place and width follow from.
#[derive(Clone, Copy, Debug, Default)]
struct DragSum {
    area: f64,
    across: f64,
    across_squared: f64,
    height: f64,
    height_squared: f64,
    rim_m: f64,
}

impl DragSum {
    fn add(&mut self, area: f64, [along_m, across_m]: [f64; 2], height_m: f64) {
        self.area += area;
        self.across += area * across_m;
        self.across_squared += area * across_m * across_m;
        self.height += area * height_m;
        self.height_squared += area * height_m * height_m;
        self.rim_m = self.rim_m.max(along_m);
    }
}

impl PorousWake {
    /// The wake of a tree; `None` if it has no drag.
    pub(super) fn of(
        tree: &Planted,
        forest: &Forest,
        grid: &ShelterGrid,
        wind: &ShelterWind,
    ) -> Option<Self> {
        let half_air = 0.5 * AIR_DENSITY;
        let constants = |segment: usize| &forest.segments()[tree.rows[segment] as usize];
        let mut sum = DragSum { rim_m: f64::NEG_INFINITY, ..DragSum::default() };
        for (index, segment) in tree.skeleton.segments.iter().enumerate() {
            let (start, end) = (segment.start_m.as_dvec3(), segment.end_m.as_dvec3());
            let axis = (end - start).normalize();
            let along = axis.x * wind.direction_x + axis.z * wind.direction_z;
            // Only the wind across a branch counts, and only that part of the force which is along the wind.
            let squared = (1.0 - along * along).max(0.0);
            let area = f64::from(constants(index).wood_drag) / half_air * squared * libm::sqrt(squared);
            let middle = 0.5 * (start + end);
            sum.add(area, wind.frame(middle.x, middle.z), middle.y);
            sum.rim_m = sum.rim_m.max(wind.frame(end.x, end.z)[0]);
        }
        for leaf in tree.skeleton.attachments.iter().filter(|at| at.kind == AttachmentKind::Leaf) {
            let constants = constants(leaf.segment as usize);
            let yielding = 1.0 + DRAG_SPEED_M_S * f64::from(constants.leaf_yield);
            let area = f64::from(constants.leaf_drag) / half_air / yielding * wind.leaves_left;
            let place = leaf.at_m.as_dvec3();
            sum.add(area, wind.frame(place.x, place.z), place.y);
        }
        if sum.area < 1e-6 {
            return None;
        }
        let (across_m, height_m) = (sum.across / sum.area, sum.height / sum.area);
        // A disc has a quarter of its diameter as its deviation; a wake with √2 times that lacks c - c²/2 on its axis, as the disc does.
        let spread = |squares: f64, mean: f64, least_m: f64| {
            libm::hypot(libm::sqrt(2.0 * (squares / sum.area - mean * mean).max(0.0)), least_m)
        };
        let spread_m = [
            spread(sum.across_squared, across_m, 0.5 * grid.cell_m),
            spread(sum.height_squared, height_m, 0.5 * grid.layer_m),
        ];
        let foot = wind.frame(tree.foot_m.x.into(), tree.foot_m.z.into());
        let tall_m = f64::from(tree.skeleton.height_m());
        let gap_m = SQRT_2 * grid.cell_m + SWAY_HEIGHTS * tall_m;
        Some(Self {
            rim_m: foot[0] + sum.rim_m,
            gap_m,
            length_m: gap_m + WAKE_HEIGHTS * tall_m,
            across_m: foot[1] + across_m,
            height_m,
            spread_m,
            drag_m2: sum.area.min(MOST_DRAG * TAU * spread_m[0] * spread_m[1]),
        })
    }

    /// The wake of a solid thing whose lowest and highest points are so high above the ground.
    /// Air passes through a share of it, which has no drag.
    pub(super) fn of_solid(
        footprint: &Footprint,
        [low_m, high_m]: [f64; 2],
        open: f64,
        grid: &ShelterGrid,
    ) -> Self {
        let [from_m, to_m] = footprint.sides_m();
        let (wide_m, tall_m) = (to_m - from_m, high_m - low_m);
        let area_m2 = wide_m * tall_m;
        // As of a tree: √2 times the deviation of the thing itself.
        let spread = |size_m: f64, least_m: f64| libm::hypot(size_m * SQRT_2 / libm::sqrt(12.0), least_m);
        let spread_m = [spread(wide_m, 0.5 * grid.cell_m), spread(tall_m, 0.5 * grid.layer_m)];
        Self {
            rim_m: footprint.ends_m()[1],
            gap_m: 0.0,
            length_m: SLENDER_LENGTHS * libm::sqrt(area_m2),
            across_m: 0.5 * (from_m + to_m),
            height_m: 0.5 * (low_m + high_m),
            spread_m,
            drag_m2: (SOLID_DRAG * (1.0 - open) * area_m2).min(MOST_DRAG * TAU * spread_m[0] * spread_m[1]),
        }
    }

    /// The rectangle of places whose wind it may lack: ranges in m along and across the wind.
    pub(super) fn reach_m(&self) -> [[f64; 2]; 2] {
        let half_m = MOST_SIDE * (self.spread_m[0] + SPREAD * self.length_m);
        [
            [self.rim_m + self.gap_m, self.rim_m + self.length_m],
            [self.across_m - half_m, self.across_m + half_m],
        ]
    }

    /// Share of the wind that the wake lacks at a place, at every height of the table; `None` outside of the wake.
    pub(super) fn lack(&self, [along_m, across_m]: [f64; 2], layer_m: f64) -> Option<Node> {
        let behind_m = along_m - self.rim_m;
        if behind_m <= self.gap_m || behind_m >= self.length_m {
            return None;
        }
        let [wide, tall] = self.spread_m.map(|spread_m| spread_m + SPREAD * behind_m);
        let side = (across_m - self.across_m) / wide;
        if side.abs() > MOST_SIDE {
            return None;
        }
        let fade = ((1.0 - behind_m / self.length_m) / FADE_SHARE).min(1.0);
        let axis = 1.0 - libm::sqrt((1.0 - self.drag_m2 / (TAU * wide * tall)).max(0.0));
        let level = fade * axis * libm::exp(-0.5 * side * side);
        let bell = |up_m: f64| libm::exp(-0.5 * (up_m / tall) * (up_m / tall));
        Some(std::array::from_fn(|number| {
            let above_m = number as f64 * layer_m;
            (level * (bell(above_m - self.height_m) + bell(above_m + self.height_m))).min(1.0)
        }))
    }
}
