// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Light and air of a day: everything follows from the sun's place in the sky.

use std::f32::consts::PI;

use glam::{Mat4, Vec2, Vec3};
use windfall_core::layout::Float4;
use windfall_core::scene::{Haze, View};
use windfall_core::{shared_constants, shared_struct};

use super::cascades::{MAPS, above, cascades};
use super::input::FrameInput;
use super::sunlit_air::is_seen;
use crate::gpu::tile::Tile;
use crate::light::{Daylight, MapError, SphericalHarmonics};

shared_constants! {
    /// Half edge of the square in which trees cast shade, in metres.
    pub(crate) const PARK_RADIUS_M: f32 = 64.0;
    /// Amplitude of the path's bends, in metres.
    pub(crate) const PATH_BEND_M: f32 = 3.4;
    /// Phase of the bends along the path in radians per metre.
    pub(crate) const PATH_BEND_RAD_M: f32 = 0.10;
}

/// Optical depth of haze at which contrast has fallen to 2 % (Koschmieder 1924).
const VISIBILITY_DEPTH: f32 = 3.912;

shared_struct! {
    /// Camera, sun and air of a frame. Light is in kcd/m².
    pub(crate) struct FrameUniform {
        /// World to clip space.
        pub(crate) view_projection: [[f32; 4]; 4],
        /// World to the sun's clip space, for the slices of the view from near to far; then to that of the map from above.
        pub(crate) shadows: [[[f32; 4]; 4]; MAPS],
        /// Camera position.
        pub(crate) eye_m: [f32; 3],
        /// Time of what sways and drifts.
        pub(crate) time_s: f32,
        /// Camera axis, scaled so that forward + x * right + y * up is a ray through place (x, y) of the whole picture's clip
        /// space.
        right: [f32; 3],
        /// Optical depth of haze near the ground, per metre.
        haze_per_m: f32,
        /// Camera axis, scaled likewise.
        up: [f32; 3],
        /// Reciprocal of the depth of the haze.
        inv_haze_depth_m: f32,
        /// Camera axis.
        forward: [f32; 3],
        /// Share of the sky that clouds cover.
        cloud_cover: f32,
        /// Direction towards the sun.
        sun_direction: [f32; 3],
        /// Tangent of the sun's distance from the zenith.
        sun_zenith_tan: f32,
        /// Radiance of a white matt surface that faces the sun.
        sun_color: [f32; 3],
        /// Time of the clouds.
        pub(crate) cloud_time_s: f32,
        /// Radiance of the sky above the horizon.
        sky_horizon: [f32; 3],
        /// 1 where a picture is the sky, else 0.
        sky_is_picture: u32,
        /// Radiance of clouds at their brightest.
        cloud_light: [f32; 3],
        /// Phase of the path's bends at the park's centre.
        path_phase_rad: f32,
        /// Centre of the park, on the ground.
        park_center_m: [f32; 3],
        /// Depth of the snow in the open.
        pub(crate) snow_depth_m: f32,
        /// Width and height of the whole picture in pixels.
        viewport_px: [f32; 2],
        /// Their reciprocals.
        inv_viewport_px: [f32; 2],
        /// Middle, in clip coordinates of the whole picture, of the part of it that is drawn.
        tile_center: [f32; 2],
        /// Size of that part relative to the whole.
        tile_scale: [f32; 2],
        /// Edges of the texels of the shadow maps.
        texels_m: [f32; 4],
        /// Light of the sky on white matt surfaces: coefficients of spherical harmonics, w unused.
        ambient: [Float4; 9],
        /// Direction that the park's path leads, x and z.
        path_lead: [f32; 2],
        /// Corner of least x and z of the rectangle on which snow lies.
        pub(crate) snow_corner_m: [f32; 2],
        /// Reciprocals of its edges in metres.
        pub(crate) snow_per_m: [f32; 2],
        /// First word of the snow on branches in the buffer of the bed; 0 without any.
        pub(crate) branch_snow_word: u32,
        /// 1 where haze has shafts of light in this view, else 0.
        pub(crate) shaft_share: f32,
    }
}

/// Share of the distance that heights above the water count as nearness in the mirror: they must stay below the distance.
const MIRROR_SLANT: f32 = 0.01;

impl FrameUniform {
    /// Angle of a pixel in radians. `drawn_bark` of `trees/bark_look.wgsl` has the same.
    pub(crate) fn pixel_rad(&self) -> f32 {
        2.0 * Vec3::from(self.up).length() * self.inv_viewport_px[1]
    }

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
        self.eye_m[1] = 2.0 * water_m - self.eye_m[1];
        self.shaft_share = 0.0;
        for axis in [&mut self.right, &mut self.up, &mut self.forward] {
            axis[1] = -axis[1];
        }
        self
    }

    /// The same for a picture of another size.
    pub(crate) fn sized(mut self, (width, height): (u32, u32)) -> Self {
        let (width, height) = (width as f32, height as f32);
        self.viewport_px = [width, height];
        self.inv_viewport_px = [1.0 / width, 1.0 / height];
        self
    }
}

/// Course of the park's path.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Path {
    /// Direction it leads, x and z.
    pub(crate) lead: Vec2,
    /// Phase of its bends in radians.
    pub(crate) phase: f32,
}

