// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The leaf columns in windows that fit in one binding each.

use super::WgpuSimulator;
use crate::buffers::{buffer, group};
use crate::columns::RECORD_BYTES;

/// A window of the leaf columns that fits in one binding.
#[derive(Debug)]
pub(super) struct Page {
    pub(super) leaves: u32,
    pub(super) columns: wgpu::BindGroup,
    pub(super) due: wgpu::BindGroup,
    pub(super) on_trees: Option<OnTrees>,
}

/// The leaves of a page that trees have.
#[derive(Debug)]
pub(super) struct OnTrees {
    pub(super) leaves: u32,
    pub(super) carried: wgpu::BindGroup,
    pub(super) carriers: wgpu::BindGroup,
}

impl WgpuSimulator {
    /// One window of every column for each page.
    pub(super) fn bind_pages(&mut self) {
        let count = self.leaves.leaf_count();
        let pages: Vec<Page> =
            (0..count).step_by(self.page_leaves as usize).map(|first| self.page(first)).collect();
        self.pages = pages;
    }

    fn page(&self, first: u32) -> Page {
        let leaves = self.page_leaves.min(self.leaves.leaf_count() - first);
        let window = |buffer| {
            wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                buffer,
                offset: u64::from(first) * RECORD_BYTES,
                size: wgpu::BufferSize::new(u64::from(leaves) * RECORD_BYTES),
            })
        };
        let up_to_wind = || self.sway_blocks().into_iter();
        let columns = || self.leaves.buffers().iter().map(window);
        let resources = up_to_wind().chain(columns()).chain([self.motion.1.as_entire_binding()]);
        let page = group(&self.gpu, &self.pipelines.leaves_layout, resources);
        // Header of four counts, then a place for every leaf; new buffers are zero.
        let due = buffer(&self.gpu, "due", 16 + u64::from(leaves) * 4, wgpu::BufferUsages::STORAGE);
        let due = group(&self.gpu, &self.pipelines.extra_layout, [due.as_entire_binding()]);
        let tree_leaves = self.environment.scene().tree_leaf_count().saturating_sub(first).min(leaves);
        let forest = self.forest.as_ref().filter(|_| tree_leaves > 0);
        let on_trees = forest.map(|forest| {
            let carried = up_to_wind().chain(columns().take(4));
            let block = buffer(&self.gpu, "carry", 16, wgpu::BufferUsages::UNIFORM);
            self.gpu.queue().write_buffer(&block, 0, bytemuck::bytes_of(&[first, forest.stride(), 0, 0]));
            let [branches, bearing] = forest.carriers();
            let petioles = self.petioles.1.as_entire_binding();
            let carriers = [block.as_entire_binding(), petioles, branches, bearing];
            OnTrees {
                leaves: tree_leaves,
                carried: group(&self.gpu, &self.pipelines.carried_layout, carried),
                carriers: group(&self.gpu, &self.pipelines.carrier_layout, carriers),
            }
        });
        Page { leaves, columns: page, due, on_trees }
    }
}
