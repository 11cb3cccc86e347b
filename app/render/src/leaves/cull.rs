// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Chooses on the device which leaves a view shows, and how finely.
//!
//! One pass over the leaves counts how many each thread keeps of every level of detail; one workgroup adds the counts up;
//! a second pass lists those that are kept behind one another, in the order of their slots; and a third writes their
//! records, with no thread idle for a leaf that is out of sight. There are no atomics: their order would show where two
//! leaves lie equally deep.

use windfall_core::layout::Float4;

use super::page::{Page, PageLayouts};
use super::record::{CULL_GROUP_SIZE, ViewUniform};
use super::species_table::SpeciesTable;
use crate::frame::cascades::{CASCADES, MAPS};
use crate::frame::sides::Sides;
use crate::gpu::pipeline::{bind_buffers, buffer_entry, layout};
use crate::gpu::shaders::compile;
use crate::trees::records::TreeRecords;

/// Views of a frame, each with its own uniform block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum View {
    /// View of the camera.
    Camera,
    /// View of the camera in water.
    Mirror,
    /// View of a shadow map from the sun, or from above.
    Shadow(usize),
    /// The same of leaves of scenery, whose shadows are coarser.
    SceneryShadow(usize),
}

/// Least edges in pixels of the pictures of leaves drawn as coarse, medium and fine meshes: a triangle then covers about
/// eight pixels or more. Below the last one pictures are thinned out.
pub(crate) const LIMITS_PX: [f32; 4] = [18.0, 48.0, 150.0, 1.8];
/// The same for shadows, whose texels are averaged: no finer mesh than the coarse one, and thinned out sooner.
const SHADOW_LIMITS_PX: [f32; 4] = [60.0, f32::MAX, f32::MAX, 6.0];
/// The same from above, where only shares of sky matter.
const ABOVE_LIMITS_PX: [f32; 4] = [f32::MAX, f32::MAX, f32::MAX, 9.0];
/// Most workgroups that write records: enough to fill a large device.
const MAX_WRITERS: u32 = 1024;
/// Share of the usual fineness that shadows of scenery have.
pub(crate) const SCENERY_SHARE: f32 = 0.35;
/// Least share of leaves that are kept, however small: those that are kept are at most four times as wide.
const LEAST_SHARE: f32 = 1.0 / 16.0;

impl ViewUniform {
    /// The view of a camera at `eye_m`, with `pixels_per_m` at one metre, drawn with a share of the usual fineness.
    pub(crate) fn perspective(clip: [[f32; 4]; 4], eye_m: [f32; 3], pixels_per_m: f32, share: f32) -> Self {
        Self { eye_m, is_parallel: 0, ..Self::with(clip, pixels_per_m, LIMITS_PX, share) }
    }

    /// The view of map number `map` with `pixels_per_m`, drawn with a share of the usual fineness.
    pub(crate) fn parallel(clip: [[f32; 4]; 4], pixels_per_m: f32, map: usize, share: f32) -> Self {
        let limits = if map < CASCADES as usize { SHADOW_LIMITS_PX } else { ABOVE_LIMITS_PX };
        Self::with(clip, pixels_per_m, limits, share)
    }

    fn with(clip: [[f32; 4]; 4], pixels_per_m: f32, limits_px: [f32; 4], share: f32) -> Self {
        let [coarse_px, medium_px, fine_px, thin_px] = limits_px.map(|limit_px| limit_px / share);
        Self {
            sides: Sides::of(clip).0.map(Float4),
            eye_m: [0.0; 3],
            pixels_per_m,
            coarse_px,
            medium_px,
            fine_px,
            thin_px,
            least_share: LEAST_SHARE * share,
            is_parallel: 1,
            padding: [0; 8],
        }
    }
}

/// The pipelines of the culling.
#[derive(Debug)]
pub(crate) struct CullPass {
    pub(crate) page_layouts: PageLayouts,
    page_layout: wgpu::BindGroupLayout,
    columns_layout: wgpu::BindGroupLayout,
    species_table: wgpu::BindGroup,
    views: [wgpu::Buffer; 2 + 2 * MAPS],
    steps: [wgpu::ComputePipeline; 4],
    /// True if leaves bring marks with them.
    pub(crate) is_painted: bool,
}

