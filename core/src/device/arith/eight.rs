// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaf records in and out of packs of eight.

use fearless_simd::{Bytes, Simd, SimdBase, mask32x8, u32x4, u32x8};

use super::lane::{LANES, Mask};
use super::transpose::{columns_of_four, rows_of_four};

/// Eight records of four words to four columns.
#[inline(always)]
pub fn load_records<S: Simd>(simd: S, records: &[[u32; 4]; LANES]) -> [u32x8<S>; 4] {
    let at = |lane: usize| u32x4::load_array_ref(simd, &records[lane]).bitcast();
    columns_of_four(simd, at).map(Bytes::bitcast)
}

/// Four columns to eight records of four words.
#[inline(always)]
pub fn store_records<S: Simd>(records: &mut [[u32; 4]; LANES], columns: [u32x8<S>; 4]) {
    let [a, b, c, d] = columns;
    let rows = rows_of_four([a.bitcast(), b.bitcast(), c.bitcast(), d.bitcast()]);
    let pairs: &mut [[u32; 8]; LANES / 2] = bytemuck::must_cast_mut(records);
    for (pair, row) in pairs.iter_mut().zip(rows) {
        row.bitcast::<u32x8<S>>().store_array(pair);
    }
}

/// The columns of `new` where the mask is true, those of `old` elsewhere. Without branches: where leaves fall and lie
/// side by side, one for each lane would be guessed wrong half the time.
#[inline(always)]
pub fn merge<S: Simd>(mask: mask32x8<S>, new: [u32x8<S>; 4], old: [u32x8<S>; 4]) -> [u32x8<S>; 4] {
    let [a, b, c, d] = new;
    let [p, q, r, s] = old;
    [Mask::select(mask, a, p), Mask::select(mask, b, q), Mask::select(mask, c, r), Mask::select(mask, d, s)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::lane::Word;
    use fearless_simd::{Level, SimdFrom, dispatch};

    /// Records come into columns and back, and only those that the mask names are changed.
    #[inline(always)]
    fn come_and_go<S: Simd>(simd: S) {
        let mut words = 0..;
        let mut records: [[u32; 4]; LANES] =
            std::array::from_fn(|_| std::array::from_fn(|_| words.next().expect("endless")));
        let before = records;
        let columns = load_records(simd, &records);
        assert_eq!(columns[2].to_array()[5], 22, "third word of the sixth record");
        let shifted = columns.map(|column| column.plus(column.all(100)));
        let index = u32x8::simd_from(simd, [3, 0, 18, 7, 7, 11, 1, 16]);
        let changes = [true, true, false, true, true, false, true, false];
        store_records(&mut records, merge(index.less_than(index.all(8)), shifted, columns));
        for lane in 0..LANES {
            let expected = if changes[lane] { before[lane].map(|word| word + 100) } else { before[lane] };
            assert_eq!(records[lane], expected, "record {lane}");
        }
    }

    #[test]
    fn records_come_and_go() {
        let level = Level::new();
        dispatch!(level, simd => come_and_go(simd));
        #[cfg(target_arch = "x86_64")]
        for level in
            [level.as_sse2().map(Level::Sse2), level.as_avx2().map(Level::Avx2)].into_iter().flatten()
        {
            dispatch!(level, simd => come_and_go(simd));
        }
    }
}
