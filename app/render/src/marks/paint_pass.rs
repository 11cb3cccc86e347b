// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Marks leaves with colours on the device, before they are culled.

use glam::Vec3;
use windfall_core::layout::Float4;
use windfall_core::{shared_constants, shared_struct};
use windfall_wgpu::LeafColumns;

use super::palette::{self, ATTACHED_COLOR, MOTIONS, NO_COLOR, RESTING_COLOR, SHADES, linear, shade};
use super::shelter_pass::ShelterBuffers;
use super::{MARKS_GROUP_SIZE, Measure, Paint};
use crate::frame::group::FrameGroup;
use crate::gpu::pipeline::{buffer_entry, layout};
use crate::gpu::shaders::compile;
use crate::leaves::page::PAGE_SLOTS;
use crate::leaves::record::COLUMN_BYTES;

/// Colours in the uniform block: the shades, and three for leaves that have none.
const COLORS: usize = NO_COLOR as usize + 1;

shared_constants! {
    /// Number of [`Measure::Motion`].
    const MEASURE_MOTION: u32 = 0;
    /// Number of [`Measure::Speed`].
    const MEASURE_SPEED: u32 = 1;
    /// Number of [`Measure::Age`].
    const MEASURE_AGE: u32 = 2;
    /// Number of [`Measure::Height`].
    const MEASURE_HEIGHT: u32 = 3;
    /// Number of [`Measure::Wake`].
    const MEASURE_WAKE: u32 = 4;
    /// Number of [`Measure::Depth`].
    const MEASURE_DEPTH: u32 = 5;
    /// Number of [`Measure::Shelter`].
    const MEASURE_SHELTER: u32 = 6;
}

shared_struct! {
    /// Property of the leaves that is shown, and its colours.
    pub(crate) struct PaintUniform, padding 8 {
        /// Colours from low to high, or of each kind of motion; then of leaves without a value. w unused.
        palette: [Float4; COLORS],
        /// Number of the measure.
        measure: u32,
        /// The present step.
        step: u32,
        /// Seconds of a step.
        dt_s: f32,
        /// Seconds since the marks before.
        since_s: f32,
        /// Value at the palette's beginning.
        low: f32,
        /// Value at its end.
        high: f32,
    }
}

shared_struct! {
    /// A leaf when it was last marked.
    pub(crate) struct PastMark {
        /// Its position in metres.
        position: [f32; 3],
        /// Roots of its colour in bytes; 0 before the first time.
        color: u32,
    }
}

/// The marks, and the pipeline that makes them.
#[derive(Debug)]
pub(crate) struct PaintPass {
    paint: Paint,
    dt_s: f32,
    base_m: f32,
    seen_s: Option<f64>,
    uniform: wgpu::Buffer,
    /// A mark for each leaf, in place of its identity.
    pub(crate) marks: wgpu::Buffer,
    /// A [`PastMark`] for each leaf.
    past: wgpu::Buffer,
    group_layout: wgpu::BindGroupLayout,
    pipeline: wgpu::ComputePipeline,
}

