// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Numbers that kernels compute with: one float and one word, or eight or sixteen of each at once.
//!
//! A kernel function is written once, over [`Real`], [`Word`] and [`Mask`]. With `f32`, `u32` and `bool` it is the
//! scalar oracle; with the SIMD vectors of `fearless_simd` (`pack.rs`) the same operations run on eight or sixteen at once,
//! lane by lane with the same bits.

use core::ops::{Add, BitAnd, BitOr, BitXor, Mul, Neg, Not, Shl, Shr, Sub};

/// Numbers of a table that [`Word::pick`] reads.
pub const PICK_COUNT: usize = 32;

/// 1.5 * 2^23: floats near it lie 1 apart, so a small whole number added to it stands in the low bits.
pub(super) const WHOLE_ANCHOR: f32 = 12_582_912.0;

/// A float, or one in each lane.
pub trait Real:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Neg<Output = Self>
    + Add<f32, Output = Self>
    + Sub<f32, Output = Self>
    + Mul<f32, Output = Self>
{
    /// The integer of the same width.
    type Word: Word<Real = Self, Mask = Self::Mask>;
    /// The truth value of the same width.
    type Mask: Mask<Real = Self, Word = Self::Word>;

    /// One number for all lanes.
    fn all(self, value: f32) -> Self;
    /// Largest whole number not above.
    fn floor(self) -> Self;
    /// This number where it is larger, else the other.
    fn max(self, other: Self) -> Self;
    /// This number where it is smaller, else the other.
    fn min(self, other: Self) -> Self;
    /// The bits.
    fn to_bits(self) -> Self::Word;
    /// The number of these bits.
    fn from_bits(bits: Self::Word) -> Self;
    /// A whole number of magnitude below 2^22 as a two's complement integer.
    fn to_whole(self) -> Self::Word;
    /// True where less.
    fn less_than(self, other: Self) -> Self::Mask;
}

/// An unsigned integer of 32 bits that wraps around, or one in each lane.
pub trait Word:
    Copy
    + BitAnd<Output = Self>
    + BitOr<Output = Self>
    + BitXor<Output = Self>
    + BitAnd<u32, Output = Self>
    + BitOr<u32, Output = Self>
    + Shl<u32, Output = Self>
    + Shr<u32, Output = Self>
{
    /// The float of the same width.
    type Real: Real<Word = Self, Mask = Self::Mask>;
    /// The truth value of the same width.
    type Mask: Mask<Real = Self::Real, Word = Self>;

    /// One word for all lanes.
    fn all(self, value: u32) -> Self;
    /// Sum modulo 2^32.
    fn plus(self, other: Self) -> Self;
    /// Difference modulo 2^32.
    fn minus(self, other: Self) -> Self;
    /// Product modulo 2^32.
    fn times(self, other: Self) -> Self;
    /// High word of the 64-bit product.
    fn times_high(self, other: Self) -> Self;
    /// Shift to the right by as many bits as another says, less than 32.
    fn shift_by(self, bits: Self) -> Self;
    /// Two's complement shift to the right.
    fn shift_signed(self, bits: u32) -> Self;
    /// Value as a float, read as two's complement.
    fn to_real(self) -> Self::Real;
    /// True where less.
    fn less_than(self, other: Self) -> Self::Mask;
    /// True where equal to a constant.
    fn equals(self, other: u32) -> Self::Mask;
    /// The numbers of a table that the words, which are below its length, stand for.
    fn pick(self, table: &[f32; PICK_COUNT]) -> Self::Real;
    /// The rows of four floats that the words stand for, component by component.
    fn look_up(self, rows: &[[f32; 4]]) -> [Self::Real; 4];
    /// The rows of four words that the words stand for, component by component.
    fn look_up_words(self, rows: &[[u32; 4]]) -> [Self; 4];
    /// The same, and the rows behind them.
    fn look_up_two(self, rows: &[[u32; 4]]) -> [[Self; 4]; 2];
    /// The first two floats of the rows that the words stand for, component by component.
    fn look_up_pairs(self, rows: &[[f32; 4]]) -> [Self::Real; 2];
    /// The words of a list that the words stand for.
    fn look_up_word(self, words: &[u32]) -> Self;
    /// Sum of the products of the lower and of the upper halves of two words, all of them two's complement, as a float.
    fn dot_halves(self, other: Self) -> Self::Real;
}

/// A truth value, or one in each lane.
pub trait Mask: Copy + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self> {
    /// The float of the same width.
    type Real;
    /// The integer of the same width.
    type Word;

    /// Returns true if true in any lane.
    fn any(self) -> bool;
    /// `yes` where true, `no` elsewhere.
    fn select(self, yes: Self::Word, no: Self::Word) -> Self::Word;
    /// `yes` where true, `no` elsewhere.
    fn select_real(self, yes: Self::Real, no: Self::Real) -> Self::Real;
}

