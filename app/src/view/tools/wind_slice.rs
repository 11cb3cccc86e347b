// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The wind in a level slice, where the camera looks.

use glam::Vec3;
use windfall_core::arith::Vec3 as KernelVec3;
use windfall_core::device::wind::sample::wind_at;
use windfall_core::{Clock, CompiledScene};
use windfall_render::camera::Camera;

/// Arrows along an edge of the slice.
const EDGE: u16 = 17;
/// Distance of two arrows for each metre that the camera is away.
const APART: f32 = 0.1;

/// Places of arrows, and the wind there in m/s. Arrows stand on a grid that stays where it is while the camera moves;
/// the grid grows coarser with the distance.
pub(crate) fn wind_slice(
    compiled: &CompiledScene,
    clock: &Clock,
    camera: &Camera,
    height_m: f32,
) -> Vec<(Vec3, Vec3)> {
    let block = compiled.step_block(clock);
    let cx = compiled.context(&block);
    let apart = (APART * camera.distance_m).max(0.05).log2().round().exp2();
    let middle = |x: f32| (x / apart).round() * apart;
    let half = f32::from(EDGE - 1) / 2.0;
    let (x0, z0) = (middle(camera.target_m.x) - half * apart, middle(camera.target_m.z) - half * apart);
    let cells = (0..EDGE).flat_map(|row| (0..EDGE).map(move |column| (row, column)));
    cells
        .map(|(row, column)| {
            let (x, z) = (x0 + f32::from(column) * apart, z0 + f32::from(row) * apart);
            let place = Vec3::new(x, compiled.ground_height(x, z) + height_m, z);
            let wind = wind_at(&cx, KernelVec3::new(place.x, place.y, place.z));
            (place, Vec3::new(wind.x, wind.y, wind.z))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use windfall_core::scene::MeanSpeed;
    use windfall_core::{Scene, World};

    use super::*;

    #[test]
    fn arrows_show_the_wind_where_they_stand() {
        let mut scene = Scene::default();
        scene.wind.speed = MeanSpeed::MetresPerSecond(5.0);
        scene.wind.direction_deg = 90.0;
        scene.wind.gusts.strength = 0.0;
        scene.wind.turbulence.intensity = 0.0;
        scene.wind.turbulence.calm_m_s = 0.0;
        scene.wind.reference_height_m = 10.0;
        let world = World::build(&scene).expect("valid");
        let camera = Camera::from(&scene.view.camera);
        let slice = wind_slice(&world.compiled, &world.clock, &camera, 10.0);
        assert_eq!(slice.len(), usize::from(EDGE * EDGE), "a square of arrows");
        let ground = world.compiled.ground_height(0.0, 0.0);
        for (place, wind) in &slice {
            assert!((place.y - ground - 10.0).abs() < 1.0e-4, "at the height asked for: {place}");
            assert!((wind.z - 5.0).abs() < 0.05 && wind.x.abs() < 0.01, "5 m/s along z: {wind}");
        }
        let moved = Camera { target_m: camera.target_m + Vec3::new(0.001, 0.0, 0.0), ..camera };
        let again = wind_slice(&world.compiled, &world.clock, &moved, 10.0);
        assert_eq!(again[0].0, slice[0].0, "a small move of the camera moves no arrow");
    }
}
