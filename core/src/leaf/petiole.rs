// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Petioles: constants of the leaf slots that belong to trees.

use bytemuck::{Pod, Zeroable};

crate::shared_constants! {
    /// Words of four that a [`Petiole`] takes.
    pub const PETIOLE_ROWS: u32 = 3;
    /// Mask of the species in [`Petiole::facts`].
    pub const PETIOLE_SPECIES_MASK: u32 = 31;
    /// Place of the strength class.
    pub const PETIOLE_CLASS_SHIFT: u32 = 5;
    /// Mask of the strength class.
    pub const PETIOLE_CLASS_MASK: u32 = 63;
    /// Place of the tree kind.
    pub const PETIOLE_KIND_SHIFT: u32 = 11;
    /// Mask of the tree kind.
    pub const PETIOLE_KIND_MASK: u32 = 31;
    /// Place of the distance from the petiole's base to the blade's centre.
    pub const PETIOLE_REACH_SHIFT: u32 = 16;
    /// Mask of it.
    pub const PETIOLE_REACH_MASK: u32 = 255;
    /// Metres per unit of it.
    pub const PETIOLE_REACH_UNIT: f32 = 1.0 / 256.0;
    /// Place of how much larger than it is a leaf is drawn on its twig, as it stands for others, in 2^-4.
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

/// Constants of a leaf slot of a tree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C, align(16))]
pub struct Petiole {
    /// Base of the petiole in the frame of its segment in m.
    pub at: [f32; 3],
    /// Row of the segment; [`NO_SEGMENT`](crate::tree::record::NO_SEGMENT) for a slot that no leaf ever has.
    pub segment: u32,
    /// Orientation x, y, z, w of the leaf in the frame of its segment, in still air.
    pub rest: [f32; 4],
    /// Centre of the blade in still air in 2^-10 m, two's complement.
    pub place: [i32; 3],
    /// Species, strength class, tree kind, reach and cluster.
    pub facts: u32,
}

const _: () = assert!(size_of::<Petiole>() == PETIOLE_ROWS as usize * 16, "rows of four words");
