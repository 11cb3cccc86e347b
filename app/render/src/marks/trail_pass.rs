// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws where leaves have been: a ring of past positions per leaf, sampled and drawn on the device.

use windfall_core::{shared_constants, shared_struct};
use windfall_wgpu::LeafColumns;

use super::MARKS_GROUP_SIZE;
use super::overlay::Overlay;
use crate::frame::group::FrameGroup;
use crate::frame::light_group::LightGroup;
use crate::gpu::pipeline::{buffer_entry, layout};
use crate::gpu::shaders::compile;
use crate::leaves::record::COLUMN_BYTES;

/// Leaves that draw a trail.
pub const MAX_TRAILS: u32 = 4096;
/// Samples per leaf.
const SAMPLES: u32 = 128;
/// Half width of a ribbon in metres.
const HALF_WIDTH_M: f32 = 0.008;
/// A leaf that goes farther than this between two frames was put elsewhere: one metre, or 60 m/s.
const BREAK_M: f32 = 1.0;
const BREAK_M_S: f32 = 60.0;

shared_constants! {
    /// Joint of a sample without a place.
    const NO_PLACE: u32 = 0;
    /// Joint of a place that is joined to the one before it.
    const JOINED: u32 = 1;
    /// Joint of a place that is not.
    const BROKEN: u32 = 2;
    /// Mask of the joint in [`TrailSample::joint_regime`].
    const JOINT_MASK: u32 = 3;
    /// Place of the regime there: of a body in the air its number plus one, else 0.
    const JOINT_REGIME_SHIFT: u32 = 2;
}

shared_struct! {
    /// A leaf at a moment.
    pub(crate) struct TrailSample {
        /// Its position in metres.
        position: [f32; 3],
        /// Joint, and regime.
        joint_regime: u32,
    }
}

shared_struct! {
    /// Trails of a frame; the lengths of time are relative to the trail's.
    pub(crate) struct TrailUniform {
        leaf_count: u32,
        /// Samples per leaf.
        sample_count: u32,
        /// Newest sample.
        newest: u32,
        /// 1 when the newest sample only just began, else 0.
        has_begun: u32,
        /// Farthest that a leaf goes between two frames.
        break_m: f32,
        /// Age of the sample before the newest.
        newest_age: f32,
        /// From each sample to the next.
        interval: f32,
        /// Half width of a ribbon.
        half_width_m: f32,
    }
}

/// Part of an interval by which a frame may come too early for a sample, so that rounding of its time does not matter.
const EARLY: f64 = 1.0e-3;

/// Which sample of the ring is being written.
#[derive(Clone, Copy, Debug, Default)]
struct RingClock {
    newest: u32,
    /// Number of the interval, from time zero on.
    number: f64,
    began_s: f64,
    seen_s: Option<f64>,
}

/// Changes of the ring of trails in a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Tick {
    clear: bool,
    began: bool,
    frame_s: f64,
}

impl RingClock {
    fn tick(&mut self, time_s: f64, trail_s: f64) -> Tick {
        let frame_s = self.seen_s.map_or(0.0, |seen| time_s - seen);
        let clear = self.seen_s.is_none() || frame_s < 0.0 || frame_s > trail_s;
        let interval = trail_s / f64::from(SAMPLES - 2);
        // Counted from time zero, so that a clip has the same samples wherever it is begun.
        let number = (time_s / interval + EARLY).floor();
        let began = clear || number != self.number;
        self.number = number;
        if began {
            self.newest = (self.newest + 1) % SAMPLES;
            self.began_s = time_s;
        }
        self.seen_s = Some(time_s);
        Tick { clear, began, frame_s: frame_s.max(0.0) }
    }
}

/// Ring of past positions, the pipeline that fills and the one that draws it.
#[derive(Debug)]
pub(crate) struct TrailPass {
    trail_s: f32,
    trail_count: u32,
    clock: RingClock,
    uniform: wgpu::Buffer,
    ring: wgpu::Buffer,
    sample_pipeline: wgpu::ComputePipeline,
    sample_layout: wgpu::BindGroupLayout,
    overlay: Overlay,
}

