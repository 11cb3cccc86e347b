// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Radiance of clear air: single scattering along the ray, and all further orders by the isotropic closure of Hillaire
//! (2020), "A Scalable and Production Ready Sky and Atmosphere Rendering Technique".

use std::f64::consts::PI;

use super::atmosphere::{
    Atmosphere, Columns, EARTH_KM, TOP_KM, aerosol_phase, densities, rayleigh_phase, transmitted,
};
use super::column_table::ColumnTable;
use super::spectrum::{BANDS, SUN, Spectrum};
use super::table::{cell, single};

/// Steps along a ray that is seen.
const STEPS: u32 = 28;
/// Steps along a ray that only lights others.
const COARSE_STEPS: u32 = 12;
/// Heights and suns for which multiple scattering is tabulated.
const HEIGHTS: usize = 12;
const SUNS: usize = 9;
/// Largest angle between the sun of a place in sight and the sun here, in radians.
const SUN_RANGE: f64 = 0.17;
/// Share of light that the land throws back into the air.
const LAND_ALBEDO: f32 = 0.12;
/// Height of the eye in km.
const EYE_KM: f64 = 0.002;

/// Clear air under one sun.
#[derive(Debug)]
pub(super) struct ClearAir {
    atmosphere: Atmosphere,
    columns: ColumnTable,
    /// Zenith angle of the sun in radians.
    sun_zenith: f64,
    /// Light scattered more than once, per unit of scattering, for heights and suns.
    multiple: Vec<Spectrum>,
}

impl ClearAir {
    pub(super) fn new(atmosphere: Atmosphere, sun_elevation: f64) -> Self {
        let sun_zenith = 0.5 * PI - sun_elevation;
        let mut air = Self { atmosphere, columns: ColumnTable::new(), sun_zenith, multiple: Vec::new() };
        air.multiple = (0..HEIGHTS * SUNS)
            .map(|index| {
                let zenith = sun_zenith + SUN_RANGE * (2.0 * (index % SUNS) as f64 / (SUNS - 1) as f64 - 1.0);
                air.scattered_often(height_of(index / SUNS), zenith.cos())
            })
            .collect();
        air
    }

    /// Sunlight that arrives on the ground, on a surface that faces the sun.
    pub(super) fn sun(&self) -> Spectrum {
        self.sunlight(EARTH_KM + EYE_KM, self.sun_zenith.cos())
    }

    /// Radiance seen from the ground at an elevation, and at an azimuth from the sun's, in radians.
    pub(super) fn radiance(&self, elevation: f64, azimuth: f64) -> Spectrum {
        let ray = [elevation.cos() * azimuth.cos(), elevation.sin(), elevation.cos() * azimuth.sin()];
        let sun = [self.sun_zenith.sin(), self.sun_zenith.cos(), 0.0];
        let cos = dot(ray, sun);
        let phases = [rayleigh_phase(cos), aerosol_phase(cos)];
        self.march(EARTH_KM + EYE_KM, ray, sun, phases, STEPS, true).light
    }

    /// Sunlight at a radius for a zenith cosine of the sun there.
    fn sunlight(&self, radius: f64, cos: f64) -> Spectrum {
        let (columns, visible) = self.columns.toward_sun(radius, cos);
        if visible <= 0.0 {
            return [0.0; BANDS];
        }
        let passed = transmitted(&self.atmosphere.depth(columns));
        std::array::from_fn(|band| SUN[band] * passed[band] * visible)
    }

