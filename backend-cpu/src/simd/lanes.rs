// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Numbers of the sixteen segments of a block, lane by lane.
//!
//! Structs of such numbers, [`Constants`](windfall_core::device::tree::sway::Constants) and responses of joints, stay in lanes from
//! step to step and from pass to pass, so that no pass transposes them.

use windfall_core::arith::pack::{BLOCK, Pack};

/// One number of all segments of a block, in a cache line of its own: a register of 64 bytes that straddles two lines takes
/// two accesses.
#[derive(Clone, Copy, Debug, Default)]
#[repr(align(64))]
pub(crate) struct Lanes(pub(super) [f32; BLOCK]);

impl Lanes {
    /// Reads one part of the lanes.
    #[inline(always)]
    pub(crate) fn load<P: Pack>(&self, simd: P::Simd, part: usize) -> P {
        P::load(simd, &self.0[part * P::LANES..])
    }

    /// Writes one part of the lanes.
    #[inline(always)]
    pub(crate) fn store<P: Pack>(&mut self, part: usize, numbers: P) {
        numbers.store(&mut self.0[part * P::LANES..]);
    }
}
