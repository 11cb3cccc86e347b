// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The leaf columns in windows that fit in one binding each.

use windfall_core::device::leaf::burn::{BURN_CELL_BITS, BURN_WORDS, BurnPage};
use windfall_core::device::leaf::collide::{COLLISION_CELL_BITS, CollisionSums};
use windfall_core::particle::{LeafParticles, leaf_particles};
use windfall_core::scene::MAX_PLUMES;
use windfall_core::tree::record::{BRANCH_COLUMNS, BRANCH_TURN, CarryBlock};

use super::WgpuSimulator;
use crate::buffers::{buffer, group, uniform};
use crate::lists::{active_bytes, empty_events, event_bytes};
use crate::particles::WINDOW_STEP;
use crate::pipelines::GroupLayout;

/// Leaf columns before the identities.
const COLUMNS_IN_MOTION: usize = 5;
/// Leaf columns before the airs.
const COLUMNS_ON_TWIGS: usize = 4;
/// Fires that leaves may feed.
#[expect(clippy::cast_possible_truncation, reason = "a few")]
const FIRES: u32 = MAX_PLUMES as u32;
/// Places and drifts.
const COLUMNS_THAT_MOVE: usize = 2;

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
    /// `None` where no leaves burn.
    pub(super) burning: Option<BurningPage>,
}

/// Bindings of the burning of the leaves of a page.
#[derive(Debug)]
pub(super) struct BurningPage {
    /// The columns of the page without airs and identities.
    pub(super) columns: wgpu::BindGroup,
    /// Burning and sums of heat, to be added to.
    pub(super) heat: wgpu::BindGroup,
    /// Burning and sums of heat, to be read.
    pub(super) heated: wgpu::BindGroup,
    /// Places and drifts of the page.
    pub(super) moved: wgpu::BindGroup,
    /// The particles of each population that is where leaves burn.
    pub(super) on_leaves: Vec<wgpu::BindGroup>,
}

/// Sums of heat in cells of the air and of the fires that leaves feed; clear between steps.
#[derive(Debug)]
pub(super) struct HeatSums {
    pub(super) buffer: wgpu::Buffer,
    pub(super) words: u32,
    pub(super) written: wgpu::BindGroup,
    /// Blocks, and the tables to be written.
    pub(super) fires: wgpu::BindGroup,
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
        let shard = self.compiled.shard_rows();
        let on_trees = shard.rows_on_trees(self.compiled.scene().tree_leaf_count());
        let tree_leaves = on_trees.saturating_sub(first).min(leaves);
        let on_trees = (self.forest.is_some() && tree_leaves > 0).then(|| {
            let branches = self.buffers.branches();
            let stride = branches.stride(BRANCH_TURN as usize);
            let block =
                CarryBlock { first_slot: shard.first_row + first, column_stride: stride, unused: [0; 2] };
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
            burning: self.heat.as_ref().map(|heat| self.burning_page(heat, first, leaves)),
        }
    }

    fn burning_page(&self, heat: &HeatSums, first: u32, leaves: u32) -> BurningPage {
        let bound = |layout, count| {
            let columns = self.buffers.leaves().windows(first, leaves).take(count);
            group(&self.gpu, self.pipelines.layout(layout), self.shared_blocks().into_iter().chain(columns))
        };
        let page = uniform(&self.gpu, "burn page", &BurnPage { first_slot: first, unused: [0; 3] });
        let burns = || wgpu::BindingResource::Buffer(self.buffers.burns().window(0, first, leaves));
        let sums = |layout| {
            let resources = [page.as_entire_binding(), burns(), heat.buffer.as_entire_binding()];
            group(&self.gpu, self.pipelines.layout(layout), resources)
        };
        let on_leaves = |run: LeafParticles| {
            let slot = run.first + first;
            let aligned = slot / WINDOW_STEP * WINDOW_STEP;
            let run = LeafParticles { first: slot - aligned, count: leaves, first_leaf: first, ..run };
            let block = uniform(&self.gpu, "leaf particles", &run);
            let columns = self.buffers.particles().windows(aligned, run.first + leaves);
            let resources = std::iter::once(block.as_entire_binding()).chain(columns).chain([burns()]);
            group(&self.gpu, self.pipelines.layout(GroupLayout::OnLeaves), resources)
        };
        let runs = leaf_particles(self.compiled.block(), self.buffers.leaves().rows());
        BurningPage {
            columns: bound(GroupLayout::LeavesOnTwigs, COLUMNS_ON_TWIGS),
            heat: sums(GroupLayout::Heat),
            heated: sums(GroupLayout::Heated),
            moved: bound(GroupLayout::LeavesThatMove, COLUMNS_THAT_MOVE),
            on_leaves: runs.map(on_leaves).collect(),
        }
    }

    /// Makes room for sums of heat, where leaves burn.
    pub(super) fn make_heat_sums(&mut self) {
        if !self.compiled.block().leaves_burn() {
            return;
        }
        let words = (BURN_WORDS << BURN_CELL_BITS) + FIRES;
        let buffer = buffer(&self.gpu, "sums of heat", u64::from(words) * 4, wgpu::BufferUsages::STORAGE);
        let written =
            group(&self.gpu, self.pipelines.layout(GroupLayout::WrittenBuffer), [buffer.as_entire_binding()]);
        let fires =
            group(&self.gpu, self.pipelines.layout(GroupLayout::BlocksAndLitter), self.shared_blocks());
        self.heat = Some(HeatSums { buffer, words, written, fires });
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