    /// Adds up what a ray meets until it leaves the air or hits the ground.
    fn march(
        &self,
        radius: f64,
        ray: [f64; 3],
        sun: [f64; 3],
        phases: [f32; 2],
        steps: u32,
        all: bool,
    ) -> Ray {
        let from = [0.0, radius, 0.0];
        let cos = ray[1];
        let to_ground = radius * radius * (cos * cos - 1.0) + EARTH_KM * EARTH_KM;
        let hits = cos < 0.0 && to_ground >= 0.0;
        let length = if hits {
            -radius * cos - to_ground.sqrt()
        } else {
            (radius * radius * (cos * cos - 1.0) + TOP_KM * TOP_KM).sqrt() - radius * cos
        };
        let mut passed = [1.0; BANDS];
        let mut out = Ray { light: [0.0; BANDS], scattered: [0.0; BANDS] };
        for step in 0..steps {
            let [near, far] =
                [step, step + 1].map(|edge| (f64::from(edge) / f64::from(steps)).powi(2) * length);
            let at = 0.5 * (near + far);
            let place = std::array::from_fn(|axis| from[axis] + ray[axis] * at);
            let here = dot(place, place).sqrt();
            let density = densities((here - EARTH_KM).max(0.0));
            let extinction = self.atmosphere.depth(density);
            let kept = transmitted(&extinction.map(|value| value * single(far - near)));
            let [molecules, aerosol] = self.atmosphere.scattering(density);
            let sun_cos = dot(place, sun) / here;
            let sunlight = self.sunlight(here, sun_cos);
            let often = if all { self.often(here - EARTH_KM, sun_cos) } else { [0.0; BANDS] };
            for band in 0..BANDS {
                let once = sunlight[band] * (molecules[band] * phases[0] + aerosol[band] * phases[1]);
                let scattering = molecules[band] + aerosol[band];
                // Light and extinction are taken to be constant along a step, which may be long.
                let share = passed[band] * (1.0 - kept[band]) / extinction[band].max(1e-12);
                out.light[band] += share * (once + scattering * often[band]);
                out.scattered[band] += share * scattering;
                passed[band] *= kept[band];
            }
        }
        if hits {
            let place: [f64; 3] = std::array::from_fn(|axis| from[axis] + ray[axis] * length);
            let sun_cos = dot(place, sun) / dot(place, place).sqrt();
            let sunlight = self.sunlight(EARTH_KM, sun_cos);
            for band in 0..BANDS {
                let ground = LAND_ALBEDO / std::f32::consts::PI * sunlight[band] * single(sun_cos.max(0.0));
                out.light[band] += passed[band] * ground;
            }
        }
        out
    }

    /// Light of all orders beyond the first that arrives at a height from everywhere, per unit of scattering: the second
    /// order summed over a sphere of directions, and a geometric series for the rest (Hillaire 2020, equations 5 to 10).
    fn scattered_often(&self, height_km: f64, sun_cos: f64) -> Spectrum {
        const RINGS: u32 = 12;
        const SPOKES: u32 = 4;
        let isotropic = [1.0 / (4.0 * std::f32::consts::PI); 2];
        let sun = [(1.0 - sun_cos * sun_cos).max(0.0).sqrt(), sun_cos, 0.0];
        let (mut light, mut scattered) = ([0.0f32; BANDS], [0.0f32; BANDS]);
        for ring in 0..RINGS {
            let cos = 1.0 - 2.0 * (f64::from(ring) + 0.5) / f64::from(RINGS);
            let sin = (1.0 - cos * cos).sqrt();
            for spoke in 0..SPOKES {
                // Left and right of the sun are alike.
                let (s, c) = (PI * (f64::from(spoke) + 0.5) / f64::from(SPOKES)).sin_cos();
                let ray = [sin * c, cos, sin * s];
                let found = self.march(EARTH_KM + height_km, ray, sun, isotropic, COARSE_STEPS, false);
                let share = 1.0 / (RINGS * SPOKES) as f32;
                for band in 0..BANDS {
                    light[band] += share * found.light[band];
                    scattered[band] += share * found.scattered[band];
                }
            }
        }
        std::array::from_fn(|band| light[band] / (1.0 - scattered[band]).max(0.05))
    }

    /// Interpolates the table of multiple scattering.
    fn often(&self, height_km: f64, sun_cos: f64) -> Spectrum {
        let y = (height_km.max(0.0) / height_of(HEIGHTS - 1)).sqrt() * (HEIGHTS - 1) as f64;
        let zenith = sun_cos.clamp(-1.0, 1.0).acos();
        let x = ((zenith - self.sun_zenith) / SUN_RANGE * 0.5 + 0.5) * (SUNS - 1) as f64;
        let ((column, fx), (row, fy)) = (cell(x, SUNS), cell(y, HEIGHTS));
        let (fx, fy) = (single(fx), single(fy));
        let at = row * SUNS + column;
        let rows = [at, at + 1, at + SUNS, at + SUNS + 1].map(|index| &self.multiple[index]);
        std::array::from_fn(|band| {
            let [a, b, c, d] = rows.map(|row| row[band]);
            (a * (1.0 - fx) + b * fx) * (1.0 - fy) + (c * (1.0 - fx) + d * fx) * fy
        })
    }
}

/// Light collected along a ray, and the share of it that was scattered.
#[derive(Debug)]
struct Ray {
    light: Spectrum,
    /// Share of the ray that was scattered on its way, for light of one from everywhere.
    scattered: Spectrum,
}

/// Heights of the table in km, denser near the ground.
fn height_of(row: usize) -> f64 {
    60.0 * (row as f64 / (HEIGHTS - 1) as f64).powi(2)
}

fn dot(a: Columns, b: Columns) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
