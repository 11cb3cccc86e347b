// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Which parts of the view each shadow map covers, and where the sky's is.
//!
//! The view is cut into slices by distance. A map covers the smallest ball around its slice: it does not change its size when
//! the camera turns, and moves in whole texels, so that edges of shadows stand still (Valient 2008, "Stable Rendering of
//! Cascaded Shadow Maps", ShaderX6).

use glam::{Mat4, Vec3};
use windfall_core::shared_constants;

use crate::camera::Camera;
use crate::quality::Quality;

shared_constants! {
    /// Number of shadow maps of the sun. The map after them is seen from straight above, for the sky.
    pub(crate) const CASCADES: u32 = 3;
}

/// Number of all maps.
pub(crate) const MAPS: usize = CASCADES as usize + 1;
/// Edge of a shadow map in texels for a picture so many shaded pixels high: its texels are about as fine as the pixels.
pub(crate) fn shadow_size(shaded_height: u32, quality: Quality) -> u32 {
    match quality {
        Quality::Plain => 512,
        _ if shaded_height > 512 => 2048,
        _ => 1024,
    }
}

/// Far ends of the slices, in metres from the camera. Trees farther away only have the shade of their pictures.
const ENDS_M: [f32; CASCADES as usize] = [8.0, 26.0, 80.0];
/// A camera that looks at something near has its first slice end so much farther than that.
const BEYOND_TARGET: f32 = 1.6;
/// Least end of the first slice and largest end of the last, in metres.
const FIRST_END_M: f32 = 1.2;
const LAST_END_M: f32 = 200.0;
/// Largest distance beyond the ball, towards the sun, of things that still throw their shadow into it, in metres.
const TOWARD_SUN_M: f32 = 150.0;

/// A shadow map's place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cascade {
    /// World to the sun's clip space.
    pub(crate) projection: Mat4,
    /// Edge of a texel in metres.
    pub(crate) texel_m: f32,
}

/// Least and largest radius of the map from above in metres, and what it is per distance of what is looked at.
const ABOVE_RADII_M: [f32; 2] = [16.0, 100.0];
const ABOVE_PER_DISTANCE: f32 = 3.0;

/// The shadow maps of `size_px` for what `camera` sees, by the light from `sun`.
pub(crate) fn cascades(
    camera: &Camera,
    aspect: f32,
    sun: Vec3,
    size_px: u32,
) -> [Cascade; CASCADES as usize] {
    let near = (BEYOND_TARGET * camera.distance_m).clamp(FIRST_END_M, ENDS_M[0]);
    let ends = ENDS_M.map(|end| end * near / ENDS_M[0]);
    // The last one reaches beyond what is looked at.
    let last = (BEYOND_TARGET * camera.distance_m).clamp(ENDS_M[2], LAST_END_M);
    let ends = [ends[0], 0.5 * (ends[1] + ENDS_M[1]), last];
    let tangent = (0.5 * camera.vertical_fov_rad).tan();
    let slope = tangent * (1.0 + aspect * aspect).sqrt();
    std::array::from_fn(|index| {
        let start = if index == 0 { 0.0 } else { ends[index - 1] };
        let (along, radius) = ball(start, ends[index], slope);
        cascade(camera.eye_m() + camera.forward() * along, radius, sun, size_px)
    })
}

/// The map of `size_px` from above of what `camera` sees nearby: the sky's, as if all its light came from the zenith.
pub(crate) fn above(camera: &Camera, size_px: u32) -> Cascade {
    let [least, most] = ABOVE_RADII_M;
    let radius = (ABOVE_PER_DISTANCE * camera.distance_m).clamp(least, most);
    let ahead = Vec3::new(camera.forward().x, 0.0, camera.forward().z);
    cascade(camera.eye_m() + ahead * (0.7 * radius), radius, Vec3::Y, size_px)
}

/// Distance of the middle and radius of the smallest ball around a slice of a cone whose edge rises by `slope`.
fn ball(start: f32, end: f32, slope: f32) -> (f32, f32) {
    let middle = (0.5 * (start + end) * (1.0 + slope * slope)).min(end);
    let (far, wide) = (end - middle, end * slope);
    (middle, (far * far + wide * wide).sqrt())
}

/// The map of a ball.
fn cascade(center: Vec3, radius: f32, sun: Vec3, size_px: u32) -> Cascade {
    let [side, upward, toward] = sun_axes(sun);
    // A little room, so that moving by whole texels leaves nothing out.
    let radius = radius * (1.0 + 4.0 / size_px as f32);
    let texel_m = 2.0 * radius / size_px as f32;
    let snap = |axis: Vec3| (center.dot(axis) / texel_m).round() * texel_m;
    let (x, y, z) = (snap(side), snap(upward), center.dot(toward));
    let (scale, depth) = (1.0 / radius, 1.0 / (2.0 * radius + TOWARD_SUN_M));
    // Depth 0 lies towards the sun, 1 behind the ball.
    let projection = Mat4::from_cols_array_2d(&[
        [side.x * scale, upward.x * scale, -toward.x * depth, 0.0],
        [side.y * scale, upward.y * scale, -toward.y * depth, 0.0],
        [side.z * scale, upward.z * scale, -toward.z * depth, 0.0],
        [-x * scale, -y * scale, (z + radius + TOWARD_SUN_M) * depth, 1.0],
    ]);
    Cascade { projection, texel_m }
}

