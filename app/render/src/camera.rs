// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A perspective camera that orbits the point it looks at.

use glam::camera::rh::{proj::directx, view};
use glam::{Mat4, Vec3};
use windfall_core::scene;

use crate::land::Land;

/// Distance of the near plane in metres: small enough to fly among leaves, and reversed infinite depth keeps the
/// far trees apart from the ground all the same.
pub(crate) const NEAR_M: f32 = 0.05;
/// Closest and farthest the camera goes from its target, in metres.
const DISTANCE_RANGE_M: (f32, f32) = (0.2, 2000.0);
/// Width of a picture relative to its height that scenes are composed for.
const USUAL_ASPECT: f32 = 16.0 / 9.0;
/// Widest a narrow picture opens the camera, in radians from top to bottom.
const MAX_FOV_RAD: f32 = 2.2;
/// Times the camera is lifted out of a hill.
const LIFTS: u32 = 4;
/// Steepest view up or down in radians; straight down would lose the sense of "up".
const MAX_PITCH_RAD: f32 = 1.54;

/// An orbit camera: it stands `distance_m` from `target_m`, in the direction that yaw and pitch give.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Point looked at in metres.
    pub target_m: Vec3,
    /// Direction from target to eye in the ground plane, in radians from +z turning to +x.
    pub yaw_rad: f32,
    /// Height of the eye above the target as an angle in radians.
    pub pitch_rad: f32,
    /// Distance from target to eye in metres.
    pub distance_m: f32,
    /// Vertical field of view in radians.
    pub vertical_fov_rad: f32,
}

impl From<&scene::Camera> for Camera {
    fn from(camera: &scene::Camera) -> Self {
        let offset = camera.eye_m - camera.target_m;
        let distance_m = offset.length().max(DISTANCE_RANGE_M.0);
        Self {
            target_m: camera.target_m,
            yaw_rad: offset.x.atan2(offset.z),
            pitch_rad: (offset.y / distance_m).asin().clamp(-MAX_PITCH_RAD, MAX_PITCH_RAD),
            distance_m,
            vertical_fov_rad: camera.vertical_fov_deg.to_radians(),
        }
    }
}

impl Camera {
    /// Position of the camera in metres.
    pub fn eye_m(&self) -> Vec3 {
        let (pitch_sin, pitch_cos) = self.pitch_rad.sin_cos();
        let (yaw_sin, yaw_cos) = self.yaw_rad.sin_cos();
        self.target_m + self.distance_m * Vec3::new(pitch_cos * yaw_sin, pitch_sin, pitch_cos * yaw_cos)
    }

    /// The camera for a picture of this aspect. One narrower than 16:9 sees as much from left to right as if it were
    /// 16:9, and more above and below.
    #[must_use]
    pub fn fitted(mut self, aspect: f32) -> Self {
        let narrower = (USUAL_ASPECT / aspect).max(1.0);
        let tangent = narrower * (0.5 * self.vertical_fov_rad).tan();
        self.vertical_fov_rad = (2.0 * tangent.atan()).min(MAX_FOV_RAD.max(self.vertical_fov_rad));
        self
    }

    /// Unit vector of the view.
    pub fn forward(&self) -> Vec3 {
        (self.target_m - self.eye_m()).normalize_or(Vec3::NEG_Z)
    }

    /// Unit vector to the right of the picture.
    pub fn right(&self) -> Vec3 {
        self.forward().cross(Vec3::Y).normalize_or(Vec3::X)
    }

    /// Unit vector to the top of the picture.
    pub fn up(&self) -> Vec3 {
        self.right().cross(self.forward())
    }

    /// World to clip space: reversed depth, 1 at the near plane and 0 at infinity.
    pub fn view_projection(&self, aspect: f32) -> Mat4 {
        directx::perspective_infinite_reverse(self.vertical_fov_rad, aspect, NEAR_M)
            * view::look_at_mat4(self.eye_m(), self.target_m, Vec3::Y)
    }

    /// Turns the camera about its target.
    pub fn orbit(&mut self, yaw_rad: f32, pitch_rad: f32) {
        self.yaw_rad = (self.yaw_rad + yaw_rad).rem_euclid(std::f32::consts::TAU);
        self.pitch_rad = (self.pitch_rad + pitch_rad).clamp(-MAX_PITCH_RAD, MAX_PITCH_RAD);
    }

    /// Divides the distance to the target by `factor`: above 1 goes nearer.
    pub fn zoom(&mut self, factor: f32) {
        let distance_m = self.distance_m / factor.max(1.0e-3);
        self.distance_m = distance_m.clamp(DISTANCE_RANGE_M.0, DISTANCE_RANGE_M.1);
    }

    /// Moves camera and target across the view, in fractions of the picture's height (right and up positive), so
    /// that what lies under the pointer stays there.
    pub fn pan(&mut self, right: f32, up: f32) {
        let height_m = 2.0 * self.distance_m * (0.5 * self.vertical_fov_rad).tan();
        self.target_m += height_m * (right * self.right() + up * self.up());
    }

    /// Moves camera and target through the scene, in metres to the right, up and ahead.
    pub fn fly(&mut self, right_m: f32, up_m: f32, ahead_m: f32) {
        self.target_m += right_m * self.right() + up_m * Vec3::Y + ahead_m * self.forward();
    }

