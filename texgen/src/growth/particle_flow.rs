// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Veins as the traces of particles that flow to the root (Rodkaew et al. 2002; Neubert et al. 2007).
//!
//! Particles start all over the blade and move to the root, to the nearest trace and to each other; where they meet
//! they go on as one. Seen from the root the traces are a tree whose cross sections add up.

use glam::Vec2;

use super::draft::{Draft, segments_distance};
use super::flow::{WidthLaw, finish, rank};
use super::ground::Ground;
use super::route::{Routes, rotate};
use super::{STEP, no_vein};
use crate::math::floor_i32;
use crate::rng::Rng;
use crate::{Blade, TexgenError, VeinGraph, VeinGrower};

/// Lets particles flow to the root.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParticleFlow {
    /// Distance between particles at the start as a share of √A, 0.02 to 0.5.
    pub spacing: f32,
    /// α: pull of the root against the nearest trace's, 0 to 1.
    pub to_root: f32,
    /// γ: pull of the nearest particle against the root's, 0 to 1.
    pub to_particle: f32,
    /// Half the width of the vein at the root as a share of √A.
    pub root_radius: f32,
}

impl Default for ParticleFlow {
    fn default() -> Self {
        Self { spacing: 0.045, to_root: 0.45, to_particle: 0.35, root_radius: 0.012 }
    }
}

/// Distance at which a trace draws with its whole strength (β = 1), as a share of √A.
const FULL_PULL: f32 = 0.06;

/// A place that a particle has passed, and where it went from there.
struct Trace {
    at: Vec2,
    next: Option<usize>,
}

/// Traces of all particles, the root first.
struct Traces<'a> {
    ground: &'a Ground,
    step: f32,
    nodes: Vec<Trace>,
    across: usize,
    cells: Vec<Vec<usize>>,
}

impl VeinGrower for ParticleFlow {
    fn grow(&self, blade: &Blade, seed: u64) -> Result<VeinGraph, TexgenError> {
        let ground = Ground::survey(blade)?;
        let step = STEP * ground.unit;
        let traces = self.flow(&ground, step, &mut Rng::new(seed).fork(1));
        let mut draft = Draft::new(&ground, step);
        replay(&traces, &mut draft);
        if draft.nodes.len() < 2 {
            return no_vein();
        }
        rank(&mut draft, 5);
        Ok(finish(draft, self.root_radius, WidthLaw::Pipe))
    }
}

impl ParticleFlow {
    /// Moves all particles until each has met a trace or can go no farther.
    fn flow<'a>(&self, ground: &'a Ground, step: f32, rng: &mut Rng) -> Traces<'a> {
        let across = usize::try_from(floor_i32(ground.extent() / (2.0 * step))).unwrap_or(0) + 1;
        let mut traces =
            Traces { ground, step, nodes: Vec::new(), across, cells: vec![Vec::new(); across * across] };
        traces.put(ground.root);
        let routes = Routes::explore(ground);
        let mut heads: Vec<usize> = self.scatter(ground, rng).into_iter().map(|p| traces.put(p)).collect();
        let alpha = self.to_root.clamp(0.05, 1.0);
        let gamma = self.to_particle.clamp(0.0, 0.9);
        for _ in 0..2000 {
            if heads.is_empty() {
                break;
            }
            let places: Vec<(usize, Vec2)> =
                heads.iter().map(|&head| (head, traces.nodes[head].at)).collect();
            let mut still = Vec::with_capacity(heads.len());
            for &head in &heads {
                let x = traces.nodes[head].at;
                if traces.merge(head, None, 1.2) {
                    continue;
                }
                let root = routes.heading(x, ground);
                let other =
                    nearest_other(&places, head, x).filter(|&(q, _)| traces.end_of(q) != traces.end_of(head));
                let particle_far = other.map_or(f32::MAX, |(_, q)| q.distance(x));
                let path = traces.nearest_path(x, head, FULL_PULL * 4.0 * ground.unit);
                let heading = match path {
                    Some(g) if traces.nodes[g].at.distance(x) <= particle_far => {
                        let near = &traces.nodes[g];
                        let tangent =
                            near.next.map_or(root, |n| (traces.nodes[n].at - near.at).normalize_or(root));
                        let beta = (near.at.distance(x) / (FULL_PULL * ground.unit)).min(1.0);
                        let aside = (near.at - x).normalize_or_zero() * beta + tangent * (1.0 - beta);
                        root * alpha + aside * (1.0 - alpha)
                    }
                    _ => {
                        let v = other.map_or(Vec2::ZERO, |(_, q)| (q - x).normalize_or_zero());
                        v * gamma + root * (1.0 - gamma)
                    }
                };
                if let Some(new) = traces.advance(head, heading.normalize_or(root)) {
                    still.push(new);
                }
            }
            heads = still;
        }
        traces
    }

    /// Random places at least a spacing apart.
    fn scatter(&self, ground: &Ground, rng: &mut Rng) -> Vec<Vec2> {
        let spacing = self.spacing.clamp(0.02, 0.5) * ground.unit;
        let side = ground.extent();
        let tries = floor_i32(12.0 * (side / spacing) * (side / spacing)).clamp(50, 60_000);
        let mut places: Vec<Vec2> = Vec::new();
        for _ in 0..tries {
            let p = Vec2::new(rng.range(0.0, side), rng.range(0.0, side));
            let free = places.iter().all(|other| other.distance_squared(p) >= spacing * spacing);
            if free && ground.room(p) > 1.0 && p.distance(ground.root) > spacing {
                places.push(p);
            }
        }
        places
    }
}

