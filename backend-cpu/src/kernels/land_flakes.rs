// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/land_flakes.wgsl
//!
//! Gives the water of the flakes that landed in a step to the snow, and that of what fell from branches.

use std::sync::{Mutex, PoisonError};

use rayon::{current_num_threads, join};
use windfall_core::Context;
use windfall_core::litter::{Bed, SnowMut, fallen_snow};
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

/// Landings up to which threads are not worth waking.
const FEW: usize = 64;

/// Lets them land, and what fell from branches, one after another, as few segments lose snow in a step.
pub(crate) fn land_flakes(cx: &Context<'_>, landings: &Landings, particles: &ParticleStore, bed: &mut Bed) {
    let mut list = landings.0.lock().unwrap_or_else(PoisonError::into_inner);
    list.retain(|&[x_m, _, z_m]| !bed.catch_flake(cx, x_m, z_m));
    let pieces = if list.len() > FEW { current_num_threads() } else { 1 };
    land_on(cx, bed.snow_mut(cx.scene), &list, pieces);
    list.clear();
    for (row, [x_m, _, z_m]) in fallen_snow(cx.scene, particles) {
        bed.land_fall(cx, row, x_m, z_m);
    }
}

/// Lets all flakes land of which cells have a share, in pieces of about as many cells: each sees to its own part of every flake.
fn land_on(cx: &Context<'_>, mut snow: SnowMut<'_>, places: &[[f32; 3]], pieces: usize) {
    if pieces > 1 {
        let middle = snow.water.len() / 2;
        let (front, back) = snow.split_at(middle);
        join(|| land_on(cx, front, places, pieces / 2), || land_on(cx, back, places, pieces.div_ceil(2)));
        return;
    }
    for &[x_m, _, z_m] in places {
        snow.land(cx, x_m, z_m, cx.scene.snow.flake_water);
    }
}
