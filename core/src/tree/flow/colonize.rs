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
use crate::convert::len32;

/// Most rounds.
const MOST_ROUNDS: u32 = 4000;
/// Share of a step within which a new place is the same as one before.
const SAME: f64 = 0.05;

/// Wood that grows from a trunk to points.
pub(super) fn colonize(
    points: &[DVec3],
    trunk: &Trunk,
    influence_m: f64,
    kill_m: f64,
    step_m: f64,
) -> Traces {
    let mut traces = Traces::from_trunk(&trunk.places);
    let mut wood = Cells::new(kill_m.max(step_m));
    for (number, place) in trunk.places.iter().enumerate() {
        wood.put(len32(number), *place);
    }
    let is_free = |wood: &Cells, point: &DVec3| wood.nearest(*point, kill_m, |_| true).is_none();
    let mut left: Vec<DVec3> = points.iter().copied().filter(|point| is_free(&wood, point)).collect();
    for _ in 0..MOST_ROUNDS {
        let mut pulls: Vec<(u32, DVec3)> = Vec::new();
        for point in &left {
            if let Some((node, at, _)) = wood.nearest(*point, influence_m, |_| true) {
                pulls.push((node, (*point - at).normalize_or_zero()));
            }
        }
        if pulls.is_empty() {
            let Some((node, toward)) = reach_out(&traces, &left) else { break };
            pulls.push((node, toward));
        }
        // By number, and of one place in the order of the points.
        pulls.sort_by_key(|pull| pull.0);
        let mut has_grown = false;
        for group in pulls.chunk_by(|a, b| a.0 == b.0) {
            let from = group[0].0;
            let sum: DVec3 = group.iter().map(|pull| pull.1).sum();
            let Some(heading) = sum.try_normalize() else { continue };
            let place = traces.places[from as usize] + heading * step_m;
            if wood.nearest(place, SAME * step_m, |_| true).is_some() {
                continue;
            }
            let node = traces.put(place);
            traces.lead(node, from);
            wood.put(node, place);
            has_grown = true;
        }
        // Points that draw the same place back and forth keep nothing alive.
        if !has_grown {
            break;
        }
        left.retain(|point| is_free(&wood, point));
    }
    traces.begin_at_tips();
    traces
}

/// The wood nearest to any point, and the direction to it, where all points are out of reach.
fn reach_out(traces: &Traces, points: &[DVec3]) -> Option<(u32, DVec3)> {
    let mut best: Option<(u32, DVec3, f64)> = None;
    for (node, at) in (0u32..).zip(&traces.places) {
        for point in points {
            let away_m2 = at.distance_squared(*point);
            if best.is_none_or(|(_, _, least_m2)| away_m2 < least_m2) {
                best = Some((node, *point - *at, away_m2));
            }
        }
    }
    best.and_then(|(node, toward, _)| Some((node, toward.try_normalize()?)))
}
