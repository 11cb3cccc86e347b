// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Eight floats, words or truth values in SIMD registers, and leaf records in and out of them.

use fearless_simd::{
    Bytes, Select, Simd, SimdBase, SimdFloat, SimdInt, SimdMask, f32x4, f32x8, i32x8, mask32x8, u32x4, u32x8,
};

use super::lane::{LANES, Mask, Real, WHOLE_ANCHOR, Word};
use super::transpose::{columns_of_eight, columns_of_four, rows_apart, rows_of_four};

impl<S: Simd> Real for f32x8<S> {
    type Word = u32x8<S>;
    type Mask = mask32x8<S>;

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
    fn to_bits(self) -> u32x8<S> {
        self.bitcast()
    }
    #[inline(always)]
    fn from_bits(bits: u32x8<S>) -> Self {
        bits.bitcast()
    }
    #[inline(always)]
    fn to_whole(self) -> u32x8<S> {
        Real::to_bits(self + WHOLE_ANCHOR) - WHOLE_ANCHOR.to_bits()
    }
    #[inline(always)]
    fn less_than(self, other: Self) -> mask32x8<S> {
        self.simd_lt(other)
    }
}

impl<S: Simd> Word for u32x8<S> {
    type Real = f32x8<S>;
    type Mask = mask32x8<S>;

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
        (self.bitcast::<i32x8<S>>() >> bits).bitcast()
    }
    #[inline(always)]
    fn to_real(self) -> f32x8<S> {
        self.bitcast::<i32x8<S>>().to_float()
    }
    #[inline(always)]
    fn less_than(self, other: Self) -> mask32x8<S> {
        self.simd_lt(other)
    }
    #[inline(always)]
    fn equals(self, other: u32) -> mask32x8<S> {
        self.simd_eq(Self::splat(self.simd, other))
    }
    #[inline(always)]
    fn look_up(self, rows: &[[f32; 4]]) -> [f32x8<S>; 4] {
        columns_of_four(pick(self, rows).map(|[row]| f32x4::load_array_ref(self.simd, row)))
    }
    #[inline(always)]
    fn look_up_words(self, rows: &[[u32; 4]]) -> [Self; 4] {
        let rows = pick(self, rows).map(|[row]| u32x4::load_array_ref(self.simd, row).bitcast());
        columns_of_four(rows).map(Bytes::bitcast)
    }
    #[inline(always)]
    fn look_up_pairs(self, rows: &[[f32; 4]]) -> [f32x8<S>; 2] {
        let simd = self.simd;
        let pairs = pick(self, rows).map(|[row]| [row[0], row[1]]);
        let two = |lane: usize| {
            let ([a, b], [c, d]) = (pairs[lane], pairs[lane + 1]);
            f32x4::load_array(simd, [a, b, c, d])
        };
        let (low, high) = (simd.combine_f32x4(two(0), two(2)), simd.combine_f32x4(two(4), two(6)));
        let (first, second) = low.deinterleave(high);
        [first, second]
    }
    #[inline(always)]
    fn look_up_blend(self, rows: &[[f32; 8]], t: f32x8<S>) -> [f32x8<S>; 8] {
        let simd = self.simd;
        let (rows, t) = (pick(self, rows), t.to_array());
        columns_of_eight(core::array::from_fn(|lane| {
            let [a, b]: &[[f32; 8]; 2] = rows[lane];
            let (a, b) = (f32x8::load_array_ref(simd, a), f32x8::load_array_ref(simd, b));
            a + f32x8::splat(simd, t[lane]) * (b - a)
        }))
    }
}

impl<S: Simd> Mask for mask32x8<S> {
    type Real = f32x8<S>;
    type Word = u32x8<S>;

    #[inline(always)]
    fn any(self) -> bool {
        self.any_true()
    }
    #[inline(always)]
    fn select(self, yes: u32x8<S>, no: u32x8<S>) -> u32x8<S> {
        Select::select(self, yes, no)
    }
    #[inline(always)]
    fn select_real(self, yes: f32x8<S>, no: f32x8<S>) -> f32x8<S> {
        Select::select(self, yes, no)
    }
}

/// For each lane the `N` elements that start at its index. All indices are checked at once: eight checks, each with a
/// branch, cost a tenth of a step, and keep the compiler from mixing the work on neighbouring lanes.
///
/// # Panics
/// If an index is too large.
#[inline(always)]
fn pick<S: Simd, T, const N: usize>(index: u32x8<S>, elements: &[T]) -> [&[T; N]; LANES] {
    let end = elements.len().saturating_sub(N - 1);
    let inside = index.simd_lt(u32x8::splat(index.simd, u32::try_from(end).unwrap_or(u32::MAX)));
    assert!(inside.all_true(), "an index lies beyond the table");
    let index = index.to_array();
    core::array::from_fn(|lane| {
        // SAFETY: `inside` says of every lane that index + N - 1 < elements.len().
        #[expect(unsafe_code, reason = "checked for all lanes at once")]
        let chunk = unsafe { elements.get_unchecked(index[lane] as usize..index[lane] as usize + N) };
        chunk.first_chunk().expect("N elements were asked for")
    })
}

