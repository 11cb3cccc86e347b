// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Objects that stand still, moved over the ground by the pointer.

use egui::Pos2;
use glam::{Quat, Vec3};
use windfall_core::scene::{Object, ObjectMotion, ObjectShape, limits};
use windfall_render::land::Land;

use super::pick::Projection;

/// Farthest in metres that an object is moved in one drag: near the horizon a point of the picture is far away.
const FARTHEST_M: f32 = 200.0;

/// An object in the hand of the user.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Grab {
    /// Its number.
    pub(crate) object: usize,
    /// Its place when it was taken.
    from_m: Vec3,
    /// Point at which it was taken.
    taken_m: Vec3,
}

impl Grab {
    /// The nearest still object under the pointer.
    pub(crate) fn at(projection: &Projection, pointer: Pos2, objects: &[Object]) -> Option<Self> {
        let (eye_m, way) = projection.ray(pointer);
        let hits = objects.iter().enumerate().filter(|(_, object)| object.motion == ObjectMotion::Still);
        let hits = hits.filter_map(|(number, object)| Some((number, distance_m(object, eye_m, way)?)));
        let (object, distance_m) = hits.min_by(|a, b| a.1.total_cmp(&b.1))?;
        Some(Self { object, from_m: objects[object].at_m, taken_m: eye_m + distance_m * way })
    }

    /// Place of the object that follows the pointer over the ground; `None` where the pointer is beyond reach.
    pub(crate) fn place(&self, projection: &Projection, pointer: Pos2, land: &Land) -> Option<Vec3> {
        let (eye_m, way) = projection.ray(pointer);
        let distance_m = (self.taken_m.y - eye_m.y) / way.y;
        let moved_m = (eye_m + distance_m * way - self.taken_m).with_y(0.0);
        let is_seen = distance_m.is_finite() && distance_m > 0.0 && moved_m.length() < FARTHEST_M;
        let to_m = self.from_m + moved_m;
        let rise_m = land.ground_m(to_m.x, to_m.z) - land.ground_m(self.from_m.x, self.from_m.z);
        let (low, high) = (limits::OBJECT_AT_M.low, limits::OBJECT_AT_M.high);
        is_seen.then(|| (to_m + Vec3::Y * rise_m).clamp(Vec3::splat(low), Vec3::splat(high)))
    }
}

/// Half of the edges in metres of the box around a shape; `None` for a mesh, of which a scene only names the file, and for a plane.
fn half_m(shape: &ObjectShape) -> Option<Vec3> {
    Some(match shape {
        ObjectShape::Sphere { radius_m } => Vec3::splat(*radius_m),
        ObjectShape::Capsule { radius_m, length_m } => {
            Vec3::new(*radius_m, 0.5 * length_m + radius_m, *radius_m)
        }
        ObjectShape::Box { size_m } => 0.5 * size_m,
        ObjectShape::Cylinder { radius_m, height_m } => Vec3::new(*radius_m, 0.5 * height_m, *radius_m),
        ObjectShape::Polyhedron { corners_m } => {
            corners_m.iter().map(|corner| corner.abs()).fold(Vec3::ZERO, Vec3::max)
        }
        ObjectShape::Plane | ObjectShape::Mesh { .. } => return None,
    })
}

fn turn(object: &Object) -> Quat {
    Quat::from_rotation_y(object.heading_deg.to_radians())
        * Quat::from_rotation_x(object.tilt_deg.to_radians())
}

/// Distance in metres at which a ray enters the box around an object.
fn distance_m(object: &Object, eye_m: Vec3, way: Vec3) -> Option<f32> {
    let (back, half_m) = (turn(object).inverse(), half_m(&object.shape)?);
    let (eye, way) = (back * (eye_m - object.at_m), back * way);
    let (a, b) = ((-half_m - eye) / way, (half_m - eye) / way);
    let (enters, leaves) = (a.min(b).max_element(), a.max(b).min_element());
    (enters <= leaves && enters > 0.0).then_some(enters)
}

/// Edges of the box around an object.
pub(crate) fn outline(object: &Object) -> [[Vec3; 2]; 12] {
    let (turn, half_m) = (turn(object), half_m(&object.shape).unwrap_or_default());
    std::array::from_fn(|edge| {
        // Four edges along each axis, by the sides of the other two that they lie on.
        let (axis, side) = (edge / 4, edge % 4);
        [-1.0, 1.0].map(|end| {
            let mut corner = Vec3::ZERO;
            corner[axis] = end;
            corner[(axis + 1) % 3] = if side & 1 == 0 { -1.0 } else { 1.0 };
            corner[(axis + 2) % 3] = if side & 2 == 0 { -1.0 } else { 1.0 };
            object.at_m + turn * (corner * half_m)
        })
    })
}

