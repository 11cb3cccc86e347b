// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves of several kinds together.

use crate::Layer;

/// Leaf pictures and meshes of several kinds, ready for an array texture.
#[derive(Clone, Debug)]
pub struct Atlas {
    /// Side of each picture in texels.
    pub size_px: u32,
    /// Leaves of each kind.
    pub variants: u32,
    /// All leaves: variant `v` of kind `k` is layer `k * variants + v`.
    pub layers: Vec<Layer>,
}
