// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Light and air of a day: everything follows from the sun's place in the sky.

use std::f32::consts::PI;

use glam::{Mat4, Vec2, Vec3, Vec4};
use windfall_core::scene::{Haze, View};

use super::renderer::FrameInput;
use super::scenery::PARK_RADIUS_M;
use super::shadow_pass::SHADOW_SIZE;
use crate::camera::Camera;
use crate::light::{Daylight, MapError, SphericalHarmonics, luminance};
use crate::trees::Stand;

/// Half edge of the square around the camera's focus in which leaves cast shadows, in metres.
const SHADOW_RADIUS_M: f32 = 11.0;
/// How far towards and away from the sun leaves still cast shadows there, in metres.
const SHADOW_DEPTH_M: f32 = 60.0;
/// Farthest the focus lies from the camera, in metres: beyond it, shadows are too small to be seen.
const FOCUS_LIMIT_M: f32 = 11.0;
/// Largest radius of the ball around the scene's trees in which they cast shadows, in metres.
const WIDE_LIMIT_M: f32 = 70.0;
/// Optical depth of haze at which contrast has fallen to 2 % (Koschmieder 1924).
const VISIBILITY_DEPTH: f32 = 3.912;
/// Calibration of incident light meters in lx s (ISO 2720).
const METER_LX_S: f32 = 250.0;
/// Stops by which a picture is brighter than a meter for grey cards would have it: autumn leaves are bright.
const BRIGHTER_BY: f32 = 1.2;

/// `Frame` of `common.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct FrameUniform {
    view_projection: [[f32; 4]; 4],
    shadow_projection: [[f32; 4]; 4],
    wide_projection: [[f32; 4]; 4],
    eye: [f32; 4],
    right: [f32; 4],
    up: [f32; 4],
    forward: [f32; 4],
    sun_direction: [f32; 4],
    sun_color: [f32; 4],
    sky_zenith: [f32; 4],
    sky_horizon: [f32; 4],
    ground_bounce: [f32; 4],
    air: [f32; 4],
    park: [f32; 4],
    viewport: [f32; 4],
    wide: [f32; 4],
    ambient: [[f32; 4]; 9],
    sky: [f32; 4],
    cloud_light: [f32; 4],
    cloud_shade: [f32; 4],
}

/// How the park's path winds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Path {
    /// Direction it leads, x and z.
    pub(super) lead: Vec2,
    /// Phase of its bends in radians.
    pub(super) phase: f32,
}

/// A ball in metres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ball {
    pub(super) center_m: Vec3,
    pub(super) radius_m: f32,
}

impl Ball {
    /// The ball around the crowns and feet of a stand; `None` without trees.
    pub(super) fn around(stand: &Stand) -> Option<Self> {
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        for tree in &stand.trees {
            let (center_m, radii_m) = (tree.crown.center_m, tree.crown.radii_m);
            low = low.min(tree.foot_m).min(center_m - radii_m);
            high = high.max(tree.foot_m).max(center_m + radii_m);
        }
        let center_m = 0.5 * (low + high);
        // Room to sway.
        let radius_m = (0.5 * (high - low).length() + 1.0).min(WIDE_LIMIT_M);
        (!stand.trees.is_empty()).then_some(Self { center_m, radius_m })
    }
}

/// What a frame's light and place are computed from.
#[derive(Clone, Debug)]
pub(super) struct Environment {
    /// Sun and sky.
    pub(super) daylight: Daylight,
    /// What the sky does to matt surfaces.
    ambient: [Vec3; 9],
    /// Exposure value at ISO 100 that light on level ground asks for.
    exposure_value: f32,
    /// Haze.
    haze: Haze,
    /// Centre of the park, on the ground.
    pub(super) park_center: Vec3,
    /// Its path.
    pub(super) path: Path,
    /// The ball around the trees of the scene.
    pub(super) stand: Option<Ball>,
}

