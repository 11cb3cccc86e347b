// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compiles a source, and the steps at which its slots are released.

use crate::blocks::{NEVER, SOURCE_BOX, SOURCE_DISC, SOURCE_SPHERE, SourceBlock};
use crate::convert::{low_word, steps};
use crate::scene::{MAX_SPECIES, Release, Scene, Source, SourceShape, Species};

pub(super) fn source_block(scene: &Scene, source: &Source) -> SourceBlock {
    let (center, extent, kind) = match source.shape {
        SourceShape::Box { center_m, half_extent_m } => (center_m, half_extent_m, SOURCE_BOX),
        SourceShape::Disc { center_m, radius_m } => {
            (center_m, glam::Vec3::new(radius_m, 0.0, radius_m), SOURCE_DISC)
        }
        SourceShape::Sphere { center_m, radius_m } => (center_m, glam::Vec3::splat(radius_m), SOURCE_SPHERE),
    };
    SourceBlock {
        center_units: center.to_array().map(length_units),
        kind,
        extent_units: extent.to_array().map(|metres| length_units(metres) as u32),
        lifetime_steps: lifetime_steps(scene, source),
        shares: bytemuck::cast(share_ends(scene, source)),
    }
}

/// The trees as a source: their leaves grow back after its lifetime.
pub(super) fn trees_block(scene: &Scene) -> SourceBlock {
    SourceBlock {
        lifetime_steps: scene.regrow_after_s.map_or(0, |s| steps(s, scene.dt_s)),
        ..bytemuck::Zeroable::zeroed()
    }
}

/// Steps from a release of a slot to the next; 0 for never.
pub(crate) fn lifetime_steps(scene: &Scene, source: &Source) -> u32 {
    source.recycle_after_s.map_or(0, |seconds| steps(seconds, scene.dt_s))
}

/// Step of the first release of the source's slot number `index`, possibly negative.
pub(crate) fn release_step(scene: &Scene, source: &Source, index: u32) -> i64 {
    let dt = f64::from(scene.dt_s);
    #[expect(clippy::cast_possible_truncation, reason = "validated to fit")]
    let whole = |seconds: f64| libm::floor(seconds / dt + 0.5) as i64;
    match source.release {
        Release::Burst { at_s } => whole(f64::from(at_s)),
        Release::Rate { per_s, from_s } => whole(f64::from(from_s) + f64::from(index) / f64::from(per_s)),
    }
}

/// Upper ends of the species' shares of the random words; a share that reaches the top is closed there.
fn share_ends(scene: &Scene, source: &Source) -> [u32; MAX_SPECIES] {
    let weight = |species: &Species| match source.species.is_empty() {
        true => 1,
        false => source
            .species
            .iter()
            .filter(|share| share.species == species.name)
            .map(|share| share.weight)
            .sum(),
    };
    let weights: Vec<u64> = scene.species.iter().map(|species| u64::from(weight(species))).collect();
    let total: u64 = weights.iter().sum();
    let mut ends = [NEVER; MAX_SPECIES];
    let mut until = 0;
    let last = weights.iter().rposition(|&weight| weight > 0).unwrap_or(0);
    for (index, weight) in weights.iter().enumerate().take(last) {
        until += weight;
        ends[index] = low_word(((until << 32) / total).min(u64::from(NEVER)).cast_signed());
    }
    ends
}

/// Lengths in 2^-10 m.
#[expect(clippy::cast_possible_truncation, reason = "validated to stay within 4096 m")]
fn length_units(metres: f32) -> i32 {
    libm::floor(f64::from(metres) * 1024.0 + 0.5) as i32
}
