// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/petiole.wgsl
//!
//! Petioles: constants of the leaf slots that belong to trees.

use crate::arith::lane::Word;
use crate::context::Context;
use crate::layout::Uint4;

crate::shared_constants! {
    /// Words of four that a [`Petiole`] takes.
    pub const PETIOLE_ROWS: u32 = 3;
    /// Mask of the species in [`Petiole::bits`].
    pub const PETIOLE_SPECIES_MASK: u32 = 31;
    /// Place of the strength class.
    pub const PETIOLE_STRENGTH_SHIFT: u32 = 5;
    /// Mask of the strength class.
    pub const PETIOLE_STRENGTH_MASK: u32 = 63;
    /// Place of the tree kind.
    pub const PETIOLE_KIND_SHIFT: u32 = 11;
    /// Mask of the tree kind.
    pub const PETIOLE_KIND_MASK: u32 = 31;
    /// Place of the length.
    pub const PETIOLE_LENGTH_SHIFT: u32 = 16;
    /// Mask of the length.
    pub const PETIOLE_LENGTH_MASK: u32 = 255;
    /// Metres per unit of the length.
    pub const PETIOLE_LENGTH_UNIT: f32 = 1.0 / 256.0;
    /// Place of the cluster.
    pub const PETIOLE_CLUSTER_SHIFT: u32 = 24;
    /// Wind speeds, in steps of 1 m/s from none, that have a chance to break of their own.
    pub const SHED_SPEEDS: u32 = 64;
    /// Classes of strength of a tree kind's petioles.
    pub const SHED_CLASSES: u32 = 64;
    /// Words of four that a tree kind's chances take.
    pub const SHED_ROWS: u32 = 64 * 64 / 4;
    /// Steps between two samples of the wind at a petiole, a power of two.
    pub const SHED_INTERVAL: u32 = 8;
}

crate::shared_struct! {
    /// Constants of a leaf slot of a tree.
    #[derive(Default)]
    pub struct Petiole {
        /// Base of the petiole in the frame of its segment in m.
        pub base: [f32; 3],
        /// Row of the segment; [`NO_SEGMENT`](crate::tree::record::NO_SEGMENT) for a slot that no leaf ever has.
        pub segment: u32,
        /// Orientation of the leaf in the frame of its segment, in still air: a quaternion x, y, z, w.
        pub rest_quaternion: [f32; 4],
        /// Centre of the blade in still air in 2^-10 m, two's complement.
        pub blade: [i32; 3],
        /// Species, strength class, tree kind, length and cluster: see [`petiole_species`] to [`petiole_cluster`].
        pub bits: u32,
    }
}

const _: () = assert!(size_of::<Petiole>() == PETIOLE_ROWS as usize * 16, "rows of four words");

/// Number of the species.
#[inline(always)]
pub fn petiole_species(bits: u32) -> u32 {
    bits & PETIOLE_SPECIES_MASK
}

/// Class of strength among those of its tree kind.
#[inline(always)]
pub fn petiole_strength<W: Word>(bits: W) -> W {
    (bits >> PETIOLE_STRENGTH_SHIFT) & PETIOLE_STRENGTH_MASK
}

/// Number of the tree kind.
#[inline(always)]
pub fn petiole_kind<W: Word>(bits: W) -> W {
    (bits >> PETIOLE_KIND_SHIFT) & PETIOLE_KIND_MASK
}

/// Distance from the petiole's base to the blade's centre in m.
#[inline(always)]
pub fn petiole_length<W: Word>(bits: W) -> W::Real {
    ((bits >> PETIOLE_LENGTH_SHIFT) & PETIOLE_LENGTH_MASK).to_real() * PETIOLE_LENGTH_UNIT
}

/// Size in 2^-4 of its own that the leaf is drawn with on its twig, where it may stand for several.
#[inline(always)]
pub fn petiole_cluster(bits: u32) -> u32 {
    bits >> PETIOLE_CLUSTER_SHIFT
}

/// Bits of a petiole; lengths and clusters are as large as fits.
pub(crate) fn petiole_bits(species: u32, strength: u32, kind: u32, length: u32, cluster: u32) -> u32 {
    species
        | (strength << PETIOLE_STRENGTH_SHIFT)
        | (kind << PETIOLE_KIND_SHIFT)
        | (length.min(PETIOLE_LENGTH_MASK) << PETIOLE_LENGTH_SHIFT)
        | (cluster.min(u32::MAX >> PETIOLE_CLUSTER_SHIFT) << PETIOLE_CLUSTER_SHIFT)
}

/// Petiole of a tree's slot.
pub fn petiole_of(cx: &Context<'_>, slot: u32) -> Petiole {
    let first = (cx.scene.first_petiole_row + slot * PETIOLE_ROWS) as usize;
    let rows: &[Uint4; PETIOLE_ROWS as usize] = cx.tables[first..].first_chunk().expect("a slot of a tree");
    bytemuck::cast(*rows)
}
