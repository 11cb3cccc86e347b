// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/wind/row.wgsl
//!
//! Rows of the wind tables: four words each. The profile and the gusts hold float bits in the first two.

use crate::arith::lane::Word;
use crate::context::Context;
use crate::layout::Uint4;

/// The two floats of row `first + index`: a value and the next one.
#[inline(always)]
pub fn wind_row<W: Word>(cx: &Context<'_>, index: W, first: u32) -> [W::Real; 2] {
    index.look_up_pairs(bytemuck::cast_slice(&cx.tables[first as usize..]))
}

/// A row of a value and the next one.
pub(crate) fn wind_entry(value: f32, next: f32) -> Uint4 {
    Uint4([value.to_bits(), next.to_bits(), 0, 0])
}