impl Environment {
    pub(super) fn new(
        view: &View,
        park_center: Vec3,
        path: Path,
        stand: Option<Ball>,
    ) -> Result<Self, MapError> {
        let daylight = Daylight::new(view)?;
        let ambient = SphericalHarmonics::of(&daylight.sky).white_surface();
        let sun = daylight.sun.illuminance * daylight.sun.direction.y.max(0.0);
        let level = luminance(daylight.sky.irradiance(Vec3::Y) + sun);
        let exposure_value = (1000.0 * level * 100.0 / METER_LX_S).log2() - BRIGHTER_BY;
        Ok(Self { daylight, ambient, exposure_value, haze: view.haze, park_center, path, stand })
    }

    /// The uniform block of one frame.
    pub(super) fn frame(&self, input: &FrameInput, time_s: f32, size: (u32, u32)) -> FrameUniform {
        let camera = &input.camera;
        let (width, height) = (size.0 as f32, size.1 as f32);
        let aspect = width / height;
        let tangent = (0.5 * camera.vertical_fov_rad).tan();
        let sun = self.daylight.sun.direction;
        let sky = &self.daylight.sky;
        let zenith = sky.sample(Vec3::Y);
        let horizon = 0.25
            * [Vec3::X, Vec3::Z, -Vec3::X, -Vec3::Z]
                .map(|to| sky.sample(to + 0.1 * Vec3::Y))
                .iter()
                .sum::<Vec3>();
        let bounce = sky.sample(Vec3::NEG_Y);
        let full = |v: Vec3, w: f32| v.extend(w).to_array();
        FrameUniform {
            view_projection: camera.view_projection(aspect).to_cols_array_2d(),
            shadow_projection: self.shadow_projection(camera).to_cols_array_2d(),
            wide_projection: self.wide_projection().to_cols_array_2d(),
            eye: full(camera.eye_m(), time_s),
            right: full(camera.right() * tangent * aspect, input.origin.0 as f32),
            up: full(camera.up() * tangent, input.origin.1 as f32),
            forward: full(camera.forward(), 0.0),
            sun_direction: full(sun, Vec2::new(sun.x, sun.z).length() / sun.y.max(0.02)),
            sun_color: full(self.daylight.sun.illuminance / PI, 0.0),
            sky_zenith: full(zenith, self.path.lead.x),
            sky_horizon: full(horizon, self.path.lead.y),
            ground_bounce: full(bounce, self.path.phase),
            air: [
                VISIBILITY_DEPTH / self.haze.visibility_m,
                exposure(self.exposure_value),
                PARK_RADIUS_M,
                2.0 * SHADOW_RADIUS_M / SHADOW_SIZE as f32,
            ],
            park: full(self.park_center, SHADOW_RADIUS_M),
            viewport: [width, height, 1.0 / width, 1.0 / height],
            wide: [self.stand.map_or(0.0, |ball| 2.0 * ball.radius_m / SHADOW_SIZE as f32), 0.0, 0.0, 0.0],
            ambient: self.ambient.map(|light| full(light, 0.0)),
            sky: [
                self.daylight.cloud_cover,
                1.0 / self.haze.depth_m,
                f32::from(u8::from(self.daylight.picture.is_none())),
                0.0,
            ],
            cloud_light: full(self.daylight.clouds[0], 0.0),
            cloud_shade: full(self.daylight.clouds[1], 0.0),
        }
    }

    /// World to the sun's clip space around what the camera looks at. The origin moves in whole texels, so that
    /// shadows do not crawl when the camera does.
    fn shadow_projection(&self, camera: &Camera) -> Mat4 {
        let eye = camera.eye_m();
        let forward = camera.forward();
        let level = Vec3::new(forward.x, 0.0, forward.z).normalize_or(Vec3::NEG_Z);
        let reach = camera.distance_m.clamp(2.0, FOCUS_LIMIT_M);
        let focus = Vec3::new(eye.x, self.park_center.y, eye.z) + level * reach;
        let [side, upward, toward] = self.sun_axes();
        let texel = 2.0 * SHADOW_RADIUS_M / SHADOW_SIZE as f32;
        let snap = |axis: Vec3| (focus.dot(axis) / texel).round() * texel;
        let middle = Vec3::new(snap(side), snap(upward), focus.dot(toward));
        project([side, upward, toward], middle, 1.0 / SHADOW_RADIUS_M, 0.5 / SHADOW_DEPTH_M)
    }

