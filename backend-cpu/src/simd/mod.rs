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
pub(crate) mod snow_block;
pub(crate) mod struck_block;
pub(crate) mod sway_scratch;

use fearless_simd::Level;

/// A set of instructions.
#[derive(Clone, Copy, Debug)]
pub enum Simd {
    /// One leaf after another, as the oracle is written.
    Scalar,
    /// Eight or sixteen leaves at once.
    Lanes(LaneLevel),
}

/// Instructions that kernels are compiled for: on x86-64 AVX-512, AVX2 and SSE4.2. Each level more takes a further minute to compile, and processors
/// with nothing but SSE2 are two decades old.
#[derive(Clone, Copy, Debug)]
pub struct LaneLevel(Level);

impl LaneLevel {
    /// The level, if kernels are compiled for it.
    fn of(level: Level) -> Option<Self> {
        #[cfg(target_arch = "x86_64")]
        level.as_sse4_2()?;
        Some(Self(level))
    }

    /// The level, as the library of lanes names it.
    pub(crate) fn level(self) -> Level {
        self.0
    }
}

impl Simd {
    /// The fastest set of this processor.
    pub fn best() -> Self {
        LaneLevel::of(Level::new()).map_or(Self::Scalar, Self::Lanes)
    }

    /// Every set of this processor.
    pub fn available() -> Vec<Self> {
        let level = Level::new();
        #[cfg(target_arch = "x86_64")]
        let levels = [
            level.as_sse4_2().map(Level::Sse4_2),
            level.as_avx2().map(Level::Avx2),
            level.as_avx512().map(Level::Avx512),
        ];
        #[cfg(not(target_arch = "x86_64"))]
        let levels = [Some(level)];
        let lanes = levels.into_iter().flatten().filter_map(LaneLevel::of).map(Self::Lanes);
        std::iter::once(Self::Scalar).chain(lanes).collect()
    }
}

/// A cache line. A function that has one on its stack keeps its stack at the bounds of lines, and with it the registers that
/// do not fit: otherwise most of those of 64 bytes straddle two lines, which cost a step of trees a tenth.
#[repr(align(64))]
#[derive(Default)]
pub(crate) struct Line {
    _words: [u64; 8],
}

/// Calls a function that is generic over packs with the widest packs of a level: `function::<P>(simd, arguments…)`.
#[cfg(target_arch = "x86_64")]
macro_rules! in_packs {
    ($level:expr, $function:ident($($argument:expr),*)) => {{
        let level = $crate::simd::LaneLevel::level($level);
        macro_rules! call {
            ($simd:expr, $pack:ident) => {
                fearless_simd::Simd::vectorize(
                    $simd,
                    #[inline(always)]
                    || {
                        std::hint::black_box(&$crate::simd::Line::default());
                        $function::<fearless_simd::$pack<_>>($simd, $($argument),*)
                    },
                )
            };
        }
        if let Some(simd) = level.as_avx512() {
            call!(simd, f32x16)
        } else if let Some(simd) = level.as_avx2() {
            call!(simd, f32x8)
        } else if let Some(simd) = level.as_sse4_2() {
            call!(simd, f32x8)
        } else {
            unreachable!("a level that kernels are compiled for")
        }
    }};
}
#[cfg(not(target_arch = "x86_64"))]
macro_rules! in_packs {
    ($level:expr, $function:ident($($argument:expr),*)) => {
        fearless_simd::dispatch!($crate::simd::LaneLevel::level($level), simd => {
            std::hint::black_box(&$crate::simd::Line::default());
            $function::<fearless_simd::f32x8<_>>(simd, $($argument),*)
        })
    };
}
pub(crate) use in_packs;
