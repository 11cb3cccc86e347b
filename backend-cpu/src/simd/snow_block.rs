// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Snow of many cells side by side in SIMD registers: it settles and melts so, and cells between which nothing slides are passed over.

use bytemuck::{cast_slice, cast_slice_mut};
use windfall_core::Context;
use windfall_core::arith::lane::{Mask, Word};
use windfall_core::arith::pack::Pack;
use windfall_core::device::terrain::snow::{
    OLD_SLOPE, SNOW_AGES, SNOW_CELLS_PER_M, SNOW_DEPTH_M, snow_age, snow_drifts, snow_floor,
};
use windfall_core::litter::SnowMut;

/// Cells that are passed over together.
const RUN: usize = 64;
/// Rise in m from a cell to the next up to which no snow slides, however loose; a little less, for rounding.
const CALM_RISE_M: f32 = 0.999 * OLD_SLOPE / SNOW_CELLS_PER_M;
/// Most lanes of a register.
const MOST_LANES: usize = 16;

/// Takes whole lines of cells through a turn.
#[inline(always)]
pub(crate) fn step_snow_lines<P: Pack>(simd: P::Simd, cx: &Context<'_>, turn: u32, snow: &mut SnowMut<'_>) {
    if turn == SNOW_AGES {
        age::<P>(simd, cx, snow);
    } else if snow_drifts(cx) {
        snow.exchange(cx, turn);
    } else {
        slide(cx, turn, snow);
    }
}

/// Lets snow settle and melt.
#[inline(always)]
fn age<P: Pack>(simd: P::Simd, cx: &Context<'_>, snow: &mut SnowMut<'_>) {
    let whole = snow.water.len() / P::LANES * P::LANES;
    let floors = floors(cx, snow.first, snow.water.len());
    for at in (0..whole).step_by(P::LANES) {
        let lanes = at..at + P::LANES;
        let water = P::load_words(simd, &snow.water[lanes.clone()]);
        let is_there = !water.equals(0);
        if !is_there.any() {
            continue;
        }
        let depth = P::load_words(simd, &snow.depth[lanes.clone()]);
        let (mut numbers, mut opens) = ([0_u32; MOST_LANES], [0.0_f32; MOST_LANES]);
        let own = numbers.iter_mut().zip(&mut opens).zip(&floors[lanes.clone()]);
        for (number, ((own, open), [height, word])) in (snow.first..).skip(at).zip(own) {
            (*own, *open) = (number, snow_floor(*height, *word).open);
        }
        let number = P::load_words(simd, &numbers[..P::LANES]);
        let open = P::load(simd, &opens[..P::LANES]);
        let [left, kept] = snow_age(cx, number, water, depth, open);
        let (left, kept) = (is_there.select(left, water), is_there.select(kept, depth));
        if left.less_than(water).any() {
            let mut before = [0_u32; MOST_LANES];
            before[..P::LANES].copy_from_slice(&snow.water[lanes.clone()]);
            P::from_bits(left).store(cast_slice_mut(&mut snow.water[lanes.clone()]));
            let after = snow.water[lanes.clone()].iter().zip(&before);
            for (melted, (after, before)) in snow.melted[lanes.clone()].iter_mut().zip(after) {
                *melted = melted.wrapping_add(before - after);
            }
        }
        P::from_bits(kept).store(cast_slice_mut(&mut snow.depth[lanes]));
    }
    snow.rest(whole).age(cx);
}

/// Lets snow slide between the cells of pairs, where it may.
#[inline(always)]
fn slide(cx: &Context<'_>, turn: u32, snow: &mut SnowMut<'_>) {
    let columns = cx.scene.snow.columns as usize;
    let floors = floors(cx, snow.first, snow.water.len());
    let (kind, odd) = (turn as usize & 3, (turn >> 2) as usize);
    let first_line = snow.first as usize / columns;
    for line in 0..snow.water.len() / columns {
        let begin = line * columns;
        // From a cell to that with which it makes a pair; there may be none at the end of a line.
        let apart = if kind == 0 { 1 } else { columns + kind - 2 };
        if kind != 0 && ((first_line + line) % 2 != odd || begin + columns >= snow.water.len()) {
            continue;
        }
        for first in (begin..begin + columns).step_by(RUN) {
            let cells = first..(first + RUN).min(begin + columns);
            let end = (cells.end + apart).min(snow.depth.len());
            let others = (cells.start + apart).min(end)..end;
            let is_steep = any_is_steep(
                (&snow.depth[cells.clone()], &floors[cells.clone()]),
                (&snow.depth[others.clone()], &floors[others]),
            );
            if is_steep {
                snow.exchange_from(cx, turn, cells);
            }
        }
    }
}

/// Returns true if snow may slide between some of these cells and those beside them.
#[inline(always)]
fn any_is_steep(
    (depths, floors): (&[u32], &[[u32; 2]]),
    (others, other_floors): (&[u32], &[[u32; 2]]),
) -> bool {
    let mut steep = 0_u32;
    let here = depths.iter().zip(floors);
    for ((one, [one_m, _]), (two, [two_m, _])) in here.zip(others.iter().zip(other_floors)) {
        let higher_m = one.wrapping_sub(*two).cast_signed() as f32 * SNOW_DEPTH_M;
        let rise_m = f32::from_bits(*one_m) - f32::from_bits(*two_m);
        steep |= u32::from(higher_m.abs() + rise_m.abs() > CALM_RISE_M);
    }
    steep != 0
}

/// Words of the floors of so many cells from one on.
#[inline(always)]
fn floors<'a>(cx: &Context<'a>, first: u32, count: usize) -> &'a [[u32; 2]] {
    let floors: &[[u32; 2]] = cast_slice(&cx.tables[cx.scene.snow.first_row as usize..]);
    &floors[first as usize..][..count]
}
