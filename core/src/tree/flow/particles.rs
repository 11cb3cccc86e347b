// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Flow of particles from their births to the root.
//!
//! Each moves by a step along the normalised sum of weighted directions: to the root, and to the nearest trace or the nearest other particle, whichever is nearer; of equally near ones it is the one with the lowest number. A particle within the
//! radius of joining, which is more than a step, goes on as part of what it meets. All particles see the places of the step before, and
//! join in the order of their numbers.

use glam::DVec3;

use super::cells::Cells;
use super::traces::Traces;
use super::trunk::Trunk;
use crate::convert::len32;

/// Radius of joining in steps.
const JOIN_STEPS: f64 = 1.3;
/// Distance in steps at which a trace draws with its whole strength, across itself; nearer it draws along.
const FULL_PULL_STEPS: f64 = 5.0;
/// Farthest distance in steps at which traces and particles draw.
const REACH_STEPS: f64 = 16.0;
/// Fall of branches towards the trunk per distance from it, at the foot of the crown and at its top.
const FALLS: (f64, f64) = (0.35, 1.5);
/// Height of the lowest branches' feet as a share of the height of the hull's lowest point.
const LOWEST: f64 = 0.85;

/// Weights and lengths of the flow.
pub(super) struct Pulls {
    pub(super) to_root: f64,
    pub(super) to_particle: f64,
    pub(super) step_m: f64,
    /// Heights in m of the hull's lowest and highest point.
    pub(super) crown_m: (f64, f64),
}

/// Traces of all particles on their way.
struct Flow<'a> {
    trunk: &'a Trunk,
    pulls: &'a Pulls,
    traces: Traces,
    /// Particle that made each place, [`SETTLED`] for the trunk.
    maker: Vec<u32>,
    /// Particle that each goes on in, itself while it flows.
    carrier: Vec<u32>,
    /// Latest place of each particle.
    head: Vec<u32>,
    cells: Cells,
}

/// Carrier of what has reached the trunk.
const SETTLED: u32 = u32::MAX;

/// Traces of particles from their births to a trunk.
pub(super) fn flow(births: &[DVec3], trunk: &Trunk, pulls: &Pulls) -> Traces {
    let mut flow = Flow {
        trunk,
        pulls,
        traces: Traces::from_trunk(&trunk.places),
        maker: vec![SETTLED; trunk.places.len()],
        carrier: (0..len32(births.len())).collect(),
        head: Vec::with_capacity(births.len()),
        cells: Cells::new(4.0 * pulls.step_m),
    };
    for (number, place) in trunk.places.iter().enumerate() {
        flow.cells.put(len32(number), *place);
    }
    for (particle, place) in births.iter().enumerate() {
        let node = flow.put(*place, len32(particle));
        flow.traces.begin(node);
        flow.head.push(node);
    }
    let mut active: Vec<u32> = (0..len32(births.len())).collect();
    // Longer ways than three times round the crown are circles.
    let longest = (3.0 * pulls.crown_m.1 / pulls.step_m).max(100.0);
    let mut step = 0.0;
    while !active.is_empty() {
        let is_lost = step > longest;
        step += 1.0;
        active.retain(|&particle| !flow.join(particle, is_lost));
        let mut heads = Cells::new(4.0 * pulls.step_m);
        for &particle in &active {
            heads.put(particle, flow.place(particle));
        }
        let moves: Vec<DVec3> = active.iter().map(|&particle| flow.heading(particle, &heads)).collect();
        for (&particle, heading) in active.iter().zip(moves) {
            let from = flow.head[particle as usize];
            let to = flow.put(flow.traces.places[from as usize] + heading * pulls.step_m, particle);
            flow.traces.lead(from, to);
            flow.head[particle as usize] = to;
        }
    }
    flow.traces
}

impl Flow<'_> {
    fn put(&mut self, place: DVec3, particle: u32) -> u32 {
        let node = self.traces.put(place);
        self.maker.push(particle);
        self.cells.put(node, place);
        node
    }

    fn place(&self, particle: u32) -> DVec3 {
        self.traces.places[self.head[particle as usize] as usize]
    }

    /// Particle that a place's trace goes on in.
    fn carrier_of(&self, node: u32) -> u32 {
        let mut at = self.maker[node as usize];
        while at != SETTLED && self.carrier[at as usize] != at {
            at = self.carrier[at as usize];
        }
        at
    }

    /// Returns true for the latest place of a particle that still flows.
    fn is_head(&self, node: u32) -> bool {
        let maker = self.maker[node as usize];
        maker != SETTLED && self.carrier[maker as usize] == maker && self.head[maker as usize] == node
    }

    /// Joins a particle to what is near; true if it has.
    fn join(&mut self, particle: u32, is_lost: bool) -> bool {
        let place = self.place(particle);
        let reach_m = if is_lost { f64::INFINITY } else { JOIN_STEPS * self.pulls.step_m };
        let others = |node: u32| self.carrier_of(node) != particle;
        let found = if is_lost {
            let nearest = (0..len32(self.trunk.places.len()))
                .min_by(|&a, &b| {
                    let away = |node: u32| self.traces.places[node as usize].distance_squared(place);
                    away(a).total_cmp(&away(b))
                })
                .unwrap_or(0);
            Some(nearest)
        } else {
            self.cells.nearest(place, reach_m, others).map(|(node, ..)| node)
        };
        let Some(node) = found else { return false };
        let carrier = self.carrier_of(node);
        self.carrier[particle as usize] = carrier;
        let head = self.head[particle as usize];
        self.traces.lead(head, node);
        true
    }

    /// Direction in which a particle moves.
    fn heading(&self, particle: u32, heads: &Cells) -> DVec3 {
        let place = self.place(particle);
        let root = self.root_from(place);
        let reach_m = REACH_STEPS * self.pulls.step_m;
        let other = heads.nearest(place, reach_m, |other| other != particle);
        let other_m = other.map_or(reach_m, |(_, _, away_m)| away_m);
        let others = |node: u32| self.carrier_of(node) != particle && !self.is_head(node);
        let sum = match self.cells.nearest(place, other_m, others) {
            Some((node, at, away_m)) => {
                let along = self.traces.toward_root(node).unwrap_or(root);
                let across = (away_m / (FULL_PULL_STEPS * self.pulls.step_m)).min(1.0);
                let aside = (at - place).normalize_or_zero() * across + along * (1.0 - across);
                root * self.pulls.to_root + aside * (1.0 - self.pulls.to_root)
            }
            None => {
                let aside = other.map_or(root, |(_, at, _)| (at - place).normalize_or_zero());
                aside * self.pulls.to_particle + root * (1.0 - self.pulls.to_particle)
            }
        };
        // Pulls that cancel leave the root's.
        sum.try_normalize().filter(|_| sum.length() > 1e-3).unwrap_or(root)
    }

    /// Direction to where a branch from a place would meet the trunk.
    fn root_from(&self, place: DVec3) -> DVec3 {
        let (low_m, high_m) = self.pulls.crown_m;
        let axis = self.trunk.at(place.y);
        let out_m = DVec3::new(place.x - axis.x, 0.0, place.z - axis.z).length();
        let share = ((place.y - low_m) / (high_m - low_m).max(1e-9)).clamp(0.0, 1.0);
        let fall = FALLS.0 + (FALLS.1 - FALLS.0) * share;
        let top_m = self.trunk.top_m();
        let foot = self.trunk.at((place.y - fall * out_m).max(LOWEST * low_m).min(top_m));
        (foot - place).try_normalize().unwrap_or(DVec3::NEG_Y)
    }
}