    /// World to the sun's clip space around all trees of the scene; without any, every place lies outside of it.
    fn wide_projection(&self) -> Mat4 {
        let Some(Ball { center_m, radius_m }) = self.stand else {
            return Mat4::from_cols(Vec4::ZERO, Vec4::ZERO, Vec4::ZERO, Vec4::new(2.0, 2.0, 0.5, 1.0));
        };
        let axes = self.sun_axes();
        let middle = Vec3::from(axes.map(|axis| center_m.dot(axis)));
        project(axes, middle, 1.0 / radius_m, 0.5 / (radius_m + SHADOW_DEPTH_M))
    }

    /// Unit vectors to the right and up as the sun sees the park, and towards the sun.
    fn sun_axes(&self) -> [Vec3; 3] {
        let toward = self.daylight.sun.direction;
        let side = toward.cross(if toward.y > 0.99 { Vec3::Z } else { Vec3::Y }).normalize();
        [side, side.cross(toward), toward]
    }
}

/// Parallel projection along the last of three axes about `middle`, given in those axes.
fn project([side, upward, toward]: [Vec3; 3], middle: Vec3, scale: f32, depth: f32) -> Mat4 {
    Mat4::from_cols_array_2d(&[
        [side.x * scale, upward.x * scale, -toward.x * depth, 0.0],
        [side.y * scale, upward.y * scale, -toward.y * depth, 0.0],
        [side.z * scale, upward.z * scale, -toward.z * depth, 0.0],
        [-middle.x * scale, -middle.y * scale, 0.5 + middle.z * depth, 1.0],
    ])
}

/// Scale from light in kcd/m² to picture, for a camera that saturates at 1.2 times what the exposure value is for
/// (ISO 12232).
fn exposure(value: f32) -> f32 {
    1000.0 / (1.2 * value.exp2())
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use windfall_core::scene::{self, Sun};

    use super::*;

    const PATH: Path = Path { lead: Vec2::X, phase: 0.0 };

    #[test]
    fn shadow_projection_separates_leaf_from_ground_along_the_sun() {
        let environment =
            Environment::new(&View::default(), Vec3::ZERO, PATH, None).expect("no file is needed");
        let matrix = environment.shadow_projection(&Camera::from(&scene::Camera::default()));
        let ground = Vec3::new(0.5, 0.0, -0.5);
        let leaf = ground + 3.0 * environment.daylight.sun.direction;
        let (low, high) = (matrix.project_point3(ground), matrix.project_point3(leaf));
        assert!((low - high).truncate().length() < 1.0e-4, "a sun ray must be one point: {low} {high}");
        assert!(high.z < low.z, "the leaf is nearer to the sun: {low} {high}");
        assert!(low.abs().max_element() < 1.0, "the focus must lie in the map: {low}");
    }

    #[test]
    fn light_stays_finite_for_every_sun() {
        for elevation_deg in [-6.0, 0.0, 1.0, 5.0, 45.0, 90.0] {
            let sun = Sun { azimuth_deg: 30.0, elevation_deg };
            let environment = Environment::new(&View { sun, ..View::default() }, Vec3::ZERO, PATH, None)
                .expect("no file is needed");
            let camera = Camera::from(&scene::Camera::default());
            let input = FrameInput { camera, time_s: 1.0, since_s: f32::INFINITY, origin: (0, 0) };
            let frame = environment.frame(&input, 1.0, (640, 480));
            let all: &[f32] = bytemuck::cast_slice(std::slice::from_ref(&frame));
            assert!(all.iter().all(|value| value.is_finite()), "elevation {elevation_deg}: {frame:?}");
        }
    }
}
