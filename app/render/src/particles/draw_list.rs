// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Order in which particles and parts of ribbons are drawn: all that are there, of all populations, from far to near.

use windfall_core::layout::Float4;
use windfall_core::{shared_constants, shared_struct};
use windfall_wgpu::ParticleColumns;

use super::looks::LookBuffers;
use super::paint::{PAINT_COLORS, PaintedParticles};
use crate::camera::Camera;
use crate::gpu::pipeline::{buffer_entry, layout};
use crate::gpu::radix_sort::RadixSort;
use crate::gpu::shaders::compile;

/// Most slots that are drawn: what the smallest binding that WebGPU allows can hold of a column.
pub(crate) const MAX_DRAWN: u32 = 1 << PART_SHIFT;
/// Vertices of a particle, and of a part of a ribbon: two in front of the head, and two at the ends of each of eight strips.
const VERTICES: u32 = 4;
const RIBBON_VERTICES: u32 = 20;
/// Place of the number of instances among the words of an indirect draw.
const INSTANCES_AT: u64 = 4;

shared_constants! {
    /// Threads of a workgroup.
    const LIST_THREADS: u32 = 256;
    /// Place of the number of a part of a ribbon in what is listed, one more than the part, above the slot; 0 is the particle itself.
    const PART_SHIFT: u32 = 23;
}

shared_struct! {
    /// Camera and time of a frame, for particles.
    pub(crate) struct ParticleUniform, padding 8 {
        /// Camera position.
        eye_m: [f32; 3],
        /// Duration of a step.
        dt_s: f32,
        /// Camera axis.
        forward: [f32; 3],
        /// Time that the shutter is open.
        shutter_s: f32,
        /// Number of the step, two's complement.
        step: u32,
        /// Number of slots that are there.
        count: u32,
        /// Number of pairs that are sorted: of all slots and parts of ribbons.
        pairs: u32,
        /// Meaning of the colours, such as [`PAINT_NONE`](super::paint::PAINT_NONE).
        paint: u32,
        /// Colours that stand for something.
        palette: [Float4; PAINT_COLORS as usize],
        /// Amount at their end.
        paint_most: f32,
        /// Pairs of slots, which come before those of parts.
        slots: u32,
    }
}

/// The list, and the pipeline that makes it.
#[derive(Debug)]
pub(crate) struct DrawList {
    pub(crate) uniform: wgpu::Buffer,
    pub(crate) sort: RadixSort,
    /// Indirect draw of all that are there.
    pub(crate) draw: wgpu::Buffer,
    /// Number of those that are there, as it is counted.
    seen_count: wgpu::Buffer,
    /// Colours that stand for something.
    pub(crate) paint: PaintedParticles,
    slots: u32,
    pairs: u32,
    dt_s: f32,
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::ComputePipeline,
}

impl DrawList {
    /// A list of `slots` particles that move in steps of `dt_s`, and so many parts of ribbons.
    pub(crate) fn new(
        (device, queue): (&wgpu::Device, &wgpu::Queue),
        (slots, parts): (u32, u32),
        dt_s: f32,
    ) -> Self {
        let slots = slots.min(MAX_DRAWN);
        let pairs = slots + parts;
        let buffer = |label, size, usage| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage: usage | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let compute = wgpu::ShaderStages::COMPUTE;
        let storage = |read_only| wgpu::BufferBindingType::Storage { read_only };
        let group_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("particle list"),
            entries: &[
                buffer_entry(0, wgpu::BufferBindingType::Uniform, compute),
                buffer_entry(1, storage(true), compute),
                buffer_entry(2, storage(true), compute),
                buffer_entry(3, storage(true), compute),
                buffer_entry(4, storage(true), compute),
                buffer_entry(5, storage(false), compute),
                buffer_entry(6, storage(false), compute),
            ],
        });
        let module = compile(device, &super::shaders(), "particles/draw_list");
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("particle list"),
            layout: Some(&layout(device, &[None, None, Some(&group_layout)])),
            module: &module,
            entry_point: Some("list"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        let vertices = if parts == 0 { VERTICES } else { RIBBON_VERTICES };
        let draw = buffer("particle draw", 16, wgpu::BufferUsages::INDIRECT);
        queue.write_buffer(&draw, 0, bytemuck::cast_slice(&[vertices, 0, 0, 0]));
        Self {
            uniform: buffer("particles", size_of::<ParticleUniform>() as u64, wgpu::BufferUsages::UNIFORM),
            sort: RadixSort::new(device, queue, pairs),
            draw,
            seen_count: buffer(
                "particles seen",
                4,
                wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
            ),
            paint: PaintedParticles::default(),
            slots,
            pairs,
            dt_s,
            layout: group_layout,
            pipeline,
        }
    }

    /// Number of slots of `columns` that are drawn.
    pub(crate) fn count(&self, columns: &ParticleColumns<'_>) -> u32 {
        columns.count.min(self.slots)
    }

    /// Lists what is there at `time_s`, in the order in which `camera` sees it; a timer writes how long that takes.
    pub(crate) fn run(
        &self,
        (device, queue): (&wgpu::Device, &wgpu::Queue),
        encoder: &mut wgpu::CommandEncoder,
        (columns, looks): (&ParticleColumns<'_>, &LookBuffers),
        (camera, time_s, shutter_s): (&Camera, f64, f32),
        timestamp_writes: Option<wgpu::ComputePassTimestampWrites<'_>>,
    ) {
        #[expect(clippy::cast_possible_truncation, reason = "whole steps within weeks")]
        let step = (time_s / f64::from(self.dt_s)).round() as i32;
        let uniform = ParticleUniform {
            eye_m: camera.eye_m().to_array(),
            dt_s: self.dt_s,
            forward: camera.forward().to_array(),
            shutter_s,
            step: step.cast_unsigned(),
            count: self.count(columns),
            pairs: self.pairs,
            paint: self.paint.measure,
            palette: self.paint.colors,
            paint_most: self.paint.most,
            slots: self.slots,
            padding: [0; 8],
        };
        queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&uniform));
        let ParticleColumns { place, motion, history, .. } = *columns;
        let shared = [&self.uniform, place, motion, &looks.populations, history];
        let buffers = shared.into_iter().chain([&self.sort.pairs, &self.seen_count]);
        let entries: Vec<_> = (0..)
            .zip(buffers)
            .map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: whole(buffer) })
            .collect();
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("particle list"),
            layout: &self.layout,
            entries: &entries,
        });
        encoder.clear_buffer(&self.seen_count, 0, None);
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("particle list"),
            timestamp_writes,
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(2, &group, &[]);
        pass.dispatch_workgroups(self.pairs.div_ceil(LIST_THREADS), 1, 1);
        self.sort.run(&mut pass);
        drop(pass);
        encoder.copy_buffer_to_buffer(&self.seen_count, 0, &self.draw, INSTANCES_AT, 4);
    }
}

/// A buffer as far as it is drawn from.
pub(crate) fn whole(buffer: &wgpu::Buffer) -> wgpu::BindingResource<'_> {
    let most = u64::from(MAX_DRAWN) * 16;
    let size = wgpu::BufferSize::new(buffer.size().min(most));
    wgpu::BindingResource::Buffer(wgpu::BufferBinding { buffer, offset: 0, size })
}
