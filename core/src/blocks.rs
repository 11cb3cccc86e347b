// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The uniform blocks that every kernel reads: what a scene compiles to, and what changes from step to step.
//!
//! Both backends get these same bytes, so nothing that depends on time or scene alone is computed twice.

use crate::flight::block::BodyBlock;
use crate::layout::{Float4, Uint4};
use crate::scene::{MAX_SOURCES, MAX_SPECIES, MAX_VORTICES};

crate::shared_struct! {
    /// One species, compiled.
    pub struct SpeciesBlock {
        /// Steps (2^-16) that a fall of one metre takes; half widths of the spread of size and of speed (2^-14); unused.
        pub scales: Uint4,
        /// First primitive motion, or that it flies as a body; three unused words.
        pub start: Uint4,
        /// Phase per step of each primitive motion for a leaf of nominal size and speed; two unused words.
        pub rates: [Uint4; 2],
        /// Transition counts, row by row.
        pub transitions: [Uint4; 9],
    }
}

crate::shared_struct! {
    /// One source, compiled. Lengths are integers in units of 2^-10 m, so that both contracts place leaves alike.
    pub struct SourceBlock {
        /// Centre x, y, z (two's complement) and kind (`SOURCE_BOX`, `SOURCE_DISC`, `SOURCE_SPHERE`).
        pub center: Uint4,
        /// Half extent or radius along x, y, z; unused word.
        pub extent: Uint4,
        /// First slot, slot count, step of the first release (two's complement), steps until a slot is released
        /// again (0: never).
        pub timing: Uint4,
        /// For each species the upper end of its share of random words.
        pub shares: [Uint4; SHARE_VECTORS as usize],
    }
}

crate::shared_struct! {
    /// The wind, compiled.
    pub struct WindBlock {
        /// Unit vector x, z the mean wind blows towards; mean speed at the reference height in m/s; rows of the
        /// profile table per metre.
        pub mean: Float4,
        /// Gust excess relative to the mean; rows of the gust table per metre; height of the ground in m; unused.
        pub gust: Float4,
        /// Standard deviation of the turbulence along, up and across the wind in m/s; unused.
        pub deviation: Float4,
        /// Turbulence cells per metre along, up and across the wind; unused.
        pub cells: Float4,
        /// First row of the profile, the gust and the turbulence table; number of vortices.
        pub tables: Uint4,
    }
}

crate::shared_struct! {
    /// Everything that stays the same until the environment is set anew.
    pub struct EnvironmentBlock {
        /// Seed, low and high word; number of leaf slots; number of species.
        pub seed: Uint4,
        /// Number of sources; steps until a landed leaf lies flat; steps of an orientation blend; rotation speed
        /// (2^-16).
        pub counts: Uint4,
        /// First velocity row of the motion tables; zero; whether leaves of some species fly as bodies; ticks
        /// per step in 2^-16.
        pub motion: Uint4,
        /// Step length in s; its inverse in 1/s; turns per second of 2^-32 turns per step; displacement per table
        /// displacement (fall speed over rotation speed).
        pub time: Float4,
        /// Height of the ground in m; height of resting leaves in m; speed lost to friction per second in m/s²;
        /// stopping distance per squared speed in s²/m.
        pub ground: Float4,
        /// Tilt kept per step while settling; three unused.
        pub settle: Float4,
        /// First row of the hills' table in that of the wind; cells along its edge less one; their binary logarithm;
        /// whether there are hills.
        pub terrain: Uint4,
        /// Cells per metre; height in m above which no leaf meets the ground; height of water above the ground at the
        /// origin in m; gravity in m/s².
        pub relief: Float4,
        /// The wind.
        pub wind: WindBlock,
        /// Of each species: drift kept over a step `e^(-dt/tau)`; fastest spin per step in 2^-18 turns, a whole number;
        /// time constant tau in s, which is the distance per drift speed until none is left; 1/tau in 1/s.
        pub responses: [Float4; MAX_SPECIES],
        /// The species.
        pub species: [SpeciesBlock; MAX_SPECIES],
        /// The species as bodies.
        pub bodies: [BodyBlock; MAX_SPECIES],
        /// The sources, and behind them the trees as one.
        pub sources: [SourceBlock; MAX_SOURCES + 1],
        /// Leaf slots of trees, the first of all; first petiole in its table; phase per step of fluttering in 2^-32
        /// turns; scheme that moves joints.
        pub crowns: Uint4,
    }
}

impl EnvironmentBlock {
    /// Whether the ground has hills.
    #[inline(always)]
    pub fn has_terrain(&self) -> bool {
        self.terrain.0[3] != 0
    }

    /// Whether leaves of some species fly as bodies.
    pub fn has_bodies(&self) -> bool {
        self.motion.0[2] != 0
    }
}

crate::shared_struct! {
    /// One vortex at one step.
    pub struct VortexBlock {
        /// A point of the axis x, y, z in m; squared core radius in m².
        pub center: Float4,
        /// Unit axis x, y, z; circulation over 2 pi in m²/s.
        pub axis: Float4,
        /// Axial speed at the centre times squared core radius in m³/s; three unused.
        pub axial: Float4,
    }
}

crate::shared_struct! {
    /// What changes from step to step.
    pub struct StepBlock {
        /// Index of the step; three unused words.
        pub index: Uint4,
        /// How far the mean wind has carried the gusts, in rows, and the turbulence, in cells, both within one
        /// period; two unused.
        pub offsets: Float4,
        /// The vortices where they are at this step.
        pub vortices: [VortexBlock; MAX_VORTICES],
    }
}

crate::shared_constants! {
    /// Vectors of a source's share thresholds: one word for each species.
    pub const SHARE_VECTORS: u32 = 32 / 4;
    /// Kind of a box source.
    pub const SOURCE_BOX: u32 = 0;
    /// Kind of a disc source.
    pub const SOURCE_DISC: u32 = 1;
    /// Kind of a sphere source.
    pub const SOURCE_SPHERE: u32 = 2;
    /// Metres per unit of integer lengths.
    pub const LENGTH_UNIT: f32 = 1.0 / 1024.0;
    /// Number of the trees as a source.
    pub const SOURCE_TREES: u32 = 16;
    /// A step that never comes.
    pub const NEVER: u32 = 0xffff_ffff;
}
