// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Ways through a blade, and the growth of a vein along one.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use glam::Vec2;

use super::ground::Ground;
use crate::math::floor_i32;
use crate::rng::Rng;

/// Coarse cells along √A.
const CELLS_PER_UNIT: f32 = 56.0;

/// Shortest ways to the root that keep off the margin.
pub(crate) struct Routes {
    side: f32,
    across: usize,
    /// Next cell on the way to the root.
    toward_root: Vec<Option<usize>>,
}

#[derive(PartialEq)]
struct Reached {
    cost: f32,
    cell: usize,
}

impl Eq for Reached {}
impl PartialOrd for Reached {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Reached {
    fn cmp(&self, other: &Self) -> Ordering {
        other.cost.total_cmp(&self.cost).then(other.cell.cmp(&self.cell))
    }
}

impl Routes {
    /// Explores a blade from its root (Dijkstra 1959, eight neighbours).
    pub(crate) fn explore(ground: &Ground) -> Self {
        let side = (ground.unit / CELLS_PER_UNIT).max(1.0);
        let across = usize::try_from(floor_i32(ground.extent() / side)).unwrap_or(0) + 1;
        let mut routes = Self { side, across, toward_root: vec![None; across * across] };
        let Some(start) = routes.cell(ground.root) else { return routes };
        let mut cost = vec![f32::INFINITY; across * across];
        cost[start] = 0.0;
        let mut heap = BinaryHeap::from([Reached { cost: 0.0, cell: start }]);
        while let Some(Reached { cost: here, cell }) = heap.pop() {
            if here > cost[cell] {
                continue;
            }
            for (next, length) in routes.neighbours(cell) {
                let room = ground.room(routes.centre(next)) / ground.unit;
                if room <= 0.0 {
                    continue;
                }
                // Three times dearer along the margin than a quarter of √A away from it.
                let tight = (1.0 - room / 0.25).max(0.0);
                let reached = here + length * (1.0 + 2.0 * tight * tight);
                if reached < cost[next] {
                    cost[next] = reached;
                    routes.toward_root[next] = Some(cell);
                    heap.push(Reached { cost: reached, cell: next });
                }
            }
        }
        routes
    }

    fn cell(&self, p: Vec2) -> Option<usize> {
        let x = usize::try_from(floor_i32(p.x / self.side)).ok()?;
        let y = usize::try_from(floor_i32(p.y / self.side)).ok()?;
        (x < self.across && y < self.across).then_some(y * self.across + x)
    }

    fn centre(&self, cell: usize) -> Vec2 {
        let (x, y) = (cell % self.across, cell / self.across);
        Vec2::new(x as f32 + 0.5, y as f32 + 0.5) * self.side
    }

    fn neighbours(&self, cell: usize) -> impl Iterator<Item = (usize, f32)> + use<> {
        let across = self.across;
        let (x, y) = (cell % across, cell / across);
        (0..9_usize).filter(|k| *k != 4).filter_map(move |k| {
            let nx = (x + k % 3).checked_sub(1).filter(|nx| *nx < across)?;
            let ny = (y + k / 3).checked_sub(1).filter(|ny| *ny < across)?;
            let length = if nx != x && ny != y { std::f32::consts::SQRT_2 } else { 1.0 };
            Some((ny * across + nx, length))
        })
    }

    /// Unit direction from a point along its way to the root: straight when the root is in sight.
    pub(crate) fn heading(&self, p: Vec2, ground: &Ground) -> Vec2 {
        let straight = (ground.root - p).normalize_or(Vec2::Y);
        if ground.sees(p, ground.root) {
            return straight;
        }
        let mut aim = None;
        let mut at = self.cell(p);
        for _ in 0..24 {
            at = at.and_then(|cell| self.toward_root[cell]);
            match at.map(|cell| self.centre(cell)).filter(|&c| ground.sees(p, c)) {
                Some(centre) => aim = Some(centre),
                None => break,
            }
        }
        aim.map_or(straight, |aim| (aim - p).normalize_or(straight))
    }

    /// Way from the root to a target; straight where the coarse grid knows none.
    pub(crate) fn to(&self, target: Vec2, ground: &Ground) -> Vec<Vec2> {
        let mut way = vec![target];
        let mut at = self.cell(target);
        while let Some(next) = at.and_then(|cell| self.toward_root[cell]) {
            way.push(self.centre(next));
            at = Some(next);
        }
        if let Some(last) = way.last_mut().filter(|_| at.is_some() && at == self.cell(ground.root)) {
            *last = ground.root;
        } else {
            way.push(ground.root);
        }
        way.reverse();
        // Straight from the root as far as half the way is in sight: ways to several lobes must part at once.
        let seen = (1..=way.len() / 2).rev().find(|&i| ground.sees(ground.root, way[i])).unwrap_or(1);
        way.drain(1..seen);
        way
    }
}

/// Growth of a vein along a way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Walk {
    /// Longest step in pixels.
    pub(crate) step: f32,
    /// Greatest turn away from the way in degrees.
    pub(crate) wander_deg: f32,
    /// Distance ahead on the way at which the vein aims, in pixels.
    pub(crate) ahead: f32,
}

/// Points of a vein that grows from a way's start to its end: `p + h·s·R(φ)·unit(T − p)` with s in 0.6 to 1 and φ
/// within the wander (Kim and Kim 2017 with the step added to the old point and the direction normalised). T is the
/// farthest point in sight not too far ahead on the way. Ends early where the blade does.
pub(crate) fn walk(way: &[Vec2], how: Walk, ground: &Ground, rng: &mut Rng) -> Vec<Vec2> {
    const MOST_STEPS: usize = 400;
    let (Some(&start), Some(&end)) = (way.first(), way.last()) else { return Vec::new() };
    let even = crate::spline::resample(way, 96);
    let spacing = crate::math::path_length(way) / 96.0;
    let reach = usize::try_from(floor_i32(how.ahead / spacing.max(1e-3))).unwrap_or(1).max(1);
    let mut points = vec![start];
    let mut passed = 0;
    let mut p = start;
    while points.len() < MOST_STEPS && p.distance(end) > how.step {
        // The nearest point of the way not yet passed.
        let window = passed..(passed + reach + 8).min(even.len());
        let far = |i: &usize| even[*i].distance_squared(p);
        passed = window.min_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or(passed);
        let aim =
            (passed + 1..=(passed + reach).min(even.len() - 1)).rev().find(|&i| ground.sees(p, even[i]));
        let Some(aim) = aim else { break };
        let straight = (even[aim] - p).normalize_or_zero();
        let turn = rng.range(-how.wander_deg, how.wander_deg).to_radians();
        let length = how.step * rng.range(0.6, 1.0);
        let bent = rotate(straight, turn) * length;
        let next = [p + bent, p + straight * length, p + straight * length * 0.3];
        let Some(next) = next.into_iter().find(|&next| ground.sees(p, next) && next != p) else { break };
        points.push(next);
        p = next;
    }
    if p != end && ground.sees(p, end) {
        points.push(end);
    }
    points
}

/// Turns a direction by an angle in radians.
pub(crate) fn rotate(direction: Vec2, angle: f32) -> Vec2 {
    let (sin, cos) = libm::sincosf(angle);
    Vec2::new(cos, sin).rotate(direction)
}