/// Unit vectors to the right and up as the sun sees the park, and towards the sun.
fn sun_axes(toward: Vec3) -> [Vec3; 3] {
    let side = toward.cross(if toward.y.abs() > 0.99 { Vec3::Z } else { Vec3::Y }).normalize();
    [side, side.cross(toward), toward]
}

#[cfg(test)]
mod tests {
    use windfall_core::scene;

    use super::*;

    const SIZE_PX: u32 = 2048;

    fn cameras() -> Vec<Camera> {
        let look = |eye: [f32; 3], target: [f32; 3], vertical_fov_deg| {
            Camera::from(&scene::Camera { eye_m: eye.into(), target_m: target.into(), vertical_fov_deg })
        };
        vec![
            look([0.0, 1.6, 9.0], [0.0, 2.6, 0.0], 50.0),
            look([40.0, 30.0, -9.0], [0.0, 0.0, 0.0], 90.0),
            look([1.0, 0.2, 0.3], [1.1, 0.25, 0.0], 12.0),
        ]
    }

    fn suns() -> [Vec3; 4] {
        [Vec3::Y, Vec3::new(1.0, 0.05, 0.0), Vec3::new(-0.3, 0.6, 0.7), Vec3::new(0.0, 0.2, -1.0)]
            .map(Vec3::normalize)
    }

    #[test]
    fn every_place_in_sight_lies_in_a_map() {
        let aspect = 16.0 / 9.0;
        for (camera, sun) in cameras().iter().flat_map(|camera| suns().map(|sun| (camera, sun))) {
            let maps = cascades(camera, aspect, sun, SIZE_PX);
            let tangent = (0.5 * camera.vertical_fov_rad).tan();
            for step in 1..=160u16 {
                let depth = 0.5 * f32::from(step);
                for (x, y) in [(0.0, 0.0), (1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)] {
                    let aside = camera.right() * (x * aspect) + camera.up() * y;
                    let place = camera.eye_m() + depth * (camera.forward() + tangent * aside);
                    let is_inside = maps.iter().any(|map| {
                        let clip = map.projection.project_point3(place);
                        clip.x.abs().max(clip.y.abs()) <= 1.0 && (0.0..=1.0).contains(&clip.z)
                    });
                    assert!(is_inside, "{place} at {depth} m, sun {sun}");
                }
            }
            assert!(
                maps.windows(2).all(|pair| pair[0].texel_m < pair[1].texel_m),
                "near maps are finer: {maps:?}"
            );
        }
    }

    #[test]
    fn the_map_from_above_has_the_ground_below_the_crowns() {
        for camera in cameras() {
            let map = above(&camera, SIZE_PX);
            let near = camera.eye_m() + camera.forward() * 3.0;
            let [ground, crown] = [0.0, 12.0].map(|y| map.projection.project_point3(near.with_y(y)));
            assert!((ground - crown).truncate().length() < 1e-4, "one above the other: {ground} {crown}");
            assert!(ground.truncate().abs().max_element() < 1.0, "what is near is in it: {ground}");
            assert!(0.0 < crown.z && crown.z < ground.z && ground.z < 1.0, "{crown} above {ground}");
        }
    }

    #[test]
    fn a_ray_of_the_sun_is_one_point_and_goes_deeper() {
        let camera = &cameras()[0];
        for sun in suns() {
            for map in cascades(camera, 1.5, sun, SIZE_PX) {
                let ground = Vec3::new(0.5, 0.0, 1.0);
                let leaf = ground + 3.0 * sun;
                let [low, high] = [ground, leaf].map(|place| map.projection.project_point3(place));
                assert!((low - high).truncate().length() < 1e-4, "one point: {low} {high}");
                assert!(high.z < low.z, "the leaf is nearer to the sun: {low} {high}");
            }
        }
    }

    #[test]
    fn texels_stay_where_they_are_when_the_camera_moves_and_turns() {
        let view = |shift: f32| {
            let eye_m = Vec3::new(shift, 1.6 + 0.3 * shift, 9.0);
            let target_m = eye_m + Vec3::new(0.4 * shift, 0.1, -8.0).normalize() * 9.0;
            cascades(
                &Camera::from(&scene::Camera { eye_m, target_m, vertical_fov_deg: 50.0 }),
                1.5,
                suns()[2],
                SIZE_PX,
            )
        };
        let in_texels =
            |map: &Cascade| map.projection.project_point3(Vec3::ZERO).truncate() * 0.5 * SIZE_PX as f32;
        for (map, moved) in view(0.0).iter().zip(&view(0.0137)) {
            assert!((map.texel_m / moved.texel_m - 1.0).abs() < 1e-5, "maps keep their size");
            let off = in_texels(map) - in_texels(moved);
            assert!((off - off.round()).length() < 0.05, "moved by {off} texels");
        }
    }
}
