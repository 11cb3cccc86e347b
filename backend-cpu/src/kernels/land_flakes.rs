// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/land_flakes.wgsl
//!
//! Gives the water of the flakes that landed in a step to the snow, and that of what fell from branches.

use rayon::prelude::*;
use windfall_core::Context;
use windfall_core::litter::{Bed, fallen_snow, flakes_of, has_landed};
use windfall_core::particle::ParticleStore;

use super::CHUNK;

/// Lets them land. Few do in a step: their places are listed side by side, and added one after another.
pub(crate) fn land_flakes(cx: &Context<'_>, particles: &ParticleStore, bed: &mut Bed) {
    let places: Vec<[f32; 3]> = flakes_of(cx.scene, particles)
        .par_chunks(CHUNK)
        .flat_map_iter(|flakes| flakes.iter().filter(|place| has_landed(place)).map(|place| place.position))
        .collect();
    for [x_m, _, z_m] in places {
        bed.land_flake(cx, x_m, z_m);
    }
    for (row, [x_m, _, z_m]) in fallen_snow(cx.scene, particles) {
        bed.land_fall(cx, row, x_m, z_m);
    }
}
