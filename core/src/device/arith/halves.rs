// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Products of words in halves, in one instruction where there is one.

#[cfg(target_arch = "x86_64")]
use fearless_simd::SimdInto;
use fearless_simd::{Simd, u32x8, u32x16};

use super::lane::Word;

/// Sum of the products of lower and of upper halves, all of them two's complement.
#[inline(always)]
fn dot_halves<W: Word>(a: W, b: W) -> W {
    let low = (a << 16).shift_signed(16).times((b << 16).shift_signed(16));
    low.plus(a.shift_signed(16).times(b.shift_signed(16)))
}

/// [`dot_halves`] of eight.
#[inline(always)]
pub(crate) fn dot_halves_of_eight<S: Simd>(a: u32x8<S>, b: u32x8<S>) -> u32x8<S> {
    #[cfg(target_arch = "x86_64")]
    if let Some(avx2) = a.simd.level().as_avx2() {
        return x86::dot_halves_of_eight(avx2, a.into(), b.into()).simd_into(a.simd);
    }
    dot_halves(a, b)
}

/// [`dot_halves`] of sixteen.
#[inline(always)]
pub(crate) fn dot_halves_of_sixteen<S: Simd>(a: u32x16<S>, b: u32x16<S>) -> u32x16<S> {
    #[cfg(target_arch = "x86_64")]
    if let Some(avx512) = a.simd.level().as_avx512() {
        return x86::dot_halves_of_sixteen(avx512, a.into(), b.into()).simd_into(a.simd);
    }
    dot_halves(a, b)
}

#[cfg(target_arch = "x86_64")]
mod x86 {
    use core::arch::x86_64::{__m256i, __m512i, _mm256_madd_epi16, _mm512_madd_epi16};

    use fearless_simd::kernel;

    kernel! {
        #[inline(always)]
        pub(super) fn dot_halves_of_eight(avx2: Avx2, a: __m256i, b: __m256i) -> __m256i {
            _mm256_madd_epi16(a, b)
        }
    }

    kernel! {
        #[inline(always)]
        pub(super) fn dot_halves_of_sixteen(avx512: Avx512, a: __m512i, b: __m512i) -> __m512i {
            _mm512_madd_epi16(a, b)
        }
    }
}
