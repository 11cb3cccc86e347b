// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Packs of eight and of sixteen.

use fearless_simd::{
    Bytes, Select, Simd, SimdBase, SimdFloat, SimdInt, SimdMask, f32x4, f32x8, f32x16, i32x8, i32x16,
    mask32x8, mask32x16, u32x4, u32x8, u32x16,
};

use super::Pack;
use crate::arith::halves::{dot_halves_of_eight, dot_halves_of_sixteen};
use crate::arith::lane::{Mask, PICK_COUNT, Real, WHOLE_ANCHOR, Word};
use crate::arith::pick::{pick_of_eight, pick_of_sixteen};
use crate::arith::transpose::{
    columns_of_four, columns_of_sixteen, transpose_eight_in_fours, transpose_sixteen_in_fours,
};

macro_rules! pack {
    (
        $lanes:literal $reals:ident $words:ident $signed:ident $masks:ident, pick $pick:ident,
        columns $columns:ident, fours $fours:ident, pairs $pairs:ident, halves $halves:ident, few $pick_few:ident
    ) => {
        impl<S: Simd> Real for $reals<S> {
            type Word = $words<S>;
            type Mask = $masks<S>;

            #[inline(always)]
            fn all(self, value: f32) -> Self {
                Self::splat(self.simd, value)
            }
            #[inline(always)]
            fn floor(self) -> Self {
                SimdFloat::floor(self)
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                other.simd_lt(self).select_real(self, other)
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                self.simd_lt(other).select_real(self, other)
            }
            #[inline(always)]
            fn to_bits(self) -> $words<S> {
                self.bitcast()
            }
            #[inline(always)]
            fn from_bits(bits: $words<S>) -> Self {
                bits.bitcast()
            }
            #[inline(always)]
            fn to_whole(self) -> $words<S> {
                Real::to_bits(self + WHOLE_ANCHOR) - WHOLE_ANCHOR.to_bits()
            }
            #[inline(always)]
            fn less_than(self, other: Self) -> $masks<S> {
                self.simd_lt(other)
            }
        }

        impl<S: Simd> Word for $words<S> {
            type Real = $reals<S>;
            type Mask = $masks<S>;

            #[inline(always)]
            fn all(self, value: u32) -> Self {
                Self::splat(self.simd, value)
            }
            #[inline(always)]
            fn plus(self, other: Self) -> Self {
                self + other
            }
            #[inline(always)]
            fn minus(self, other: Self) -> Self {
                self - other
            }
            #[inline(always)]
            fn times(self, other: Self) -> Self {
                self * other
            }
            #[inline(always)]
            fn times_high(self, other: Self) -> Self {
                let (a_low, a_high) = (self & 0xffff, self >> 16);
                let (b_low, b_high) = (other & 0xffff, other >> 16);
                let middle = a_high * b_low + ((a_low * b_low) >> 16);
                let carry = (middle & 0xffff) + a_low * b_high;
                a_high * b_high + (middle >> 16) + (carry >> 16)
            }
            #[inline(always)]
            fn shift_by(self, bits: Self) -> Self {
                self >> bits
            }
            #[inline(always)]
            fn shift_signed(self, bits: u32) -> Self {
                (self.bitcast::<$signed<S>>() >> bits).bitcast()
            }
            #[inline(always)]
            fn to_real(self) -> $reals<S> {
                self.bitcast::<$signed<S>>().to_float()
            }
            #[inline(always)]
            fn less_than(self, other: Self) -> $masks<S> {
                self.simd_lt(other)
            }
            #[inline(always)]
            fn equals(self, other: u32) -> $masks<S> {
                self.simd_eq(Self::splat(self.simd, other))
            }
            #[inline(always)]
            fn pick(self, table: &[f32; PICK_COUNT]) -> $reals<S> {
                $pick_few(self, table)
            }
            #[inline(always)]
            fn look_up(self, rows: &[[f32; 4]]) -> [$reals<S>; 4] {
                let rows = $pick::<_, _, 1>(self, rows);
                $columns(
                    self.simd,
                    #[inline(always)]
                    |lane| f32x4::load_array_ref(self.simd, &rows.at(lane)[0]),
                )
            }
            #[inline(always)]
            fn look_up_words(self, rows: &[[u32; 4]]) -> [Self; 4] {
                let rows = $pick::<_, _, 1>(self, rows);
                let [x, y, z, w] = $columns(
                    self.simd,
                    #[inline(always)]
                    |lane| u32x4::load_array_ref(self.simd, &rows.at(lane)[0]).bitcast(),
                );
                [x.bitcast(), y.bitcast(), z.bitcast(), w.bitcast()]
            }
            #[inline(always)]
            fn look_up_two(self, rows: &[[u32; 4]]) -> [[Self; 4]; 2] {
                let rows = $pick::<_, _, 2>(self, rows);
                let [a, b, c, d] = $columns(
                    self.simd,
                    #[inline(always)]
                    |lane| u32x4::load_array_ref(self.simd, &rows.at(lane)[0]).bitcast(),
                );
                let [x, y, z, w] = $columns(
                    self.simd,
                    #[inline(always)]
                    |lane| u32x4::load_array_ref(self.simd, &rows.at(lane)[1]).bitcast(),
                );
                [
                    [a.bitcast(), b.bitcast(), c.bitcast(), d.bitcast()],
                    [x.bitcast(), y.bitcast(), z.bitcast(), w.bitcast()],
                ]
            }
            #[inline(always)]
            fn look_up_pairs(self, rows: &[[f32; 4]]) -> [$reals<S>; 2] {
                $pairs(self, rows)
            }
            #[inline(always)]
            fn look_up_word(self, words: &[u32]) -> Self {
                let picked = $pick::<_, _, 1>(self, words);
                let mut found = [0; $lanes];
                for (lane, word) in found.iter_mut().enumerate() {
                    *word = picked.at(lane)[0];
                }
                Self::load_array(self.simd, found)
            }
            #[inline(always)]
            fn dot_halves(self, other: Self) -> $reals<S> {
                $halves(self, other).to_real()
            }
        }

        impl<S: Simd> Mask for $masks<S> {
            type Real = $reals<S>;
            type Word = $words<S>;

            #[inline(always)]
            fn any(self) -> bool {
                self.any_true()
            }
            #[inline(always)]
            fn select(self, yes: $words<S>, no: $words<S>) -> $words<S> {
                Select::select(self, yes, no)
            }
            #[inline(always)]
            fn select_real(self, yes: $reals<S>, no: $reals<S>) -> $reals<S> {
                Select::select(self, yes, no)
            }
        }

        impl<S: Simd> Pack for $reals<S> {
            type Simd = S;
            type Spans<'a, const N: usize> = Picked<'a, [f32; 4], $lanes, N>;
            const LANES: usize = $lanes;

            #[inline(always)]
            fn fill(simd: S, value: f32) -> Self {
                SimdBase::splat(simd, value)
            }
            #[inline(always)]
            fn load(simd: S, floats: &[f32]) -> Self {
                Self::load_array_ref(simd, floats.first_chunk().expect("enough floats for all lanes"))
            }
            #[inline(always)]
            fn load_words(simd: S, words: &[u32]) -> $words<S> {
                $words::load_array_ref(simd, words.first_chunk().expect("enough words for all lanes"))
            }
            #[expect(clippy::cast_possible_truncation, reason = "no more than sixteen lanes")]
            #[inline(always)]
            fn bits_of(mask: $masks<S>) -> u32 {
                mask.to_bitmask() as u32
            }
            #[inline(always)]
            fn store(self, floats: &mut [f32]) {
                self.store_array(floats.first_chunk_mut().expect("room for all lanes"));
            }
            #[inline(always)]
            fn transpose_in_fours(rows: [Self; 4]) -> [Self; 4] {
                $fours(rows)
            }
            #[inline(always)]
            fn spans<const N: usize>(index: $words<S>, rows: &[[f32; 4]]) -> Self::Spans<'_, N> {
                $pick(index, rows)
            }
            #[inline(always)]
            fn column<const N: usize>(simd: S, spans: &Self::Spans<'_, N>, row: usize) -> [Self; 4] {
                $columns(
                    simd,
                    #[inline(always)]
                    |lane| f32x4::load_array_ref(simd, &spans.at(lane)[row]),
                )
            }
        }

        /// For each lane the `N` elements that start at its index. All indices are checked at once: a check for each,
        /// with a branch, cost a tenth of a step, and keeps the compiler from mixing the work on neighbouring lanes.
        ///
        /// # Panics
        /// If an index is too large.
        #[inline(always)]
        fn $pick<S: Simd, T, const N: usize>(index: $words<S>, elements: &[T]) -> Picked<'_, T, $lanes, N> {
            const { assert!(size_of::<T>().is_power_of_two(), "an index shifted is an offset") };
            let end = elements.len().saturating_sub(N - 1);
            let addressable = u32::MAX >> size_of::<T>().trailing_zeros();
            let end = u32::try_from(end).unwrap_or(addressable).min(addressable);
            let inside = index.simd_lt($words::splat(index.simd, end));
            assert!(inside.all_true(), "an index lies beyond the table");
            Picked { elements, offsets: (index << size_of::<T>().trailing_zeros()).to_array() }
        }
    };
}