impl CullPass {
    /// The pipelines; `is_painted` for leaves in the colours of their marks.
    pub(crate) fn new(device: &wgpu::Device, species_table: &SpeciesTable, is_painted: bool) -> Self {
        let compute = wgpu::ShaderStages::COMPUTE;
        let read = wgpu::BufferBindingType::Storage { read_only: true };
        let write = wgpu::BufferBindingType::Storage { read_only: false };
        let uniform = |binding| buffer_entry(binding, wgpu::BufferBindingType::Uniform, compute);
        let group = |label, entries: &[wgpu::BindGroupLayoutEntry]| {
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries })
        };
        let page_layout = group(
            "leaf page",
            &[
                uniform(0),
                uniform(1),
                buffer_entry(2, read, compute),
                buffer_entry(3, write, compute),
                buffer_entry(4, write, compute),
                buffer_entry(5, write, compute),
            ],
        );
        let columns_layout =
            group("leaf columns", &[0, 1, 2, 3].map(|binding| buffer_entry(binding, read, compute)));
        let kinds_layout = group("leaf species_table", &[uniform(0)]);
        let module = compile(device, &super::shaders(), "leaves/cull");
        let constants = [("IS_PAINTED", f64::from(u8::from(is_painted)))];
        let layout = layout(device, &[Some(&page_layout), Some(&columns_layout), Some(&kinds_layout)]);
        let steps = ["count", "arrange", "list", "write"].map(|entry_point| {
            device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(entry_point),
                layout: Some(&layout),
                module: &module,
                entry_point: Some(entry_point),
                compilation_options: wgpu::PipelineCompilationOptions {
                    constants: &constants,
                    ..Default::default()
                },
                cache: None,
            })
        });
        let views = [(); 2 + 2 * MAPS].map(|()| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("leaf view"),
                size: size_of::<ViewUniform>() as u64,
                usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        });
        let species_table = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("leaf species_table"),
            layout: &kinds_layout,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: species_table.uniform.as_entire_binding(),
            }],
        });
        Self {
            page_layouts: PageLayouts::new(device),
            page_layout,
            columns_layout,
            species_table,
            views,
            steps,
            is_painted,
        }
    }

    /// Sets what a view sees in the frames to come.
    pub(crate) fn write(&self, queue: &wgpu::Queue, view: View, uniform: &ViewUniform) {
        queue.write_buffer(self.buffer(view), 0, bytemuck::bytes_of(uniform));
    }

    fn buffer(&self, view: View) -> &wgpu::Buffer {
        match view {
            View::Camera => &self.views[0],
            View::Mirror => &self.views[1],
            View::Shadow(map) => &self.views[2 + map.min(MAPS - 1)],
            View::SceneryShadow(map) => &self.views[2 + MAPS + map.min(MAPS - 1)],
        }
    }

    /// Fills the records and draws of a page from a window of place, attitude, schedule and identity, or marks in place of
    /// identities if leaves are painted.
    pub(crate) fn run(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        page: &Page,
        columns: [wgpu::BufferBinding<'_>; 4],
        tree_records: &TreeRecords,
        view: View,
    ) {
        let own = [
            self.buffer(view),
            &page.buffers.uniform,
            tree_records.buffer(),
            &page.buffers.chosen,
            &page.draws,
            &page.records,
        ];
        let own = bind_buffers(device, "leaf page", &self.page_layout, &own);
        let entries: Vec<_> = (0u32..)
            .zip(columns)
            .map(|(binding, window)| wgpu::BindGroupEntry {
                binding,
                resource: wgpu::BindingResource::Buffer(window),
            })
            .collect();
        let columns = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("leaf columns"),
            layout: &self.columns_layout,
            entries: &entries,
        });
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("leaf culling"),
            timestamp_writes: None,
        });
        pass.set_bind_group(0, &own, &[]);
        pass.set_bind_group(1, &columns, &[]);
        pass.set_bind_group(2, &self.species_table, &[]);
        let groups = page.uniform.threads.div_ceil(CULL_GROUP_SIZE);
        let writers = page.uniform.count.div_ceil(CULL_GROUP_SIZE).min(MAX_WRITERS);
        for (step, groups) in self.steps.iter().zip([groups, 1, groups, writers]) {
            pass.set_pipeline(step);
            pass.dispatch_workgroups(groups, 1, 1);
        }
    }
}
