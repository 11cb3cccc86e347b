// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Several floats, words or truth values side by side in SIMD registers: eight, or sixteen where registers are that wide.

mod lanes;

use bytemuck::{must_cast_ref, must_cast_slice};
use fearless_simd::Simd;

use super::lane::{Mask, Real, Word};

/// Rows that packs take together: two packs of eight or one of sixteen.
pub const BLOCK: usize = 16;

/// The row of a block that lane number `lane` holds. Records of four floats that follow one another come into lanes in
/// this order, and out of them, without crossing the blocks of four floats that shuffles are cheap within.
#[inline(always)]
pub const fn row_of_lane(lane: usize) -> usize {
    4 * (lane % 4) + lane / 4
}

/// The rows of a block's lanes, as [`row_of_lane`] says.
#[expect(clippy::cast_possible_truncation, reason = "sixteen rows")]
pub const ROWS_OF_LANES: [u32; BLOCK] = {
    let mut rows = [0; BLOCK];
    let mut lane = 0;
    while lane < BLOCK {
        rows[lane] = row_of_lane(lane) as u32;
        lane += 1;
    }
    rows
};

/// A bit for each row of a block, the first in the lowest place, from a bit for each lane.
#[inline(always)]
pub const fn rows_of_bits(lanes: u32) -> u32 {
    // Lane and row are a place in a square of four by four and its mirror image.
    let kept = lanes & 0x8421;
    let near = ((lanes & 0x0842) << 3) | ((lanes >> 3) & 0x0842);
    let next = ((lanes & 0x0084) << 6) | ((lanes >> 6) & 0x0084);
    let far = ((lanes & 0x0008) << 9) | ((lanes >> 9) & 0x0008);
    kept | near | next | far
}

/// Several floats side by side.
pub trait Pack: Real {
    /// The instructions.
    type Simd: Simd;
    /// As many rows for each lane.
    type Spans<'a, const N: usize>;
    /// Number of floats.
    const LANES: usize;