impl PaintPass {
    /// Marks for `leaf_count` leaves of a scene with steps of `dt_s`, whose ground lies at `base_m`.
    pub(crate) fn new(
        device: &wgpu::Device,
        frame: &FrameGroup,
        paint: Paint,
        leaf_count: u32,
        dt_s: f32,
        base_m: f32,
    ) -> Self {
        let compute = wgpu::ShaderStages::COMPUTE;
        let storage = |read_only| wgpu::BufferBindingType::Storage { read_only };
        let group_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("paint"),
            entries: &[
                buffer_entry(0, wgpu::BufferBindingType::Uniform, compute),
                buffer_entry(1, storage(true), compute),
                buffer_entry(2, storage(true), compute),
                buffer_entry(3, storage(false), compute),
                buffer_entry(4, storage(false), compute),
                buffer_entry(5, storage(true), compute),
                buffer_entry(6, wgpu::BufferBindingType::Uniform, compute),
                buffer_entry(7, storage(true), compute),
            ],
        });
        let module = compile(device, &super::shaders(), "marks/paint_pass");
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("paint"),
            layout: Some(&layout(device, &[Some(&frame.layout), Some(&group_layout)])),
            module: &module,
            entry_point: Some("mark"),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants: &frame.overrides(),
                ..Default::default()
            },
            cache: None,
        });
        let buffer = |label, size, usage| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage,
                mapped_at_creation: false,
            })
        };
        let uniform_usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let marks_usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        let bytes = u64::from(leaf_count.max(1)) * COLUMN_BYTES;
        Self {
            paint,
            dt_s,
            base_m,
            seen_s: None,
            uniform: buffer("paint", size_of::<PaintUniform>() as u64, uniform_usage),
            marks: buffer("leaf marks", bytes, marks_usage),
            past: buffer("leaf marks before", bytes, wgpu::BufferUsages::STORAGE),
            group_layout,
            pipeline,
        }
    }

    /// Paints otherwise from now on.
    pub(crate) fn set(&mut self, paint: Paint) {
        self.paint = paint;
    }

    /// Paint in use.
    pub(crate) fn paint(&self) -> Paint {
        self.paint
    }

    /// Marks `leaves` as they are at `time_s`, in so much of the wind.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "whole steps, and a short time"
    )]
    pub(crate) fn mark(
        &mut self,
        (device, queue): (&wgpu::Device, &wgpu::Queue),
        encoder: &mut wgpu::CommandEncoder,
        frame: &FrameGroup,
        (leaves, shelter): (&LeafColumns<'_>, &ShelterBuffers),
        time_s: f64,
    ) {
        // Back in time things move as well.
        let passed_s = self.seen_s.map_or(0.0, |seen| (time_s - seen).abs());
        self.seen_s = Some(time_s);
        let step = (time_s / f64::from(self.dt_s)).round() as u32;
        let measure = match self.paint.measure {
            Measure::Motion => MEASURE_MOTION,
            Measure::Speed => MEASURE_SPEED,
            Measure::Age => MEASURE_AGE,
            Measure::Height => MEASURE_HEIGHT,
            Measure::Wake => MEASURE_WAKE,
            Measure::Depth => MEASURE_DEPTH,
            Measure::Shelter => MEASURE_SHELTER,
        };
        let low = if self.paint.measure == Measure::Height { self.base_m } else { 0.0 };
        let uniform = PaintUniform {
            palette: colors(self.paint.measure).map(|color| Float4(color.extend(1.0).to_array())),
            measure,
            step,
            dt_s: self.dt_s,
            since_s: passed_s as f32,
            low,
            high: low + self.paint.most.max(1.0e-6),
            padding: [0; 8],
        };
        queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&uniform));
        let count = u64::from(leaves.leaf_count).min(self.marks.size() / COLUMN_BYTES);
        let mut first = 0;
        while first < count {
            let part = (count - first).min(u64::from(PAGE_SLOTS));
            let window = |buffer| {
                let size = wgpu::BufferSize::new(part * COLUMN_BYTES);
                wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                    buffer,
                    offset: first * COLUMN_BYTES,
                    size,
                })
            };
            let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("paint"),
                layout: &self.group_layout,
                entries: &[
                    wgpu::BindGroupEntry { binding: 0, resource: self.uniform.as_entire_binding() },
                    wgpu::BindGroupEntry { binding: 1, resource: window(leaves.place) },
                    wgpu::BindGroupEntry { binding: 2, resource: window(leaves.identity) },
                    wgpu::BindGroupEntry { binding: 3, resource: window(&self.marks) },
                    wgpu::BindGroupEntry { binding: 4, resource: window(&self.past) },
                    wgpu::BindGroupEntry { binding: 5, resource: window(leaves.drift) },
                    wgpu::BindGroupEntry { binding: 6, resource: shelter.uniform.as_entire_binding() },
                    wgpu::BindGroupEntry { binding: 7, resource: shelter.left.as_entire_binding() },
                ],
            });
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: Some("paint"),
                timestamp_writes: None,
            });
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &frame.group, &[]);
            pass.set_bind_group(1, &group, &[]);
            pass.dispatch_workgroups((part as u32).div_ceil(MARKS_GROUP_SIZE), 1, 1);
            first += part;
        }
    }
}

/// The palette of a measure, and the colours of leaves at rest, on twigs, and without a value.
fn colors(measure: Measure) -> [Vec3; COLORS] {
    let mut colors = std::array::from_fn(|index| match measure {
        Measure::Motion => linear(MOTIONS[index.min(MOTIONS.len() - 1)].1),
        _ => shade(index as f32 / (SHADES - 1) as f32),
    });
    colors[RESTING_COLOR as usize] = linear(palette::RESTING);
    colors[ATTACHED_COLOR as usize] = linear(palette::ATTACHED);
    colors[NO_COLOR as usize] = linear(palette::NONE);
    colors
}
