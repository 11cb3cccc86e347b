// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Tertiary veins: the rungs between laterals.

use glam::Vec2;

use super::contour_guided::Path;
use super::draft::{Draft, Refusal};
use super::laterals::direction_at;
use super::route::rotate;
use crate::math::floor_i32;
use crate::rng::Rng;

/// Veins from one lateral across to its neighbours (percurrent), or towards the margin, that wander by so many degrees.
pub(super) fn grow(draft: &mut Draft<'_>, lateral: &Path, wander_deg: f32, rng: &mut Rng) {
    let spacing = 0.05 * draft.ground.unit / draft.step;
    for side in [-1.0, 1.0] {
        let mut place = spacing * rng.range(0.5, 1.2);
        loop {
            let station = usize::try_from(floor_i32(place)).unwrap_or(0);
            if station + 2 >= lateral.len() {
                break;
            }
            let out =
                rotate(direction_at(draft, lateral, station), side * (80.0 + 10.0 * rng.bell()).to_radians());
            rung(draft, lateral[station], out, wander_deg, rng);
            place += spacing * rng.range(0.75, 1.4);
        }
    }
}

/// One of them: on from a node until it meets a vein, which it joins, or the margin.
fn rung(draft: &mut Draft<'_>, from: u32, mut heading: Vec2, wander_deg: f32, rng: &mut Rng) {
    const MOST_STEPS: usize = 80;
    let mut last = from;
    for _ in 0..MOST_STEPS {
        heading = rotate(heading, (wander_deg * rng.bell()).to_radians());
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
