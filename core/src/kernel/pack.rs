// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Several floats, words or truth values side by side in SIMD registers: eight, or sixteen where registers are that wide.

use bytemuck::must_cast_slice;
use fearless_simd::{
    Bytes, Select, Simd, SimdBase, SimdFloat, SimdInt, SimdMask, f32x4, f32x8, f32x16, i32x8, i32x16,
    mask32x8, mask32x16, u32x4, u32x8, u32x16,
};

use super::lane::{Mask, Real, WHOLE_ANCHOR, Word};
use super::transpose::{
    columns_of_eight, columns_of_four, columns_of_sixteen, transpose_eight_in_fours,
    transpose_sixteen_in_fours,
};

/// Rows that packs take together: two packs of eight or one of sixteen.
pub const BLOCK: usize = 16;

/// The row of a block that lane number `lane` holds. Records of four floats that follow one another come into lanes in
/// this order, and out of them, without crossing the blocks of four floats that shuffles are cheap within.
pub const fn row_of_lane(lane: usize) -> usize {
    4 * (lane % 4) + lane / 4
}

/// Several floats side by side.
pub trait Pack: Real {
    /// The instructions.
    type Simd: Simd;
    /// As many rows for each lane.
    type Spans<'a, const N: usize>;
    /// How many floats.
    const LANES: usize;

    /// One float for all lanes.
    fn fill(simd: Self::Simd, value: f32) -> Self;
    /// The first floats of a slice.
    fn load(simd: Self::Simd, floats: &[f32]) -> Self;
    /// The first words of a slice.
    fn load_words(simd: Self::Simd, words: &[u32]) -> Self::Word;
    /// Into the first floats of a slice.
    fn store(self, floats: &mut [f32]);
    /// Transposes four vectors within each four lanes.
    fn transpose_in_fours(rows: [Self; 4]) -> [Self; 4];
    /// `N` rows from every index on.
    ///
    /// # Panics
    /// If there are not as many for any lane.
    fn spans<const N: usize>(index: Self::Word, rows: &[[f32; 4]]) -> Self::Spans<'_, N>;
    /// Row number `row` of every lane's rows, component by component.
    fn column<const N: usize>(simd: Self::Simd, spans: &Self::Spans<'_, N>, row: usize) -> [Self; 4];
}

/// The records of a block of which pack number `part` holds its lanes.
#[inline(always)]
pub fn load_block<P: Pack>(simd: P::Simd, records: &[[f32; 4]; BLOCK], part: usize) -> [P; 4] {
    let floats: &[f32] = must_cast_slice(records);
    let at = part * P::LANES;
    P::transpose_in_fours([
        P::load(simd, &floats[at..]),
        P::load(simd, &floats[BLOCK + at..]),
        P::load(simd, &floats[2 * BLOCK + at..]),
        P::load(simd, &floats[3 * BLOCK + at..]),
    ])
}

/// The reverse of [`load_block`].
#[inline(always)]
pub fn store_block<P: Pack>(records: &mut [[f32; 4]; BLOCK], part: usize, columns: [P; 4]) {
    let floats: &mut [f32] = bytemuck::must_cast_slice_mut(records);
    let at = part * P::LANES;
    let [a, b, c, d] = P::transpose_in_fours(columns);
    a.store(&mut floats[at..]);
    b.store(&mut floats[BLOCK + at..]);
    c.store(&mut floats[2 * BLOCK + at..]);
    d.store(&mut floats[3 * BLOCK + at..]);
}

macro_rules! pack {
    (
        $lanes:literal $reals:ident $words:ident $signed:ident $masks:ident, pick $pick:ident,
        columns $columns:ident, fours $fours:ident, pairs $pairs:ident, blend $blend:ident
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
            fn look_up(self, rows: &[[f32; 4]]) -> [$reals<S>; 4] {
                let rows = $pick::<_, _, 1>(self, rows);
                $columns(self.simd, |lane| f32x4::load_array_ref(self.simd, &rows.at(lane)[0]))
            }
            #[inline(always)]
            fn look_up_words(self, rows: &[[u32; 4]]) -> [Self; 4] {
                let rows = $pick::<_, _, 1>(self, rows);
                let load = |lane| u32x4::load_array_ref(self.simd, &rows.at(lane)[0]).bitcast();
                let [x, y, z, w] = $columns(self.simd, load);
                [x.bitcast(), y.bitcast(), z.bitcast(), w.bitcast()]
            }
            #[inline(always)]
            fn look_up_pairs(self, rows: &[[f32; 4]]) -> [$reals<S>; 2] {
                $pairs(self, rows)
            }
            #[inline(always)]
            fn look_up_blend(self, rows: &[[f32; 8]], t: $reals<S>) -> [$reals<S>; 8] {
                $blend(self, rows, t)
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
                $columns(simd, |lane| f32x4::load_array_ref(simd, &spans.at(lane)[row]))
            }
        }

        /// For each lane the `N` elements that start at its index. All indices are checked at once: a check for each,
        /// with a branch, cost a tenth of a step, and keeps the compiler from mixing the work on neighbouring lanes.
        ///
        /// # Panics
        /// If an index is too large.
        #[inline(always)]
        fn $pick<S: Simd, T, const N: usize>(index: $words<S>, elements: &[T]) -> Picked<'_, T, $lanes, N> {
            let end = elements.len().saturating_sub(N - 1);
            let inside = index.simd_lt($words::splat(index.simd, u32::try_from(end).unwrap_or(u32::MAX)));
            assert!(inside.all_true(), "an index lies beyond the table");
            Picked { elements, index: index.to_array() }
        }
    };
}