#[cfg(test)]
mod tests {
    use egui::{Rect, pos2, vec2};
    use windfall_core::scene::{Camera, Ground, ObjectKey, Terrain};

    use super::*;

    fn projection() -> Projection {
        let camera = Camera {
            eye_m: Vec3::new(0.0, 3.0, 10.0),
            target_m: Vec3::new(0.0, 0.5, 0.0),
            vertical_fov_deg: 45.0,
        };
        let picture = Rect::from_min_size(pos2(300.0, 0.0), vec2(980.0, 720.0));
        Projection::new(&windfall_render::camera::Camera::from(&camera), picture)
    }

    fn stone(x: f32, z: f32) -> Object {
        Object { at_m: Vec3::new(x, 0.5, z), heading_deg: 30.0, ..Object::default() }
    }

    #[test]
    fn the_object_in_front_is_taken_and_follows_the_pointer() {
        let projection = projection();
        let at = |place| projection.place(place).expect("in front");
        let objects = [stone(0.0, -1.5), stone(0.0, 0.0), stone(3.0, 0.0)];
        let taken = |place| Grab::at(&projection, at(place), &objects).map(|grab| grab.object);
        assert_eq!(taken(objects[1].at_m), Some(1), "the nearer one");
        assert_eq!(taken(objects[2].at_m), Some(2), "beside it");
        assert_eq!(taken(Vec3::new(-3.0, 0.5, 0.0)), None, "nothing is there");
        let land = Land::of(&Ground::default());
        let grab = Grab::at(&projection, at(objects[2].at_m), &objects).expect("the third");
        let stays = grab.place(&projection, at(objects[2].at_m), &land).expect("in reach");
        assert!(stays.distance(objects[2].at_m) < 1.0e-2, "nobody has moved it: {stays}");
        let to = grab.taken_m + Vec3::new(-5.0, 0.0, 1.5);
        let moved = grab.place(&projection, at(to), &land).expect("in reach");
        assert!(moved.distance(Vec3::new(-2.0, 0.5, 1.5)) < 1.0e-2, "over the ground: {moved}");
        assert_eq!(grab.place(&projection, pos2(790.0, 5.0), &land), None, "into the sky");
    }

    #[test]
    fn what_moves_by_itself_stays_and_hills_carry_what_is_moved() {
        let projection = projection();
        let key = ObjectKey { time_s: 0.0, moved_m: Vec3::ZERO, turned_deg: 0.0 };
        let rolling = Object { motion: ObjectMotion::Path(vec![key]), ..stone(0.0, 0.0) };
        let pointer = projection.place(rolling.at_m).expect("in front");
        assert_eq!(Grab::at(&projection, pointer, &[rolling]), None, "it goes its own way");
        let hilly = Ground { terrain: Some(Terrain::default()), ..Ground::default() };
        let land = Land::of(&hilly);
        let grab = Grab::at(&projection, pointer, &[stone(0.0, 0.0)]).expect("a stone");
        let aside = projection.place(grab.taken_m + Vec3::X * 4.0).expect("in front");
        let moved = grab.place(&projection, aside, &land).expect("in reach");
        let height = |place: Vec3| place.y - land.ground_m(place.x, place.z);
        assert!((height(moved) - height(grab.from_m)).abs() < 1.0e-3, "as high above the ground: {moved}");
        assert!((moved.y - grab.from_m.y).abs() > 1.0e-3, "which is elsewhere there: {moved}");
    }

    #[test]
    fn an_outline_has_the_twelve_edges_of_a_box() {
        let object = Object { heading_deg: 0.0, ..stone(1.0, 2.0) };
        let edges = outline(&object);
        assert!(edges.iter().all(|[a, b]| (a.distance(*b) - 1.0).abs() < 1.0e-5), "{edges:?}");
        let mut middles: Vec<_> = edges.iter().map(|[a, b]| format!("{:.1}", *a + *b)).collect();
        middles.sort_unstable();
        middles.dedup();
        assert_eq!(middles.len(), 12, "no edge twice");
    }
}
