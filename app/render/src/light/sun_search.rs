// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Finds the sun in a map, so that it can cast shadows.

use glam::Vec3;

use super::EnvironmentMap;
use super::spectrum::luminance;
use super::sun::SunLight;

/// Cosines of the angles around the brightest pixel within which everything is the sun's (4 degrees), and between which the
/// sky behind it is measured (6 and 10 degrees).
const SUN_COS: f32 = 0.997_564;
const RING_COS: [f32; 2] = [0.994_522, 0.984_808];
/// Least share of all light on a surface facing it that makes a bright spot a sun.
const DOMINANT: f32 = 0.12;

/// The sun of a map and the map without it. What exceeds the sky around the brightest spot is the sun; the spot is
/// filled with that sky. Without a dominant sun above the horizon the map stays whole and the sun is black.
pub(super) fn take_sun(map: &EnvironmentMap) -> (SunLight, EnvironmentMap) {
    let brightest = map.parts().max_by(|a, b| luminance(a.1).total_cmp(&luminance(b.1)));
    let Some((peak, ..)) = brightest else { return (black(Vec3::Y), map.clone()) };
    let (mut around, mut angles) = (Vec3::ZERO, 0.0);
    for (direction, radiance, angle) in map.parts() {
        if (RING_COS[1]..RING_COS[0]).contains(&direction.dot(peak)) {
            around += radiance * angle;
            angles += angle;
        }
    }
    let sky = around / f32::max(angles, f32::MIN_POSITIVE);
    let (mut illuminance, mut middle) = (Vec3::ZERO, Vec3::ZERO);
    for (direction, radiance, angle) in map.parts() {
        if direction.dot(peak) > SUN_COS {
            let excess = (radiance - sky).max(Vec3::ZERO) * angle;
            illuminance += excess;
            middle += direction * luminance(excess);
        }
    }
    // In double precision: the square of a faint sum would be no number of single precision.
    let direction = middle.as_dvec3().normalize_or(peak.as_dvec3()).as_vec3();
    let all = luminance(map.irradiance(direction));
    if direction.y < 0.02 || luminance(illuminance) < DOMINANT * all {
        return (black(peak), map.clone());
    }
    let without =
        map.map(|towards, radiance| if towards.dot(peak) > SUN_COS { radiance.min(sky) } else { radiance });
    (SunLight { direction, illuminance }, without)
}

fn black(toward: Vec3) -> SunLight {
    // Shadows and the sides of trees still need a direction, and from above.
    SunLight { direction: toward.with_y(toward.y.abs().max(0.5)).normalize(), illuminance: Vec3::ZERO }
}
