// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Rays that meet solid parts.

use glam::DVec3;

use super::distance_grid::DistanceGrid;
use super::faces::Faces;
use super::part::{Solid, SolidPose};
use crate::scene::ObjectShape;

/// Distance in m at which a ray from a place in a direction, a unit vector, enters a part in a pose: 0 from inside.
pub(crate) fn entry_m(solid: &Solid, pose: &SolidPose, from_m: DVec3, direction: DVec3) -> Option<f64> {
    let back = pose.turn.inverse();
    let (from, toward) = (back * (from_m - pose.center_m), back * direction);
    let span = match (&solid.shape, &solid.faces) {
        (_, Some(Faces::Convex(_, planes))) => {
            clip(from, toward, planes.iter().map(|plane| (plane.normal, plane.offset_m)))
        }
        (_, Some(Faces::Mesh(_, grid))) => return mesh_entry(from, toward, grid),
        (ObjectShape::Box { size_m }, None) => {
            let half = 0.5 * size_m.as_dvec3();
            let axes = [(DVec3::X, half.x), (DVec3::Y, half.y), (DVec3::Z, half.z)];
            clip(from, toward, axes.into_iter().flat_map(|(axis, half)| [(axis, half), (-axis, half)]))
        }
        (ObjectShape::Cylinder { radius_m, height_m }, None) => {
            rod(from, toward, 0.5 * f64::from(*height_m), (*radius_m).into())
        }
        (ObjectShape::Capsule { radius_m, length_m }, None) => {
            let (half, radius) = (0.5 * f64::from(*length_m), f64::from(*radius_m));
            let ends = [half, -half].map(|y| ball(from - DVec3::Y * y, toward, radius));
            ends.into_iter()
                .chain([rod(from, toward, half, radius)])
                .flatten()
                .min_by(|a, b| a.0.total_cmp(&b.0))
        }
        (ObjectShape::Sphere { radius_m }, None) => ball(from, toward, (*radius_m).into()),
        // Those have faces.
        (ObjectShape::Plane | ObjectShape::Polyhedron { .. } | ObjectShape::Mesh { .. }, None) => None,
    };
    span.map(|(enters, _)| enters)
}

/// Part of a ray behind all planes, as distances along it; each plane is its outward normal and distance from the origin.
fn clip(from: DVec3, toward: DVec3, planes: impl Iterator<Item = (DVec3, f64)>) -> Option<(f64, f64)> {
    let (mut enters, mut leaves) = (0.0, f64::INFINITY);
    for (normal, offset) in planes {
        let (speed, above) = (normal.dot(toward), normal.dot(from) - offset);
        if speed == 0.0 {
            if above >= 0.0 {
                return None;
            }
        } else if speed < 0.0 {
            enters = f64::max(enters, -above / speed);
        } else {
            leaves = f64::min(leaves, -above / speed);
        }
    }
    (enters < leaves).then_some((enters, leaves))
}

/// Part of a ray in an endless cylinder about y.
fn round(from: DVec3, toward: DVec3, radius: f64) -> Option<(f64, f64)> {
    let a = toward.x * toward.x + toward.z * toward.z;
    let c = from.x * from.x + from.z * from.z - radius * radius;
    if a < 1e-18 {
        return (c < 0.0).then_some((0.0, f64::INFINITY));
    }
    let b = from.x * toward.x + from.z * toward.z;
    let root = b * b - a * c;
    if root <= 0.0 {
        return None;
    }
    let root = libm::sqrt(root);
    let (enters, leaves) = ((-b - root) / a, (-b + root) / a);
    (leaves > 0.0).then_some((enters.max(0.0), leaves))
}

/// Part of a ray in a cylinder about y between two heights.
fn rod(from: DVec3, toward: DVec3, half: f64, radius: f64) -> Option<(f64, f64)> {
    let ends = clip(from, toward, [(DVec3::Y, half), (DVec3::NEG_Y, half)].into_iter())?;
    let side = round(from, toward, radius)?;
    let (enters, leaves) = (ends.0.max(side.0), ends.1.min(side.1));
    (enters < leaves).then_some((enters, leaves))
}

/// Part of a ray in a ball about the origin.
fn ball(from: DVec3, toward: DVec3, radius: f64) -> Option<(f64, f64)> {
    let b = from.dot(toward);
    let root = b * b - (from.length_squared() - radius * radius);
    if root <= 0.0 {
        return None;
    }
    let root = libm::sqrt(root);
    (root - b > 0.0).then_some(((-b - root).max(0.0), root - b))
}

