// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Sun and sky of a moment.

use std::f32::consts::{FRAC_PI_2, PI, TAU};

use glam::Vec3;
use rayon::prelude::*;
use windfall_core::scene::{PhysicalSky, Sky, SkyMap, Sun, View};

use super::Atmosphere;
use super::EnvironmentMap;
use super::MapError;
use super::clouds::{OVERCAST_ILLUMINANCE, cloud_share, overcast};
use super::picture_file::Picture;
use super::scattering::ClearAir;
use super::spectrum::{ToRgb, luminance};
use super::sun::{SunLight, sun_direction};
use super::sun_search::take_sun;

/// Width and height of a computed sky in pixels.
const SIZE: (usize, usize) = (256, 128);
/// Share of light that autumn meadows and woods throw back.
const GROUND_ALBEDO: Vec3 = Vec3::new(0.125, 0.115, 0.055);

/// Colour of an overcast sky, of luminance 1: about 6800 K (Lee and Hernández-Andrés 2005).
const OVERCAST_COLOR: Vec3 = Vec3::new(0.975, 1.0, 1.075);

/// All light that comes from above, and what the ground returns of it.
#[derive(Clone, Debug)]
pub struct Daylight {
    /// The sun.
    pub sun: SunLight,
    /// Everything else that lights.
    pub sky: EnvironmentMap,
    /// Visible sky behind sun and clouds.
    pub(crate) seen: EnvironmentMap,
    /// True if `seen` is a picture, which has a sun, clouds and a horizon of its own.
    pub(crate) is_picture: bool,
    /// Clouds to be drawn before the sky, 0 to 1.
    pub(crate) cloud_cover: f32,
    /// Radiance of the brightest and of the darkest clouds.
    pub(crate) clouds: [Vec3; 2],
}

impl Daylight {
    /// The light that a view asks for.
    ///
    /// # Errors
    /// A picture that cannot be used.
    pub fn new(view: &View) -> Result<Self, MapError> {
        match &view.sky {
            Sky::Physical(sky) => Ok(Self::physical(&view.sun, *sky)),
            Sky::Map(map) => Self::of_picture(map),
        }
    }

    /// Sun and sky that a picture shows.
    ///
    /// # Errors
    /// A file that cannot be used.
    pub(crate) fn of_picture(map: &SkyMap) -> Result<Self, MapError> {
        Ok(Self::of_pixels(map, Picture::read(&map.path)?))
    }

    /// The same of a picture whose bytes the caller has: of `map` the path is the name that errors give it.
    ///
    /// # Errors
    /// Bytes that cannot be used.
    pub fn of_picture_bytes(map: &SkyMap, bytes: &[u8]) -> Result<Self, MapError> {
        Ok(Self::of_pixels(map, Picture::from_bytes(&map.path, bytes)?))
    }

    fn of_pixels(map: &SkyMap, picture: Picture) -> Self {
        let whole = EnvironmentMap::of_picture(picture).turned(map.rotation_deg);
        let whole = whole.map(|_, radiance| radiance * map.intensity_kcd_m2);
        let (sun, sky) = take_sun(&whole);
        Self { sun, sky, seen: whole, is_picture: true, cloud_cover: 0.0, clouds: [Vec3::ZERO; 2] }
    }

    /// Sun and sky as the model has them.
    pub(crate) fn physical(sun: &Sun, sky: PhysicalSky) -> Self {
        let direction = sun_direction(sun);
        let elevation = f64::from(sun.elevation_deg).to_radians();
        let air = ClearAir::new(Atmosphere::new(sky.aerosol), elevation);
        let to_rgb = ToRgb::new();
        let beam = to_rgb.rgb(&air.sun()).max(Vec3::ZERO);
        let clear = clear_sky(&air, &to_rgb, direction);
        let level = Vec3::Y;
        let sky_light = clear.irradiance(level);
        let sun_light = beam * direction.y.max(0.0);
        let [all, from_sky] = [luminance(sky_light + sun_light), luminance(sky_light)];
        let share = cloud_share(sky.cloud_cover, (from_sky / all.max(1e-9)).min(1.0));
        let diffuse = share.global * share.diffuse * all;
        let direct = share.global * (1.0 - share.diffuse) * all;
        // Clouds have the colour of all light that falls on them, and a closed cover that of daylight at any hour.
        let tint =
            ((sky_light + sun_light) / all.max(1e-9)).lerp(OVERCAST_COLOR, sky.cloud_cover * sky.cloud_cover);
        let zenith = (diffuse - (1.0 - sky.cloud_cover) * from_sky).max(0.0) / OVERCAST_ILLUMINANCE;
        let above = clear.map(|towards, radiance| {
            radiance * (1.0 - sky.cloud_cover) + tint * (zenith * overcast(towards.y))
        });
        let illuminance = beam * (direct / luminance(sun_light).max(1e-9)).min(1.0);
        let ground = GROUND_ALBEDO / PI * (above.irradiance(level) + illuminance * direction.y.max(0.0));
        // Few clouds leave the sky between them clear.
        let veil = sky.cloud_cover * sky.cloud_cover;
        let gaps = clear.map(|towards, radiance| radiance.lerp(above.sample(towards), veil));
        let with_ground = |map: &EnvironmentMap| {
            map.map(|towards, radiance| if towards.y < 0.0 { ground } else { radiance })
        };
        let cover = sky.cloud_cover.max(0.05);
        Self {
            sun: SunLight { direction, illuminance },
            sky: with_ground(&above),
            seen: with_ground(&gaps),
            is_picture: false,
            cloud_cover: sky.cloud_cover,
            clouds: [tint * (zenith / cover), ground],
        }
    }
}

/// The upper half of the sky without clouds; the lower half is black. The sky is alike on both sides of the sun, so half of it is computed.
fn clear_sky(air: &ClearAir, to_rgb: &ToRgb, sun: Vec3) -> EnvironmentMap {
    let (width, height) = SIZE;
    let half = width / 2;
    let sun_azimuth = sun.z.atan2(sun.x);
    let rows: Vec<Vec<Vec3>> = (0..height / 2)
        .into_par_iter()
        .map(|row| {
            let elevation = f64::from(FRAC_PI_2 - PI * (row as f32 + 0.5) / height as f32);
            let away = |step: usize| std::f64::consts::PI * step as f64 / half as f64;
            // Some colours of the air lie outside of what a screen can show.
            (0..=half).map(|step| to_rgb.rgb(&air.radiance(elevation, away(step))).max(Vec3::ZERO)).collect()
        })
        .collect();
    EnvironmentMap::from_fn(width, height, |direction| {
        if direction.y <= 0.0 {
            return Vec3::ZERO;
        }
        let turned = (direction.z.atan2(direction.x) - sun_azimuth).rem_euclid(TAU);
        let away = turned.min(TAU - turned) / PI * half as f32;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a number of pixels")]
        let [row, left] = [(direction.y.acos() / PI * height as f32) as usize, (away as usize).min(half - 1)];
        rows[row.min(height / 2 - 1)][left].lerp(rows[row.min(height / 2 - 1)][left + 1], away - left as f32)
    })
}
