// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Solid things: what leaves strike, lie on and are pushed by.

use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};

/// Shape of an object in a frame of its own, about its centre.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum ObjectShape {
    /// A ball.
    Sphere {
        /// Radius in metres, 0.005 to 50.
        radius_m: f32,
    },
    /// A cylinder along y with half a ball at either end.
    Capsule {
        /// Radius in metres, 0.005 to 50.
        radius_m: f32,
        /// Distance of the two balls' centres in metres, 0 to 200.
        length_m: f32,
    },
    /// A box.
    Box {
        /// Edges in metres, each 0.02 to 200.
        size_m: Vec3,
    },
    /// A cylinder along y.
    Cylinder {
        /// Radius in metres, 0.005 to 50.
        radius_m: f32,
        /// Height in metres, 0.02 to 200.
        height_m: f32,
    },
    /// Everything below a plane, level in its own frame, as far as [`PLANE_REACH_M`] along x and z. It gives no shelter.
    Plane,
    /// A convex polyhedron about a centre of its own.
    Polyhedron {
        /// Its corners in metres, 4 to 32 of them, each component -100 to 100; at least 0.02 from the lowest to the highest along each axis.
        corners_m: Vec<Vec3>,
    },
    /// A rigid body whose surface is all triangles of a glTF file, about the file's origin: closed, and 0.02 to 200 m along each axis.
    Mesh {
        /// The `.gltf` or `.glb` file, as seen from the folder of the scene.
        file: String,
        /// Factor of its size, 0.001 to 1000.
        #[serde(default = "true_to_size")]
        scale: f32,
    },
}

/// Distance in metres from the centre of a plane, along either axis of its own, up to which it is there.
pub const PLANE_REACH_M: f32 = 200.0;

/// Scale of a mesh that is as large as in its file.
fn true_to_size() -> f32 {
    1.0
}

/// Loss of speed along a surface at a contact.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum ObjectFriction {
    /// At most a coefficient, 0 to 5, times the impulse into the surface.
    Coulomb(f32),
    /// Share, 0 to 1, of the speed along the surface that each strike takes, whatever its impulse: the response of particles in
    /// Zachmann's lectures ("Virtuelle Realität und Simulation", 2008).
    Loss(f32),
}

/// Displacement of an object at a time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ObjectKey {
    /// Simulated time in seconds, 0 to 86400, later than the key before.
    pub time_s: f32,
    /// Displacement from the object's place in metres, each component -4096 to 4096.
    pub moved_m: Vec3,
    /// Turn about the vertical beyond the object's own in degrees, -360 to 360.
    #[serde(default)]
    pub turned_deg: f32,
}

/// Motion of an object.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum ObjectMotion {
    /// It stays where it is.
    Still,
    /// Along keys whose times increase, smoothly between them; before the first and after the last it stands still.
    Path(Vec<ObjectKey>),
}

/// Material of an object's surface, as it is drawn and exported. Leaves find no difference.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Finish {
    /// Stone, plaster or concrete with the marks of weather.
    #[default]
    Stone,
    /// Boards with their grain along the longest edge.
    Wood,
    /// Painted or bare metal, smooth enough to glint.
    Metal,
    /// Panes that mirror what is before them.
    Glass,
}

impl Finish {
    /// All materials.
    pub const ALL: [Self; 4] = [Self::Stone, Self::Wood, Self::Metal, Self::Glass];
}

/// A solid thing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Object {
    /// Shape.
    pub shape: ObjectShape,
    /// Place of its centre in metres, each component -4096 to 4096.
    pub at_m: Vec3,
    /// Turn about the vertical in degrees, from +z to +x, -360 to 360.
    pub heading_deg: f32,
    /// Turn about its own x axis before that in degrees, -180 to 180.
    pub tilt_deg: f32,
    /// Motion.
    pub motion: ObjectMotion,
    /// Friction of leaves on it.
    pub friction: ObjectFriction,
    /// Coefficient of restitution of leaves that strike it, 0 to 1.
    pub restitution: f32,
    /// Share of its face that air passes through, as between the boards of a fence, 0 to 0.9. Leaves and flakes do not pass.
    pub open: f32,
    /// Reflectance of its surface, linear red, green and blue, each 0 to 1.
    pub color: Vec3,
    /// Material of its surface.
    pub finish: Finish,
}

impl Default for Object {
    fn default() -> Self {
        Self {
            shape: ObjectShape::Box { size_m: Vec3::ONE },
            at_m: Vec3::new(0.0, 0.5, 0.0),
            heading_deg: 0.0,
            tilt_deg: 0.0,
            motion: ObjectMotion::Still,
            friction: ObjectFriction::Coulomb(0.5),
            restitution: 0.1,
            open: 0.0,
            color: Vec3::new(0.32, 0.29, 0.25),
            finish: Finish::Stone,
        }
    }
}

/// Somebody who walks on the ground: two feet that swing and stand, and a body above them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Walker {
    /// Corners x, z of the way in metres, 2 to 256 of them, each component -4096 to 4096.
    pub way_m: Vec<Vec2>,
    /// Speed in m/s, 0.2 to 3: people stroll at 1.4.
    pub speed_m_s: f32,
    /// Time at which the walk begins in seconds, 0 to 86400.
    pub start_s: f32,
    /// Reflectance of the jacket, linear red, green and blue, each 0 to 1.
    pub color: Vec3,
}

impl Default for Walker {
    fn default() -> Self {
        Self {
            way_m: vec![Vec2::new(-5.0, 0.0), Vec2::new(5.0, 0.0)],
            speed_m_s: 1.4,
            start_s: 0.0,
            color: Vec3::new(0.28, 0.08, 0.05),
        }
    }
}
