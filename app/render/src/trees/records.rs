// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Data that all parts of one tree share, for the shaders: one record for every tree, and one for leaves of no tree.

use windfall_core::shared_struct;

use super::{BarkKind, SceneTrees, StandingTree};
use crate::gpu::upload;

/// Least radius of a drawn twig in pixels: thinner ones would fall between the samples.
const TWIG_PX: f32 = 0.55;

shared_struct! {
    /// A tree, as its bark and its leaves ask for it.
    pub(crate) struct TreeRecord, padding 8 {
        /// Centre of the crown.
        center_m: [f32; 3],
        /// Place of its leaves in the order of the year, negative for leaves of no tree.
        turned: f32,
        /// Half axes of the crown.
        radii_m: [f32; 3],
        /// Range of that order.
        turned_range: f32,
        /// Factor on the colour of its leaves.
        tint: [f32; 3],
        /// Leaves that one stands for.
        cluster: f32,
        /// Number of its kind of bark.
        bark_kind: u32,
        /// Random number of the tree, 0 to 1.
        own: f32,
        /// Least radius of a drawn twig in pixels.
        twig_px: f32,
        /// Diameter of its leaves in metres.
        leaf_m: f32,
        /// First slot of its leaves.
        first_slot: u32,
        /// The slot after the last.
        end_slot: u32,
    }
}

/// Leaves that belong to no tree.
const NO_TREE: TreeRecord = TreeRecord {
    center_m: [0.0; 3],
    turned: -1.0,
    radii_m: [1.0; 3],
    turned_range: 0.0,
    tint: [1.0; 3],
    cluster: 1.0,
    bark_kind: 0,
    own: 0.0,
    twig_px: 0.0,
    leaf_m: 0.0,
    first_slot: 0,
    end_slot: 0,
    padding: [0; 8],
};

/// The records of all trees.
#[derive(Debug)]
pub(crate) struct TreeRecords {
    buffer: wgpu::Buffer,
}

impl TreeRecords {
    pub(crate) fn new(device: &wgpu::Device, queue: &wgpu::Queue, scene_trees: &SceneTrees) -> Self {
        let mut next = 0;
        let records: Vec<TreeRecord> = std::iter::once(NO_TREE)
            .chain(scene_trees.trees.iter().map(|tree| record(tree, &mut next)))
            .collect();
        let usage = wgpu::BufferUsages::STORAGE;
        let bytes = bytemuck::cast_slice(&records);
        Self { buffer: upload::buffer(device, queue, "tree records", usage, bytes) }
    }

    /// The records: first that of no tree, then those of all trees.
    pub(crate) fn buffer(&self) -> &wgpu::Buffer {
        &self.buffer
    }
}

/// The record of a tree whose leaves have the slots from `next` on, which moves behind them.
fn record(tree: &StandingTree, next: &mut u32) -> TreeRecord {
    let first_slot = *next;
    *next += tree.leaves;
    let (crown, look) = (&tree.crown, &tree.look);
    let kind = BarkKind::ALL.iter().position(|&kind| kind == look.bark).unwrap_or(0);
    TreeRecord {
        center_m: crown.center_m.to_array(),
        turned: look.turned,
        radii_m: crown.radii_m.to_array(),
        turned_range: look.turned_range,
        tint: look.tint.to_array(),
        cluster: tree.cluster as f32,
        bark_kind: u32::try_from(kind).unwrap_or(0),
        own: look.own,
        twig_px: TWIG_PX,
        leaf_m: tree.leaf_m,
        first_slot,
        end_slot: *next,
        ..NO_TREE
    }
}
