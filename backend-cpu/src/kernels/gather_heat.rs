// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/gather_heat.wgsl
//!
//! Adds the heat that burning leaves release to cells of the air and to the fires that they feed.

use rayon::prelude::*;
use windfall_core::Context;
use windfall_core::device::leaf::burn::{UNLIT, feeds_plume, leaf_heat_release};
use windfall_core::leaf::{Burns, Leaves};

use super::CHUNK;
use crate::heat_sums::HeatSums;

/// Adds the heat of all leaves.
pub(crate) fn gather_heat(cx: &Context<'_>, leaves: &Leaves, burns: &Burns, heat: &HeatSums) {
    let plumes = &cx.step.moments[0].plumes[..cx.step.plume_count as usize];
    burns.burn.par_chunks(CHUNK).enumerate().for_each(|(chunk, burns)| {
        let mut touched = Vec::new();
        for (slot, burn) in (chunk * CHUNK..).zip(burns).filter(|(_, burn)| burn.lit != UNLIT) {
            let place = leaves.place[slot].position.into();
            let own = leaf_heat_release(cx, place, leaves.place[slot].bits, leaves.schedule[slot].size, burn);
            if own.sums.count == 0 {
                continue;
            }
            if heat.cells.add(own.index, &own.sums) {
                touched.push(own.index);
            }
            for (number, _) in plumes.iter().enumerate().filter(|(_, plume)| feeds_plume(plume, place)) {
                heat.feed(number, own.sums.power);
            }
        }
        heat.cells.list(&touched);
    });
}
