// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Main, lateral and tertiary veins led by the margin (Kim and Kim 2017, corrected).
//!
//! Points of the margin serve as target auxins. Main veins grow from the root to the tip and to the strongest
//! lobes at least 25° apart; laterals leave their main vein at 25° to 70° and grow to teeth, lobes or wherever their
//! angle leads; tertiary veins grow across from lateral to lateral.

use glam::Vec2;

use super::curve::Curve;
use super::draft::{Draft, Refusal};
use super::flow::{WidthLaw, finish};
use super::ground::Ground;
use super::habit::{Habit, Layout};
use super::laterals::{Flank, angle, direction_at};
use super::margin::Margin;
use super::route::{Routes, Walk, walk};
use super::{STEP, fan, no_vein, tertiary};
use crate::math::quadratic;
use crate::rng::Rng;
use crate::{Blade, TexgenError, VeinGraph, VeinGrower};

/// Growth step as a share of √A.
const STRIDE: f32 = 0.04;
/// Smallest angle between two main veins as seen from the root, in degrees.
const MAINS_APART_DEG: f32 = 25.0;

/// Grows veins along the margin's directions.
#[derive(Clone, Copy, Debug, Default)]
pub struct ContourGuided {
    /// Courses of the veins.
    pub habit: Habit,
    /// Kind of curve.
    pub curve: Curve,
    /// True to add tertiary veins.
    pub tertiary: bool,
}

/// A main vein or lateral as nodes of the draft, from its start outward.
pub(super) type Path = Vec<u32>;

impl VeinGrower for ContourGuided {
    fn grow(&self, blade: &Blade, seed: u64) -> Result<VeinGraph, TexgenError> {
        let ground = Ground::survey(blade)?;
        let mut draft = Draft::new(&ground, STEP * ground.unit);
        let rng = Rng::new(seed);
        self.framework(&mut draft, blade, &rng)?;
        Ok(finish(draft, self.habit.root_radius, WidthLaw::Murray))
    }
}

impl ContourGuided {
    /// Grows main and lateral veins, and tertiary ones if wanted, into a draft that holds only a root.
    pub(super) fn framework(
        &self,
        draft: &mut Draft<'_>,
        blade: &Blade,
        rng: &Rng,
    ) -> Result<(), TexgenError> {
        let ground = draft.ground;
        if self.habit.layout == Layout::Fan {
            fan::grow(draft, &mut rng.fork(1));
            return if draft.nodes.len() < 2 { no_vein() } else { Ok(()) };
        }
        let margin = Margin::new(&blade.outline, ground);
        let routes = Routes::explore(ground);
        let mut mains: Vec<Path> = Vec::new();
        for (index, target) in self.main_targets(&margin, ground).into_iter().enumerate() {
            let way = routes.to(target, ground);
            let how = self.stride(ground, 0.5, 0.22);
            let points = walk(&way, how, ground, &mut rng.fork(100 + index as u64));
            let path = self.lay(draft, 0, &points, 1, 0.04);
            if path.len() > 1 {
                mains.push(path);
            }
        }
        if mains.is_empty() {
            return no_vein();
        }
        let mut laterals = Vec::new();
        let length =
            |draft: &Draft<'_>, path: &Path| draft.at(path[0]).distance(draft.at(path[path.len() - 1]));
        let longest = mains.iter().map(|path| length(draft, path)).fold(0.0, f32::max);
        for (index, main) in mains.iter().enumerate() {
            let share = length(draft, main) / longest.max(1e-6);
            for side in [-1.0, 1.0] {
                let label = 200 + 2 * index as u64 + u64::from(side > 0.0);
                laterals.extend(self.laterals(draft, main, side, share, &margin, &mut rng.fork(label)));
            }
        }
        if self.tertiary {
            for (index, path) in laterals.iter().chain(&mains).enumerate() {
                tertiary::grow(draft, path, self.habit.wander_deg, &mut rng.fork(10_000 + index as u64));
            }
        }
        Ok(())
    }

    /// A walk whose wander is a share of the habit's.
    fn stride(&self, ground: &Ground, calm: f32, ahead: f32) -> Walk {
        Walk {
            step: STRIDE * ground.unit,
            wander_deg: (self.habit.wander_deg * calm).clamp(0.0, 30.0),
            ahead: ahead * ground.unit,
        }
    }

    /// Draws a curve through growth points and adds it to the draft, as far as nothing is in the way.
    fn lay(&self, draft: &mut Draft<'_>, from: u32, points: &[Vec2], order: u8, clearance: f32) -> Path {
        let mut path = vec![from];
        let mut last = from;
        for &p in self.curve.draw(points, draft.step).iter().skip(1) {
            match draft.grow(last, p, order, clearance) {
                Ok(node) => {
                    path.push(node);
                    last = node;
                }
                Err(Refusal::TooLong) => continue,
                Err(_) => break,
            }
        }
        path
    }

    /// Targets of the main veins, the tip first.
    fn main_targets(&self, margin: &Margin, ground: &Ground) -> Vec<Vec2> {
        let mut targets = vec![ground.tip];
        let Layout::Palmate(most) = self.habit.layout else { return targets };
        let reach = ground.root.distance(ground.tip);
        let mut tips: Vec<(f32, Vec2)> = margin
            .tips(0.13 * ground.unit, 0.02 * ground.unit)
            .into_iter()
            .filter_map(|(index, height)| Some((height, margin.target(index)?)))
            .map(|(height, target)| (height.min(0.12 * ground.unit) * target.distance(ground.root), target))
            .filter(|(_, target)| target.distance(ground.root) > 0.25 * reach)
            .collect();
        tips.sort_by(|a, b| b.0.total_cmp(&a.0));
        let apart = MAINS_APART_DEG.to_radians();
        for (_, tip) in tips {
            let direction = tip - ground.root;
            let free = targets.iter().all(|other| angle(*other - ground.root, direction) >= apart);
            if targets.len() < most as usize && free {
                targets.push(tip);
            }
        }
        targets
    }

    /// Laterals on one side of a main vein; `share` is the vein's length against the longest one's.
    fn laterals(
        &self,
        draft: &mut Draft<'_>,
        main: &Path,
        side: f32,
        share: f32,
        margin: &Margin,
        rng: &mut Rng,
    ) -> Vec<Path> {
        let flank = Flank { habit: &self.habit, draft, main, side, margin };
        let plans = flank.plans(share, rng);
        let ground = draft.ground;
        let mut out = Vec::new();
        for (station, target) in plans {
            let from = draft.at(main[station]);
            let along = direction_at(draft, main, station);
            let chord = target - from;
            // Leaves at a wider angle than its chord and bows towards the main vein's tip.
            let away = (chord.normalize_or_zero() - along * self.habit.bow).normalize_or_zero();
            let control = from + away * chord.length() * 0.5;
            let way: Vec<Vec2> =
                (0..=16_u8).map(|i| quadratic(from, control, target, f32::from(i) / 16.0)).collect();
            let points = walk(&way, self.stride(ground, 1.0, 0.1), ground, rng);
            let path = self.lay(draft, main[station], &points, 2, 0.3);
            if path.len() > 3 {
                out.push(path);
            }
        }
        out
    }
}
