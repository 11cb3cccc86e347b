// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Fine veins running like rungs from one lateral to the next.

use super::{Order, Vein};
use crate::math::{path_length, point_along};
use crate::rng::Rng;

/// Rungs between the neighbouring laterals of one side.
pub(super) fn rungs(side: &[Vein], spacing: f32, rng: &mut Rng) -> Vec<Vein> {
    let mut out = Vec::new();
    for pair in side.windows(2) {
        let (lower, upper) = (&pair[0].points, &pair[1].points);
        let length = path_length(lower).min(path_length(upper));
        let mut at = spacing * rng.range(0.6, 1.2);
        while at < length * 0.96 {
            let fraction = at / length;
            let (a, _) = point_along(lower, (fraction + 0.05 * rng.bell()).clamp(0.0, 1.0));
            let (b, _) =
                point_along(upper, (fraction - 0.12 * (1.0 - fraction) + 0.05 * rng.bell()).clamp(0.0, 1.0));
            let sag = (b - a).perp() * 0.12 * rng.bell();
            let kink = 0.06 * a.distance(b);
            let mut path = vec![a];
            for t in [0.25, 0.5, 0.75] {
                let jitter = glam::Vec2::new(rng.bell(), rng.bell()) * kink;
                path.push(a.lerp(b, t) + sag * (4.0 * t * (1.0 - t)) + jitter);
            }
            path.push(b);
            let radius = 0.0024 * rng.range(0.7, 1.1);
            out.push(Vein::tapering(path, radius, radius, Order::Tertiary));
            at += spacing * rng.range(0.7, 1.35);
        }
    }
    out
}
