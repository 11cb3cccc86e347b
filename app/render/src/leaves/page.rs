// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Pages of slots, each with room for the records of what a view shows.

use super::meshes::LEVELS;
use super::record::{COLUMN_BYTES, LeafDraw, LeafRecord, PageUniform, SLOTS_PER_THREAD};
use crate::gpu::upload;
use crate::trees::SceneTrees;

/// Most slots of a page, and most leaves drawn from it: what the smallest binding that WebGPU allows can hold.
pub(crate) const PAGE_SLOTS: u32 = 1 << 20;
const PAGE_RECORDS: u32 = 1 << 21;
/// Bytes of a record and of a draw.
const RECORD_BYTES: u64 = size_of::<LeafRecord>() as u64;
const DRAW_BYTES: u64 = size_of::<LeafDraw>() as u64;

/// Slots that are culled together, and what comes of it.
#[derive(Debug)]
pub(crate) struct Page {
    pub(crate) uniform: PageUniform,
    /// Draws of the four levels.
    pub(crate) draws: wgpu::Buffer,
    pub(crate) records: wgpu::Buffer,
    /// For the culling, without the view.
    pub(crate) buffers: PageBuffers,
    /// For the drawing.
    pub(crate) group: wgpu::BindGroup,
}

/// Buffers that only the culling uses.
#[derive(Debug)]
pub(crate) struct PageBuffers {
    pub(crate) uniform: wgpu::Buffer,
    pub(crate) chosen: wgpu::Buffer,
}

impl Page {
    /// Pages for `leaf_count` leaves, the first of them those of the trees of `scene_trees`.
    pub(crate) fn all(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        records_layout: &wgpu::BindGroupLayout,
        scene_trees: &SceneTrees,
        leaf_count: u32,
    ) -> Vec<Self> {
        let trees: Vec<(u32, u32)> =
            scene_trees.trees.iter().map(|tree| (tree.leaves, tree.cluster)).collect();
        let records_of_trees = u32::try_from(trees.len() + 1).unwrap_or(u32::MAX);
        let page = |(first, count, records): (u32, u32, u32)| {
            let uniform = PageUniform {
                first,
                count,
                threads: count.div_ceil(SLOTS_PER_THREAD),
                trees: records_of_trees,
            };
            Self::new(device, queue, records_layout, uniform, records)
        };
        split(&trees, leaf_count).into_iter().map(page).collect()
    }

    /// A page with room for so many `records`, which drawing binds by `records_layout`.
    fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        records_layout: &wgpu::BindGroupLayout,
        uniform: PageUniform,
        records: u32,
    ) -> Self {
        let buffer = |label, size: u64, usage| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage,
                mapped_at_creation: false,
            })
        };
        let storage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        let indirect =
            wgpu::BufferUsages::INDIRECT | wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST;
        let records = buffer("leaf records", u64::from(records.max(1)) * RECORD_BYTES, storage);
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("leaf records"),
            layout: records_layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: records.as_entire_binding() }],
        });
        let bytes = bytemuck::bytes_of(&uniform);
        Self {
            uniform,
            draws: buffer("leaf draws", LEVELS as u64 * DRAW_BYTES, storage | indirect),
            buffers: PageBuffers {
                uniform: upload::buffer(device, queue, "leaf page", wgpu::BufferUsages::UNIFORM, bytes),
                chosen: buffer(
                    "chosen leaves",
                    u64::from(uniform.threads * 4 + uniform.count).max(1) * 4,
                    storage,
                ),
            },
            records,
            group,
        }
    }

    /// The parts of columns of `leaf_count` rows that this page's slots are in, if there are any.
    pub(crate) fn windows<'a, const N: usize>(
        &self,
        columns: [&'a wgpu::Buffer; N],
        leaf_count: u32,
    ) -> Option<[wgpu::BufferBinding<'a>; N]> {
        // The columns may be shorter than announced while their number changes.
        let count = self.uniform.count.min(leaf_count.saturating_sub(self.uniform.first));
        let size = wgpu::BufferSize::new(u64::from(count) * COLUMN_BYTES)?;
        let offset = u64::from(self.uniform.first) * COLUMN_BYTES;
        Some(columns.map(|buffer| wgpu::BufferBinding { buffer, offset, size: Some(size) }))
    }

    /// Draws its levels; all bind groups are set.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        // Near leaves are finer: they hide the others.
        for level in (0..LEVELS as u64).rev() {
            let at = level * DRAW_BYTES;
            pass.set_vertex_buffer(0, self.draws.slice(at..at + DRAW_BYTES));
            pass.draw_indirect(&self.draws, at);
        }
    }
}

/// Pages of a world whose first leaves grew on trees of so many leaves that stand for so many each: first slot, number
/// of slots, and most leaves drawn from them.
fn split(trees: &[(u32, u32)], leaf_count: u32) -> Vec<(u32, u32, u32)> {
    let most = trees.iter().map(|(_, cluster)| *cluster).max().unwrap_or(1).max(1);
    let step = (PAGE_RECORDS / most).min(PAGE_SLOTS);
    let records = |first: u32, end: u32| {
        let mut start = 0;
        let mut more = 0;
        for &(leaves, cluster) in trees {
            let within = (start + leaves).min(end).saturating_sub(start.max(first));
            more += within * cluster.saturating_sub(1);
            start += leaves;
        }
        end - first + more
    };
    (0..leaf_count)
        .step_by(step as usize)
        .map(|first| {
            let end = leaf_count.min(first.saturating_add(step));
            (first, end - first, records(first, end))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pages_hold_every_leaf_and_its_copies() {
        assert_eq!(split(&[(10, 3), (5, 1)], 20), [(0, 20, 40)], "ten stand for three, ten for one");
        let pages = split(&[(1_000_000, 4)], 1_500_000);
        assert!(
            pages.iter().all(|(_, count, records)| *count <= PAGE_SLOTS && *records <= PAGE_RECORDS),
            "{pages:?}"
        );
        assert!(pages.iter().all(|(first, ..)| first % 16 == 0), "columns can be bound there: {pages:?}");
        assert_eq!(pages.iter().map(|page| page.1).sum::<u32>(), 1_500_000, "every slot");
        assert_eq!(pages.iter().map(|page| page.2).sum::<u32>(), 4_500_000, "every copy");
        assert_eq!(split(&[], 0), [], "nothing for no leaves");
    }
}
