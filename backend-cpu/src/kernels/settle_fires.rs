// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/settle_fires.wgsl
//!
//! Lets the fires follow the leaves that feed them, and clears all sums of heat.

use windfall_core::blocks::SceneBlock;
use windfall_core::device::leaf::burn::fire_words;
use windfall_core::litter::Bed;

use crate::heat_sums::HeatSums;

/// Lets them follow.
pub(crate) fn settle_fires(scene: &SceneBlock, bed: &mut Bed, heat: &HeatSums) {
    for (fire, fed) in bed.fires_mut(scene).iter_mut().zip(heat.take()) {
        *fire = fire_words(fire[0], fed);
    }
}
