// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reflections of an environment in rough surfaces.

use glam::Vec3;
use rayon::prelude::*;
use windfall_core::shared_constants;

use super::EnvironmentMap;

/// Rows of the first level; the others have half as many as the one before.
const ROWS: usize = 64;
shared_constants! {
    /// Roughness of the first level.
    pub(crate) const LEAST_ROUGHNESS: f32 = 0.1;
    /// Difference in roughness from one level to the next.
    pub(crate) const ROUGHNESS_STEP: f32 = 0.225;
}

/// Roughness of each level, as artists count it: the square root of the width of the microfacets' distribution.
pub(crate) const ROUGHNESS: [f32; 5] = [0.1, 0.325, 0.55, 0.775, 1.0];
/// Directions drawn for each pixel.
const DRAWS: u32 = 48;

/// Radiance mirrored by surfaces of rising roughness, seen head on: the GGX distribution of normals (Walter et al. 2007),
/// weighted by the cosine of the light as Karis (2013) proposed. Draws that stand for a wide cone read a small map
/// (Křivánek and Colbert 2008), so that few are enough.
pub(crate) fn prefiltered(map: &EnvironmentMap) -> Vec<EnvironmentMap> {
    let pyramid = pyramid(map);
    let levels = (0u32..).zip(ROUGHNESS);
    levels.map(|(level, roughness)| filtered(&pyramid, ROWS >> level, roughness)).collect()
}

/// The map and ever smaller ones, down to four rows.
fn pyramid(map: &EnvironmentMap) -> Vec<EnvironmentMap> {
    let mut levels = vec![map.clone()];
    loop {
        let last = &levels[levels.len() - 1];
        let rows = last.size().1.next_power_of_two() / 2;
        if rows < 4 {
            return levels;
        }
        levels.push(last.shrunk(rows));
    }
}

/// One level of one roughness.
fn filtered(pyramid: &[EnvironmentMap], rows: usize, roughness: f32) -> EnvironmentMap {
    let draws = draws(roughness);
    let source_rows = pyramid[0].size().1 as f32;
    // Solid angle of a pixel on the equator.
    let pixel = (std::f32::consts::PI / source_rows).powi(2);
    let blank = EnvironmentMap::from_fn(2 * rows, rows, |_| Vec3::ZERO);
    let pixels = (0..2 * rows * rows).into_par_iter().map(|index| {
        let normal = blank.direction(index);
        let (side, ahead) = normal.any_orthonormal_pair();
        let (mut sum, mut weights) = (Vec3::ZERO, 0.0);
        for &(toward, cone) in &draws {
            let direction = side * toward.x + ahead * toward.y + normal * toward.z;
            let level = (0.5 * (cone / pixel).log2()).max(0.0).round();
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small number")]
            let level = (level as usize).min(pyramid.len() - 1);
            sum += pyramid[level].sample(direction) * toward.z;
            weights += toward.z;
        }
        sum / weights
    });
    EnvironmentMap::new(2 * rows, rows, pixels.collect())
}

/// Directions that light comes from, about a normal along z, with the solid angles they stand for.
fn draws(roughness: f32) -> Vec<(Vec3, f32)> {
    let width = (roughness * roughness).powi(2);
    let draw = |index: u32| {
        let share = (index as f32 + 0.5) / DRAWS as f32;
        // The golden angle spreads them evenly.
        let (sin, cos) = (index as f32 * 2.399_963_2).sin_cos();
        let tilt_cos2 = (1.0 - share) / (1.0 + (width - 1.0) * share);
        let (tilt_cos, tilt_sin) = (tilt_cos2.sqrt(), (1.0 - tilt_cos2).max(0.0).sqrt());
        // Mirrored at the tilted facet.
        let toward = Vec3::new(
            2.0 * tilt_cos * tilt_sin * cos,
            2.0 * tilt_cos * tilt_sin * sin,
            2.0 * tilt_cos2 - 1.0,
        );
        let spread = tilt_cos2 * (width - 1.0) + 1.0;
        let density = width / (std::f32::consts::PI * spread * spread) / 4.0;
        (toward, 1.0 / (DRAWS as f32 * density))
    };
    (0..DRAWS).map(draw).filter(|(toward, _)| toward.z > 0.0).collect()
}