    /// Turns the view about the eye; positive angles look to the left and up.
    pub fn look(&mut self, yaw_rad: f32, pitch_rad: f32) {
        let eye_m = self.eye_m();
        self.orbit(yaw_rad, -pitch_rad);
        self.target_m += eye_m - self.eye_m();
    }

    /// Lifts the camera to `clearance_m` metres above the land, keeping what it looks at.
    pub fn stay_above(&mut self, land: &Land, clearance_m: f32) {
        self.target_m.y = self.target_m.y.max(land.surface_m(self.target_m.x, self.target_m.z) + clearance_m);
        // Lifted along a circle the eye comes to stand elsewhere, where the land may be higher.
        for _ in 0..LIFTS {
            let eye = self.eye_m();
            let least_m = land.surface_m(eye.x, eye.z) + clearance_m;
            if eye.y >= least_m {
                break;
            }
            let lowest = ((least_m - self.target_m.y) / self.distance_m).clamp(-1.0, 1.0).asin();
            self.pitch_rad = self.pitch_rad.max(lowest).min(MAX_PITCH_RAD);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scene_camera_keeps_its_place() {
        let described =
            scene::Camera { eye_m: Vec3::new(3.0, 2.0, -5.0), target_m: Vec3::ONE, vertical_fov_deg: 40.0 };
        let camera = Camera::from(&described);
        assert!(camera.eye_m().distance(described.eye_m) < 1.0e-5, "eye at {}", camera.eye_m());
    }

    #[test]
    fn target_projects_to_the_middle() {
        let mut camera = Camera::from(&scene::Camera::default());
        camera.orbit(0.7, 0.3);
        camera.pan(0.1, -0.2);
        let clip = camera.view_projection(1.5) * camera.target_m.extend(1.0);
        assert!((clip.x / clip.w).abs() < 1.0e-5, "off centre: {clip}");
        assert!((clip.y / clip.w).abs() < 1.0e-5, "off centre: {clip}");
        assert!(clip.z > 0.0 && clip.z < clip.w, "reversed depth must fall from 1 to 0: {clip}");
    }

    #[test]
    fn narrow_pictures_see_the_whole_width() {
        let camera = Camera::from(&scene::Camera::default());
        let edge = |aspect: f32| aspect * (0.5 * camera.fitted(aspect).vertical_fov_rad).tan();
        assert!((edge(4.0 / 3.0) - edge(16.0 / 9.0)).abs() < 1.0e-5, "{} from the side", edge(4.0 / 3.0));
        assert_eq!(camera.fitted(2.0), camera, "a wide picture is as the scene says");
        assert!(camera.fitted(0.01).vertical_fov_rad <= MAX_FOV_RAD, "within bounds");
    }

    #[test]
    fn flying_keeps_the_view_and_looking_keeps_the_place() {
        let mut camera = Camera::from(&scene::Camera::default());
        let (eye_m, forward) = (camera.eye_m(), camera.forward());
        camera.fly(1.0, 2.0, 3.0);
        let wanted = eye_m + camera.right() + 2.0 * Vec3::Y + 3.0 * forward;
        assert!(camera.eye_m().distance(wanted) < 1.0e-5, "flown to {}", camera.eye_m());
        assert!(camera.forward().distance(forward) < 1.0e-5, "looks ahead: {}", camera.forward());
        let (eye_m, right) = (camera.eye_m(), camera.right());
        camera.look(0.3, 0.2);
        assert!(camera.eye_m().distance(eye_m) < 1.0e-5, "stays: {}", camera.eye_m());
        assert!(camera.forward().dot(right) < -0.2, "looks to the left: {}", camera.forward());
        assert!(camera.forward().y > forward.y + 0.1, "and up: {}", camera.forward());
    }

    #[test]
    fn orbit_and_zoom_stay_in_range() {
        let mut camera = Camera::from(&scene::Camera::default());
        camera.orbit(100.0, 100.0);
        camera.zoom(0.0);
        assert!(camera.pitch_rad <= MAX_PITCH_RAD, "pitch {}", camera.pitch_rad);
        assert!(camera.distance_m <= DISTANCE_RANGE_M.1, "distance {}", camera.distance_m);
        camera.orbit(0.0, -100.0);
        camera.stay_above(&Land::of(&scene::Ground::default()), 0.0);
        assert!(camera.eye_m().y >= -1.0e-4, "eye below ground: {}", camera.eye_m());
    }

    #[test]
    fn hills_lift_the_camera() {
        let terrain = scene::Terrain { relief_m: 60.0, ..scene::Terrain::default() };
        let land = Land::of(&scene::Ground { terrain: Some(terrain), ..scene::Ground::default() });
        let mut lifted = 0;
        for step in 0..64u8 {
            let mut camera = Camera::from(&scene::Camera::default());
            camera.distance_m = 40.0;
            camera.orbit(0.1 * f32::from(step), -2.0);
            let before = camera;
            camera.stay_above(&land, 0.1);
            let eye = camera.eye_m();
            assert!(eye.y > land.surface_m(eye.x, eye.z), "in a hill at {eye}");
            lifted += u32::from(camera != before);
        }
        assert!(lifted > 30, "{lifted} views began in the ground");
    }
}
