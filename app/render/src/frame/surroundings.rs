// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Light and air of a day: everything follows from the sun's place in the sky.

use std::f32::consts::PI;

use glam::{Mat4, Vec2, Vec3};
use windfall_core::scene::{Haze, View};

use super::cascades::{MAPS, above, cascades, shadow_size};
use super::input::FrameInput;
use crate::gpu::tile::Tile;
use crate::light::{Daylight, MapError, SphericalHarmonics};

/// Half edge of the square in which trees cast shade, in metres.
pub(crate) const PARK_RADIUS_M: f32 = 64.0;
/// Optical depth of haze at which contrast has fallen to 2 % (Koschmieder 1924).
const VISIBILITY_DEPTH: f32 = 3.912;

/// `Frame` of `common.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
pub(crate) struct FrameUniform {
    pub(crate) view_projection: [[f32; 4]; 4],
    pub(crate) shadows: [[[f32; 4]; 4]; MAPS],
    pub(crate) eye: [f32; 4],
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
    tile: [f32; 4],
    texels: [f32; 4],
    ambient: [[f32; 4]; 9],
    pub(crate) sky: [f32; 4],
    cloud_light: [f32; 4],
    cloud_shade: [f32; 4],
}

/// Share of the distance that heights above the water count as nearness in the mirror: they must stay below the distance.
const MIRROR_SLANT: f32 = 0.01;

impl FrameUniform {
    /// The frame as water with its surface at `water_m` mirrors it: seen from as far beneath. Nothing under the surface is
    /// drawn.
    ///
    /// # Source
    /// The near plane laid into the surface: Lengyel, "Oblique view frustum depth projection and clipping" (2005), here for
    /// reversed depth without a far plane.
    pub(crate) fn mirrored(mut self, water_m: f32) -> Self {
        let turned = Mat4::from_translation(Vec3::new(0.0, 2.0 * water_m, 0.0))
            * Mat4::from_scale(Vec3::new(1.0, -1.0, 1.0));
        let mut matrix = (Mat4::from_cols_array_2d(&self.view_projection) * turned).to_cols_array_2d();
        let surface = [0.0, 1.0, 0.0, -water_m];
        for (column, part) in matrix.iter_mut().zip(surface) {
            column[2] = column[3] - MIRROR_SLANT * part;
        }
        self.view_projection = matrix;
        self.eye[1] = 2.0 * water_m - self.eye[1];
        for axis in [&mut self.right, &mut self.up, &mut self.forward] {
            axis[1] = -axis[1];
        }
        self
    }

    /// The same for a picture of another size.
    pub(crate) fn sized(mut self, (width, height): (u32, u32)) -> Self {
        let (width, height) = (width as f32, height as f32);
        self.viewport = [width, height, 1.0 / width, 1.0 / height];
        self
    }
}

/// How the park's path winds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Path {
    /// Direction it leads, x and z.
    pub(crate) lead: Vec2,
    /// Phase of its bends in radians.
    pub(crate) phase: f32,
}

/// What a frame's light and place are computed from.
#[derive(Clone, Debug)]
pub(crate) struct Environment {
    /// Sun and sky.
    pub(crate) daylight: Daylight,
    /// What the sky does to matt surfaces.
    ambient: [Vec3; 9],
    /// Haze.
    haze: Haze,
    /// Centre of the park, on the ground.
    pub(crate) park_center: Vec3,
    /// Its path.
    pub(crate) path: Path,
}

impl Environment {
    pub(crate) fn new(view: &View, park_center: Vec3, path: Path) -> Result<Self, MapError> {
        let daylight = Daylight::new(view)?;
        let ambient = SphericalHarmonics::of(&daylight.sky).white_surface();
        Ok(Self { daylight, ambient, haze: view.haze, park_center, path })
    }

