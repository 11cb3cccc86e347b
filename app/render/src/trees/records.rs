// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! What all parts of one tree share, for the shaders: one record for every tree, and one for leaves of no tree.

use super::{BarkKind, Stand, StandingTree};
use crate::gpu::upload;

/// Least radius of a drawn twig in pixels: thinner ones would fall between the samples.
const TWIG_PX: f32 = 0.55;

/// `Stem` of `stem.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
struct StemRecord {
    center_turned: [f32; 4],
    radii_range: [f32; 4],
    tint_cluster: [f32; 4],
    bark: [f32; 4],
    /// First slot of its leaves and the one after the last.
    slots: [u32; 4],
}

/// Leaves that belong to no tree.
const NO_STEM: StemRecord = StemRecord {
    center_turned: [0.0, 0.0, 0.0, -1.0],
    radii_range: [1.0, 1.0, 1.0, 0.0],
    tint_cluster: [1.0; 4],
    bark: [0.0; 4],
    slots: [0; 4],
};

/// Bytes of a record.
const STRIDE: u64 = size_of::<StemRecord>() as u64;
const ATTRIBUTES: [wgpu::VertexAttribute; 4] =
    wgpu::vertex_attr_array![5 => Float32x4, 6 => Float32x4, 7 => Float32x4, 8 => Float32x4];

/// The records of all trees.
#[derive(Debug)]
pub(crate) struct Stems {
    buffer: wgpu::Buffer,
}

impl Stems {
    pub(crate) fn new(device: &wgpu::Device, queue: &wgpu::Queue, stand: &Stand) -> Self {
        let mut next = 0;
        let records: Vec<StemRecord> =
            std::iter::once(NO_STEM).chain(stand.trees.iter().map(|tree| record(tree, &mut next))).collect();
        let usage = wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::STORAGE;
        let bytes = bytemuck::cast_slice(&records);
        Self { buffer: upload::buffer(device, queue, "stems", usage, bytes) }
    }

    /// The records of no tree and of all trees.
    pub(crate) fn buffer(&self) -> &wgpu::Buffer {
        &self.buffer
    }

    /// The record of a tree, or of no tree, as the only one of a vertex buffer.
    pub(crate) fn of(&self, tree: Option<usize>) -> wgpu::BufferSlice<'_> {
        let index = tree.map_or(0, |tree| tree as u64 + 1);
        self.buffer.slice(index * STRIDE..(index + 1) * STRIDE)
    }

    /// Layout of a buffer that holds one record for everything drawn: a stride of nought.
    pub(crate) fn layout() -> wgpu::VertexBufferLayout<'static> {
        let step_mode = wgpu::VertexStepMode::Instance;
        wgpu::VertexBufferLayout { array_stride: 0, step_mode, attributes: &ATTRIBUTES }
    }
}

/// The record of a tree whose leaves have the slots from `next` on, which moves behind them.
fn record(tree: &StandingTree, next: &mut u32) -> StemRecord {
    let first = *next;
    *next += tree.leaves;
    let (crown, look) = (&tree.crown, &tree.look);
    let kind = BarkKind::ALL.iter().position(|&kind| kind == look.bark).unwrap_or(0);
    StemRecord {
        center_turned: crown.center_m.extend(look.turned).to_array(),
        radii_range: crown.radii_m.extend(look.turned_range).to_array(),
        tint_cluster: look.tint.extend(tree.cluster as f32).to_array(),
        bark: [kind as f32, look.own, f32::from(u8::from(look.is_low)), TWIG_PX],
        slots: [first, *next, 0, 0],
    }
}
