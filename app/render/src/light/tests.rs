// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Light against what is known of it.

use std::f32::consts::PI;

use glam::Vec3;
use windfall_core::scene::{PhysicalSky, Sun};

use super::Daylight;
use super::EnvironmentMap;
use super::SphericalHarmonics;
use super::luminance;

fn day(elevation_deg: f32, cloud_cover: f32) -> Daylight {
    let sky = PhysicalSky { cloud_cover, ..PhysicalSky::default() };
    Daylight::physical(&Sun { azimuth_deg: 0.0, elevation_deg }, sky)
}

/// Illuminance of level ground in klx.
fn level(day: &Daylight) -> f32 {
    let sun = luminance(day.sun.illuminance) * day.sun.direction.y.max(0.0);
    sun + luminance(day.sky.irradiance(Vec3::Y))
}

/// Directions all around.
fn normals() -> impl Iterator<Item = Vec3> {
    (0..200u16).map(|index| {
        let y = 1.0 - f32::from(index) / 99.5;
        let (sin, cos) = (2.4 * f32::from(index)).sin_cos();
        Vec3::new(cos * (1.0 - y * y).max(0.0).sqrt(), y, sin * (1.0 - y * y).max(0.0).sqrt())
    })
}

#[test]
fn a_constant_map_lights_every_normal_with_pi_times_its_radiance() {
    let radiance = Vec3::new(0.2, 3.0, 40.0);
    let map = EnvironmentMap::from_fn(256, 128, |_| radiance);
    let harmonics = SphericalHarmonics::of(&map);
    for normal in normals() {
        let error = (harmonics.irradiance(normal) / (PI * radiance) - 1.0).abs().max_element();
        assert!(error < 1e-3, "off by {error} towards {normal}");
        let error = (map.irradiance(normal) / (PI * radiance) - 1.0).abs().max_element();
        assert!(error < 2e-3, "the sum over pixels is off by {error} towards {normal}");
    }
}

#[test]
fn harmonics_of_a_cosine_lobe_are_those_of_the_closed_form() {
    // Radiance max(0, cos) has the zonal coefficients sqrt(pi)/2, sqrt(pi/3), sqrt(5 pi)/8 (Ramamoorthi and Hanrahan 2001);
    // the irradiance is the sum of their products with pi, 2 pi/3, pi/4 and the functions.
    let axis = Vec3::new(0.48, 0.6, -0.64);
    let map = EnvironmentMap::from_fn(256, 128, |towards| Vec3::splat(towards.dot(axis).max(0.0)));
    let harmonics = SphericalHarmonics::of(&map);
    for normal in normals() {
        let cos = normal.dot(axis);
        let expected = PI / 4.0 + PI / 3.0 * cos + 5.0 * PI / 128.0 * (3.0 * cos * cos - 1.0);
        let found = harmonics.irradiance(normal).x;
        assert!((found - expected).abs() < 3e-3, "{found}, not {expected}, at {cos}");
    }
}

#[test]
fn sunlight_is_as_strong_as_measured() {
    // Clear sky at sea level: about 100 klx from a high sun, of which the beam is 80 to 90 % (IES Lighting Handbook,
    // 9th edition, figures 8-3 to 8-5); 10 degrees leave about 8 klx on level ground.
    let noon = level(&day(90.0, 0.0));
    assert!((90.0..130.0).contains(&noon), "{noon} klx at the zenith");
    let high = level(&day(60.0, 0.0));
    assert!((80.0..115.0).contains(&high), "{high} klx at 60 degrees");
    let low = level(&day(10.0, 0.0));
    assert!((6.0..16.0).contains(&low), "{low} klx at 10 degrees");
    // 0.4 klx at sunset, 3.4 lx at the end of civil twilight (Seidelmann 1992, Explanatory Supplement).
    let sunset = level(&day(-0.8, 0.0));
    assert!((0.2..1.0).contains(&sunset), "{sunset} klx at sunset");
    let dusk = level(&day(-6.0, 0.0));
    assert!((0.001..0.02).contains(&dusk), "{dusk} klx at dusk");
}

#[test]
fn light_fades_as_the_sun_goes_down() {
    let levels: Vec<f32> = [90.0, 70.0, 50.0, 30.0, 15.0, 8.0, 4.0, 2.0, 0.0, -2.0, -4.0, -6.0]
        .map(|elevation| level(&day(elevation, 0.0)))
        .into();
    assert!(levels.windows(2).all(|pair| pair[1] < pair[0]), "{levels:?}");
}

#[test]
fn the_zenith_is_blue_and_the_low_sun_red() {
    let zenith = day(40.0, 0.0).sky.sample(Vec3::Y);
    assert!(zenith.z > 2.0 * zenith.x && zenith.z > 1.5 * zenith.y, "{zenith}");
    // 2 to 5 kcd/m² at 40 degrees in clear air (CIE S 011, type 12).
    assert!((1.0..5.0).contains(&luminance(zenith)), "{zenith}");
    let sun = day(3.0, 0.0).sun.illuminance;
    assert!(sun.x > 2.0 * sun.y && sun.y > 3.0 * sun.z, "{sun}");
    let low = day(3.0, 0.0).sky;
    let [toward, away] = [1.0, -1.0].map(|x| low.sample(Vec3::new(x, 0.03, 0.0).normalize()));
    assert!(toward.x > 1.5 * toward.z, "the horizon glows below the sun: {toward}");
    assert!(luminance(toward) > 3.0 * luminance(away), "{toward} and {away}");
}

#[test]
fn clouds_dim_the_day_as_measured() {
    for elevation in [10.0, 30.0, 60.0] {
        let clear = level(&day(elevation, 0.0));
        for cover in [0.25f32, 0.5, 0.75, 1.0] {
            let found = level(&day(elevation, cover)) / clear;
            let expected = 1.0 - 0.75 * cover.powf(3.4);
            assert!((found / expected - 1.0).abs() < 0.02, "{found}, not {expected}, under {cover}");
        }
        let overcast = day(elevation, 1.0);
        assert!(luminance(overcast.sun.illuminance) < 1e-4 * clear, "no sun comes through");
        let [zenith, low] = [Vec3::Y, Vec3::new(0.0, 0.01, 1.0)].map(|to| luminance(overcast.sky.sample(to)));
        assert!((zenith / low - 3.0).abs() < 0.15, "the zenith of an overcast sky is three times as bright");
    }
}

#[test]
fn light_is_finite_and_not_negative_for_every_sun_and_air() {
    for elevation_deg in [-6.0, -1.0, 0.0, 0.3, 89.9, 90.0] {
        for (aerosol, cloud_cover) in [(0.0, 0.0), (1.0, 0.0), (0.1, 1.0)] {
            let sun = Sun { azimuth_deg: 123.0, elevation_deg };
            let day = Daylight::physical(&sun, PhysicalSky { aerosol, cloud_cover });
            let all = day.sky.pixels().iter().chain(&day.clouds).chain([&day.sun.illuminance]);
            let is_light = |color: &Vec3| color.is_finite() && color.min_element() >= 0.0;
            assert!(all.clone().all(is_light), "{elevation_deg} {aerosol} {cloud_cover}");
        }
    }
}
