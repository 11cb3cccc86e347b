// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Rays that solid parts stop.

use glam::DVec3;

use super::distance_grid::DistanceGrid;
use super::faces::Faces;
use super::part::{Solid, SolidPose};
use crate::scene::ObjectShape;

/// Returns true if a part in a pose stops the ray from a place in a direction, a unit vector.
pub(crate) fn stops(solid: &Solid, pose: &SolidPose, from_m: DVec3, direction: DVec3) -> bool {
    let back = pose.turn.inverse();
    let (from, toward) = (back * (from_m - pose.center_m), back * direction);
    match (&solid.shape, &solid.faces) {
        (_, Some(Faces::Convex(_, planes))) => {
            let planes = planes.iter().map(|plane| (plane.normal, plane.offset_m));
            crosses(from, toward, planes)
        }
        (_, Some(Faces::Mesh(_, grid))) => crosses_mesh(from, toward, grid),
        (ObjectShape::Box { size_m }, None) => {
            let half = 0.5 * size_m.as_dvec3();
            let axes = [(DVec3::X, half.x), (DVec3::Y, half.y), (DVec3::Z, half.z)];
            crosses(from, toward, axes.into_iter().flat_map(|(axis, half)| [(axis, half), (-axis, half)]))
        }
        (ObjectShape::Cylinder { radius_m, height_m }, None) => {
            let half = 0.5 * f64::from(*height_m);
            let ends = clip(from, toward, [(DVec3::Y, half), (DVec3::NEG_Y, half)].into_iter());
            ends.zip(round(from, toward, (*radius_m).into()))
                .is_some_and(|(a, b)| a.0.max(b.0) < a.1.min(b.1))
        }
        (ObjectShape::Capsule { radius_m, length_m }, None) => {
            passes_rod(from, toward, 0.5 * f64::from(*length_m), (*radius_m).into())
        }
        (ObjectShape::Sphere { radius_m }, None) => passes_rod(from, toward, 0.0, (*radius_m).into()),
        // Those have faces.
        (ObjectShape::Plane | ObjectShape::Polyhedron { .. } | ObjectShape::Mesh { .. }, None) => false,
    }
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

fn crosses(from: DVec3, toward: DVec3, planes: impl Iterator<Item = (DVec3, f64)>) -> bool {
    clip(from, toward, planes).is_some()
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

/// Returns true for a ray that comes nearer than a radius to the piece of the y axis within `half` of the origin.
fn passes_rod(from: DVec3, toward: DVec3, half: f64, radius: f64) -> bool {
    // Least squared distance of a place on the ray from the nearest on the rod: convex along the ray, so ends and bends decide.
    let away_m2 = |along: f64| {
        let at = from + toward * along.max(0.0);
        at.distance_squared(DVec3::new(0.0, at.y.clamp(-half, half), 0.0))
    };
    let level = toward.x * toward.x + toward.z * toward.z;
    let to_axis = if level > 0.0 { -(from.x * toward.x + from.z * toward.z) / level } else { 0.0 };
    let to_end = |y: f64| -(from - DVec3::Y * y).dot(toward);
    [0.0, to_axis, to_end(half), to_end(-half)].into_iter().any(|along| away_m2(along) < radius * radius)
}

/// Walks through the distances around a mesh.
fn crosses_mesh(from: DVec3, toward: DVec3, grid: &DistanceGrid) -> bool {
    let size = DVec3::from(grid.nodes.map(|nodes| f64::from(nodes - 1) * grid.cell_m));
    let (low, high) = (grid.low_m, grid.low_m + size);
    let sides = [(DVec3::X, high.x, low.x), (DVec3::Y, high.y, low.y), (DVec3::Z, high.z, low.z)];
    let planes = sides.into_iter().flat_map(|(axis, high, low)| [(axis, high), (-axis, -low)]);
    let Some((enters, leaves)) = clip(from, toward, planes) else { return false };
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
            return true;
        }
        along += step;
    }
    false
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::Scene;
    use crate::scene::{Object, ObjectShape};
    use crate::solid::solids_of;

    /// Rays that are stopped by an object, of those from a place in these directions.
    fn stopped(object: Object, from: DVec3, directions: &[DVec3]) -> Vec<bool> {
        let scene = Scene { objects: vec![object], ..Scene::default() };
        let solid = &solids_of(&scene).expect("shapes")[0];
        let pose = solid.pose_at(0.0, |_, _| 0.0);
        directions.iter().map(|&toward| stops(solid, &pose, from, toward.normalize())).collect()
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
            let found = stopped(object.clone(), DVec3::ZERO, &[DVec3::X, DVec3::NEG_X, beside, DVec3::Y]);
            assert_eq!(found, [true, false, false, false], "{:?}", object.shape);
        }
    }

    #[test]
    fn ends_count_and_turns_are_taken() {
        let rod = ObjectShape::Capsule { radius_m: 0.2, length_m: 6.0 };
        let upright = Object { shape: rod.clone(), at_m: Vec3::new(4.0, 0.0, 0.0), ..Object::default() };
        let aside = [DVec3::new(4.0, 2.9, 0.0), DVec3::new(4.0, 0.0, 2.9)];
        assert_eq!(stopped(upright.clone(), DVec3::ZERO, &aside), [true, false], "upright");
        let lying = Object { tilt_deg: 90.0, ..upright };
        assert_eq!(stopped(lying, DVec3::ZERO, &aside), [false, true], "lying along z");
        let disc = ObjectShape::Cylinder { radius_m: 2.0, height_m: 0.2 };
        let disc = Object { shape: disc, at_m: Vec3::new(0.0, 3.0, 0.0), ..Object::default() };
        let rays = [DVec3::Y, DVec3::new(1.5, 3.0, 0.0), DVec3::new(2.5, 3.0, 0.0), DVec3::X];
        assert_eq!(stopped(disc, DVec3::ZERO, &rays), [true, true, false, false], "its edge");
        let floor = Object { shape: ObjectShape::Plane, at_m: Vec3::ZERO, ..Object::default() };
        let rays = [DVec3::Y, DVec3::new(3.0, -1.0, 0.0), DVec3::X];
        assert_eq!(stopped(floor, DVec3::Y, &rays), [false, true, false], "a plane from above");
    }
}