    /// The uniform block of one frame.
    pub(crate) fn frame(
        &self,
        input: &FrameInput,
        time_s: f32,
        size: (u32, u32),
        tile: &Tile,
    ) -> FrameUniform {
        let camera = &input.camera;
        let (width, height) = (size.0 as f32, size.1 as f32);
        let aspect = width / height;
        let tangent = (0.5 * camera.vertical_fov_rad).tan();
        let sun = self.daylight.sun.direction;
        let map_px = shadow_size(size.1);
        let [near, middle, far] = cascades(camera, aspect, sun, map_px);
        let maps = [near, middle, far, above(camera, map_px)];
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
            view_projection: (tile.crop() * camera.view_projection(aspect)).to_cols_array_2d(),
            shadows: maps.map(|map| map.projection.to_cols_array_2d()),
            eye: full(camera.eye_m(), time_s),
            right: full(camera.right() * tangent * aspect, 0.0),
            up: full(camera.up() * tangent, 0.0),
            forward: full(camera.forward(), 0.0),
            sun_direction: full(sun, Vec2::new(sun.x, sun.z).length() / sun.y.max(0.02)),
            sun_color: full(self.daylight.sun.illuminance / PI, 0.0),
            sky_zenith: full(zenith, self.path.lead.x),
            sky_horizon: full(horizon, self.path.lead.y),
            ground_bounce: full(bounce, self.path.phase),
            air: [VISIBILITY_DEPTH / self.haze.visibility_m, 0.0, PARK_RADIUS_M, 0.0],
            park: full(self.park_center, 0.0),
            viewport: [width, height, 1.0 / width, 1.0 / height],
            tile: tile.clip_area(),
            texels: maps.map(|map| map.texel_m),
            ambient: self.ambient.map(|light| full(light, 0.0)),
            sky: [
                self.daylight.cloud_cover,
                1.0 / self.haze.depth_m,
                f32::from(u8::from(!self.daylight.is_picture)),
                time_s,
            ],
            cloud_light: full(self.daylight.clouds[0], 0.0),
            cloud_shade: full(self.daylight.clouds[1], 0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use windfall_core::scene::{self, Sun};

    use super::*;
    use crate::camera::Camera;
    use crate::gpu::tile::tiles;

    const PATH: Path = Path { lead: Vec2::X, phase: 0.0 };

    #[test]
    fn a_mirror_shows_what_a_reflected_ray_meets() {
        let environment = Environment::new(&View::default(), Vec3::ZERO, PATH).expect("no picture of a sky");
        let camera = Camera::from(&scene::Camera::default());
        let input = FrameInput { camera, time_s: 0.0, since_s: f32::INFINITY, origin: (0, 0) };
        let tile = tiles((640, 360), (640, 360)).next().expect("a tile");
        let frame = environment.frame(&input, 0.0, (640, 360), &tile);
        let water_m = 0.3;
        let mirrored = frame.mirrored(water_m);
        let plain = Mat4::from_cols_array_2d(&frame.view_projection);
        let mirror = Mat4::from_cols_array_2d(&mirrored.view_projection);
        let eye = camera.eye_m();
        for x in [-3.0, 0.0, 2.5] {
            let surface = Vec3::new(x, water_m, -4.0);
            let away = (surface - eye).normalize() * Vec3::new(1.0, -1.0, 1.0);
            let in_place = plain.project_point3(surface).truncate();
            let mut before = f32::MAX;
            for distance in [0.5, 3.0, 40.0, 400.0] {
                let clip = mirror * (surface + distance * away).extend(1.0);
                let shown = clip.truncate().truncate() / clip.w;
                assert!(shown.distance(in_place) < 1.0e-4, "{shown} is not over {in_place}");
                let depth = clip.z / clip.w;
                assert!((0.0..=1.0).contains(&depth) && depth < before, "depth {depth} after {before}");
                before = depth;
            }
            let under = mirror * (surface - 0.2 * Vec3::Y).extend(1.0);
            assert!(under.z > under.w, "what is under water is cut off");
        }
    }

    #[test]
    fn light_stays_finite_for_every_sun() {
        for elevation_deg in [-6.0, 0.0, 1.0, 5.0, 45.0, 90.0] {
            let sun = Sun { azimuth_deg: 30.0, elevation_deg };
            let environment = Environment::new(&View { sun, ..View::default() }, Vec3::ZERO, PATH)
                .expect("no file is needed");
            let camera = Camera::from(&scene::Camera::default());
            let input = FrameInput { camera, time_s: 1.0, since_s: f32::INFINITY, origin: (0, 0) };
            let tile = tiles((640, 480), (640, 480)).next().expect("a tile");
            let frame = environment.frame(&input, 1.0, (640, 480), &tile);
            let all: &[f32] = bytemuck::cast_slice(std::slice::from_ref(&frame));
            assert!(all.iter().all(|value| value.is_finite()), "elevation {elevation_deg}: {frame:?}");
        }
    }
}
