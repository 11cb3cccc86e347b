// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Veins as a graph, and what can grow one.

use glam::Vec2;

use crate::{Blade, TexgenError};

/// A point on a vein.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VeinNode {
    /// Position in pixels of the blade's picture.
    pub position: Vec2,
    /// Index of the node one step nearer to the root, always lower than the node's own; `None` for the root.
    pub parent: Option<u32>,
    /// Rank of the vein that leads here: 1 main, 2 lateral, 3 and more finer.
    pub order: u8,
    /// Half the vein's width in pixels; never larger than the parent's.
    pub radius: f32,
}

/// Veins of one leaf: a tree from the root, and the joins that close loops in it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VeinGraph {
    /// Nodes; the root comes first.
    pub nodes: Vec<VeinNode>,
    /// Pairs of nodes that meet though neither is the other's parent (closed venation).
    pub joins: Vec<(u32, u32)>,
}

/// A way to grow veins on a blade.
pub trait VeinGrower {
    /// Grows veins; equal blades and seeds give equal veins.
    ///
    /// # Errors
    /// [`TexgenError`] when the blade leaves no room for any vein.
    fn grow(&self, blade: &Blade, seed: u64) -> Result<VeinGraph, TexgenError>;
}