/// Nearest other particle.
fn nearest_other(places: &[(usize, Vec2)], own: usize, x: Vec2) -> Option<(usize, Vec2)> {
    let far = |p: &(usize, Vec2)| p.1.distance_squared(x);
    places.iter().filter(|(id, _)| *id != own).min_by(|a, b| far(a).total_cmp(&far(b))).copied()
}

impl Traces<'_> {
    fn cell(&self, x: f32) -> usize {
        usize::try_from(floor_i32(x / (2.0 * self.step))).unwrap_or(0).min(self.across - 1)
    }

    fn put(&mut self, at: Vec2) -> usize {
        let id = self.nodes.len();
        self.nodes.push(Trace { at, next: None });
        let cell = self.cell(at.y) * self.across + self.cell(at.x);
        self.cells[cell].push(id);
        id
    }

    fn around(&self, p: Vec2, radius: f32) -> impl Iterator<Item = usize> + '_ {
        let (left, right) = (self.cell(p.x - radius), self.cell(p.x + radius));
        let (top, bottom) = (self.cell(p.y - radius), self.cell(p.y + radius));
        (top..=bottom)
            .flat_map(move |row| &self.cells[row * self.across + left..=row * self.across + right])
            .flatten()
            .copied()
    }

    /// Present end of a trace.
    fn end_of(&self, mut node: usize) -> usize {
        while let Some(next) = self.nodes[node].next {
            node = next;
        }
        node
    }

    /// Nearest node of a trace that reaches the root.
    fn nearest_path(&self, x: Vec2, head: usize, radius: f32) -> Option<usize> {
        let far = |id: &usize| self.nodes[*id].at.distance_squared(x);
        self.around(x, radius)
            .filter(|&id| id != head && far(&id) <= radius * radius)
            .min_by(|a, b| far(a).total_cmp(&far(b)).then(a.cmp(b)))
            .filter(|&id| self.end_of(id) == 0)
    }

    /// Ends a particle in a trace within some steps, or in one of the two nodes of a segment that bars its way.
    fn merge(&mut self, head: usize, barred_by: Option<usize>, steps: f32) -> bool {
        let x = self.nodes[head].at;
        let far = |traces: &Self, id: usize| traces.nodes[id].at.distance_squared(x);
        let mut near: Vec<usize> = match barred_by {
            Some(a) => [Some(a), self.nodes[a].next].into_iter().flatten().collect(),
            None => {
                let reach = steps * self.step;
                self.around(x, reach).filter(|&id| far(self, id) <= reach * reach).collect()
            }
        };
        near.sort_by(|&a, &b| far(self, a).total_cmp(&far(self, b)).then(a.cmp(&b)));
        for id in near {
            let end = self.end_of(id);
            let own = id == head || end == head;
            // Into a trace still under way only from behind, lest its end be walled in by its own feeders.
            let ahead = self.nodes[end].at.distance(self.ground.root) > x.distance(self.ground.root);
            let fits = !own && (end == 0 || !ahead || steps > 2.0);
            if fits
                && self.bars(head, self.nodes[id].at, Some(id)).is_none()
                && self.ground.sees(x, self.nodes[id].at)
            {
                self.nodes[head].next = Some(id);
                return true;
            }
        }
        false
    }

    /// First node of a segment that the way from a head to a place would cross.
    fn bars(&self, head: usize, to: Vec2, goal: Option<usize>) -> Option<usize> {
        let from = self.nodes[head].at;
        self.around((from + to) / 2.0, 4.0 * self.step).find(|&a| {
            let Some(b) = self.nodes[a].next else { return false };
            let (p, q) = (self.nodes[a].at, self.nodes[b].at);
            let touches = [a, b].into_iter().any(|end| end == head || Some(end) == goal);
            if touches {
                // Segments with a common end may not lie on each other.
                let other = if a == head || Some(a) == goal { q } else { p };
                let corner = if a == head || b == head { from } else { to };
                let far_end = if a == head || b == head { to } else { from };
                return crate::math::segment_distance(other, corner, far_end).0 < 0.02 * self.step
                    || crate::math::segment_distance(far_end, corner, other).0 < 0.02 * self.step;
            }
            segments_distance(from, to, p, q) <= 0.05 * self.step
        })
    }

    /// Moves a particle a step; `None` when it has met a trace or is stuck.
    fn advance(&mut self, head: usize, heading: Vec2) -> Option<usize> {
        let x = self.nodes[head].at;
        for turn_deg in [0.0_f32, 25.0, -25.0, 55.0, -55.0, 90.0, -90.0] {
            let to = x + rotate(heading, turn_deg.to_radians()) * self.step;
            if !self.ground.sees(x, to) {
                continue;
            }
            match self.bars(head, to, None) {
                None => {
                    let new = self.put(to);
                    self.nodes[head].next = Some(new);
                    return Some(new);
                }
                Some(segment) if self.merge(head, Some(segment), 0.0) => return None,
                Some(_) => {}
            }
        }
        // Hemmed in: whatever trace is still in reach takes it.
        self.merge(head, None, 2.9);
        None
    }
}

/// Puts all traces that reach the root into a draft, from the root outward.
fn replay(traces: &Traces<'_>, draft: &mut Draft<'_>) {
    let mut feeders: Vec<Vec<usize>> = vec![Vec::new(); traces.nodes.len()];
    for (id, trace) in traces.nodes.iter().enumerate() {
        if let Some(next) = trace.next {
            feeders[next].push(id);
        }
    }
    let mut queue = std::collections::VecDeque::from([(0_usize, 0_u32)]);
    while let Some((trace, node)) = queue.pop_front() {
        for &feeder in &feeders[trace] {
            if let Ok(id) = draft.grow(node, traces.nodes[feeder].at, 1, 0.0) {
                queue.push_back((feeder, id));
            }
        }
    }
}