/// `N` elements for each lane.
#[derive(Clone, Copy, Debug)]
pub struct Picked<'a, T, const LANES: usize, const N: usize> {
    elements: &'a [T],
    /// Bytes before the elements of each lane, all of which are in the slice.
    offsets: [u32; LANES],
}

impl<'a, T, const LANES: usize, const N: usize> Picked<'a, T, LANES, N> {
    #[inline(always)]
    fn at(&self, lane: usize) -> &'a [T; N] {
        // SAFETY: whoever makes this checks for every lane that index + N - 1 < elements.len(), and that the index times the size of
        // an element, which the offset is, fits a word. Processors do not address rows of 16 bytes by index.
        #[expect(unsafe_code, reason = "checked for all lanes at once")]
        unsafe {
            let first: *const u8 = self.elements.as_ptr().cast();
            &*first.add(self.offsets[lane] as usize).cast()
        }
    }
}

pack!(
    8 f32x8 u32x8 i32x8 mask32x8, pick pick_eight,
    columns columns_of_four, fours transpose_eight_in_fours, pairs pairs_of_eight, halves dot_halves_of_eight, few pick_of_eight
);
pack!(
    16 f32x16 u32x16 i32x16 mask32x16, pick pick_sixteen,
    columns columns_of_sixteen, fours transpose_sixteen_in_fours, pairs pairs_of_sixteen, halves dot_halves_of_sixteen, few pick_of_sixteen
);

/// Rows of which only two floats are asked for.
#[inline(always)]
fn pairs_of_eight<S: Simd>(index: u32x8<S>, rows: &[[f32; 4]]) -> [f32x8<S>; 2] {
    let simd = index.simd;
    let rows = pick_eight::<_, _, 1>(index, rows);
    let two = |lane: usize| {
        let ([[a, b, ..]], [[c, d, ..]]) = (rows.at(lane), rows.at(lane + 1));
        f32x4::load_array(simd, [*a, *b, *c, *d])
    };
    let (low, high) = (simd.combine_f32x4(two(0), two(2)), simd.combine_f32x4(two(4), two(6)));
    let (first, second) = low.deinterleave(high);
    [first, second]
}

#[inline(always)]
fn pairs_of_sixteen<S: Simd>(index: u32x16<S>, rows: &[[f32; 4]]) -> [f32x16<S>; 2] {
    let [first, second, _, _] = index.look_up(rows);
    [first, second]
}
