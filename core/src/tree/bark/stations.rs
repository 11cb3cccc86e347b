// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Positions along a limb of the rings of its skin.

use super::BarkDetail;
use super::path::{Path, Root};

/// Cosine of the weakest bend that is rounded with two more rings.
const SHARP_BEND: f32 = 0.93;

impl Path {
    /// Positions of rings: at the base, the tip and the joints, and where flare, collar and bends need them.
    pub(super) fn stations(&self, detail: BarkDetail) -> Vec<f32> {
        let end_m = self.length_m();
        let mut wanted = Vec::new();
        match self.root {
            Root::Ground { sunk_m, flare } if flare > 0.0 => {
                let heights: &[f32] = match detail {
                    BarkDetail::Full => &[0.35, 0.8, 1.4, 2.2, 3.4],
                    BarkDetail::Middle => &[0.5, 1.2, 2.6],
                    BarkDetail::Far => &[1.2],
                };
                wanted.extend(heights.iter().map(|height| sunk_m + height * self.base_radius_m()));
            }
            Root::Limb { out_m, .. } => {
                let ways: &[f32] = match detail {
                    BarkDetail::Full => &[0.0, 0.6, 1.4, 3.0],
                    BarkDetail::Middle => &[0.0, 1.2],
                    BarkDetail::Far => &[],
                };
                wanted.extend(ways.iter().map(|way| out_m + way * self.base_radius_m()));
            }
            _ => {}
        }
        for (pair, &rounding_m) in self.pieces.windows(2).zip(&self.rounding_m[1..]) {
            let joint_m = pair[1].begin_m;
            if rounding_m > 0.0 && detail == BarkDetail::Full {
                wanted.extend([joint_m - rounding_m, joint_m + rounding_m]);
                if pair[0].direction.dot(pair[1].direction) < SHARP_BEND {
                    wanted.extend([joint_m - 0.5 * rounding_m, joint_m + 0.5 * rounding_m]);
                }
            }
            wanted.push(joint_m);
        }
        wanted.retain(|at| *at > 0.0 && *at < end_m);
        wanted.sort_by(f32::total_cmp);
        // Rings closer than this would pass through each other in a bend, or show nothing.
        let apart_m = |at: f32| 0.3 * self.radius_m(at).max(0.05 * self.base_radius_m());
        let mut stations = vec![0.0];
        let mut since_kept = 0;
        for (place, &at) in wanted.iter().enumerate() {
            let is_straight = detail == BarkDetail::Far
                && since_kept < 2
                && wanted.get(place + 1).is_some_and(|&next| {
                    self.direction(next).dot(self.direction(stations[stations.len() - 1])) > 0.97
                });
            let is_close = at - stations[stations.len() - 1] < apart_m(at) || end_m - at < apart_m(at);
            since_kept += 1;
            if !(is_straight || is_close) {
                stations.push(at);
                since_kept = 0;
            }
        }
        stations.push(end_m);
        stations
    }
}