/// Eight records of four words to four columns.
#[inline(always)]
pub fn load_records<S: Simd>(simd: S, records: &[[u32; 4]; LANES]) -> [u32x8<S>; 4] {
    let at = |lane: usize| u32x4::load_array_ref(simd, &records[lane]).bitcast();
    columns_of_four([at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7)]).map(Bytes::bitcast)
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

/// Eight records of four floats, wherever each lies, to four columns.
#[inline(always)]
pub fn gather_records<S: Simd>(simd: S, records: [&[f32; 4]; LANES]) -> [f32x8<S>; 4] {
    let [a, b, c, d, e, f, g, h] = records;
    columns_of_four([
        f32x4::load_array_ref(simd, a),
        f32x4::load_array_ref(simd, b),
        f32x4::load_array_ref(simd, c),
        f32x4::load_array_ref(simd, d),
        f32x4::load_array_ref(simd, e),
        f32x4::load_array_ref(simd, f),
        f32x4::load_array_ref(simd, g),
        f32x4::load_array_ref(simd, h),
    ])
}

/// Four columns to eight records of four floats, wherever each lies.
#[inline(always)]
pub fn scatter_records<S: Simd>(records: [&mut [f32; 4]; LANES], columns: [f32x8<S>; 4]) {
    let [a, b, c, d, e, f, g, h] = records;
    let [p, q, r, s, t, u, v, w] = rows_apart(columns);
    p.store_array(a);
    q.store_array(b);
    r.store_array(c);
    s.store_array(d);
    t.store_array(e);
    u.store_array(f);
    v.store_array(g);
    w.store_array(h);
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
    use fearless_simd::{Level, SimdFrom, dispatch};

    /// Looks every kind of row up in lanes and one by one.
    #[inline(always)]
    fn agree<S: Simd>(simd: S) {
        let fours: Vec<[f32; 4]> =
            (0..40u8).map(|row| [0, 1, 2, 3].map(|part| f32::from(row * 4 + part))).collect();
        let eights: Vec<[f32; 8]> =
            fours.chunks_exact(2).map(|pair| std::array::from_fn(|part| pair[part / 4][part % 4])).collect();
        let indices = [3, 0, 18, 7, 7, 11, 1, 16];
        let index = u32x8::simd_from(simd, indices);
        let blend = [0.0, 0.25, 1.0, 0.5, 0.75, 0.125, 0.0, 1.0];
        let rows = index.look_up(&fours).map(SimdBase::to_array);
        let pairs = index.look_up_pairs(&fours).map(SimdBase::to_array);
        let blends = index.look_up_blend(&eights, f32x8::simd_from(simd, blend)).map(SimdBase::to_array);
        for (lane, index) in indices.into_iter().enumerate() {
            assert_eq!(rows.map(|row| row[lane]), index.look_up(&fours), "row {index}");
            assert_eq!(pairs.map(|pair| pair[lane]), index.look_up_pairs(&fours), "pair {index}");
            assert_eq!(
                blends.map(|part| part[lane]),
                index.look_up_blend(&eights, blend[lane]),
                "blend {index}"
            );
        }
        let mut words = 0..;
        let mut records: [[u32; 4]; LANES] =
            std::array::from_fn(|_| std::array::from_fn(|_| words.next().expect("endless")));
        let before = records;
        let columns = load_records(simd, &records);
        assert_eq!(columns[2].to_array()[5], 22, "third word of the sixth record");
        let shifted = columns.map(|column| column.plus(column.all(100)));
        store_records(&mut records, merge(index.less_than(index.all(8)), shifted, columns));
        for lane in 0..LANES {
            let expected = if indices[lane] < 8 { before[lane].map(|word| word + 100) } else { before[lane] };
            assert_eq!(records[lane], expected, "record {lane}");
        }
    }

    #[test]
    fn lanes_do_what_one_does() {
        let level = Level::new();
        dispatch!(level, simd => agree(simd));
        #[cfg(target_arch = "x86_64")]
        for level in
            [level.as_sse2().map(Level::Sse2), level.as_avx2().map(Level::Avx2)].into_iter().flatten()
        {
            dispatch!(level, simd => agree(simd));
        }
    }

    #[test]
    #[should_panic(expected = "beyond the table")]
    fn a_row_beyond_the_table_is_refused() {
        dispatch!(Level::new(), simd => {
            let [row, ..] = u32x8::splat(simd, 4).look_up(&[[0.0; 4]; 4]);
            assert_eq!(row.to_array(), [0.0; LANES], "never reached");
        });
    }
}
