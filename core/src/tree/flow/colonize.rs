// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Space colonisation (see [`SpaceColonization`](crate::scene::SpaceColonization) for the source).
//!
//! In every round each point draws the nearest wood within its reach; of equally near places the one with the lowest number. Wood that is
//! drawn grows by a step along the normalised sum of the directions to its points. A point that wood has come near to is gone.

use glam::DVec3;

use super::cells::Cells;
use super::traces::Traces;
use super::trunk::Trunk;

/// Most rounds.
const MOST_ROUNDS: u32 = 4000;
/// Share of a step within which a new place is the same as one before.
const SAME: f64 = 0.05;

/// A point that still attracts, with the wood nearest to it.
struct Point {
    place: DVec3,
    node: u32,
    away_m2: f64,
}

impl Point {
    /// Takes new wood, whose number is above those before, if it is nearer.
    fn meet(&mut self, node: u32, place: DVec3) {
        let away_m2 = place.distance_squared(self.place);
        if away_m2 < self.away_m2 {
            (self.node, self.away_m2) = (node, away_m2);
        }
    }
}

/// Wood that grows from a trunk to points.
pub(super) fn colonize(
    places: &[DVec3],
    trunk: &Trunk,
    influence_m: f64,
    kill_m: f64,
    step_m: f64,
) -> Traces {
    let mut traces = Traces::from_trunk(&trunk.places);
    let mut points: Vec<Point> =
        places.iter().map(|&place| Point { place, node: 0, away_m2: f64::INFINITY }).collect();
    let mut wood = Cells::new(step_m);
    let mut first_new = 0;
    for _ in 0..MOST_ROUNDS {
        for (node, &place) in (0u32..).zip(&traces.places).skip(first_new) {
            wood.put(node, place);
            points.iter_mut().for_each(|point| point.meet(node, place));
        }
        first_new = traces.places.len();
        points.retain(|point| point.away_m2 > kill_m * kill_m);
        let pull = |point: &Point| {
            let toward = (point.place - traces.places[point.node as usize]).normalize_or_zero();
            (point.node, toward)
        };
        let near = points.iter().filter(|point| point.away_m2 <= influence_m * influence_m);
        let mut pulls: Vec<(u32, DVec3)> = near.map(pull).collect();
        if pulls.is_empty() {
            // All are out of reach: wood grows towards the one that is nearest.
            let nearest = points.iter().min_by(|a, b| a.away_m2.total_cmp(&b.away_m2));
            pulls.extend(nearest.map(pull));
        }
        // By number, and of one place in the order of the points.
        pulls.sort_by_key(|pull| pull.0);
        for group in pulls.chunk_by(|a, b| a.0 == b.0) {
            let from = group[0].0;
            let sum: DVec3 = group.iter().map(|pull| pull.1).sum();
            let Some(heading) = sum.try_normalize() else { continue };
            let place = traces.places[from as usize] + heading * step_m;
            // Points that draw the same place back and forth keep nothing alive.
            if wood.nearest(place, SAME * step_m, |_| true).is_none() {
                let node = traces.put(place);
                traces.lead(node, from);
            }
        }
        if traces.places.len() == first_new {
            break;
        }
    }
    traces.begin_at_tips();
    traces
}
