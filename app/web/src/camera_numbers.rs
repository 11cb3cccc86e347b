// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The camera as seven numbers, which a link carries.

use glam::Vec3;
use windfall_render::camera::Camera;

use crate::error::WebError;

/// Number of a camera: name, lowest and highest value, and both in words.
type Field = (&'static str, f32, f32, &'static str);

/// Numbers of a camera in their order.
const FIELDS: [Field; 7] = [
    ("target x", -1.0e5, 1.0e5, "-100000 to 100000 m"),
    ("target y", -1.0e5, 1.0e5, "-100000 to 100000 m"),
    ("target z", -1.0e5, 1.0e5, "-100000 to 100000 m"),
    ("yaw", -7.0, 7.0, "-7 to 7 rad"),
    ("pitch", -1.54, 1.54, "-1.54 to 1.54 rad"),
    ("distance", 0.2, 2000.0, "0.2 to 2000 m"),
    ("field of view", 0.01, 2.6, "0.01 to 2.6 rad"),
];

/// The numbers of a camera: point looked at, yaw, pitch, distance, vertical field of view.
pub(crate) fn numbers_of(camera: &Camera) -> [f32; 7] {
    let Camera { target_m, yaw_rad, pitch_rad, distance_m, vertical_fov_rad } = *camera;
    [target_m.x, target_m.y, target_m.z, yaw_rad, pitch_rad, distance_m, vertical_fov_rad]
}

/// The camera of these numbers.
///
/// # Errors
/// [`WebError::Camera`] for the first that is missing or not allowed.
pub(crate) fn camera_of(numbers: &[f32]) -> Result<Camera, WebError> {
    for (index, (field, low, high, allowed)) in FIELDS.into_iter().enumerate() {
        let value = numbers.get(index).copied().unwrap_or(f32::NAN);
        if !(low..=high).contains(&value) {
            return Err(WebError::Camera { field, value, allowed });
        }
    }
    Ok(Camera {
        target_m: Vec3::new(numbers[0], numbers[1], numbers[2]),
        yaw_rad: numbers[3],
        pitch_rad: numbers[4],
        distance_m: numbers[5],
        vertical_fov_rad: numbers[6],
    })
}
