// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Solid parts as seen from above.

use glam::{DVec2, DVec3};

use super::outline::Outline;
use super::part::Solid;
use super::sight::entry_m;

/// Height in m above everything.
const ABOVE_M: f64 = 1e4;

/// Rectangle about a part as seen from above, with sides along its own.
#[derive(Clone, Copy, Debug)]
pub struct Footprint {
    /// Centre, x and z.
    pub center_m: DVec2,
    /// Unit vector along one of its sides, x and z.
    pub along: DVec2,
    /// Half edges along it and across.
    pub half_m: DVec2,
}

impl Footprint {
    /// Place so far from the centre, along and across.
    pub fn place_m(&self, offset_m: DVec2) -> DVec2 {
        self.center_m + self.along * offset_m.x + self.along.perp() * offset_m.y
    }
}

impl Solid {
    /// Rectangle about it as seen from above; `None` for what moves or has no end.
    pub fn footprint(&self) -> Option<Footprint> {
        let outline = Outline::of_still(self)?;
        // Objects are tilted about their own x, which stays level.
        let own_x = self.pose_at(0.0, |_, _| 0.0).turn * DVec3::X;
        let along = DVec2::new(own_x.x, own_x.z).try_normalize().unwrap_or(DVec2::X);
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for point in outline.points {
            let level = DVec2::new(point.x, point.z);
            let offset = DVec2::new(level.dot(along), level.dot(along.perp()));
            (low, high) = (low.min(offset), high.max(offset));
        }
        let middle = 0.5 * (low + high);
        let center_m = along * middle.x + along.perp() * middle.y;
        Some(Footprint { center_m, along, half_m: 0.5 * (high - low) })
    }

    /// Height in m of its upper side at a place, at time zero; `None` beside it.
    pub fn top_m(&self, x_m: f64, z_m: f64) -> Option<f64> {
        let pose = self.pose_at(0.0, |_, _| 0.0);
        let way_m = entry_m(self, &pose, DVec3::new(x_m, ABOVE_M, z_m), DVec3::NEG_Y)?;
        Some(ABOVE_M - way_m)
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::scene::{Object, ObjectMotion, ObjectShape, Scene};
    use crate::solid::solids_of;

    fn solid(shape: ObjectShape, heading_deg: f32, tilt_deg: f32) -> Solid {
        let at_m = Vec3::new(2.0, 1.0, -3.0);
        let object =
            Object { shape, at_m, heading_deg, tilt_deg, motion: ObjectMotion::Still, ..Object::default() };
        let scene = Scene { objects: vec![object], ..Scene::default() };
        solids_of(&scene).expect("valid").remove(0)
    }

    #[test]
    fn footprints_are_along_what_they_are_of() {
        let wall = solid(ObjectShape::Box { size_m: Vec3::new(3.0, 0.6, 0.4) }, 33.0, 0.0);
        let found = wall.footprint().expect("it stands still");
        assert!(found.center_m.distance(DVec2::new(2.0, -3.0)) < 1e-6, "{found:?}");
        assert!(found.half_m.distance(DVec2::new(1.5, 0.2)) < 1e-6, "{found:?}");
        let corner = found.place_m(found.half_m * 0.99);
        assert!((wall.top_m(corner.x, corner.y).expect("above it") - 1.3).abs() < 1e-6);
        let beside = found.place_m(found.half_m * 1.01);
        assert_eq!(wall.top_m(beside.x, beside.y), None);
        // A trunk that lies: its own y is level.
        let trunk = solid(ObjectShape::Cylinder { radius_m: 0.15, height_m: 2.6 }, 40.0, 90.0);
        let found = trunk.footprint().expect("it stands still");
        assert!((found.half_m.y - 1.3).abs() < 1e-3 && (found.half_m.x - 0.15).abs() < 0.01, "{found:?}");
        let end = found.place_m(DVec2::new(0.09, 1.2));
        assert!((trunk.top_m(end.x, end.y).expect("above it") - 1.12).abs() < 1e-6);
    }
}
