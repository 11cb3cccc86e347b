// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/kernels/sample_air.wgsl
//!
//! Samples the air for the leaves of a unit of slots that has its turn.

use bytemuck::must_cast_ref;
use windfall_core::Context;
use windfall_core::arith::lane::{Mask, Word};
use windfall_core::arith::pack::{BLOCK, Pack, load_block, store_pairs};
use windfall_core::device::leaf::air::{AIR_UNIT_SHIFT, air_is_sampled, air_sample};
use windfall_core::device::leaf::fall::response_of;
use windfall_core::device::leaf::record::{STATE_FALLING, flies, leaf_state};
use windfall_core::leaf::{Drift, Place};

use super::CHUNK;
use crate::quiet::UNIT;
use crate::simd::branch_block::vector_and_fourth;

/// Returns true if the leaves of a unit of a chunk sample the air in this step.
#[inline(always)]
pub(crate) fn unit_samples(cx: &Context<'_>, unit: usize) -> bool {
    const { assert!(UNIT == 1 << AIR_UNIT_SHIFT, "slots of a unit have their turn together") };
    const { assert!(CHUNK.is_multiple_of(4 * UNIT), "turns begin anew with every chunk") };
    #[expect(clippy::cast_possible_truncation, reason = "slots of a chunk")]
    let first = (unit * UNIT) as u32;
    air_is_sampled(cx, first)
}

/// Samples the air for those leaves of a block that fall.
#[inline(always)]
pub(crate) fn sample_air<P: Pack>(
    simd: P::Simd,
    cx: &Context<'_>,
    place: &[Place; BLOCK],
    drift: &[Drift; BLOCK],
    air: &mut [[u32; 2]; BLOCK],
) {
    for part in 0..BLOCK / P::LANES {
        let (position, bits) = vector_and_fourth::<P>(load_block(simd, must_cast_ref(place), part));
        let bits = bits.to_bits();
        let falls = leaf_state(bits).equals(STATE_FALLING) & !flies(bits);
        if falls.any() {
            let (velocity, _) = vector_and_fourth::<P>(load_block(simd, must_cast_ref(drift), part));
            let response = response_of(cx, bits);
            let sampled = air_sample(cx, position, velocity, response.time_constant_s);
            store_pairs::<P>(air, part, sampled, P::bits_of(falls));
        }
    }
}
