// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The leaf columns in windows that fit in one binding each.

use windfall_core::tree::record::{BRANCH_COLUMNS, BRANCH_TURN, CarryBlock};

use super::WgpuSimulator;
use crate::buffers::{buffer, group, uniform};
use crate::pipelines::GroupLayout;

/// Leaf columns before the identities.
const COLUMNS_IN_MOTION: usize = 5;
/// Header of an empty event list.
const EVENT_LIST_HEADER: [u8; 16] = [0; 16];

/// A window of the leaf columns that fits in one binding.
#[derive(Debug)]
pub(super) struct Page {
    pub(super) leaves: u32,
    pub(super) columns: wgpu::BindGroup,
    /// The same without identities.
    pub(super) in_motion: wgpu::BindGroup,
    pub(super) events: wgpu::BindGroup,
    /// Header of `events`: lengths of the lists of even and odd steps.
    event_counts: wgpu::Buffer,
    pub(super) on_trees: Option<OnTrees>,
}

/// The leaves of a page that trees have.
#[derive(Debug)]
pub(super) struct OnTrees {
    pub(super) leaves: u32,
    pub(super) carriers: wgpu::BindGroup,
}

impl WgpuSimulator {
    /// One window of every column for each page.
    pub(super) fn bind_pages(&mut self) {
        let count = self.buffers.leaves().rows();
        let pages: Vec<Page> =
            (0..count).step_by(self.page_leaves as usize).map(|first| self.page(first)).collect();
        self.pages = pages;
    }

    /// Clears the event lists. A step clears the list of the next one; after a jump in time that is another.
    pub(super) fn clear_events(&self) {
        for page in &self.pages {
            self.gpu.queue().write_buffer(&page.event_counts, 0, &EVENT_LIST_HEADER);
        }
    }

    fn page(&self, first: u32) -> Page {
        let leaves = self.page_leaves.min(self.buffers.leaves().rows() - first);
        let blocks = || self.shared_blocks().into_iter();
        let columns = || self.buffers.leaves().windows(first, leaves);
        let all = blocks().chain(columns());
        let page = group(&self.gpu, self.pipelines.layout(GroupLayout::Leaves), all);
        let hot = blocks().chain(columns().take(COLUMNS_IN_MOTION));
        let in_motion = group(&self.gpu, self.pipelines.layout(GroupLayout::LeavesInMotion), hot);
        // Header of four counts, then a place for every leaf; new buffers are zero.
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST;
        let event_counts =
            buffer(&self.gpu, "event_list", EVENT_LIST_HEADER.len() as u64 + u64::from(leaves) * 4, usage);
        let events = group(
            &self.gpu,
            self.pipelines.layout(GroupLayout::OneBuffer),
            [event_counts.as_entire_binding()],
        );
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
                carriers: group(&self.gpu, self.pipelines.layout(GroupLayout::Carriers), carriers),
            }
        });
        Page { leaves, columns: page, in_motion, events, event_counts, on_trees }
    }
}
