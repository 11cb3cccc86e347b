// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Hints to processors about what will be read soon. Elsewhere than on x86-64 they do nothing.

/// Into the first level of cache.
pub(crate) const FIRST_LEVEL: i32 = 3;
/// Into the second level of cache.
pub(crate) const SECOND_LEVEL: i32 = 2;

/// Bytes of a cache line.
#[cfg(target_arch = "x86_64")]
const LINE: usize = 64;

/// Prefetches so many items.
#[inline(always)]
pub(crate) fn prefetch<const LEVEL: i32, T>(first: *const T, count: usize) {
    #[cfg(target_arch = "x86_64")]
    for line in 0..(count * size_of::<T>()).div_ceil(LINE) {
        // SAFETY: a hint about any address is allowed, and changes nothing but time: a quarter of a step of a thousand trees, up
        // to a fifth of one of a million leaves in turbulence (`benches/record/README.md`).
        #[expect(unsafe_code, reason = "a hint reads nothing")]
        unsafe {
            std::arch::x86_64::_mm_prefetch::<LEVEL>(first.cast::<i8>().wrapping_add(line * LINE));
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (first, count);
}

#[cfg(all(test, target_arch = "x86_64"))]
mod tests {
    use std::arch::x86_64::{_MM_HINT_T0, _MM_HINT_T1};

    use super::*;

    #[test]
    fn levels_are_those_of_the_processor() {
        assert_eq!((FIRST_LEVEL, SECOND_LEVEL), (_MM_HINT_T0, _MM_HINT_T1));
    }
}
