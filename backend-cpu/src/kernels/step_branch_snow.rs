// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/step_branch_snow.wgsl
//!
//! Adds up the areas above each square, and lets branches take what has come down over them in a round, and lose what falls from them.

use windfall_core::Context;
use windfall_core::device::terrain::snow::{SNOW_AGES, snow_turn};
use windfall_core::device::tree::branch_snow::CROWN_TURN;
use windfall_core::litter::Bed;
use windfall_core::tree::Branches;

/// Takes the snow of all branches through a step: one after another, for there is something to do in two steps of a round.
pub(crate) fn step_branch_snow(cx: &Context<'_>, branches: &Branches, bed: &mut Bed) {
    match snow_turn(cx.step.index) {
        CROWN_TURN => bed.add_branches(cx),
        SNOW_AGES => bed.step_branch_snow(cx, branches),
        _ => {}
    }
}
