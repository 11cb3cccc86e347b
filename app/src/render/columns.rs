// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The leaf buffers a simulator lends to the renderer.

/// Borrowed columns of leaves: one 16-byte record per leaf in each buffer, usable as vertex and storage buffers.
#[derive(Clone, Copy, Debug)]
pub struct LeafColumns<'a> {
    /// x, y, z in metres; w: bits 0-1 state (0 dormant, 1 attached, 2 falling, 3 resting), bits 9-13 species.
    pub position: &'a wgpu::Buffer,
    /// Unit quaternion x, y, z, w from the leaf's frame (blade in the XZ plane, normal +Y, tip towards +Z).
    pub orientation: &'a wgpu::Buffer,
    /// z: low 16 bits are the size relative to the species, in units of 2^-14.
    pub course: &'a wgpu::Buffer,
    /// w: bits 0-15 tint, bits 16-23 variant.
    pub identity: &'a wgpu::Buffer,
    /// Number of leaves.
    pub leaf_count: u32,
}
