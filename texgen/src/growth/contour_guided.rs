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
use super::habit::{Habit, LateralTargets, Layout};
use super::margin::Margin;
use super::route::{Routes, Walk, rotate, walk};
use super::{STEP, fan, no_vein};
use crate::math::{floor_i32, quadratic};
use crate::rng::Rng;
use crate::{Blade, TexgenError, VeinGraph, VeinGrower};

/// Growth step as a share of √A.
const STRIDE: f32 = 0.04;
/// Smallest angle between two main veins as seen from the root, in degrees.
const MAINS_APART_DEG: f32 = 25.0;

/// Grows veins along the margin's directions.
#[derive(Clone, Copy, Debug, Default)]
pub struct ContourGuided {
    /// How veins run.
    pub habit: Habit,
    /// Kind of curve.
    pub curve: Curve,
    /// Whether to add tertiary veins.
    pub tertiary: bool,
}

/// A main vein or lateral as nodes of the draft, from its start outward.
type Path = Vec<u32>;

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
                self.rungs(draft, path, &mut rng.fork(10_000 + index as u64));
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
        let ground = draft.ground;
        let (fewest, most) = self.habit.lateral_pairs;
        let pairs = rng.integer(fewest.min(most), most.max(fewest)) as f32 * share;
        let mut plans = match self.habit.targets {
            LateralTargets::Lobes(size) => self.lobe_plans(draft, main, side, size, margin, rng),
            LateralTargets::Even => self.station_plans(draft, main, side, pairs, None, margin, rng),
            LateralTargets::Teeth(size) => {
                self.station_plans(draft, main, side, pairs, Some(size), margin, rng)
            }
        };
        plans.sort_by_key(|(station, _)| *station);
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

    /// Evenly spaced stations, each with where its angle leads, or the strongest tooth near there.
    #[expect(clippy::too_many_arguments, reason = "one step of `laterals`, split off for reading")]
    fn station_plans(
        &self,
        draft: &Draft<'_>,
        main: &Path,
        side: f32,
        pairs: f32,
        tooth: Option<f32>,
        margin: &Margin,
        rng: &mut Rng,
    ) -> Vec<(usize, Vec2)> {
        let ground = draft.ground;
        let teeth = tooth.map(|size| margin.tips(size * ground.unit, 0.12 * size * ground.unit));
        let count = pairs.round().max(1.0);
        let mut plans = Vec::new();
        let mut last_target: Option<Vec2> = None;
        let mut place = 0.35 + if side > 0.0 { self.habit.stagger } else { 0.0 };
        while place < count {
            let share = ((place + 0.12 * rng.bell()) / count).clamp(0.02, 0.96);
            place += 1.0;
            // Laterals stand closer near the tip.
            let share = share * (1.18 - 0.18 * share) * 0.94;
            let station = station_at(main, share);
            let from = draft.at(main[station]);
            let along = direction_at(draft, main, station);
            // Wider at the base, narrower near the tip.
            let lean = self.habit.divergence_deg + 9.0 * (0.5 - share) + 3.0 * rng.bell();
            let out = rotate(along, side * lean.clamp(25.0, 70.0).to_radians());
            let Some(hit) = ground.reach(from, out, 3.0 * ground.unit) else { continue };
            let mut target = hit;
            if let Some(teeth) = &teeth {
                let there = margin.nearest(hit);
                let near = margin.window(0.3 * ground.unit * 2.0 / count.max(4.0));
                let best = teeth
                    .iter()
                    .filter(|(tooth, _)| margin.apart(*tooth, there) <= near)
                    .filter_map(|(tooth, height)| {
                        let p = margin.target(*tooth)?;
                        let bearing = angle(p - from, along).to_degrees();
                        let fits =
                            (25.0..=70.0).contains(&bearing) && (p - from).perp_dot(along) * side < 0.0;
                        let away = margin.apart(*tooth, there) as f32 / near as f32;
                        fits.then_some((height * (1.0 - 0.7 * away), p))
                    })
                    .reduce(|a, b| if b.0 > a.0 { b } else { a });
                target = best.map_or(hit, |(_, p)| p);
            }
            let too_short = target.distance(from) < 0.06 * ground.unit;
            let taken = last_target.is_some_and(|last| last.distance(target) < 0.02 * ground.unit);
            if !too_short && !taken {
                last_target = Some(target);
                plans.push((station, target));
            }
        }
        plans
    }

    /// One lateral to each lobe of the side, from where its angle fits best, and finer ones between.
    fn lobe_plans(
        &self,
        draft: &Draft<'_>,
        main: &Path,
        side: f32,
        size: f32,
        margin: &Margin,
        rng: &mut Rng,
    ) -> Vec<(usize, Vec2)> {
        let ground = draft.ground;
        let (_, most) = self.habit.lateral_pairs;
        let end = draft.at(main[main.len() - 1]);
        let mut lobes: Vec<(f32, usize, Vec2)> = Vec::new();
        for (index, height) in margin.tips(size * ground.unit, 0.1 * size * ground.unit) {
            let Some(target) = margin.target(index) else { continue };
            if target.distance(end) < 0.09 * ground.unit {
                continue;
            }
            let wanted = (self.habit.divergence_deg + 4.0 * rng.bell()).clamp(25.0, 70.0);
            let best = (main.len() / 24..main.len() * 15 / 16)
                .filter_map(|station| {
                    let from = draft.at(main[station]);
                    let along = direction_at(draft, main, station);
                    let bearing = angle(target - from, along).to_degrees();
                    let fits =
                        (25.0..=70.0).contains(&bearing) && (target - from).perp_dot(along) * side < 0.0;
                    (fits && ground.sees(from, target)).then_some(((bearing - wanted).abs(), station))
                })
                .reduce(|a, b| if b.0 < a.0 { b } else { a });
            if let Some((_, station)) = best {
                lobes.push((height, station, target));
            }
        }
        lobes.sort_by(|a, b| b.0.total_cmp(&a.0));
        lobes.truncate(most as usize);
        let mut plans: Vec<(usize, Vec2)> =
            lobes.into_iter().map(|(_, station, target)| (station, target)).collect();
        plans.sort_by_key(|(station, _)| *station);
        plans.dedup_by(|b, a| b.0.abs_diff(a.0) < main.len() / 40);
        self.fill_gaps(draft, main, side, &mut plans, rng);
        plans
    }

    /// Adds a lateral where two neighbours leave much of the main vein bare.
    fn fill_gaps(
        &self,
        draft: &Draft<'_>,
        main: &Path,
        side: f32,
        plans: &mut Vec<(usize, Vec2)>,
        rng: &mut Rng,
    ) {
        let ground = draft.ground;
        let widest = usize::try_from(floor_i32(0.2 / STEP)).unwrap_or(1);
        let mut borders: Vec<usize> = plans.iter().map(|(station, _)| *station).collect();
        borders.insert(0, main.len() / 20);
        borders.push(main.len() * 15 / 16);
        for pair in borders.windows(2) {
            let gap = pair[1].saturating_sub(pair[0]);
            let more = gap / widest;
            for k in 1..=more {
                let station = pair[0] + gap * k / (more + 1);
                let from = draft.at(main[station]);
                let lean = self.habit.divergence_deg + 5.0 * rng.bell();
                let out =
                    rotate(direction_at(draft, main, station), side * lean.clamp(25.0, 70.0).to_radians());
                // Between lobes a lateral gives up before the margin.
                let longest = ground.reach(from, out, 3.0 * ground.unit).map_or(0.0, |p| p.distance(from));
                if longest > 0.1 * ground.unit {
                    plans.push((station, from + out * longest * rng.range(0.7, 0.92)));
                }
            }
        }
    }

    /// Tertiary veins from one lateral across to its neighbours (percurrent), or towards the margin.
    fn rungs(&self, draft: &mut Draft<'_>, lateral: &Path, rng: &mut Rng) {
        let spacing = 0.05 * draft.ground.unit / draft.step;
        for side in [-1.0, 1.0] {
            let mut place = spacing * rng.range(0.5, 1.2);
            loop {
                let station = usize::try_from(floor_i32(place)).unwrap_or(0);
                if station + 2 >= lateral.len() {
                    break;
                }
                let out = rotate(
                    direction_at(draft, lateral, station),
                    side * (80.0 + 10.0 * rng.bell()).to_radians(),
                );
                self.rung(draft, lateral[station], out, rng);
                place += spacing * rng.range(0.75, 1.4);
            }
        }
    }

    /// One tertiary vein: on from a node until it meets a vein, which it joins, or the margin.
    fn rung(&self, draft: &mut Draft<'_>, from: u32, mut heading: Vec2, rng: &mut Rng) {
        const MOST_STEPS: usize = 80;
        let mut last = from;
        for _ in 0..MOST_STEPS {
            heading = rotate(heading, (self.habit.wander_deg * rng.bell()).to_radians());
            match draft.grow(last, draft.at(last) + heading * draft.step, 3, 0.6) {
                Ok(node) => last = node,
                Err(Refusal::Blocked(a, b)) => {
                    let far = |node: u32| draft.at(last).distance(draft.at(node));
                    let (near, other) = if far(a) <= far(b) { (a, b) } else { (b, a) };
                    if last != from && draft.join(last, near).is_err() {
                        // Where a third vein bars this way too, the rung ends free.
                        let _ = draft.join(last, other);
                    }
                    break;
                }
                Err(_) => break,
            }
        }
    }
}

/// Index of the node at a share (0..=1) of a path's nodes.
fn station_at(path: &Path, share: f32) -> usize {
    let last = path.len() - 1;
    usize::try_from(floor_i32(share * last as f32)).unwrap_or(0).min(last)
}

/// Unit direction of a path around a node, outward.
fn direction_at(draft: &Draft<'_>, path: &Path, station: usize) -> Vec2 {
    let before = path[station.saturating_sub(6)];
    let after = path[(station + 6).min(path.len() - 1)];
    (draft.at(after) - draft.at(before)).normalize_or(Vec2::NEG_Y)
}

/// Angle between two directions in radians.
fn angle(a: Vec2, b: Vec2) -> f32 {
    libm::acosf((a.normalize_or_zero().dot(b.normalize_or_zero())).clamp(-1.0, 1.0))
}
