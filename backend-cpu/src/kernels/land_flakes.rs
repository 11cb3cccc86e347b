// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/land_flakes.wgsl
//!
//! Gives the water of the flakes that landed in a step to the snow, and that of what fell from branches.

use std::sync::{Mutex, PoisonError};

use windfall_core::Context;
use windfall_core::litter::{Bed, fallen_snow};
use windfall_core::particle::ParticleStore;

/// Places of the flakes that land in one step, in the order in which threads come upon them: sums over them have none.
#[derive(Debug, Default)]
pub(crate) struct Landings(Mutex<Vec<[f32; 3]>>);

impl Landings {
    /// Adds places, and empties their list.
    pub(crate) fn append(&self, places: &mut Vec<[f32; 3]>) {
        if !places.is_empty() {
            self.0.lock().unwrap_or_else(PoisonError::into_inner).append(places);
        }
    }
}

/// Lets them land, one after another, as few do in a step.
pub(crate) fn land_flakes(cx: &Context<'_>, landings: &Landings, particles: &ParticleStore, bed: &mut Bed) {
    let mut list = landings.0.lock().unwrap_or_else(PoisonError::into_inner);
    for [x_m, _, z_m] in list.drain(..) {
        bed.land_flake(cx, x_m, z_m);
    }
    for (row, [x_m, _, z_m]) in fallen_snow(cx.scene, particles) {
        bed.land_fall(cx, row, x_m, z_m);
    }
}