/// Walks through the distances around a mesh.
fn mesh_entry(from: DVec3, toward: DVec3, grid: &DistanceGrid) -> Option<f64> {
    let size = DVec3::from(grid.nodes.map(|nodes| f64::from(nodes - 1) * grid.cell_m));
    let (low, high) = (grid.low_m, grid.low_m + size);
    let sides = [(DVec3::X, high.x, low.x), (DVec3::Y, high.y, low.y), (DVec3::Z, high.z, low.z)];
    let planes = sides.into_iter().flat_map(|(axis, high, low)| [(axis, high), (-axis, -low)]);
    let (enters, leaves) = clip(from, toward, planes)?;
    let step = 0.5 * grid.cell_m;
    let mut along = enters;
    while along < leaves {
        let cell = (from + toward * along - low) / grid.cell_m;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "between the first node and the last"
        )]
        let [x, y, z] = [0, 1, 2]
            .map(|axis| libm::floor(cell[axis] + 0.5).clamp(0.0, f64::from(grid.nodes[axis] - 1)) as usize);
        let [across, down, _] = grid.nodes.map(|nodes| nodes as usize);
        if grid.distances[(z * down + y) * across + x] <= 0 {
            return Some(along);
        }
        along += step;
    }
    None
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::Scene;
    use crate::scene::{Object, ObjectShape};
    use crate::solid::solids_of;

    /// Distances in m, to a hundredth, at which rays from a place meet an object.
    fn entries(object: &Object, from: DVec3, directions: &[DVec3]) -> Vec<Option<f64>> {
        let round = |m: f64| libm::floor(m * 100.0 + 0.5) / 100.0;
        let scene = Scene { objects: vec![object.clone()], ..Scene::default() };
        let solid = &solids_of(&scene).expect("shapes")[0];
        let pose = solid.pose_at(0.0, |_, _| 0.0);
        let entry = |toward: &DVec3| entry_m(solid, &pose, from, toward.normalize()).map(round);
        directions.iter().map(entry).collect()
    }

    #[test]
    fn rays_meet_every_shape_where_it_is() {
        let cube = [0, 1, 2, 3, 4, 5, 6, 7]
            .map(|bits: u8| Vec3::from([1, 2, 4].map(|bit| if bits & bit == 0 { -1.0 } else { 1.0 })));
        let torus = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/data/torus.gltf");
        let shapes = [
            ObjectShape::Box { size_m: Vec3::splat(2.0) },
            ObjectShape::Sphere { radius_m: 1.0 },
            ObjectShape::Capsule { radius_m: 1.0, length_m: 2.0 },
            ObjectShape::Cylinder { radius_m: 1.0, height_m: 2.0 },
            ObjectShape::Polyhedron { corners_m: cube.to_vec() },
            ObjectShape::Mesh { file: torus.into(), scale: 2.0 },
        ];
        for shape in shapes {
            let is_torus = matches!(shape, ObjectShape::Mesh { .. });
            let object = Object { shape, at_m: Vec3::new(4.0, 0.0, 0.0), ..Object::default() };
            let beside = if is_torus { DVec3::new(4.0, 0.0, 3.5) } else { DVec3::new(4.0, 0.0, 1.6) };
            let found = entries(&object, DVec3::ZERO, &[DVec3::X, DVec3::NEG_X, beside, DVec3::Y]);
            // The torus is 1.3 m in radius outside, in cells of some centimetres.
            let (wanted_m, within_m) = if is_torus { (2.7, 0.06) } else { (3.0, 0.005) };
            assert!(
                found[0].is_some_and(|found_m| (found_m - wanted_m).abs() <= within_m),
                "{:?}: {found:?}",
                object.shape
            );
            assert_eq!(found[1..], [None; 3], "{:?}", object.shape);
        }
    }

    #[test]
    fn ends_count_and_turns_are_taken() {
        let capsule = ObjectShape::Capsule { radius_m: 0.2, length_m: 6.0 };
        let upright = Object { shape: capsule, at_m: Vec3::new(4.0, 0.0, 0.0), ..Object::default() };
        let aside = [DVec3::new(4.0, 2.9, 0.0), DVec3::new(4.0, 0.0, 2.9)];
        assert_eq!(entries(&upright, DVec3::ZERO, &aside), [Some(4.69), None], "upright");
        let lying = Object { tilt_deg: 90.0, ..upright.clone() };
        assert_eq!(entries(&lying, DVec3::ZERO, &aside), [None, Some(4.69)], "lying along z");
        let above = DVec3::new(4.0, 5.0, 0.0);
        assert_eq!(entries(&upright, above, &[DVec3::NEG_Y, DVec3::Y]), [Some(1.8), None], "its round end");
        assert_eq!(entries(&upright, upright.at_m.as_dvec3(), &[DVec3::Y]), [Some(0.0)], "from inside");
        let disc = ObjectShape::Cylinder { radius_m: 2.0, height_m: 0.2 };
        let disc = Object { shape: disc, at_m: Vec3::new(0.0, 3.0, 0.0), ..Object::default() };
        let rays = [DVec3::Y, DVec3::new(2.5, 3.0, 0.0), DVec3::X];
        assert_eq!(entries(&disc, DVec3::ZERO, &rays), [Some(2.9), None, None], "a disc overhead");
        let floor = Object { shape: ObjectShape::Plane, at_m: Vec3::ZERO, ..Object::default() };
        assert_eq!(entries(&floor, DVec3::Y, &[DVec3::Y, DVec3::NEG_Y]), [None, Some(1.0)], "a plane");
    }
}
