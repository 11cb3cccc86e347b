// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Pages of slots, each with room for the records of what a view shows.

use std::ops::Range;

use super::meshes::LEVELS;
use super::record::{COLUMN_BYTES, LeafDraw, LeafLight, LeafRecord, PageUniform, SLOTS_PER_THREAD};
use crate::gpu::pipeline::{bind_buffers, buffer_entry};
use crate::gpu::upload;
use crate::trees::SceneTrees;

/// Most slots of a page, and most leaves drawn from it: what the smallest binding that WebGPU allows can hold.
pub(crate) const PAGE_SLOTS: u32 = 1 << 20;
const PAGE_RECORDS: u32 = 1 << 21;
/// Pages begin at multiples of so many slots: columns can be bound at multiples of 256 bytes on every device.
const ALIGNED_SLOTS: u32 = 16;
/// Bytes of a record, of the light on it and of a draw.
const RECORD_BYTES: u64 = size_of::<LeafRecord>() as u64;
const LIGHT_BYTES: u64 = size_of::<LeafLight>() as u64;
const DRAW_BYTES: u64 = size_of::<LeafDraw>() as u64;

/// Slots that are culled together, and what comes of it.
#[derive(Debug)]
pub(crate) struct Page {
    pub(crate) uniform: PageUniform,
    /// Draws of the four levels, and of a square for each leaf that is not of the smallest.
    pub(crate) draws: wgpu::Buffer,
    pub(crate) records: wgpu::Buffer,
    /// For the culling, without the view.
    pub(crate) buffers: PageBuffers,
    /// For the drawing: the records, and of small leaves also their light.
    pub(crate) group: wgpu::BindGroup,
    pub(crate) lit_group: wgpu::BindGroup,
    /// For finding the light on small leaves.
    pub(crate) lighting: wgpu::BindGroup,
    /// Most leaves that are drawn.
    pub(crate) most_records: u32,
}

/// Layouts of what of a page is bound, other than by its culling.
#[derive(Debug)]
pub(crate) struct PageLayouts {
    /// Records, to be drawn.
    pub(crate) records: wgpu::BindGroupLayout,
    /// Records and the light on them, to be drawn.
    pub(crate) lit_records: wgpu::BindGroupLayout,
    /// Records, their light, and the draws that say which are small.
    pub(crate) lighting: wgpu::BindGroupLayout,
}

impl PageLayouts {
    pub(crate) fn new(device: &wgpu::Device) -> Self {
        let read = wgpu::BufferBindingType::Storage { read_only: true };
        let write = wgpu::BufferBindingType::Storage { read_only: false };
        let (vertex, compute) = (wgpu::ShaderStages::VERTEX, wgpu::ShaderStages::COMPUTE);
        let layout = |label, entries: &[wgpu::BindGroupLayoutEntry]| {
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries })
        };
        let records = buffer_entry(0, read, vertex);
        Self {
            records: layout("leaf records", &[records]),
            lit_records: layout("lit leaf records", &[records, buffer_entry(1, read, vertex)]),
            lighting: layout(
                "leaf lighting",
                &[
                    buffer_entry(0, read, compute),
                    buffer_entry(1, write, compute),
                    buffer_entry(2, read, compute),
                ],
            ),
        }
    }
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
        layouts: &PageLayouts,
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
            Self::new(device, queue, layouts, uniform, records)
        };
        split(&trees, leaf_count).into_iter().map(page).collect()
    }

    /// A page with room for so many `records`.
    fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        layouts: &PageLayouts,
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
        let most_records = records.max(1);
        let records = buffer("leaf records", u64::from(most_records) * RECORD_BYTES, storage);
        let lights = buffer("light on leaves", u64::from(most_records) * LIGHT_BYTES, storage);
        let draws = buffer("leaf draws", (LEVELS + 1) as u64 * DRAW_BYTES, storage | indirect);
        let bind = |label, layout, buffers: &[&wgpu::Buffer]| bind_buffers(device, label, layout, buffers);
        let group = bind("leaf records", &layouts.records, &[&records]);
        let lit_group = bind("lit leaf records", &layouts.lit_records, &[&records, &lights]);
        let lighting = bind("leaf lighting", &layouts.lighting, &[&records, &lights, &draws]);
        let bytes = bytemuck::bytes_of(&uniform);
        Self {
            uniform,
            draws,
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
            lit_group,
            lighting,
            most_records,
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

    /// Draws some of its levels; all bind groups are set.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, levels: Range<usize>) {
        // Near leaves are finer: they hide the others.
        levels.rev().for_each(|level| self.draw_one(pass, level));
    }

    /// Draws a square for each leaf that is not of the smallest; all bind groups are set.
    pub(crate) fn draw_squares(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.draw_one(pass, LEVELS);
    }

    fn draw_one(&self, pass: &mut wgpu::RenderPass<'_>, number: usize) {
        let at = number as u64 * DRAW_BYTES;
        pass.set_vertex_buffer(0, self.draws.slice(at..at + DRAW_BYTES));
        pass.draw_indirect(&self.draws, at);
    }
}

/// Pages of a world whose first leaves grew on trees of so many leaves that stand for so many each: first slot, number
/// of slots, and most leaves drawn from them.
fn split(trees: &[(u32, u32)], leaf_count: u32) -> Vec<(u32, u32, u32)> {
    let most = trees.iter().map(|(_, cluster)| *cluster).max().unwrap_or(1).max(1);
    let step = (PAGE_RECORDS / most).min(PAGE_SLOTS) / ALIGNED_SLOTS * ALIGNED_SLOTS;
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
        for cluster in [4, 7, 30] {
            let pages = split(&[(1_000_000, cluster)], 1_500_000);
            assert!(
                pages.iter().all(|(_, count, records)| *count <= PAGE_SLOTS && *records <= PAGE_RECORDS),
                "{pages:?}"
            );
            assert!(pages.iter().all(|(first, ..)| first % 16 == 0), "columns can be bound there: {pages:?}");
            assert_eq!(pages.iter().map(|page| page.1).sum::<u32>(), 1_500_000, "every slot");
            let copies = 1_000_000 * cluster + 500_000;
            assert_eq!(pages.iter().map(|page| page.2).sum::<u32>(), copies, "every copy");
        }
        assert_eq!(split(&[], 0), [], "nothing for no leaves");
    }
}