/// Sources of a frame's light and place.
#[derive(Clone, Debug)]
pub(crate) struct Surroundings {
    /// Sun and sky.
    pub(crate) daylight: Daylight,
    /// Light of the sky on matt surfaces.
    ambient: [Vec3; 9],
    /// Haze.
    pub(crate) haze: Haze,
    /// Centre of the park, on the ground.
    pub(crate) park_center: Vec3,
    /// Its path.
    pub(crate) path: Path,
}

impl Surroundings {
    pub(crate) fn new(view: &View, park_center: Vec3, path: Path) -> Result<Self, MapError> {
        Ok(Self::of(Daylight::new(view)?, view.haze, park_center, path))
    }

    pub(crate) fn of(daylight: Daylight, haze: Haze, park_center: Vec3, path: Path) -> Self {
        let ambient = SphericalHarmonics::of(&daylight.sky).white_surface();
        Self { daylight, ambient, haze, park_center, path }
    }

    /// True if the haze shows shafts of light.
    pub(crate) fn has_shafts(&self) -> bool {
        is_seen(VISIBILITY_DEPTH / self.haze.visibility_m, self.daylight.sun.illuminance.max_element())
    }

    /// The uniform block of a tile of a picture of `size` shaded pixels with shadow maps of `map_px` texels along an edge.
    pub(crate) fn frame(
        &self,
        input: &FrameInput,
        time_s: f32,
        (size, map_px): ((u32, u32), u32),
        tile: &Tile,
    ) -> FrameUniform {
        let camera = &input.camera;
        let (width, height) = (size.0 as f32, size.1 as f32);
        let aspect = width / height;
        let tangent = (0.5 * camera.vertical_fov_rad).tan();
        let sun = self.daylight.sun.direction;
        let [near, middle, far] = cascades(camera, aspect, sun, map_px);
        let maps = [near, middle, far, above(camera, map_px)];
        let sky = &self.daylight.sky;
        let horizon = 0.25
            * [Vec3::X, Vec3::Z, -Vec3::X, -Vec3::Z]
                .map(|to| sky.sample(to + 0.1 * Vec3::Y))
                .iter()
                .sum::<Vec3>();
        let (tile_center, tile_scale) = tile.clip_area();
        FrameUniform {
            view_projection: (tile.crop() * camera.view_projection(aspect)).to_cols_array_2d(),
            shadows: maps.map(|map| map.projection.to_cols_array_2d()),
            eye_m: camera.eye_m().to_array(),
            time_s,
            right: (camera.right() * tangent * aspect).to_array(),
            haze_per_m: VISIBILITY_DEPTH / self.haze.visibility_m,
            up: (camera.up() * tangent).to_array(),
            inv_haze_depth_m: 1.0 / self.haze.depth_m,
            forward: camera.forward().to_array(),
            cloud_cover: self.daylight.cloud_cover,
            sun_direction: sun.to_array(),
            sun_zenith_tan: Vec2::new(sun.x, sun.z).length() / sun.y.max(0.02),
            sun_color: (self.daylight.sun.illuminance / PI).to_array(),
            cloud_time_s: time_s,
            sky_horizon: horizon.to_array(),
            sky_is_picture: self.daylight.is_picture.into(),
            cloud_light: self.daylight.clouds[0].to_array(),
            path_phase_rad: self.path.phase,
            park_center_m: self.park_center.to_array(),
            snow_depth_m: 0.0,
            viewport_px: [width, height],
            inv_viewport_px: [1.0 / width, 1.0 / height],
            tile_center,
            tile_scale,
            texels_m: maps.map(|map| map.texel_m),
            ambient: self.ambient.map(|light| Float4(light.extend(0.0).to_array())),
            path_lead: self.path.lead.to_array(),
            snow_corner_m: [0.0; 2],
            snow_per_m: [0.0; 2],
            branch_snow_word: 0,
            shaft_share: f32::from(u8::from(self.has_shafts())),
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use windfall_core::scene::{self, Sun};

    use super::*;
    use crate::camera::Camera;
    use crate::frame::lens_moment::LensMoment;
    use crate::gpu::tile::tiles;

    const PATH: Path = Path { lead: Vec2::X, phase: 0.0 };

    #[test]
    fn a_mirror_shows_what_a_reflected_ray_meets() {
        let surroundings =
            Surroundings::new(&View::default(), Vec3::ZERO, PATH).expect("no picture of a sky");
        let camera = Camera::from(&scene::Camera::default());
        let input = FrameInput { camera, time_s: 0.0, moment: LensMoment::FIRST, origin: (0, 0) };
        let tile = tiles((640, 360), (640, 360)).next().expect("a tile");
        let frame = surroundings.frame(&input, 0.0, ((640, 360), 1024), &tile);
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
            let surroundings = Surroundings::new(&View { sun, ..View::default() }, Vec3::ZERO, PATH)
                .expect("no file is needed");
            let camera = Camera::from(&scene::Camera::default());
            let input = FrameInput { camera, time_s: 1.0, moment: LensMoment::FIRST, origin: (0, 0) };
            let tile = tiles((640, 480), (640, 480)).next().expect("a tile");
            let frame = surroundings.frame(&input, 1.0, ((640, 480), 1024), &tile);
            let all: &[f32] = bytemuck::cast_slice(std::slice::from_ref(&frame));
            assert!(all.iter().all(|value| value.is_finite()), "elevation {elevation_deg}: {frame:?}");
        }
    }
}
