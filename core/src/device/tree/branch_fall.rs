// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/tree/branch_fall.wgsl
//!
//! Snow that falls from branches as particles. What a segment loses waits in a word of its own until a particle takes it along, and until that lands; a
//! particle serves every so many segments, one at a time.

use super::branch_snow::{CROWN_WORDS, branch_word, crown_squares};
use crate::arith::vector::Vec3;
use crate::blocks::{NEVER, SnowBlock};
use crate::context::Context;
use crate::device::solid::shape::row_vector;

crate::shared_constants! {
    /// Least units of water that fall as a particle: a quarter of a gram, a lump of more than a centimetre. Less comes down at once.
    pub const LEAST_FALL: u32 = 64;
}

/// Place among the words of the litter of the snow that falls from the segment in a row.
#[inline(always)]
pub fn fall_word(snow: &SnowBlock, row: u32) -> u32 {
    branch_word(snow, snow.branches) + CROWN_WORDS * crown_squares(snow) + row
}

/// Returns true if so much snow that a segment loses falls as a particle, while of what it lost before so much falls.
#[inline(always)]
pub fn falls_as_particle(snow: &SnowBlock, lost: u32, falling: u32) -> bool {
    snow.fall_slots != 0 && lost >= LEAST_FALL && falling == 0
}

/// First of the segments that a particle serves from which snow falls; [`NEVER`] if there is none.
#[inline(always)]
pub fn fall_row(cx: &Context<'_>, particle: u32) -> u32 {
    let snow = &cx.scene.snow;
    let mut row = particle;
    while row < snow.branches {
        if cx.litter[fall_word(snow, row) as usize] != 0 {
            return row;
        }
        row += snow.fall_slots;
    }
    NEVER
}

/// Middle of the segment in a row at rest.
#[inline(always)]
pub fn fall_start(cx: &Context<'_>, row: u32) -> Vec3 {
    row_vector(cx.tables[(cx.scene.snow.first_branch_row + cx.scene.snow.branches + row) as usize])
}