impl TrailPass {
    /// Trails of `trail_s` seconds behind the first leaves of `leaf_count`.
    pub(crate) fn new(
        device: &wgpu::Device,
        frame: &FrameGroup,
        light: &LightGroup,
        trail_s: f32,
        leaf_count: u32,
    ) -> Self {
        let trail_count = leaf_count.clamp(1, MAX_TRAILS);
        let buffer = |label, size, usage| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage: usage | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let ring_bytes = u64::from(trail_count) * u64::from(SAMPLES) * size_of::<TrailSample>() as u64;
        let ring = buffer("trail ring", ring_bytes, wgpu::BufferUsages::STORAGE);
        let uniform = buffer("trail", size_of::<TrailUniform>() as u64, wgpu::BufferUsages::UNIFORM);

        let compute = wgpu::ShaderStages::COMPUTE;
        let read = wgpu::BufferBindingType::Storage { read_only: true };
        let write = wgpu::BufferBindingType::Storage { read_only: false };
        let sample_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("trail samples"),
            entries: &[
                buffer_entry(0, wgpu::BufferBindingType::Uniform, compute),
                buffer_entry(1, read, compute),
                buffer_entry(2, write, compute),
            ],
        });
        let module = compile(device, &super::shaders(), "marks/trail_sample");
        let sample_pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("trail samples"),
            layout: Some(&layout(device, &[Some(&sample_layout)])),
            module: &module,
            entry_point: Some("sample"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });

        let overlay = Overlay::new(device, (frame, light), "trails", "marks/trail_pass", [&uniform, &ring]);
        let clock = RingClock::default();
        Self { trail_s, trail_count, clock, uniform, ring, sample_pipeline, sample_layout, overlay }
    }

    /// Length of the trails in seconds.
    pub(crate) fn trail_s(&self) -> f32 {
        self.trail_s
    }

    /// Writes where `leaves` are at `time_s` into the ring.
    #[expect(clippy::cast_possible_truncation, reason = "small differences of times, rounded for the shader")]
    pub(crate) fn sample(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        leaves: &LeafColumns<'_>,
        time_s: f64,
    ) {
        let count = leaves.leaf_count.min(self.trail_count);
        let trail_s = f64::from(self.trail_s);
        let tick = self.clock.tick(time_s, trail_s);
        if tick.clear {
            encoder.clear_buffer(&self.ring, 0, None);
        }
        let interval = (trail_s / f64::from(SAMPLES - 2)).max(tick.frame_s);
        let uniform = TrailUniform {
            leaf_count: count,
            sample_count: SAMPLES,
            newest: self.clock.newest,
            has_begun: tick.began.into(),
            break_m: BREAK_M.max(BREAK_M_S * tick.frame_s as f32),
            newest_age: ((time_s - self.clock.began_s) / trail_s) as f32,
            interval: (interval / trail_s) as f32,
            half_width_m: HALF_WIDTH_M,
        };
        queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&uniform));
        let Some(bytes) = wgpu::BufferSize::new(u64::from(count) * COLUMN_BYTES) else { return };
        let place = wgpu::BufferBinding { buffer: leaves.place, offset: 0, size: Some(bytes) };
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("trail samples"),
            layout: &self.sample_layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: self.uniform.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::Buffer(place) },
                wgpu::BindGroupEntry { binding: 2, resource: self.ring.as_entire_binding() },
            ],
        });
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("trail samples"),
            timestamp_writes: None,
        });
        pass.set_pipeline(&self.sample_pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(count.div_ceil(MARKS_GROUP_SIZE), 1, 1);
    }

    /// Draws the ribbons; bind groups 0 and 1 are set.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, leaf_count: u32) {
        self.overlay.draw(pass, 6 * (SAMPLES - 1), leaf_count.min(self.trail_count));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ring_advances_once_an_interval() {
        let mut clock = RingClock::default();
        let trail_s = 12.6;
        let first = clock.tick(0.0, trail_s);
        assert!(first.clear && first.began, "the first frame starts a clean ring: {first:?}");
        let began = (1..=60).filter(|&frame| clock.tick(f64::from(frame) / 60.0, trail_s).began).count();
        assert!((8..=10).contains(&began), "{began} samples in a second of 0.1 s intervals");
    }

    #[test]
    fn ring_is_cleared_when_time_jumps() {
        let mut clock = RingClock::default();
        clock.tick(5.0, 3.0);
        assert!(!clock.tick(5.1, 3.0).clear, "a frame later nothing is lost");
        assert!(clock.tick(1.0, 3.0).clear, "time went back");
        assert!(clock.tick(9.0, 3.0).clear, "a jump longer than the trail");
    }
}
