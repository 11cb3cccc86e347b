// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A set of leaves as it is drawn, page by page.

use std::iter;
use std::mem::offset_of;
use std::ops::Range;

use windfall_wgpu::LeafColumns;

use super::burning::BurningPass;
use super::cull::{CullPass, View};
use super::meshes::LEVELS;
use super::page::Page;
use super::record::LeafDraw;
use crate::trees::SceneTrees;
use crate::trees::records::TreeRecords;

/// Leaves that are drawn together.
#[derive(Debug)]
pub(crate) struct VisibleLeaves {
    pub(crate) pages: Vec<Page>,
}

impl VisibleLeaves {
    /// Room for `leaf_count` leaves, the first of them those of the trees of `scene_trees`.
    pub(crate) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        cull: &CullPass,
        scene_trees: &SceneTrees,
        leaf_count: u32,
    ) -> Self {
        Self { pages: Page::all(device, queue, &cull.page_layouts, scene_trees, leaf_count) }
    }

    /// Culls the leaves of `columns`, with their `marks` if they are painted, for a view: a number of those that were
    /// announced.
    pub(crate) fn cull(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        cull: &CullPass,
        (columns, marks, tree_records): (&LeafColumns<'_>, Option<&wgpu::Buffer>, &TreeRecords),
        view: View,
    ) {
        let leaf_count = columns.leaf_count;
        for page in &self.pages {
            let identity = marks.unwrap_or(columns.identity);
            let columns = [columns.place, columns.attitude, columns.schedule, identity];
            match page.windows(columns, leaf_count) {
                None => encoder.clear_buffer(&page.draws, 0, None),
                Some(windows) => cull.run(device, encoder, page, windows, tree_records, view),
            }
        }
    }

    /// Marks the leaves of `columns` that burn, by the column of their burning, in what the last culling left.
    pub(crate) fn mark_burning(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        burning: &BurningPass,
        (columns, burns): (&LeafColumns<'_>, &wgpu::Buffer),
    ) {
        for page in &self.pages {
            if let Some(windows) = page.windows([burns], columns.leaf_count) {
                let [burns] = windows;
                burning.run(device, encoder, page, burns);
            }
        }
    }

    /// Draws some levels of detail of what the last culling left; the pipeline and bind groups 0 to 2 are set.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, levels: Range<usize>) {
        for page in &self.pages {
            pass.set_bind_group(3, &page.group, &[]);
            page.draw(pass, levels.clone());
        }
    }

    /// Draws the small leaves that the last culling left, in the light found for them; the pipeline and bind groups 0 to 2 are set.
    pub(crate) fn draw_lit(&self, pass: &mut wgpu::RenderPass<'_>) {
        for page in &self.pages {
            pass.set_bind_group(3, &page.lit_group, &[]);
            page.draw(pass, 0..1);
        }
    }

    /// Draws a square for each leaf that the last culling left, but for small ones; the pipeline and bind groups 0 to 2 are set.
    pub(crate) fn draw_squares(&self, pass: &mut wgpu::RenderPass<'_>) {
        for page in &self.pages {
            pass.set_bind_group(3, &page.group, &[]);
            page.draw_squares(pass);
        }
    }

    /// Draws all levels with the rows of `columns`, of which `leaf_count` are used, bound behind the records; the pipeline and bind groups 0 to 2 are set.
    pub(crate) fn draw_with<const N: usize>(
        &self,
        device: &wgpu::Device,
        pass: &mut wgpu::RenderPass<'_>,
        layout: &wgpu::BindGroupLayout,
        columns: [&wgpu::Buffer; N],
        leaf_count: u32,
    ) {
        for page in &self.pages {
            let Some(windows) = page.windows(columns, leaf_count) else { continue };
            let records = page.records.as_entire_buffer_binding();
            let bound = iter::once(records).chain(windows).zip(0..);
            let entries: Vec<_> = bound
                .map(|(buffer, binding)| wgpu::BindGroupEntry {
                    binding,
                    resource: wgpu::BindingResource::Buffer(buffer),
                })
                .collect();
            let descriptor = wgpu::BindGroupDescriptor {
                label: Some("leaf records and columns"),
                layout,
                entries: &entries,
            };
            pass.set_bind_group(3, &device.create_bind_group(&descriptor), &[]);
            page.draw(pass, 0..LEVELS);
        }
    }

    /// Layout of the draw that a vertex belongs to, a stride of nought: first record and level.
    pub(crate) fn layout() -> wgpu::VertexBufferLayout<'static> {
        const fn word(offset: usize, shader_location: u32) -> wgpu::VertexAttribute {
            wgpu::VertexAttribute {
                format: wgpu::VertexFormat::Uint32,
                offset: offset as u64,
                shader_location,
            }
        }
        const ATTRIBUTES: [wgpu::VertexAttribute; 2] =
            [word(offset_of!(LeafDraw, first_record), 0), word(offset_of!(LeafDraw, level), 1)];
        let step_mode = wgpu::VertexStepMode::Instance;
        wgpu::VertexBufferLayout { array_stride: 0, step_mode, attributes: &ATTRIBUTES }
    }
}
