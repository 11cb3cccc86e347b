// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Has memory bring blocks of a batch closer before they are needed.
//!
//! A block of limbs with its twigs is some ninety cache lines in seven columns and two tables, a few lines from each page:
//! processors do not foresee them, and a step of a large forest waited for them as long as it worked.

use std::ops::Range;

use windfall_core::arith::pack::BLOCK;

use super::segment_block::SegmentBlock;
use super::sway_block::Step;

/// How many blocks ahead: one is too late where memory is slow, four and more gain nothing.
pub(super) const AHEAD: usize = 2;

/// Bytes that come together.
const LINE: usize = 64;

/// Brings so many items to the second level of cache, which gained more than bringing them to the first.
#[inline(always)]
fn fetch<T>(first: *const T, count: usize) {
    #[cfg(target_arch = "x86_64")]
    for line in 0..(count * size_of::<T>()).div_ceil(LINE) {
        use std::arch::x86_64::{_MM_HINT_T1, _mm_prefetch};
        // SAFETY: a hint about any address is allowed, and changes nothing but time: of a step of a thousand trees a
        // quarter (`benches/record/README.md`).
        #[expect(unsafe_code, reason = "a hint reads nothing")]
        unsafe {
            _mm_prefetch::<_MM_HINT_T1>(first.cast::<i8>().wrapping_add(line * LINE));
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (first, count);
}

impl Step<'_, '_> {
    /// Fetches a block of limbs and its twigs, if there is such a block: state, leaf counts and some of the constants.
    #[inline(always)]
    pub(super) fn fetch(&self, number: usize, constants: Range<usize>) {
        let Some(block) = self.blocks.limbs.get(number) else { return };
        self.fetch_rows(&block.segments, constants.clone());
        for twigs in &self.blocks.twigs[block.twigs.clone()] {
            self.fetch_rows(twigs, constants.clone());
        }
    }

    #[inline(always)]
    fn fetch_rows(&self, segments: &SegmentBlock, constants: Range<usize>) {
        let lanes = segments.lanes(constants);
        fetch(lanes.as_ptr(), lanes.len());
        let branches = &self.rows.branches;
        let first = segments.rows.start;
        fetch(branches.turn.as_ptr().wrapping_add(first), BLOCK);
        fetch(branches.rate.as_ptr().wrapping_add(first), BLOCK);
        fetch(branches.base.as_ptr().wrapping_add(first), BLOCK);
        fetch(branches.pose.as_ptr().wrapping_add(first), BLOCK);
        fetch(branches.velocity.as_ptr().wrapping_add(first), BLOCK);
        fetch(branches.spin.as_ptr().wrapping_add(first), BLOCK);
        fetch(branches.bearing.as_ptr().wrapping_add(first), BLOCK);
    }
}
