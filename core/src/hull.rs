// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Convex polyhedra: the faces between given corners.

use glam::{DVec3, Vec3};
use thiserror::Error;

use crate::convert::len32;

/// Most corners of a polyhedron: a bit for each in a word.
pub const MAX_CORNERS: usize = 32;
/// Distance from a plane within which a corner lies in it, relative to the largest distance of two corners along an axis.
const FLAT: f64 = 1e-5;

/// A side of a polyhedron.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Face {
    /// Unit vector outwards.
    pub normal: DVec3,
    /// Distance in m of its plane from the origin, along the normal.
    pub offset_m: f64,
    /// Corners in it, a bit for each.
    corners: u32,
}

/// A convex polyhedron.
#[derive(Clone, Debug, PartialEq)]
pub struct Hull {
    /// Its sides.
    pub faces: Vec<Face>,
    /// The same as triangles: numbers of corners, counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
}

/// Faults of corners as those of a polyhedron.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum HullError {
    /// Corners in one plane.
    #[error("flat: all in one plane")]
    Flat,
    /// A point that is no corner.
    #[error("not convex: [{index}] lies between others")]
    Inside {
        /// Its number, from 0.
        index: usize,
    },
}

impl Hull {
    /// The polyhedron between corners, at most [`MAX_CORNERS`] of them.
    ///
    /// # Errors
    /// [`HullError`] if they are not all corners of one.
    pub fn around(corners_m: &[Vec3]) -> Result<Self, HullError> {
        let points: Vec<DVec3> = corners_m.iter().map(|corner| corner.as_dvec3()).collect();
        let faces = faces_of(&points);
        if faces.len() < 4 {
            return Err(HullError::Flat);
        }
        let bits = |index: usize| faces.iter().filter(|face| (face.corners >> index) & 1 == 1).count();
        if let Some(index) = (0..points.len()).find(|&index| bits(index) < 3) {
            return Err(HullError::Inside { index });
        }
        let triangles = faces.iter().flat_map(|face| face.triangles(&points)).collect();
        Ok(Self { faces, triangles })
    }
}

/// Planes through three of the points that have all others on one side, each once.
fn faces_of(points: &[DVec3]) -> Vec<Face> {
    let low = points.iter().copied().fold(DVec3::INFINITY, DVec3::min);
    let high = points.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
    let near_m = FLAT * (high - low).max_element();
    let mut faces: Vec<Face> = Vec::new();
    for (first, a) in points.iter().enumerate() {
        for (second, b) in points.iter().enumerate().skip(first + 1) {
            for c in points.iter().skip(second + 1) {
                let across = (b - a).cross(c - a);
                if across.length() <= near_m * (b - a).length().max((c - a).length()) {
                    continue;
                }
                let normal = across.normalize();
                let heights = || points.iter().map(|point| (point - a).dot(normal));
                let normal = match (heights().any(|m| m > near_m), heights().any(|m| m < -near_m)) {
                    (true, false) => -normal,
                    (false, true) => normal,
                    // All in one plane, or some on either side.
                    _ => continue,
                };
                let corners = (0..)
                    .zip(heights())
                    .filter(|(_, m)| m.abs() <= near_m)
                    .fold(0, |bits, (index, _)| bits | 1u32 << index);
                // Three of more corners in a plane find it again.
                if !faces.iter().any(|face| face.corners & corners == corners) {
                    faces.retain(|face| face.corners & corners != face.corners);
                    faces.push(Face { normal, offset_m: offset_m(points, normal), corners });
                }
            }
        }
    }
    faces
}

/// Distance in m of the farthest of the points along a normal.
fn offset_m(points: &[DVec3], normal: DVec3) -> f64 {
    points.iter().map(|point| point.dot(normal)).fold(f64::NEG_INFINITY, f64::max)
}

impl Face {
    /// Triangles from its first corner on, counter-clockwise from outside.
    fn triangles(&self, points: &[DVec3]) -> Vec<[u32; 3]> {
        let own: Vec<usize> = (0..points.len()).filter(|&at| (self.corners >> at) & 1 == 1).collect();
        let middle = own.iter().map(|&at| points[at]).sum::<DVec3>() / own.len() as f64;
        let along = (points[own[0]] - middle).normalize();
        let across = self.normal.cross(along);
        let mut around: Vec<(f64, u32)> = own
            .iter()
            .map(|&at| {
                let from = points[at] - middle;
                (libm::atan2(from.dot(across), from.dot(along)), len32(at))
            })
            .collect();
        around.sort_by(|a, b| a.0.total_cmp(&b.0));
        around.windows(2).skip(1).map(|pair| [around[0].1, pair[0].1, pair[1].1]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube() -> Vec<Vec3> {
        let sign = |number: u8, bit: u8| if number & bit == 0 { -0.5 } else { 0.5 };
        (0..8).map(|number| Vec3::new(sign(number, 1), sign(number, 2), sign(number, 4))).collect()
    }

    /// Volume in m³ within the triangles.
    fn volume_m3(hull: &Hull, corners_m: &[Vec3]) -> f32 {
        let places = hull.triangles.iter().map(|triangle| triangle.map(|at| corners_m[at as usize]));
        places.map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
    }

    #[test]
    fn a_cube_has_six_sides() {
        let hull = Hull::around(&cube()).expect("a cube");
        assert_eq!((hull.faces.len(), hull.triangles.len()), (6, 12), "sides and triangles");
        let volume_m3 = volume_m3(&hull, &cube());
        assert!((volume_m3 - 1.0).abs() < 1e-6, "{volume_m3} m³");
        for face in &hull.faces {
            assert!((face.offset_m - 0.5).abs() < 1e-9, "{face:?}");
            assert!((face.normal.abs().max_element() - 1.0).abs() < 1e-9, "{face:?}");
        }
    }

    #[test]
    fn points_around_a_ball_are_all_corners() {
        // Golden spiral: no four of them in a plane.
        let points: Vec<Vec3> = (0..32u8)
            .map(|number| {
                let y = 1.0 - (2.0 * f32::from(number) + 1.0) / 32.0;
                let (sin, cos) = libm::sincosf(2.399_963_2 * f32::from(number));
                Vec3::new((1.0 - y * y).sqrt() * cos, y, (1.0 - y * y).sqrt() * sin)
            })
            .collect();
        let hull = Hull::around(&points).expect("a ball");
        assert_eq!(hull.faces.len(), 2 * 32 - 4, "sides, by Euler's formula");
        let volume_m3 = volume_m3(&hull, &points);
        assert!((3.4..4.19).contains(&volume_m3), "{volume_m3} m³");
    }

    #[test]
    fn points_that_are_no_corners_are_named() {
        let with = |point: Vec3| Hull::around(&cube().into_iter().chain([point]).collect::<Vec<_>>());
        for inside in [Vec3::ZERO, Vec3::new(0.5, 0.1, 0.1), Vec3::new(0.5, 0.5, 0.0)] {
            assert_eq!(with(inside), Err(HullError::Inside { index: 8 }), "{inside}");
        }
        assert!(with(Vec3::new(0.6, 0.1, 0.1)).is_ok(), "a pyramid on one side");
        let flat: Vec<Vec3> = cube().into_iter().filter(|corner| corner.y < 0.0).collect();
        assert_eq!(Hull::around(&flat), Err(HullError::Flat), "one side of the cube");
    }
}
