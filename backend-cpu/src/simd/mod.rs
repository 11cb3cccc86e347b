// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Sets of instructions, and the layouts of records in SIMD registers behind the kernels. All sets give the same bits.

pub(crate) mod batch_blocks;
pub(crate) mod branch_block;
pub(crate) mod falling_block;
pub(crate) mod flying_block;
pub(crate) mod lanes;
pub(crate) mod leaf_block;
pub(crate) mod lying_block;
pub(crate) mod particle_block;
pub(crate) mod prefetch;
pub(crate) mod struck_block;
pub(crate) mod sway_scratch;

use fearless_simd::Level;

/// A set of instructions.
#[derive(Clone, Copy, Debug)]
pub enum Simd {
    /// One leaf after another, as the oracle is written.
    Scalar,
    /// Eight or sixteen leaves at once, with the instructions of a level.
    Lanes(Level),
}

impl Simd {
    /// The fastest set of this processor.
    pub fn best() -> Self {
        Self::Lanes(Level::new())
    }

    /// Every set of this processor.
    pub fn available() -> Vec<Self> {
        let level = Level::new();
        let mut sets = vec![Self::Scalar];
        #[cfg(target_arch = "x86_64")]
        {
            sets.extend(level.as_sse2().map(Level::Sse2).map(Self::Lanes));
            sets.extend(level.as_sse4_2().map(Level::Sse4_2).map(Self::Lanes));
            sets.extend(level.as_avx2().map(Level::Avx2).map(Self::Lanes));
            sets.extend(level.as_avx512().map(Level::Avx512).map(Self::Lanes));
        }
        #[cfg(not(target_arch = "x86_64"))]
        sets.push(Self::Lanes(level));
        sets
    }
}

/// A cache line. A function that has one on its stack keeps its stack at the bounds of lines, and with it the registers that
/// do not fit: otherwise most of those of 64 bytes straddle two lines, which cost a step of trees a tenth.
#[repr(align(64))]
#[derive(Default)]
pub(crate) struct Line {
    _words: [u64; 8],
}

/// Calls a function that is generic over packs with those of eight lanes: `function::<P>(simd, arguments…)`.
macro_rules! in_packs_of_eight {
    ($level:expr, $function:ident($($argument:expr),*)) => {
        fearless_simd::dispatch!($level, simd => {
            std::hint::black_box(&$crate::simd::Line::default());
            $function::<fearless_simd::f32x8<_>>(simd, $($argument),*)
        })
    };
}

/// Calls such a function with the widest packs of a level.
#[cfg(target_arch = "x86_64")]
macro_rules! in_packs {
    ($level:expr, $function:ident($($argument:expr),*)) => {{
        let level: fearless_simd::Level = $level;
        match level.as_avx512() {
            Some(simd) => fearless_simd::Simd::vectorize(
                simd,
                #[inline(always)]
                || {
                    std::hint::black_box(&$crate::simd::Line::default());
                    $function::<fearless_simd::f32x16<_>>(simd, $($argument),*)
                },
            ),
            None => $crate::simd::in_packs_of_eight!(level, $function($($argument),*)),
        }
    }};
}
#[cfg(not(target_arch = "x86_64"))]
pub(crate) use in_packs_of_eight as in_packs;
#[cfg(target_arch = "x86_64")]
pub(crate) use {in_packs, in_packs_of_eight};