/// `N` elements for each lane.
#[derive(Clone, Copy, Debug)]
pub struct Picked<'a, T, const LANES: usize, const N: usize> {
    elements: &'a [T],
    /// Where those of each lane start: all of them are in the slice.
    index: [u32; LANES],
}

impl<'a, T, const LANES: usize, const N: usize> Picked<'a, T, LANES, N> {
    #[inline(always)]
    fn at(&self, lane: usize) -> &'a [T; N] {
        let start = self.index[lane] as usize;
        // SAFETY: whoever makes this checks that index + N - 1 < elements.len() for every lane.
        #[expect(unsafe_code, reason = "checked for all lanes at once")]
        let chunk = unsafe { self.elements.get_unchecked(start..start + N) };
        chunk.first_chunk().expect("N elements were asked for")
    }
}

pack!(
    8 f32x8 u32x8 i32x8 mask32x8, pick pick_eight,
    columns columns_of_four, fours transpose_eight_in_fours, pairs pairs_of_eight, blend blend_of_eight
);
pack!(
    16 f32x16 u32x16 i32x16 mask32x16, pick pick_sixteen,
    columns columns_of_sixteen, fours transpose_sixteen_in_fours, pairs pairs_of_sixteen, blend blend_of_sixteen
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

#[inline(always)]
fn blend_of_eight<S: Simd>(index: u32x8<S>, rows: &[[f32; 8]], t: f32x8<S>) -> [f32x8<S>; 8] {
    let simd = index.simd;
    let (rows, t) = (pick_eight::<_, _, 2>(index, rows), t.to_array());
    columns_of_eight(core::array::from_fn(|lane| {
        let [a, b] = rows.at(lane);
        let (a, b) = (f32x8::load_array_ref(simd, a), f32x8::load_array_ref(simd, b));
        a + f32x8::splat(simd, t[lane]) * (b - a)
    }))
}

#[inline(always)]
fn blend_of_sixteen<S: Simd>(index: u32x16<S>, rows: &[[f32; 8]], t: f32x16<S>) -> [f32x16<S>; 8] {
    let simd = index.simd;
    let ((low, high), (t_low, t_high)) = (simd.split_u32x16(index), simd.split_f32x16(t));
    let (low, high) = (low.look_up_blend(rows, t_low), high.look_up_blend(rows, t_high));
    core::array::from_fn(|part| simd.combine_f32x8(low[part], high[part]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::lane::Word;
    use fearless_simd::{Level, dispatch};

    fn numbers<P: Pack>(pack: P) -> Vec<f32> {
        let mut floats = vec![0.0; P::LANES];
        pack.store(&mut floats);
        floats
    }

    /// Looks every kind of row up in lanes and one by one.
    #[inline(always)]
    fn look_up_alike<P: Pack>(simd: P::Simd) {
        let fours: Vec<[f32; 4]> =
            (0..40u8).map(|row| [0, 1, 2, 3].map(|part| f32::from(row * 4 + part))).collect();
        let words: Vec<[u32; 4]> = fours.iter().map(|row| row.map(f32::to_bits)).collect();
        let eights: Vec<[f32; 8]> =
            fours.chunks_exact(2).map(|pair| std::array::from_fn(|part| pair[part / 4][part % 4])).collect();
        let indices = [3, 0, 18, 7, 7, 11, 1, 16, 2, 2, 17, 5, 9, 0, 14, 6];
        let blend =
            [0.0, 0.25, 1.0, 0.5, 0.75, 0.125, 0.0, 1.0, 0.5, 0.5, 0.0, 0.25, 1.0, 0.75, 0.625, 0.375];
        let (index, t) = (P::load_words(simd, &indices), P::load(simd, &blend));
        let rows = index.look_up(&fours).map(numbers);
        let bits = index.look_up_words(&words).map(|word| numbers(P::from_bits(word)));
        let pairs = index.look_up_pairs(&fours).map(numbers);
        let blends = index.look_up_blend(&eights, t).map(numbers);
        let spans = P::spans::<5>(index, &fours);
        let further = P::column(simd, &spans, 4).map(numbers);
        for (lane, (index, t)) in indices.into_iter().zip(blend).enumerate().take(P::LANES) {
            assert_eq!([0, 1, 2, 3].map(|part| rows[part][lane]), index.look_up(&fours), "row {index}");
            assert_eq!([0, 1, 2, 3].map(|part| bits[part][lane]), index.look_up(&fours), "words {index}");
            assert_eq!([0, 1].map(|part| pairs[part][lane]), index.look_up_pairs(&fours), "pair {index}");
            let one = index.look_up_blend(&eights, t);
            assert_eq!(blends.each_ref().map(|part| part[lane]), one, "blend {index}");
            assert_eq!(
                [0, 1, 2, 3].map(|part| further[part][lane]),
                (index + 4).look_up(&fours),
                "span {index}"
            );
        }
    }

    /// Records of a block come into lanes in the order that [`row_of_lane`] gives, and back to where they were.
    #[inline(always)]
    fn turn_alike<P: Pack>(simd: P::Simd) {
        let records: [[f32; 4]; BLOCK] =
            std::array::from_fn(|row| std::array::from_fn(|part| (10 * row + part) as f32));
        let mut back = [[0.0; 4]; BLOCK];
        for part in 0..BLOCK / P::LANES {
            let columns: [P; 4] = load_block(simd, &records, part);
            for (number, column) in columns.into_iter().enumerate() {
                for (lane, float) in numbers(column).into_iter().enumerate() {
                    let row = row_of_lane(part * P::LANES + lane);
                    assert_eq!(float, records[row][number], "number {number} of row {row}");
                }
            }
            store_block(&mut back, part, columns);
        }
        assert_eq!(back, records, "as they were");
    }

    #[test]
    fn lanes_do_what_one_does() {
        let level = Level::new();
        #[cfg(target_arch = "x86_64")]
        let others = [level.as_sse2().map(Level::Sse2), level.as_avx2().map(Level::Avx2)];
        #[cfg(not(target_arch = "x86_64"))]
        let others = [];
        for level in std::iter::once(level).chain(others.into_iter().flatten()) {
            dispatch!(level, simd => look_up_alike::<f32x8<_>>(simd));
            dispatch!(level, simd => look_up_alike::<f32x16<_>>(simd));
            dispatch!(level, simd => turn_alike::<f32x8<_>>(simd));
            dispatch!(level, simd => turn_alike::<f32x16<_>>(simd));
        }
    }

    #[test]
    #[should_panic(expected = "beyond the table")]
    fn a_row_beyond_the_table_is_refused() {
        dispatch!(Level::new(), simd => {
            let [row, ..] = f32x16::splat(simd, 4.0).to_whole().look_up(&[[0.0; 4]; 4]);
            assert_eq!(numbers(row), [0.0; 16], "never reached");
        });
    }
}