impl Real for f32 {
    type Word = u32;
    type Mask = bool;

    #[inline(always)]
    fn all(self, value: f32) -> Self {
        value
    }
    #[inline(always)]
    fn floor(self) -> Self {
        self.floor()
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if self > other { self } else { other }
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        if self < other { self } else { other }
    }
    #[inline(always)]
    fn to_bits(self) -> u32 {
        self.to_bits()
    }
    #[inline(always)]
    fn from_bits(bits: u32) -> Self {
        f32::from_bits(bits)
    }
    #[inline(always)]
    fn to_whole(self) -> u32 {
        (self + WHOLE_ANCHOR).to_bits().wrapping_sub(WHOLE_ANCHOR.to_bits())
    }
    #[inline(always)]
    fn less_than(self, other: Self) -> bool {
        self < other
    }
}

impl Word for u32 {
    type Real = f32;
    type Mask = bool;

    #[inline(always)]
    fn all(self, value: u32) -> Self {
        value
    }
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        self.wrapping_add(other)
    }
    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        self.wrapping_sub(other)
    }
    #[inline(always)]
    fn times(self, other: Self) -> Self {
        self.wrapping_mul(other)
    }
    #[inline(always)]
    fn times_high(self, other: Self) -> Self {
        ((u64::from(self) * u64::from(other)) >> 32) as u32
    }
    #[inline(always)]
    fn shift_by(self, bits: Self) -> Self {
        self >> bits
    }
    #[inline(always)]
    fn shift_signed(self, bits: u32) -> Self {
        ((self as i32) >> bits) as u32
    }
    #[inline(always)]
    fn to_real(self) -> f32 {
        (self as i32) as f32
    }
    #[inline(always)]
    fn less_than(self, other: Self) -> bool {
        self < other
    }
    #[inline(always)]
    fn equals(self, other: u32) -> bool {
        self == other
    }
    #[inline(always)]
    fn pick(self, table: &[f32; PICK_COUNT]) -> f32 {
        table[self as usize]
    }
    #[inline(always)]
    fn look_up(self, rows: &[[f32; 4]]) -> [f32; 4] {
        rows[self as usize]
    }
    #[inline(always)]
    fn look_up_words(self, rows: &[[u32; 4]]) -> [u32; 4] {
        rows[self as usize]
    }
    #[inline(always)]
    fn look_up_two(self, rows: &[[u32; 4]]) -> [[u32; 4]; 2] {
        [rows[self as usize], rows[self as usize + 1]]
    }
    #[inline(always)]
    fn look_up_pairs(self, rows: &[[f32; 4]]) -> [f32; 2] {
        let [first, second, _, _] = rows[self as usize];
        [first, second]
    }
    #[inline(always)]
    fn look_up_word(self, words: &[u32]) -> u32 {
        words[self as usize]
    }
    #[inline(always)]
    fn dot_halves(self, other: Self) -> f32 {
        let high = |word: u32| (word as i32) >> 16;
        let low = |word: u32| high(word << 16);
        (low(self) * low(other) + high(self) * high(other)) as f32
    }
}

impl Mask for bool {
    type Real = f32;
    type Word = u32;

    #[inline(always)]
    fn any(self) -> bool {
        self
    }
    #[inline(always)]
    fn select(self, yes: u32, no: u32) -> u32 {
        if self { yes } else { no }
    }
    #[inline(always)]
    fn select_real(self, yes: f32, no: f32) -> f32 {
        if self { yes } else { no }
    }
}

/// Implements `map` and `zip_mut` for a struct of numbers and, behind the semicolon, of such structs.
macro_rules! each_number {
    ($name:ident { $($number:ident),* $(; $($part:ident),+)? }) => {
        impl<R> $name<R> {
            /// The struct with the results of `f` in place of its numbers.
            #[inline(always)]
            pub fn map<S>(&self, f: impl Fn(&R) -> S + Copy) -> $name<S> {
                $name { $($number: f(&self.$number),)* $($($part: self.$part.map(f),)+)? }
            }

            /// Calls `f` with every number, to be changed, and its counterpart in `other`.
            #[inline(always)]
            pub fn zip_mut<S>(&mut self, other: &$name<S>, f: impl Fn(&mut R, &S) + Copy) {
                $(f(&mut self.$number, &other.$number);)*
                $($(self.$part.zip_mut(&other.$part, f);)+)?
            }
        }
    };
}
pub(crate) use each_number;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_numbers_and_shifts_keep_their_sign() {
        for value in [-4_000_000.0_f32, -1.0, 0.0, 1.0, 4_000_000.0] {
            assert_eq!(value.to_whole() as i32 as f32, value, "{value}");
        }
        assert_eq!(0x8000_0000_u32.shift_signed(31), u32::MAX, "the sign fills up");
        assert_eq!(0xffff_ffff_u32.times_high(0xffff_ffff), 0xffff_fffe, "high word");
    }
}
