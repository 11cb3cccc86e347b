// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Turns records side by side into lanes and back.
//!
//! Written with the shuffles of AVX2 where there are any: they are a third of a step's instructions, and put together
//! from portable ones there would be twice as many.

#[cfg(target_arch = "x86_64")]
use fearless_simd::SimdInto;
use fearless_simd::{Simd, SimdBase, f32x4, f32x8, f32x16};

/// Four rows of four to four columns.
#[inline(always)]
fn transpose_four<S: Simd>([a, b, c, d]: [f32x4<S>; 4]) -> [f32x4<S>; 4] {
    let (even_low, even_high) = a.interleave(c);
    let (odd_low, odd_high) = b.interleave(d);
    let (x, y) = even_low.interleave(odd_low);
    let (z, w) = even_high.interleave(odd_high);
    [x, y, z, w]
}

/// Eight rows of four to four columns of eight.
#[inline(always)]
pub(crate) fn columns_of_four<S: Simd>(simd: S, row: impl Fn(usize) -> f32x4<S>) -> [f32x8<S>; 4] {
    transpose_eight_in_fours([
        simd.combine_f32x4(row(0), row(4)),
        simd.combine_f32x4(row(1), row(5)),
        simd.combine_f32x4(row(2), row(6)),
        simd.combine_f32x4(row(3), row(7)),
    ])
}

/// Transposes four vectors within each four lanes.
#[inline(always)]
pub(crate) fn transpose_eight_in_fours<S: Simd>(rows: [f32x8<S>; 4]) -> [f32x8<S>; 4] {
    let simd = rows[0].simd;
    #[cfg(target_arch = "x86_64")]
    if let Some(avx2) = simd.level().as_avx2() {
        let [a, b, c, d] = rows;
        let [x, y, z, w] = x86::transpose_in_halves(avx2, [a.into(), b.into(), c.into(), d.into()]);
        return [x.simd_into(simd), y.simd_into(simd), z.simd_into(simd), w.simd_into(simd)];
    }
    let halves = rows.map(|row| simd.split_f32x8(row));
    let low = transpose_four(halves.map(|(low, _)| low));
    let high = transpose_four(halves.map(|(_, high)| high));
    core::array::from_fn(|column| simd.combine_f32x4(low[column], high[column]))
}

/// Transposes four vectors within each four lanes.
#[inline(always)]
pub(crate) fn transpose_sixteen_in_fours<S: Simd>(rows: [f32x16<S>; 4]) -> [f32x16<S>; 4] {
    let simd = rows[0].simd;
    #[cfg(target_arch = "x86_64")]
    if let Some(avx512) = simd.level().as_avx512() {
        let [a, b, c, d] = rows;
        let [x, y, z, w] = x86::transpose_in_quarters(avx512, [a.into(), b.into(), c.into(), d.into()]);
        return [x.simd_into(simd), y.simd_into(simd), z.simd_into(simd), w.simd_into(simd)];
    }
    let halves = rows.map(|row| simd.split_f32x16(row));
    let low = transpose_eight_in_fours(halves.map(|(low, _)| low));
    let high = transpose_eight_in_fours(halves.map(|(_, high)| high));
    core::array::from_fn(|column| simd.combine_f32x8(low[column], high[column]))
}

#[inline(always)]
fn join_fours<S: Simd>(simd: S, a: f32x4<S>, b: f32x4<S>, c: f32x4<S>, d: f32x4<S>) -> f32x16<S> {
    simd.combine_f32x8(simd.combine_f32x4(a, b), simd.combine_f32x4(c, d))
}

/// Sixteen rows of four to four columns of sixteen.
#[inline(always)]
pub(crate) fn columns_of_sixteen<S: Simd>(simd: S, row: impl Fn(usize) -> f32x4<S>) -> [f32x16<S>; 4] {
    transpose_sixteen_in_fours([
        join_fours(simd, row(0), row(4), row(8), row(12)),
        join_fours(simd, row(1), row(5), row(9), row(13)),
        join_fours(simd, row(2), row(6), row(10), row(14)),
        join_fours(simd, row(3), row(7), row(11), row(15)),
    ])
}

#[cfg(target_arch = "x86_64")]
mod x86 {
    use core::arch::x86_64::{
        __m256, __m512, _mm256_castpd_ps, _mm256_castps_pd, _mm256_unpackhi_pd, _mm256_unpackhi_ps,
        _mm256_unpacklo_pd, _mm256_unpacklo_ps, _mm512_castpd_ps, _mm512_castps_pd, _mm512_unpackhi_pd,
        _mm512_unpackhi_ps, _mm512_unpacklo_pd, _mm512_unpacklo_ps,
    };

    use fearless_simd::kernel;

    kernel! {
        /// Transposes the lower halves of four vectors among each other, and the upper halves.
        #[inline(always)]
        pub(super) fn transpose_in_halves(avx2: Avx2, rows: [__m256; 4]) -> [__m256; 4] {
            let [a, b, c, d] = rows;
            let ab_low = _mm256_castps_pd(_mm256_unpacklo_ps(a, b));
            let ab_high = _mm256_castps_pd(_mm256_unpackhi_ps(a, b));
            let cd_low = _mm256_castps_pd(_mm256_unpacklo_ps(c, d));
            let cd_high = _mm256_castps_pd(_mm256_unpackhi_ps(c, d));
            [
                _mm256_castpd_ps(_mm256_unpacklo_pd(ab_low, cd_low)),
                _mm256_castpd_ps(_mm256_unpackhi_pd(ab_low, cd_low)),
                _mm256_castpd_ps(_mm256_unpacklo_pd(ab_high, cd_high)),
                _mm256_castpd_ps(_mm256_unpackhi_pd(ab_high, cd_high)),
            ]
        }
    }

    kernel! {
        /// Transposes the quarters of four vectors, each among each other.
        #[inline(always)]
        pub(super) fn transpose_in_quarters(avx512: Avx512, rows: [__m512; 4]) -> [__m512; 4] {
            let [a, b, c, d] = rows;
            let ab_low = _mm512_castps_pd(_mm512_unpacklo_ps(a, b));
            let ab_high = _mm512_castps_pd(_mm512_unpackhi_ps(a, b));
            let cd_low = _mm512_castps_pd(_mm512_unpacklo_ps(c, d));
            let cd_high = _mm512_castps_pd(_mm512_unpackhi_ps(c, d));
            [
                _mm512_castpd_ps(_mm512_unpacklo_pd(ab_low, cd_low)),
                _mm512_castpd_ps(_mm512_unpackhi_pd(ab_low, cd_low)),
                _mm512_castpd_ps(_mm512_unpacklo_pd(ab_high, cd_high)),
                _mm512_castpd_ps(_mm512_unpackhi_pd(ab_high, cd_high)),
            ]
        }
    }
}
