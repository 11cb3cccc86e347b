// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Checks solid things and those who walk.

use glam::Vec3;

use super::check::Check;
use crate::SceneError;
use crate::hull::{Hull, MAX_CORNERS};
use crate::scene::{
    MAX_MOVERS, MAX_OBJECTS, MAX_PATH_KEYS, Object, ObjectFriction, ObjectKey, ObjectMotion, ObjectShape,
    Scene, WALKER_LIMBS, Walker, limits,
};

impl Scene {
    /// Checks objects and walkers, each by itself and all together.
    pub(super) fn check_objects(&self, check: &Check<'_>) -> Result<(), SceneError> {
        check.length("objects", self.objects.len(), 0, MAX_OBJECTS)?;
        check.length("walkers", self.walkers.len(), 0, MAX_MOVERS / WALKER_LIMBS)?;
        for (index, object) in self.objects.iter().enumerate() {
            object.check(&check.inside(format!("objects[{index}]")))?;
        }
        for (index, walker) in self.walkers.iter().enumerate() {
            walker.check(&check.inside(format!("walkers[{index}]")))?;
        }
        let limbs = WALKER_LIMBS * self.walkers.len();
        let moving = self.objects.iter().filter(|object| object.motion != ObjectMotion::Still).count();
        check.holds(moving + limbs <= MAX_MOVERS, "objects", || {
            let found = format!("{moving} that move, and {limbs} limbs of walkers");
            (found, format!("at most {MAX_MOVERS} of both together"))
        })?;
        for (name, count) in [("objects", self.objects.len()), ("walkers", self.walkers.len())] {
            check.holds(count == 0 || self.ground.litter.is_some(), name, || {
                (format!("a list of {count}"), "none without ground.litter".into())
            })?;
        }
        Ok(())
    }
}

impl Object {
    fn check(&self, at: &Check<'_>) -> Result<(), SceneError> {
        self.shape.check(&at.inside("shape"))?;
        at.vector("at_m", self.at_m, limits::OBJECT_AT_M)?;
        at.numbers([
            ("heading_deg", self.heading_deg.into(), limits::HEADING_DEG),
            ("tilt_deg", self.tilt_deg.into(), limits::OBJECT_TILT_DEG),
            ("restitution", self.restitution.into(), limits::RESTITUTION),
            ("open", self.open.into(), limits::OPEN),
        ])?;
        let (name, number, limit) = match self.friction {
            ObjectFriction::Coulomb(coefficient) => ("Coulomb", coefficient, limits::COULOMB),
            ObjectFriction::Loss(share) => ("Loss", share, limits::LOSS),
        };
        at.inside("friction").numbers([(name, number.into(), limit)])?;
        at.vector("color", self.color, limits::COLOR)?;
        if let ObjectMotion::Path(keys) = &self.motion {
            at.length("motion", keys.len(), 1, MAX_PATH_KEYS)?;
            let mut before_s = f32::NEG_INFINITY;
            for (index, key) in keys.iter().enumerate() {
                key.check(&at.inside(format!("motion[{index}]")), before_s)?;
                before_s = key.time_s;
            }
        }
        Ok(())
    }
}

impl ObjectShape {
    fn check(&self, at: &Check<'_>) -> Result<(), SceneError> {
        match self {
            Self::Sphere { radius_m } => {
                at.numbers([("radius_m", (*radius_m).into(), limits::OBJECT_RADIUS_M)])
            }
            Self::Capsule { radius_m, length_m } => at.numbers([
                ("radius_m", (*radius_m).into(), limits::OBJECT_RADIUS_M),
                ("length_m", (*length_m).into(), limits::OBJECT_LENGTH_M),
            ]),
            Self::Box { size_m } => at.vector("size_m", *size_m, limits::OBJECT_SIZE_M),
            Self::Cylinder { radius_m, height_m } => at.numbers([
                ("radius_m", (*radius_m).into(), limits::OBJECT_RADIUS_M),
                ("height_m", (*height_m).into(), limits::OBJECT_HEIGHT_M),
            ]),
            Self::Plane => Ok(()),
            Self::Polyhedron { corners_m } => check_corners(corners_m, at),
            Self::Mesh { file, scale } => {
                at.numbers([("scale", (*scale).into(), limits::MESH_SCALE)])?;
                at.holds(!file.is_empty(), "file", || {
                    (String::from("empty"), "the name of a .gltf or .glb file".into())
                })
            }
        }
    }
}

/// Checks the corners of a polyhedron.
fn check_corners(corners_m: &[Vec3], at: &Check<'_>) -> Result<(), SceneError> {
    at.length("corners_m", corners_m.len(), 4, MAX_CORNERS)?;
    for (index, corner) in corners_m.iter().enumerate() {
        at.vector(&format!("corners_m[{index}]"), *corner, limits::CORNER_M)?;
    }
    let low_m = corners_m.iter().copied().fold(Vec3::INFINITY, Vec3::min);
    let high_m = corners_m.iter().copied().fold(Vec3::NEG_INFINITY, Vec3::max);
    let size_m = high_m - low_m;
    at.holds(size_m.min_element() >= limits::OBJECT_SIZE_M.low, "corners_m", || {
        (
            format!("of a size of {size_m} m"),
            format!("at least {} m along each axis", limits::OBJECT_SIZE_M.low),
        )
    })?;
    match Hull::around(corners_m) {
        Ok(_) => Ok(()),
        Err(error) => at.holds(false, "corners_m", || {
            (error.to_string(), "the corners of a convex polyhedron, and no other points".into())
        }),
    }
}

impl ObjectKey {
    fn check(&self, at: &Check<'_>, before_s: f32) -> Result<(), SceneError> {
        at.numbers([
            ("time_s", self.time_s.into(), limits::KEY_TIME_S),
            ("turned_deg", self.turned_deg.into(), limits::TURNED_DEG),
        ])?;
        at.vector("moved_m", self.moved_m, limits::OBJECT_AT_M)?;
        at.holds(self.time_s > before_s, "time_s", || {
            (format!("{:?}", self.time_s), format!("later than the key before, at {before_s} s"))
        })
    }
}

impl Walker {
    fn check(&self, at: &Check<'_>) -> Result<(), SceneError> {
        at.numbers([
            ("speed_m_s", self.speed_m_s.into(), limits::WALK_M_S),
            ("start_s", self.start_s.into(), limits::START_S),
        ])?;
        at.vector("color", self.color, limits::COLOR)?;
        at.length("way_m", self.way_m.len(), 2, MAX_PATH_KEYS)?;
        for (index, corner) in self.way_m.iter().enumerate() {
            let place = Vec3::new(corner.x, 0.0, corner.y);
            at.vector(&format!("way_m[{index}]"), place, limits::OBJECT_AT_M)?;
            let before = index.checked_sub(1).and_then(|before| self.way_m.get(before));
            at.holds(before.is_none_or(|before| before.distance(*corner) >= 0.1), "way_m", || {
                (format!("{:?} twice in a row", corner.to_array()), "corners at least 0.1 m apart".into())
            })?;
        }
        Ok(())
    }
}
