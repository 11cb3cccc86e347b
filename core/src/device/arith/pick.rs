// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Numbers of a table small enough for registers, by permutations where there are any.

#[cfg(target_arch = "x86_64")]
use fearless_simd::SimdInto;
use fearless_simd::{Simd, SimdBase, f32x8, f32x16, u32x8, u32x16};

use super::lane::PICK_COUNT;

/// The number that each of eight words below [`PICK_COUNT`] stands for.
#[inline(always)]
pub(crate) fn pick_of_eight<S: Simd>(index: u32x8<S>, table: &[f32; PICK_COUNT]) -> f32x8<S> {
    let simd = index.simd;
    #[cfg(target_arch = "x86_64")]
    if let Some(avx2) = simd.level().as_avx2() {
        let ([a, b, c, d], _) = table.as_chunks() else { unreachable!("four times eight numbers") };
        let load = |eight| f32x8::load_array_ref(simd, eight).into();
        return x86::pick_of_eight(avx2, index.into(), [load(a), load(b), load(c), load(d)]).simd_into(simd);
    }
    let mut numbers = [0.0; 8];
    for (number, index) in numbers.iter_mut().zip(index.to_array()) {
        *number = table[index as usize % PICK_COUNT];
    }
    f32x8::load_array(simd, numbers)
}

/// The same of sixteen.
#[inline(always)]
pub(crate) fn pick_of_sixteen<S: Simd>(index: u32x16<S>, table: &[f32; PICK_COUNT]) -> f32x16<S> {
    let simd = index.simd;
    #[cfg(target_arch = "x86_64")]
    if let Some(avx512) = simd.level().as_avx512() {
        let ([a, b], _) = table.as_chunks() else { unreachable!("twice sixteen numbers") };
        let load = |sixteen| f32x16::load_array_ref(simd, sixteen).into();
        return x86::pick_of_sixteen(avx512, index.into(), [load(a), load(b)]).simd_into(simd);
    }
    let (low, high) = simd.split_u32x16(index);
    simd.combine_f32x8(pick_of_eight(low, table), pick_of_eight(high, table))
}

#[cfg(target_arch = "x86_64")]
mod x86 {
    use core::arch::x86_64::{
        __m256, __m256i, __m512, __m512i, _mm256_blendv_ps, _mm256_castsi256_ps, _mm256_permutevar8x32_ps,
        _mm256_slli_epi32, _mm512_permutex2var_ps,
    };

    use fearless_simd::kernel;

    kernel! {
        #[inline(always)]
        pub(super) fn pick_of_eight(avx2: Avx2, index: __m256i, table: [__m256; 4]) -> __m256 {
            let [a, b, c, d] = table;
            // Bits 3 and 4 of the indices, put where signs are.
            let odd = _mm256_castsi256_ps(_mm256_slli_epi32::<28>(index));
            let upper = _mm256_castsi256_ps(_mm256_slli_epi32::<27>(index));
            let (a, b) = (_mm256_permutevar8x32_ps(a, index), _mm256_permutevar8x32_ps(b, index));
            let (c, d) = (_mm256_permutevar8x32_ps(c, index), _mm256_permutevar8x32_ps(d, index));
            _mm256_blendv_ps(_mm256_blendv_ps(a, b, odd), _mm256_blendv_ps(c, d, odd), upper)
        }
    }

    kernel! {
        #[inline(always)]
        pub(super) fn pick_of_sixteen(avx512: Avx512, index: __m512i, table: [__m512; 2]) -> __m512 {
            let [low, high] = table;
            _mm512_permutex2var_ps(low, index, high)
        }
    }
}
