// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compiles the air that solid things drag along as they move.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use crate::blocks::SlipstreamBlock;
use crate::convert::single;
use crate::scene::{ObjectMotion, ObjectShape, Scene};
use crate::solid::{Limb, Solid};

/// Drag coefficient of solid things: an assumption between those of round and of angular ones.
const DRAG: f64 = 0.8;
/// Length of a slipstream in square roots of the area that its thing sweeps, as of the wakes of those that stand.
const LENGTHS: f64 = 12.0;
/// Area in m² that somebody who walks sweeps: 1.75 m by 0.4 m.
const WALKER_M2: f64 = 0.7;
/// Speed in m/s below which a thing drags nothing along.
const LEAST_M_S: f64 = 0.01;

/// Returns true if a part drags air along: objects do, and walkers as a whole, counted as their trunks.
pub(super) fn drags_air(solid: &Solid) -> bool {
    solid.moves() && matches!(solid.limb(), None | Some(Limb::Trunk))
}

/// The slipstream of a part at a time, of which steps are so long, over ground of a height at x, z.
pub(super) fn slipstream_block(
    solid: &Solid,
    time_s: f64,
    dt_s: f64,
    ground_m: impl Fn(f64, f64) -> f64,
) -> SlipstreamBlock {
    let [before, after] = [-0.5, 0.5].map(|steps| solid.pose_at(time_s + steps * dt_s, &ground_m));
    let velocity = (after.center_m - before.center_m) / dt_s;
    let speed_m_s = velocity.length();
    if speed_m_s < LEAST_M_S {
        // Of a sixteenth of a square metre, at rest.
        return block(DVec3::ZERO, DVec3::X, 0.0, 0.0625);
    }
    let heading = velocity / speed_m_s;
    let area_m2 = match solid.limb() {
        Some(_) => WALKER_M2,
        None => swept_m2(solid, after.turn.inverse() * heading),
    };
    block(0.5 * (before.center_m + after.center_m), heading, speed_m_s, area_m2)
}

/// Width in m and speed in m/s of the slipstreams of a scene: of the narrowest side of an object, and no slower than it ever is.
pub(super) fn widths_and_speeds(scene: &Scene, solids: &[Solid]) -> impl Iterator<Item = (f64, f64)> {
    let walkers = scene.walkers.iter().map(|walker| (spread_m(WALKER_M2), f64::from(walker.speed_m_s)));
    let objects = scene.objects.iter().zip(solids).filter_map(|(object, solid)| {
        let ObjectMotion::Path(keys) = &object.motion else { return None };
        let narrowest = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| swept_m2(solid, axis));
        // Between two keys an object is at most twice as fast as in the mean.
        let fastest = keys.windows(2).map(|pair| {
            let way_m = (pair[1].moved_m - pair[0].moved_m).as_dvec3().length();
            2.0 * way_m / f64::from(pair[1].time_s - pair[0].time_s)
        });
        Some((spread_m(narrowest.into_iter().fold(f64::INFINITY, f64::min)), fastest.fold(0.0, f64::max)))
    });
    walkers.chain(objects)
}

/// Standard deviation in m of the bell of a disc of an area: √2 times that of the disc, a quarter of its diameter.
fn spread_m(area_m2: f64) -> f64 {
    libm::sqrt(area_m2 / (2.0 * PI))
}

fn block(center_m: DVec3, heading: DVec3, speed_m_s: f64, area_m2: f64) -> SlipstreamBlock {
    let spread_m = spread_m(area_m2);
    let drag_m2 = 2.0 / 3.0 * DRAG * area_m2 / TAU;
    SlipstreamBlock {
        center_m: center_m.to_array().map(single),
        spread_m: single(spread_m),
        heading: heading.to_array().map(single),
        drag_m2: single(drag_m2),
        speed_m_s: single(speed_m_s),
        fronts_per_m: single(1.0 / (2.0 * spread_m)),
        lengths_per_m: single(1.0 / (LENGTHS * libm::sqrt(area_m2))),
        padding: Default::default(),
    }
}

/// Area in m² that a part sweeps per metre of its way, in a direction of its own frame.
fn swept_m2(solid: &Solid, toward: DVec3) -> f64 {
    let across = libm::hypot(toward.x, toward.z);
    let round = |radius_m: f32, length_m: f32, ends: f64| {
        let (radius, length) = (f64::from(radius_m), f64::from(length_m));
        2.0 * radius * length * across + PI * radius * radius * ends
    };
    match solid.shape {
        ObjectShape::Sphere { radius_m } => round(radius_m, 0.0, 1.0),
        ObjectShape::Capsule { radius_m, length_m } => round(radius_m, length_m, 1.0),
        ObjectShape::Cylinder { radius_m, height_m } => round(radius_m, height_m, toward.y.abs()),
        ObjectShape::Box { size_m } => {
            let size = size_m.as_dvec3();
            toward.abs().dot(DVec3::new(size.y * size.z, size.x * size.z, size.x * size.y))
        }
        ObjectShape::Polyhedron { .. } | ObjectShape::Mesh { .. } => {
            solid.surface().map_or(0.0, |surface| surface.shadow_m2(toward))
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    #[test]
    fn shapes_sweep_the_area_of_their_shadow() {
        let diagonal = DVec3::new(0.6, 0.8, 0.0);
        let cases = [
            (ObjectShape::Sphere { radius_m: 2.0 }, 4.0 * PI),
            (ObjectShape::Box { size_m: Vec3::new(1.0, 2.0, 3.0) }, 0.6 * 6.0 + 0.8 * 3.0),
            (ObjectShape::Cylinder { radius_m: 0.5, height_m: 4.0 }, 0.6 * 4.0 + 0.8 * PI * 0.25),
            (ObjectShape::Capsule { radius_m: 0.5, length_m: 4.0 }, 0.6 * 4.0 + PI * 0.25),
        ];
        for (shape, expected) in cases {
            let found = swept_m2(shape, diagonal);
            assert!((found - expected).abs() < 1e-6, "{shape:?}: {found}, not {expected}");
        }
    }
}
