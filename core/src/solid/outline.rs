// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Outlines of solid parts: points whose convex hull is about a part.

use std::f64::consts::TAU;

use glam::DVec3;

use super::part::{Solid, SolidPose};
use crate::scene::ObjectShape;

/// Points around a circle.
const ROUND: u32 = 16;

/// Outline of a solid part.
#[derive(Clone, Debug)]
pub(crate) struct Outline {
    /// Points in m whose convex hull is about the part.
    pub(crate) points: Vec<DVec3>,
    /// Heights in m of its lowest and of its highest point.
    pub(crate) heights_m: [f64; 2],
    /// Share of its face that air passes through.
    pub(crate) open: f64,
}

impl Outline {
    /// Outline of a part that stands still and is no plane; `None` for others.
    pub(crate) fn of_still(solid: &Solid) -> Option<Self> {
        (!solid.moves() && solid.shape != ObjectShape::Plane)
            .then(|| Self::of(solid, &solid.pose_at(0.0, |_, _| 0.0)))
    }

    fn of(solid: &Solid, pose: &SolidPose) -> Self {
        let place = |own: DVec3| pose.center_m + pose.turn * own;
        let points: Vec<DVec3> = match solid.shape {
            ObjectShape::Box { size_m } => {
                let half_m = 0.5 * size_m.as_dvec3();
                let signs = |corner: u32| [1, 2, 4].map(|bit| if corner & bit == 0 { -1.0 } else { 1.0 });
                (0..8).map(|corner| place(half_m * DVec3::from(signs(corner)))).collect()
            }
            ObjectShape::Cylinder { radius_m, height_m } => {
                let rim = |up_m: f64| circle(radius_m.into()).map(move |at| at + DVec3::Y * up_m);
                let half_m = 0.5 * f64::from(height_m);
                rim(-half_m).chain(rim(half_m)).map(place).collect()
            }
            ObjectShape::Sphere { radius_m } => ball(pose.center_m, radius_m.into()).collect(),
            ObjectShape::Capsule { radius_m, length_m } => {
                let half_m = 0.5 * f64::from(length_m);
                let end = |up_m: f64| ball(place(DVec3::Y * up_m), radius_m.into());
                end(-half_m).chain(end(half_m)).collect()
            }
            ObjectShape::Plane | ObjectShape::Polyhedron { .. } | ObjectShape::Mesh { .. } => solid
                .surface()
                .into_iter()
                .flat_map(|surface| surface.corners_m())
                .map(|at| place(*at))
                .collect(),
        };
        let heights = || points.iter().map(|point| point.y);
        let heights_m =
            [heights().fold(f64::INFINITY, f64::min), heights().fold(f64::NEG_INFINITY, f64::max)];
        Self { points, heights_m, open: solid.open.into() }
    }

    /// Height in m from the lowest to the highest point.
    pub(crate) fn height_m(&self) -> f64 {
        self.heights_m[1] - self.heights_m[0]
    }

    /// Middle of its points.
    pub(crate) fn middle_m(&self) -> DVec3 {
        self.points.iter().sum::<DVec3>() / self.points.len() as f64
    }
}

/// Points of a level circle around the origin.
fn circle(radius_m: f64) -> impl Iterator<Item = DVec3> {
    (0..ROUND).map(move |number| {
        let (sin, cos) = libm::sincos(f64::from(number) * TAU / f64::from(ROUND));
        DVec3::new(radius_m * cos, 0.0, radius_m * sin)
    })
}

/// Points around a ball, and its lowest and highest.
fn ball(center_m: DVec3, radius_m: f64) -> impl Iterator<Item = DVec3> {
    let poles = [-radius_m, radius_m].map(|up_m| DVec3::Y * up_m);
    circle(radius_m).chain(poles).map(move |at| center_m + at)
}
