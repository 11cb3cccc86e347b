// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Sixteen leaves in the litter, side by side in SIMD registers: which of them something may happen to. That is rare, and done one
//! by one.

use bytemuck::{must_cast_mut, must_cast_ref};
use windfall_core::Context;
use windfall_core::arith::lane::{Mask, Word};
use windfall_core::arith::pack::{BLOCK, Pack, load_block, rows_of_bits, store_block};
use windfall_core::device::leaf::record::{
    is_covered, lies_still, lying_support, wake_speed_squared, with_cover,
};
use windfall_core::device::leaf::wake::{Cover, LyingWind, cover_of, lying_wind};
use windfall_core::device::solid::near::may_meet_movers;
use windfall_core::leaf::{Drift, LeavesMut, Place, Schedule};

use super::branch_block::{Column, vector_and_fourth};

/// Slots that follow one another.
pub(crate) struct LyingBlock<'a> {
    pub(crate) place: &'a mut [Place; BLOCK],
    pub(crate) drift: &'a [Drift; BLOCK],
    pub(crate) schedule: &'a [Schedule; BLOCK],
}

/// The block of slots from one on.
#[inline(always)]
pub(crate) fn lying_block<'a>(leaves: &'a mut LeavesMut<'_>, first: usize) -> LyingBlock<'a> {
    let whole = "as many slots are left";
    LyingBlock {
        place: leaves.place[first..].first_chunk_mut().expect(whole),
        drift: leaves.drift[first..].first_chunk().expect(whole),
        schedule: leaves.schedule[first..].first_chunk().expect(whole),
    }
}

/// Leaves of a block, a bit for each, the first in the lowest place.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Covers {
    /// Leaves that have lost what they lay on.
    pub(crate) loose: u32,
    /// Leaves that lie with nothing on them.
    pub(crate) exposed: u32,
}

impl LyingBlock<'_> {
    /// Marks those that others cover.
    #[inline(always)]
    pub(crate) fn check_cover<P: Pack>(&mut self, simd: P::Simd, cx: &Context<'_>) -> Covers {
        let mut covers = Covers::default();
        for part in 0..BLOCK / P::LANES {
            let (position, bits) = vector_and_fourth::<P>(load_block(simd, must_cast_ref(self.place), part));
            let bits = bits.to_bits();
            let lies = lies_still(bits);
            if !lies.any() {
                continue;
            }
            let reach = self.support::<P>(simd, lies, part);
            let Cover { is_loose, is_covered } = cover_of(cx, bits, position, reach);
            let marked = lies.select(with_cover(bits, is_covered), bits);
            let column: &mut Column = must_cast_mut(self.place);
            store_block(column, part, [position.x, position.y, position.z, P::from_bits(marked)]);
            covers.loose |= P::bits_of(lies & is_loose) << (part * P::LANES);
            covers.exposed |= P::bits_of(lies & !is_covered) << (part * P::LANES);
        }
        Covers { loose: rows_of_bits(covers.loose), exposed: rows_of_bits(covers.exposed) }
    }

    /// A bit for each that a solid part which moves may come upon.
    #[inline(always)]
    pub(crate) fn meet_movers<P: Pack>(&self, simd: P::Simd, cx: &Context<'_>) -> u32 {
        let mut near = 0;
        for part in 0..BLOCK / P::LANES {
            let (position, bits) = vector_and_fourth::<P>(load_block(simd, must_cast_ref(self.place), part));
            let lies = lies_still(bits.to_bits());
            if lies.any() {
                near |= P::bits_of(lies & may_meet_movers(cx, position)) << (part * P::LANES);
            }
        }
        rows_of_bits(near)
    }

    /// Samples the wind at those that nothing covers. A bit for each that it may take.
    #[inline(always)]
    pub(crate) fn sample_wind<P: Pack>(&self, simd: P::Simd, cx: &Context<'_>) -> u32 {
        let mut waking = 0;
        for part in 0..BLOCK / P::LANES {
            let (position, bits) = vector_and_fourth::<P>(load_block(simd, must_cast_ref(self.place), part));
            let bits = bits.to_bits();
            let lies = lies_still(bits) & !is_covered(bits);
            if !lies.any() {
                continue;
            }
            let (_, phase) = vector_and_fourth::<P>(load_block(simd, must_cast_ref(self.drift), part));
            let none = bits.all(0);
            let wake_square = wake_speed_squared(lies.select(phase.to_bits(), none));
            let reach = self.support::<P>(simd, lies, part);
            let LyingWind { may_wake, .. } = lying_wind(cx, bits, position, reach, wake_square);
            waking |= P::bits_of(lies & may_wake) << (part * P::LANES);
        }
        rows_of_bits(waking)
    }

    /// Depths to which they reach. The words of others would be any floats, subnormal ones too, on which processors are slow.
    #[inline(always)]
    fn support<P: Pack>(&self, simd: P::Simd, lies: P::Mask, part: usize) -> P {
        let [_, rate, ..]: [P; 4] = load_block(simd, must_cast_ref(self.schedule), part);
        let rate = rate.to_bits();
        lying_support(lies.select(rate, rate.all(0)))
    }
}
