// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/tree/branch_snow.wgsl
//!
//! Snow on the branches of trees.
//!
//! # Model
//! Flakes that come down beneath a crown are caught over a square of 8 x 8 cells first. Once a round each segment whose middle is above the square takes its share of
//! that, by how much of the square's leaves and wood it has, and the less the more it bears already: `dI = (I* - I)(1 - exp(-C P/I*))` in small steps
//! (Hedstrom and Pomeroy 1998), C being the share of the sky that crowns cover. I* grows with the area of leaves and twigs, and falls for wood that stands
//! steep. What is above I*, because a branch has bent down or has lost leaves, slides off; a share falls as warmth and wind have it (Roesch et al. 2001),
//! and much more at once where a branch swings fast. What is not held falls on, evenly over the square. All of it are integers, so nothing is lost.

use crate::arith::lane::{Real, Word};
use crate::arith::math::reciprocal;
use crate::arith::rng::{philox, unit_float};
use crate::blocks::SnowBlock;
use crate::context::Context;
use crate::device::terrain::snow::{SNOW_INTERVAL, SNOW_TURNS, SNOW_WORDS, round_at_random};
use crate::layout::Uint4;

crate::shared_constants! {
    /// Cells along the edge of a square of the crowns.
    pub const CROWN_CELLS: u32 = 8;
    /// Words of a square: what has come down over it in this round and in the next, and what of that is left to fall on.
    pub const CROWN_WORDS: u32 = 4;
    /// Kilograms of a unit of water: 1/4096 mm over a cell.
    pub const SNOW_UNIT_KG: f32 = 1.0 / 262_144.0;
    /// Squared angular velocity in rad²/s² from which on a branch shakes snow off: assumed.
    pub const SHAKING_SQUARED: f32 = 1.0;
    /// Share of its snow that it then loses in a round: assumed.
    pub const SHAKEN_SHARE: f32 = 0.25;
    /// Random words of flakes that crowns catch.
    pub const STREAM_CROWN: u32 = 0x8000_0002;
    /// Random words of snow that falls from branches.
    pub const STREAM_BRANCH: u32 = 0x8000_0003;
}

/// Areas with which a segment catches snow.
#[derive(Clone, Copy, Debug)]
pub struct BranchCatch {
    /// Its square of the crowns; [`NEVER`](crate::blocks::NEVER) if there is none beneath it.
    pub square: u32,
    /// Its share of the leaves and wood over the square.
    pub share: f32,
    /// Area of its wood as seen from above when it lies level, in m².
    pub wood_m2: f32,
    /// Area in m² of one of its leaves with all that it stands for.
    pub leaf_m2: f32,
}

/// Snow of a segment after a round.
#[derive(Clone, Copy, Debug)]
pub struct BranchRound {
    /// Units of water on it.
    pub held: u32,
    /// Units that it gives to its square beyond those that it takes from it, two's complement.
    pub given: u32,
}

/// Number of the squares along x.
#[inline(always)]
pub fn crown_columns(snow: &SnowBlock) -> u32 {
    snow.columns.div_ceil(CROWN_CELLS)
}

/// Number of all squares.
#[inline(always)]
pub fn crown_squares(snow: &SnowBlock) -> u32 {
    crown_columns(snow) * snow.lines.div_ceil(CROWN_CELLS)
}

/// Square over a cell.
#[inline(always)]
pub fn crown_square(snow: &SnowBlock, cell: u32) -> u32 {
    (cell / snow.columns / CROWN_CELLS) * crown_columns(snow) + (cell % snow.columns) / CROWN_CELLS
}

/// Cells along x of the square over a cell: fewer at the edge.
#[inline(always)]
pub fn crown_width(snow: &SnowBlock, cell: u32) -> u32 {
    CROWN_CELLS.min(snow.columns - (cell % snow.columns) / CROWN_CELLS * CROWN_CELLS)
}

