// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Places at which laterals leave a main vein, and their ends.

use glam::Vec2;

use super::STEP;
use super::contour_guided::Path;
use super::draft::Draft;
use super::habit::{Habit, LateralTargets};
use super::margin::Margin;
use super::route::rotate;
use crate::math::floor_i32;
use crate::rng::Rng;

/// A lateral: the station of its main vein where it starts, and its end.
pub(super) type Plan = (usize, Vec2);

/// One side of a main vein.
#[derive(Clone, Copy)]
pub(super) struct Flank<'a> {
    pub(super) habit: &'a Habit,
    pub(super) draft: &'a Draft<'a>,
    pub(super) main: &'a Path,
    /// The side: sign of the angles at which laterals leave it.
    pub(super) side: f32,
    pub(super) margin: &'a Margin,
}

impl Flank<'_> {
    /// The laterals, from the main vein's start on; `share` is the vein's length against the longest one's.
    pub(super) fn plans(&self, share: f32, rng: &mut Rng) -> Vec<Plan> {
        let (fewest, most) = self.habit.lateral_pairs;
        let pairs = rng.integer(fewest.min(most), most.max(fewest)) as f32 * share;
        let mut plans = match self.habit.targets {
            LateralTargets::Lobes(size) => self.towards_lobes(size, rng),
            LateralTargets::Even => self.evenly(pairs, None, rng),
            LateralTargets::Teeth(size) => self.evenly(pairs, Some(size), rng),
        };
        plans.sort_by_key(|(station, _)| *station);
        plans
    }

    /// Evenly spaced stations, each with where its angle leads, or the strongest tooth near there.
    fn evenly(&self, pairs: f32, tooth: Option<f32>, rng: &mut Rng) -> Vec<Plan> {
        let Self { habit, draft, main, side, margin } = *self;
        let ground = draft.ground;
        let teeth = tooth.map(|size| margin.tips(size * ground.unit, 0.12 * size * ground.unit));
        let count = pairs.round().max(1.0);
        let mut plans = Vec::new();
        let mut last_target: Option<Vec2> = None;
        let mut place = 0.35 + if side > 0.0 { habit.stagger } else { 0.0 };
        while place < count {
            let share = ((place + 0.12 * rng.bell()) / count).clamp(0.02, 0.96);
            place += 1.0;
            // Laterals stand closer near the tip.
            let share = share * (1.18 - 0.18 * share) * 0.94;
            let station = station_at(main, share);
            let from = draft.at(main[station]);
            let along = direction_at(draft, main, station);
            // Wider at the base, narrower near the tip.
            let lean = habit.divergence_deg + 9.0 * (0.5 - share) + 3.0 * rng.bell();
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
    fn towards_lobes(&self, size: f32, rng: &mut Rng) -> Vec<Plan> {
        let Self { habit, draft, main, side, margin } = *self;
        let ground = draft.ground;
        let (_, most) = habit.lateral_pairs;
        let end = draft.at(main[main.len() - 1]);
        let mut lobes: Vec<(f32, usize, Vec2)> = Vec::new();
        for (index, height) in margin.tips(size * ground.unit, 0.1 * size * ground.unit) {
            let Some(target) = margin.target(index) else { continue };
            if target.distance(end) < 0.09 * ground.unit {
                continue;
            }
            let wanted = (habit.divergence_deg + 4.0 * rng.bell()).clamp(25.0, 70.0);
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
        let mut plans: Vec<Plan> = lobes.into_iter().map(|(_, station, target)| (station, target)).collect();
        plans.sort_by_key(|(station, _)| *station);
        plans.dedup_by(|b, a| b.0.abs_diff(a.0) < main.len() / 40);
        self.fill_gaps(&mut plans, rng);
        plans
    }

    /// Adds a lateral where two neighbours leave much of the main vein bare.
    fn fill_gaps(&self, plans: &mut Vec<Plan>, rng: &mut Rng) {
        let Self { habit, draft, main, side, .. } = *self;
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
                let lean = habit.divergence_deg + 5.0 * rng.bell();
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
}

/// Index of the node at a share (0..=1) of a path's nodes.
fn station_at(path: &Path, share: f32) -> usize {
    let last = path.len() - 1;
    usize::try_from(floor_i32(share * last as f32)).unwrap_or(0).min(last)
}

/// Unit direction of a path around a node, outward.
pub(super) fn direction_at(draft: &Draft<'_>, path: &Path, station: usize) -> Vec2 {
    let before = path[station.saturating_sub(6)];
    let after = path[(station + 6).min(path.len() - 1)];
    (draft.at(after) - draft.at(before)).normalize_or(Vec2::NEG_Y)
}

/// Angle between two directions in radians.
pub(super) fn angle(a: Vec2, b: Vec2) -> f32 {
    libm::acosf((a.normalize_or_zero().dot(b.normalize_or_zero())).clamp(-1.0, 1.0))
}
