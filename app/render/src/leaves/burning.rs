// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves that burn: how far their fronts have run, written into the records that the culling has made; light of their rims.
//!
//! Only scenes in which leaves burn have any of this: shaders of others are built without it, and their pictures hold no arrivals.

use glam::Vec3;
use windfall_core::{shared_constants, shared_struct};

use super::page::Page;
use super::record::CULL_GROUP_SIZE;
use super::species_table::SpeciesTable;
use crate::gpu::pipeline::{buffer_entry, layout, uniform_entry};
use crate::gpu::shaders::compile;
use crate::light::black_body;

/// Most workgroups that go through the records of a page.
const MAX_GROUPS: u32 = 1024;
/// Temperature in K of a front at its hottest: what smoulders has 900 to 1100 K, and flames that lick it heat it further.
const FRONT_K: f32 = 1100.0;
/// Temperature in K and opacity of the foot of the flame that stands on it.
const FLAME_K: f32 = 1600.0;
const FLAME_OPACITY: f32 = 0.002;
/// Temperature by which its light there and behind it is measured.
const COOLER_K: f32 = 900.0;
/// Cooling behind a front in K/s: it is dark after half a second.
const COOLING_K_S: f32 = 550.0;

shared_constants! {
    /// In place of the direction out of a crown: the leaf burns, and the low half is the share of the way that its front has run.
    const BURN_BIT: u32 = 1 << 31;
    /// It lies at rest.
    const BURN_SETTLED_BIT: u32 = 1 << 30;
    /// It has been put out.
    const BURN_OUT_BIT: u32 = 1 << 29;
    /// Stages of drying by which a leaf curls until it has burnt.
    const BURN_CURL: f32 = 1.6;
}

shared_struct! {
    /// Step of a frame.
    pub(crate) struct BurningUniform {
        /// The step.
        step: u32,
        /// Zero.
        unused: u32,
        /// Zeros.
        unused_pair: [u32; 2],
    }
}

/// WGSL constants of the light of fronts.
pub(crate) fn light_constants() -> String {
    let [hot, cooler] = [FRONT_K, COOLER_K].map(black_body);
    let hot = hot + FLAME_OPACITY * black_body(FLAME_K);
    // Between two temperatures light fades about exponentially, and blue before red.
    let fading = |hot: f32, cooler: f32| {
        let per_k = (hot / cooler).ln() / (FRONT_K - COOLER_K);
        per_k * COOLING_K_S
    };
    let [red, green, blue] = [0, 1, 2].map(|channel| fading(hot[channel], cooler[channel]));
    // There is hardly any blue.
    let fade = Vec3::new(red, green, if blue.is_finite() { blue } else { green });
    let constant =
        |name: &str, Vec3 { x, y, z }: Vec3| format!("const {name} = vec3<f32>({x:?}, {y:?}, {z:?});\n");
    constant("FRONT_RADIANCE", hot) + &constant("FRONT_FADE_PER_S", fade)
}

/// Pipeline that marks the leaves which burn.
#[derive(Debug)]
pub(crate) struct BurningPass {
    uniform: wgpu::Buffer,
    layout: wgpu::BindGroupLayout,
    table: wgpu::BindGroup,
    pipeline: wgpu::ComputePipeline,
}

impl BurningPass {
    /// `None` for a scene in which no leaves burn.
    pub(crate) fn new(device: &wgpu::Device, species_table: &SpeciesTable) -> Option<Self> {
        if !species_table.leaves_burn {
            return None;
        }
        let compute = wgpu::ShaderStages::COMPUTE;
        let storage = |read_only| wgpu::BufferBindingType::Storage { read_only };
        let group_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("burning leaves"),
            entries: &[
                buffer_entry(0, wgpu::BufferBindingType::Uniform, compute),
                buffer_entry(1, storage(true), compute),
                buffer_entry(2, storage(false), compute),
                buffer_entry(3, storage(true), compute),
            ],
        });
        let mut table_entry = uniform_entry(0);
        table_entry.visibility = compute;
        let table_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("leaf species_table"),
            entries: &[table_entry],
        });
        let table = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("leaf species_table"),
            layout: &table_layout,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: species_table.uniform.as_entire_binding(),
            }],
        });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("burning leaves"),
            layout: Some(&layout(device, &[Some(&group_layout), None, Some(&table_layout)])),
            module: &compile(device, &super::shaders(), "leaves/burning"),
            entry_point: Some("mark"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        let uniform = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("burning leaves"),
            size: size_of::<BurningUniform>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Some(Self { uniform, layout: group_layout, table, pipeline })
    }

    /// Sets the step of the frames to come.
    pub(crate) fn write(&self, queue: &wgpu::Queue, step: u32) {
        let uniform = BurningUniform { step, unused: 0, unused_pair: [0; 2] };
        queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&uniform));
    }

    /// Marks the leaves of a page that burn, from a window of the column of burning; it has been culled.
    pub(crate) fn run(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        page: &Page,
        burns: wgpu::BufferBinding<'_>,
    ) {
        let resources = [
            self.uniform.as_entire_binding(),
            page.draws.as_entire_binding(),
            page.records.as_entire_binding(),
            wgpu::BindingResource::Buffer(burns),
        ];
        let entries: Vec<_> = (0..)
            .zip(resources)
            .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource })
            .collect();
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("burning leaves"),
            layout: &self.layout,
            entries: &entries,
        });
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("burning leaves"),
            timestamp_writes: None,
        });
        pass.set_bind_group(0, &group, &[]);
        pass.set_bind_group(2, &self.table, &[]);
        pass.set_pipeline(&self.pipeline);
        pass.dispatch_workgroups(page.uniform.count.div_ceil(CULL_GROUP_SIZE).min(MAX_GROUPS), 1, 1);
    }
}
