// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/tree/branch_snow.wgsl
//!
//! Snow on the branches of trees.
//!
//! # Model
//! Flakes that come down beneath a crown are caught over a square of 8 x 8 cells first, of a grid that is shifted at random from round to round, so that no edges of
//! squares show. Once a round each segment whose middle is above the square takes its share of
//! that, by how much of the square's leaves and wood it has, and the less the more it bears already: `dI = (I* - I)(1 - exp(-C P/I*))` in small steps
//! (Hedstrom and Pomeroy 1998), C being the share of the sky that crowns cover. I* grows with the area of leaves and twigs, and falls for wood that stands
//! steep. What is above I*, because a branch has bent down or has lost leaves, slides off; a share falls as warmth and wind have it (Roesch et al. 2001), in lumps,
//! and much more at once where a branch swings fast. What is not held falls on, evenly over the square. All of it are integers, so nothing is lost.

use crate::arith::lane::{Real, Word};
use crate::arith::math::reciprocal;
use crate::arith::rng::{philox, unit_float};
use crate::blocks::SnowBlock;
use crate::context::Context;
use crate::device::terrain::snow::{SNOW_INTERVAL, SNOW_TURNS, SNOW_UNIT_KG, SNOW_WORDS, round_at_random};
use crate::layout::Uint4;

crate::shared_constants! {
    /// Cells along the edge of a square of the crowns.
    pub const CROWN_CELLS: u32 = 8;
    /// Words of a square: what has come down over it in a round, what of that is left to fall on, and the area above it that catches; of this round and of the next.
    pub const CROWN_WORDS: u32 = 6;
    /// Words of a square in one round.
    pub const CROWN_POOL: u32 = 3;
    /// Turn in which the areas above the squares are added up.
    pub const CROWN_TURN: u32 = 4;
    /// Units of that area in a m².
    pub const CROWN_UNITS_M2: f32 = 65_536.0;
    /// Share of the water over a square that segments take at most, so that rounding never gives more than there is.
    pub const CROWN_TAKEN: f32 = 0.999_99;

    /// Squared angular velocity in rad²/s² from which on a branch shakes snow off: assumed.
    pub const SHAKING_SQUARED: f32 = 1.0;
    /// Share of its snow that it then loses in a round: assumed.
    pub const SHAKEN_SHARE: f32 = 0.25;
    /// Least share of its snow that a branch loses at once to warmth and wind, in as few rounds as make their rate: assumed.
    pub const LUMP_SHARE: f32 = 0.25;
    /// Random words of flakes that crowns catch.
    pub const STREAM_CROWN: u32 = 0x8000_0002;
    /// Random words of snow that falls from branches.
    pub const STREAM_BRANCH: u32 = 0x8000_0003;
    /// Random words of the shift of the squares.
    pub const STREAM_SHIFT: u32 = 0x8000_0004;
}

/// Areas with which a segment catches snow.
#[derive(Clone, Copy, Debug)]
pub struct BranchCatch {
    /// Cell beneath its middle; [`NEVER`](crate::blocks::NEVER) if there is none.
    pub cell: u32,
    /// Units of area by which it shares in what comes down, with all its leaves.
    pub area: u32,
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
    /// Units that it takes from its square.
    pub caught: u32,
    /// Units that it loses.
    pub lost: u32,
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

/// Number of a cell in the grid of the squares of a round, shifted around the edges.
#[inline(always)]
pub fn crown_cell(cx: &Context<'_>, cell: u32) -> u32 {
    let snow = &cx.scene.snow;
    let [x, z, ..] = philox(cx.scene.seed, [crown_round(cx.step.index), STREAM_SHIFT, 0, 0]);
    let column = (cell % snow.columns + x % CROWN_CELLS) % snow.columns;
    let line = (cell / snow.columns + z % CROWN_CELLS) % snow.lines;
    line * snow.columns + column
}

/// Square over a cell of its grid.
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

/// Number of the round to which the flakes of a step belong: those that crowns have caught by its last exchange wait no longer.
#[inline(always)]
pub fn crown_round(step: u32) -> u32 {
    (step + (SNOW_INTERVAL - 1)) / (SNOW_INTERVAL * SNOW_TURNS)
}

/// First of the words of the squares in a step.
#[inline(always)]
pub fn crown_pool(step: u32) -> u32 {
    CROWN_POOL * (crown_round(step) & 1)
}

/// Place among the words of the litter of the snow on the segment in a row.
#[inline(always)]
pub fn branch_word(snow: &SnowBlock, row: u32) -> u32 {
    snow.first_word + SNOW_WORDS * (snow.columns * snow.lines) + row
}

/// Place among the words of the litter of one of the words of a square.
#[inline(always)]
pub fn crown_word(snow: &SnowBlock, square: u32, word: u32) -> u32 {
    branch_word(snow, snow.branches) + word * crown_squares(snow) + square
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
    let Uint4([cell, area, wood_m2, leaf_m2]) = cx.tables[(cx.scene.snow.first_branch_row + row) as usize];
    BranchCatch { cell, area, wood_m2: f32::from_bits(wood_m2), leaf_m2: f32::from_bits(leaf_m2) }
}

/// Units of water that a segment bears at most, whose axis has a vertical component and on which so many leaves hang.
#[inline(always)]
pub fn branch_room(cx: &Context<'_>, catch: BranchCatch, leaf_count: f32, axis_y: f32) -> f32 {
    let level = (1.0 - axis_y * axis_y).max(0.0);
    cx.step.snow.branch_units_m2 * (catch.wood_m2 * level + catch.leaf_m2 * leaf_count)
}

/// Units of water that a segment may take of what has come down over its square, above which is so much area.
#[inline(always)]
pub fn branch_offer(catch: BranchCatch, fresh: u32, area: u32) -> f32 {
    let part = catch.area.to_real() * reciprocal(area.max(1).to_real());
    fresh.to_real() * (part * CROWN_TAKEN)
}

/// Snow of the segment in a row after a round in which it may take so much.
#[expect(clippy::manual_clamp, reason = "written as in WGSL")]
#[inline(always)]
pub fn branch_round(
    cx: &Context<'_>,
    row: u32,
    room: f32,
    held: u32,
    offered: f32,
    spin_squared: f32,
) -> BranchRound {
    let before = held.to_real();
    let free = (1.0 - before * reciprocal(room.max(1.0))).max(0.0);
    let caught = (offered * free).floor().to_whole();
    let mut share = cx.step.snow.branch_sheds;
    if SHAKING_SQUARED < spin_squared {
        share += SHAKEN_SHARE;
    }
    let over = (before - room).max(0.0);
    let [word, chance, ..] = philox(cx.scene.seed, [row, STREAM_BRANCH, cx.step.index, 0]);
    let lump = share.max(LUMP_SHARE).min(1.0);
    let mut falls = over;
    if unit_float(chance) * lump < share {
        falls += (before - over) * lump;
    }
    let lost = round_at_random(falls, word).min(held);
    BranchRound { held: held - lost + caught, caught, lost }
}

/// Mass in kg of the snow on the segments of these rows.
#[inline(always)]
pub fn branch_snow_kg<W: Word>(cx: &Context<'_>, row: W) -> W::Real {
    let snow = &cx.scene.snow;
    if snow.branches == 0 {
        return row.all(0).to_real();
    }
    row.plus(row.all(branch_word(snow, 0))).look_up_word(cx.litter).to_real() * SNOW_UNIT_KG
}
