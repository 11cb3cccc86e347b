// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! One solid part.

use std::collections::HashMap;
use std::sync::Arc;

use glam::{DQuat, DVec3, Vec3};

use super::faces::Faces;
use super::walk::{Gait, LIMBS, Limb};
use crate::SceneError;
use crate::scene::keyed::{Key, numbers_at};
use crate::scene::{Finish, Object, ObjectFriction, ObjectMotion, ObjectShape, Scene};
use crate::surface::Surface;

/// Place and orientation of a solid part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolidPose {
    /// Centre in m.
    pub center_m: DVec3,
    /// Turn from the part's own frame.
    pub turn: DQuat,
}

/// A solid part.
#[derive(Clone, Debug)]
pub struct Solid {
    /// Shape.
    pub shape: ObjectShape,
    pub(crate) faces: Option<Faces>,
    /// Friction.
    pub friction: ObjectFriction,
    /// Coefficient of restitution.
    pub restitution: f32,
    /// Share of its face that air passes through.
    pub open: f32,
    /// Reflectance, linear red, green and blue.
    pub color: Vec3,
    /// Material of its surface.
    pub finish: Finish,
    path: Path,
}

/// Motion of a part.
#[derive(Clone, Debug)]
enum Path {
    Still(SolidPose),
    Keys { tilt: DQuat, keys: Vec<Key<4>> },
    Limb { gait: Gait, limb: Limb },
}

/// Friction of leaves on clothes and boots, assumed.
const WALKER_FRICTION: ObjectFriction = ObjectFriction::Coulomb(0.5);
/// Restitution of leaves that strike them, assumed.
const WALKER_RESTITUTION: f32 = 0.1;

/// All solid parts of a scene: the objects in their order, then the limbs of walkers. Meshes are read now.
///
/// # Errors
/// [`SceneError::Field`] for a polyhedron that is none, or a mesh that cannot be read or is not closed.
pub fn solids_of(scene: &Scene) -> Result<Vec<Solid>, SceneError> {
    let mut solids: Vec<Solid> = Vec::new();
    let mut read = HashMap::new();
    for (index, object) in scene.objects.iter().enumerate() {
        let faces = Faces::of(&object.shape, &mut read).map_err(|error| SceneError::Field {
            file: scene.name.clone(),
            field: format!("objects[{index}].shape"),
            value: error.to_string(),
            allowed: error.allowed(),
        })?;
        solids.push(Solid::of_object(object, faces));
    }
    for walker in &scene.walkers {
        let gait = Gait::of(walker);
        solids.extend(LIMBS.iter().map(|&limb| Solid {
            shape: limb.shape(),
            faces: None,
            friction: WALKER_FRICTION,
            restitution: WALKER_RESTITUTION,
            open: 0.0,
            color: limb.color(walker.color),
            finish: Finish::Stone,
            path: Path::Limb { gait: gait.clone(), limb },
        }));
    }
    Ok(solids)
}

impl Solid {
    /// The part that an object is.
    fn of_object(object: &Object, faces: Option<Faces>) -> Self {
        let tilt = DQuat::from_rotation_x(f64::from(object.tilt_deg).to_radians());
        let (at, heading) = (object.at_m.as_dvec3(), f64::from(object.heading_deg));
        let path = match &object.motion {
            ObjectMotion::Still => Path::Still(SolidPose { center_m: at, turn: turned(heading) * tilt }),
            ObjectMotion::Path(keys) => {
                let keys = keys.iter().map(|key| {
                    let center = at + key.moved_m.as_dvec3();
                    (key.time_s.into(), [center.x, center.y, center.z, heading + f64::from(key.turned_deg)])
                });
                Path::Keys { tilt, keys: keys.collect() }
            }
        };
        Self {
            shape: object.shape.clone(),
            faces,
            friction: object.friction,
            restitution: object.restitution,
            open: object.open,
            color: object.color,
            finish: object.finish,
            path,
        }
    }

    /// A part that stands still, of no colour of its own.
    pub(super) fn still(
        shape: ObjectShape,
        friction: ObjectFriction,
        restitution: f32,
        pose: SolidPose,
    ) -> Self {
        Self {
            shape,
            faces: None,
            friction,
            restitution,
            open: 0.0,
            color: Vec3::ZERO,
            finish: Finish::Stone,
            path: Path::Still(pose),
        }
    }

    /// Its surface, if it is a polyhedron or a mesh.
    pub fn surface(&self) -> Option<&Arc<Surface>> {
        self.faces.as_ref().map(Faces::surface)
    }

    /// Returns true if it ever moves.
    pub fn moves(&self) -> bool {
        !matches!(self.path, Path::Still(_))
    }

    /// The limb of a walker that it is; `None` for an object.
    pub fn limb(&self) -> Option<Limb> {
        match self.path {
            Path::Limb { limb, .. } => Some(limb),
            _ => None,
        }
    }

    /// Pose at a time in seconds, over ground of a height in m at x, z.
    pub fn pose_at(&self, time_s: f64, ground_m: impl Fn(f64, f64) -> f64) -> SolidPose {
        match &self.path {
            Path::Still(pose) => *pose,
            Path::Keys { tilt, keys } => {
                let [x, y, z, heading] = numbers_at(keys, time_s).unwrap_or_default();
                SolidPose { center_m: DVec3::new(x, y, z), turn: turned(heading) * *tilt }
            }
            Path::Limb { gait, limb } => gait.pose(*limb, time_s, ground_m),
        }
    }
}

/// Turn about the vertical by degrees.
fn turned(degrees: f64) -> DQuat {
    DQuat::from_rotation_y(degrees.to_radians())
}
