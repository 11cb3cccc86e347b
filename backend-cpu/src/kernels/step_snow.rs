// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/step_snow.wgsl
//!
//! Lets snow slide and drift from cell to cell, or settle and melt, in the steps in which it does.

use rayon::join;
use windfall_core::Context;
use windfall_core::blocks::NEVER;
use windfall_core::device::terrain::snow::{SNOW_AGES, snow_drifts, snow_turn};
use windfall_core::litter::{Bed, SnowMut};

use crate::simd::snow_block::step_snow_lines;
use crate::simd::{Simd, in_packs};

/// Cells that a thread takes before it takes the next.
const RUN: usize = 1 << 14;

/// Takes all cells through a step.
pub(crate) fn step_snow(cx: &Context<'_>, bed: &mut Bed, simd: Simd) {
    let turn = snow_turn(cx.step.index);
    if turn == NEVER {
        return;
    }
    if turn == 0 {
        bed.clear_crowns(cx);
    }
    if turn == SNOW_AGES {
        bed.fall_through_crowns(cx);
    }
    let line = cx.scene.snow.columns as usize;
    // Pairs of lines begin with the first or the second; no pair is parted.
    let before = if turn < SNOW_AGES { line * (turn >> 2) as usize } else { 0 };
    let mut snow = bed.snow_mut(cx.scene);
    if snow_drifts(cx) {
        snow.exchange_around(cx, turn);
    }
    let before = before.min(snow.water.len());
    let (mut front, back) = snow.split_at(before);
    step_cells(cx, turn, &mut front, simd);
    step_pairs(cx, turn, 2 * line, back, simd);
}

/// Takes cells through it, in runs of whole pairs of lines.
fn step_pairs(cx: &Context<'_>, turn: u32, pair: usize, mut snow: SnowMut<'_>, simd: Simd) {
    if snow.water.len() <= RUN.max(pair) {
        step_cells(cx, turn, &mut snow, simd);
        return;
    }
    let middle = (snow.water.len() / 2).next_multiple_of(pair).min(snow.water.len() - 1) / pair * pair;
    let (front, back) = snow.split_at(middle.max(pair));
    join(|| step_pairs(cx, turn, pair, front, simd), || step_pairs(cx, turn, pair, back, simd));
}

fn step_cells(cx: &Context<'_>, turn: u32, snow: &mut SnowMut<'_>, simd: Simd) {
    match (simd, turn) {
        (Simd::Lanes(level), turn) => in_packs!(level, step_snow_lines(cx, turn, snow)),
        (Simd::Scalar, SNOW_AGES) => snow.age(cx),
        (Simd::Scalar, turn) => snow.exchange(cx, turn),
    }
}