    /// One float for all lanes.
    fn fill(simd: Self::Simd, value: f32) -> Self;
    /// The first floats of a slice.
    fn load(simd: Self::Simd, floats: &[f32]) -> Self;
    /// The first words of a slice.
    fn load_words(simd: Self::Simd, words: &[u32]) -> Self::Word;
    /// A bit for each lane, the first in the lowest place.
    fn bits_of(mask: Self::Mask) -> u32;
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

/// Two words of each record of a block of which pack number `part` holds its lanes.
#[inline(always)]
pub fn load_pairs<P: Pack>(simd: P::Simd, records: &[[u32; 2]; BLOCK], part: usize) -> [P::Word; 2] {
    let rows = P::load_words(simd, &ROWS_OF_LANES[part * P::LANES..]);
    let twos: &[[u32; 4]; BLOCK / 2] = must_cast_ref(records);
    let [x, y, next_x, next_y] = (rows >> 1).look_up_words(twos);
    let is_next = (rows & 1).equals(1);
    [is_next.select(next_x, x), is_next.select(next_y, y)]
}

/// The reverse of [`load_pairs`], for the lanes of which a bit is set.
#[inline(always)]
pub fn store_pairs<P: Pack>(records: &mut [[u32; 2]; BLOCK], part: usize, words: [P::Word; 2], lanes: u32) {
    let [mut x, mut y] = [[0.0; BLOCK]; 2];
    P::from_bits(words[0]).store(&mut x);
    P::from_bits(words[1]).store(&mut y);
    for lane in 0..P::LANES {
        if lanes >> lane & 1 == 1 {
            records[row_of_lane(part * P::LANES + lane)] = [x[lane].to_bits(), y[lane].to_bits()];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::lane::PICK_COUNT;
    use fearless_simd::{Level, SimdBase, dispatch, f32x8, f32x16};

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
        let indices = [3, 0, 18, 7, 7, 11, 1, 16, 2, 2, 17, 5, 9, 0, 14, 6];
        let halves: [u32; BLOCK] =
            std::array::from_fn(|lane| word_of(lane).wrapping_mul(0x9e37_79b9) ^ 0x8000);
        let weights: [u32; BLOCK] = std::array::from_fn(|lane| (512 - word_of(lane)) | (word_of(lane) << 16));
        let table: [f32; PICK_COUNT] = std::array::from_fn(|number| number as f32 - 7.5);
        let few: [u32; BLOCK] = std::array::from_fn(|lane| word_of(lane * 7 % PICK_COUNT));
        let picked = numbers(P::load_words(simd, &few).pick(&table));
        let index = P::load_words(simd, &indices);
        let rows = index.look_up(&fours).map(numbers);
        let ones = numbers(P::from_bits(index.look_up_word(words.as_flattened())));
        let two = index.look_up_two(&words);
        let [bits, next] = two.map(|row| row.map(|word| numbers(P::from_bits(word))));
        let pairs = index.look_up_pairs(&fours).map(numbers);
        let dots = numbers(P::load_words(simd, &halves).dot_halves(P::load_words(simd, &weights)));
        let spans = P::spans::<5>(index, &fours);
        let further = P::column(simd, &spans, 4).map(numbers);
        for (lane, index) in indices.into_iter().enumerate().take(P::LANES) {
            assert_eq!([0, 1, 2, 3].map(|part| rows[part][lane]), index.look_up(&fours), "row {index}");
            assert_eq!([0, 1, 2, 3].map(|part| bits[part][lane]), index.look_up(&fours), "words {index}");
            let after = (index + 1).look_up(&fours);
            assert_eq!([0, 1, 2, 3].map(|part| next[part][lane]), after, "words after {index}");
            assert_eq!(ones[lane].to_bits(), words.as_flattened()[index as usize], "word {index}");
            assert_eq!([0, 1].map(|part| pairs[part][lane]), index.look_up_pairs(&fours), "pair {index}");
            assert_eq!(picked[lane], few[lane].pick(&table), "number {}", few[lane]);
            assert_eq!(dots[lane], halves[lane].dot_halves(weights[lane]), "halves of lane {lane}");
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

        let pairs = records.map(|[x, y, ..]| [x, y].map(f32::to_bits));
        let mut some = [[0; 2]; BLOCK];
        for part in 0..BLOCK / P::LANES {
            let words = load_pairs::<P>(simd, &pairs, part);
            for (number, word) in words.into_iter().enumerate() {
                for (lane, float) in numbers(P::from_bits(word)).into_iter().enumerate() {
                    let row = row_of_lane(part * P::LANES + lane);
                    assert_eq!(float, records[row][number], "word {number} of row {row}");
                }
            }
            store_pairs::<P>(&mut some, part, words, 0b1111_0101_1111_0101);
        }
        for lane in 0..BLOCK {
            let row = row_of_lane(lane);
            let is_stored = 0b1111_0101 >> (lane % 8) & 1 == 1;
            assert_eq!(some[row], if is_stored { pairs[row] } else { [0; 2] }, "pair of row {row}");
        }
    }

    #[test]
    fn bits_of_lanes_become_bits_of_rows() {
        for lane in 0..BLOCK {
            assert_eq!(rows_of_bits(1 << lane), 1 << row_of_lane(lane), "lane {lane}");
        }
        assert_eq!(rows_of_bits(0xffff), 0xffff, "all of them");
    }

    /// Truth values come out as bits, the first lane in the lowest place.
    #[inline(always)]
    fn count_alike<P: Pack>(simd: P::Simd) {
        let lanes: [u32; BLOCK] = std::array::from_fn(word_of);
        let bits = P::bits_of(P::load_words(simd, &lanes).less_than(P::load_words(simd, &[3; BLOCK])));
        assert_eq!(bits, 0b111, "the first three of {} lanes", P::LANES);
    }

    #[expect(clippy::cast_possible_truncation, reason = "sixteen lanes")]
    fn word_of(lane: usize) -> u32 {
        lane as u32
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
            dispatch!(level, simd => count_alike::<f32x8<_>>(simd));
            dispatch!(level, simd => count_alike::<f32x16<_>>(simd));
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
