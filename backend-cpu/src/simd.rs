// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Which instructions move the leaves. All of them give the same bits.

use fearless_simd::Level;

/// A set of instructions.
#[derive(Clone, Copy, Debug)]
pub enum Simd {
    /// One leaf after another, as the oracle is written.
    Scalar,
    /// Eight leaves at once, with the instructions of a level.
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
