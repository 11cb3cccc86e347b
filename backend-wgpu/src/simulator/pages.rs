// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The leaf columns in windows that fit in one binding each.

use windfall_core::device::leaf::collide::{COLLISION_CELL_BITS, CollisionSums};
use windfall_core::tree::record::{BRANCH_COLUMNS, BRANCH_TURN, CarryBlock};

use super::WgpuSimulator;
use crate::buffers::{buffer, group, uniform};
use crate::lists::{active_bytes, empty_events, event_bytes};
use crate::pipelines::GroupLayout;

/// Leaf columns before the identities.
const COLUMNS_IN_MOTION: usize = 5;
/// Leaf columns before the airs.
const COLUMNS_ON_TWIGS: usize = 4;

/// A window of the leaf columns that fits in one binding.
#[derive(Debug)]
pub(super) struct Page {
    pub(super) leaves: u32,
    pub(super) columns: wgpu::BindGroup,
    /// The same without identities.
    pub(super) in_motion: wgpu::BindGroup,
    /// All columns, and the litter to be written; `None` without any that changes.
    pub(super) with_litter: Option<wgpu::BindGroup>,
    pub(super) active: List,
    pub(super) events: List,
    pub(super) on_trees: Option<OnTrees>,
}

/// A buffer of lists of leaves or of cells, bound for kernels that read it and for those that fill it.
#[derive(Debug)]
pub(super) struct List {
    pub(super) buffer: wgpu::Buffer,
    pub(super) read: wgpu::BindGroup,
    pub(super) filled: wgpu::BindGroup,
}

/// The leaves of a page that trees have.
#[derive(Debug)]
pub(super) struct OnTrees {
    pub(super) leaves: u32,
    /// The columns of the page without airs and identities.
    pub(super) columns: wgpu::BindGroup,
    pub(super) carriers: wgpu::BindGroup,
}

impl WgpuSimulator {
    /// One window of every column for each page.
    pub(super) fn bind_pages(&mut self) {
        let count = self.buffers.leaves().rows();
        let pages: Vec<Page> =
            (0..count).step_by(self.page_leaves as usize).map(|first| self.page(first)).collect();
        self.pages = pages;
        self.clear_events();
    }

    /// Clears the event lists. A step clears the list of the next one; after a jump in time that is another.
    pub(super) fn clear_events(&self) {
        for page in &self.pages {
            let empty = empty_events();
            self.gpu.queue().write_buffer(&page.events.buffer, 0, bytemuck::cast_slice(&empty));
        }
    }

    fn page(&self, first: u32) -> Page {
        let leaves = self.page_leaves.min(self.buffers.leaves().rows() - first);
        let blocks = || self.shared_blocks().into_iter();
        let columns = || self.buffers.leaves().windows(first, leaves);
        let bound = |layout, count| {
            group(&self.gpu, self.pipelines.layout(layout), blocks().chain(columns().take(count)))
        };
        let tree_leaves = self.compiled.scene().tree_leaf_count().saturating_sub(first).min(leaves);
        let on_trees = (self.forest.is_some() && tree_leaves > 0).then(|| {
            let branches = self.buffers.branches();
            let stride = branches.stride(BRANCH_TURN as usize);
            let block = CarryBlock { first_slot: first, column_stride: stride, unused: [0; 2] };
            let block = uniform(&self.gpu, "carry", &block);
            let carriers = [
                block.as_entire_binding(),
                branches.buffer(BRANCH_TURN as usize).as_entire_binding(),
                branches.buffer(BRANCH_COLUMNS as usize).as_entire_binding(),
            ];
            OnTrees {
                leaves: tree_leaves,
                columns: bound(GroupLayout::LeavesOnTwigs, COLUMNS_ON_TWIGS),
                carriers: group(&self.gpu, self.pipelines.layout(GroupLayout::Carriers), carriers),
            }
        });
        let carried = on_trees.as_ref().map_or(0, |on_trees| on_trees.leaves);
        let is_living = self.compiled.block().has_living_litter();
        // Leaves that carriers or the litter may let go within a window.
        let kept = if is_living { leaves } else { carried };
        Page {
            leaves,
            columns: bound(GroupLayout::Leaves, usize::MAX),
            in_motion: bound(GroupLayout::LeavesInMotion, COLUMNS_IN_MOTION),
            with_litter: is_living.then(|| bound(GroupLayout::LeavesAndLitter, usize::MAX)),
            active: self.list("active_list", active_bytes(leaves, kept)),
            events: self.list("event_lists", event_bytes(leaves)),
            on_trees,
        }
    }

    /// Makes cells for the collisions of leaves, where they may collide.
    pub(super) fn make_collision_cells(&mut self) {
        if self.compiled.block().has_living_litter() && self.collisions.is_none() {
            let bytes = (size_of::<CollisionSums>() as u64) << COLLISION_CELL_BITS;
            self.collisions = Some(self.list("collision cells", bytes));
        }
    }

    fn list(&self, label: &str, bytes: u64) -> List {
        let buffer =
            buffer(&self.gpu, label, bytes, wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::INDIRECT);
        let bound = |layout| group(&self.gpu, self.pipelines.layout(layout), [buffer.as_entire_binding()]);
        let (read, filled) = (bound(GroupLayout::ReadBuffer), bound(GroupLayout::WrittenBuffer));
        List { buffer, read, filled }
    }
}