/// Part that a cell gets of so many units that fall through its square: a difference of one between cells, and the sum to the unit.
#[inline(always)]
pub fn crown_part(snow: &SnowBlock, cell: u32, units: u32) -> u32 {
    let (column, line) = (cell % snow.columns, cell / snow.columns);
    let width = crown_width(snow, cell);
    let high = CROWN_CELLS.min(snow.lines - line / CROWN_CELLS * CROWN_CELLS);
    (units + (line % CROWN_CELLS) * width + column % CROWN_CELLS) / (width * high)
}

/// First of the two words of the squares into which the flakes of a step go: those that crowns have caught by the last exchange of a round wait no longer.
#[inline(always)]
pub fn crown_pool(step: u32) -> u32 {
    2 * (((step + (SNOW_INTERVAL - 1)) / (SNOW_INTERVAL * SNOW_TURNS)) & 1)
}

/// Place among the words of the litter of one of the words of a square.
#[inline(always)]
pub fn crown_word(snow: &SnowBlock, square: u32, word: u32) -> u32 {
    snow.first_word
        + SNOW_WORDS * (snow.columns * snow.lines)
        + snow.branches
        + word * crown_squares(snow)
        + square
}

/// Returns true for a flake that a crown is in the way of, where so much of the sky is open.
#[inline(always)]
pub fn flake_is_caught(cx: &Context<'_>, x: f32, z: f32, open: f32) -> bool {
    if cx.scene.snow.branches == 0 || !(0.0..1.0).contains(&open) {
        return false;
    }
    let [word, ..] = philox(cx.scene.seed, [x.to_bits(), STREAM_CROWN, cx.step.index, z.to_bits()]);
    open <= unit_float(word)
}

/// Areas with which the segment in a row catches snow. Only where snow lies on branches.
#[inline(always)]
pub fn branch_catch(cx: &Context<'_>, row: u32) -> BranchCatch {
    let Uint4([square, share, wood_m2, leaf_m2]) = cx.tables[(cx.scene.snow.first_branch_row + row) as usize];
    BranchCatch {
        square,
        share: f32::from_bits(share),
        wood_m2: f32::from_bits(wood_m2),
        leaf_m2: f32::from_bits(leaf_m2),
    }
}

/// Units of water that a segment bears at most, whose axis has a vertical component and on which so many leaves hang.
#[inline(always)]
pub fn branch_room(cx: &Context<'_>, catch: BranchCatch, leaf_count: f32, axis_y: f32) -> f32 {
    let level = (1.0 - axis_y * axis_y).max(0.0);
    cx.step.snow.branch_units_m2 * (catch.wood_m2 * level + catch.leaf_m2 * leaf_count)
}

/// Snow of the segment in a row after a round in which so much has come down over its square.
#[inline(always)]
pub fn branch_round(
    cx: &Context<'_>,
    row: u32,
    catch: BranchCatch,
    room: f32,
    held: u32,
    fresh: u32,
    spin_squared: f32,
) -> BranchRound {
    let before = held.to_real();
    let free = (1.0 - before * reciprocal(room.max(1.0))).max(0.0);
    let caught = (fresh.to_real() * (catch.share * free)).floor().to_whole().min(fresh);
    let mut share = cx.step.snow.branch_sheds;
    if SHAKING_SQUARED < spin_squared {
        share += SHAKEN_SHARE;
    }
    let over = (before - room).max(0.0);
    let falls = over + (before - over) * share.min(1.0);
    let [word, ..] = philox(cx.scene.seed, [row, STREAM_BRANCH, cx.step.index, 0]);
    let shed = round_at_random(falls, word).min(held);
    BranchRound { held: held - shed + caught, given: shed.wrapping_sub(caught) }
}

/// Mass in kg of the snow on the segments of these rows.
#[inline(always)]
pub fn branch_snow_kg<W: Word>(cx: &Context<'_>, row: W) -> W::Real {
    let snow = &cx.scene.snow;
    if snow.branches == 0 {
        return row.all(0).to_real();
    }
    let first = snow.first_word + SNOW_WORDS * (snow.columns * snow.lines);
    row.plus(row.all(first)).look_up_word(cx.litter).to_real() * SNOW_UNIT_KG
}
