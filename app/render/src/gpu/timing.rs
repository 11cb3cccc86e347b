// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Time that the device takes for each pass, where it can be queried.

use std::sync::Arc;
use std::sync::atomic::{AtomicU8, AtomicU64, Ordering};

/// Bytes from one pass's timestamps to the next one's: where a resolve may begin.
const STRIDE: u64 = wgpu::QUERY_RESOLVE_BUFFER_ALIGNMENT;

const IDLE: u8 = 0;
const COPIED: u8 = 1;
const MAPPING: u8 = 2;
const MAPPED: u8 = 3;
const FAILED: u8 = 4;

/// Timestamp queries for a beginning and an end of each pass, and the latest answer.
#[derive(Debug)]
pub struct GpuTimer {
    passes: &'static [&'static str],
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    readable: wgpu::Buffer,
    period_ns: f32,
    state: Arc<AtomicU8>,
    /// A bit for each pass that was encoded since the last resolve, and those whose timestamps are on their way.
    encoded: AtomicU64,
    copied: AtomicU64,
    latest: Vec<(&'static str, f32)>,
    answers: u32,
}

impl GpuTimer {
    /// A timer of these passes; `None` where the device has no timestamps.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue, passes: &'static [&'static str]) -> Option<Self> {
        if !device.features().contains(wgpu::Features::TIMESTAMP_QUERY) {
            return None;
        }
        let count = u32::try_from(passes.len()).ok().filter(|count| *count <= u64::BITS)?;
        let buffer = |usage| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("timestamps"),
                size: u64::from(count) * STRIDE,
                usage,
                mapped_at_creation: false,
            })
        };
        Some(Self {
            passes,
            queries: device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("timestamps"),
                ty: wgpu::QueryType::Timestamp,
                count: 2 * count,
            }),
            resolved: buffer(wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC),
            readable: buffer(wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST),
            period_ns: queue.get_timestamp_period(),
            state: Arc::new(AtomicU8::new(IDLE)),
            encoded: AtomicU64::new(0),
            copied: AtomicU64::new(0),
            latest: Vec::new(),
            answers: 0,
        })
    }

    /// Timestamp writes for the descriptor of the pass of this number.
    pub(crate) fn render_writes(&self, pass: u32) -> wgpu::RenderPassTimestampWrites<'_> {
        self.encoded.fetch_or(1 << pass, Ordering::Relaxed);
        wgpu::RenderPassTimestampWrites {
            query_set: &self.queries,
            beginning_of_pass_write_index: Some(2 * pass),
            end_of_pass_write_index: Some(2 * pass + 1),
        }
    }

    /// The same for a pass that is many: for the first and for the last of them.
    pub(crate) fn split_writes(&self, pass: u32) -> [wgpu::RenderPassTimestampWrites<'_>; 2] {
        let whole = self.render_writes(pass);
        [
            wgpu::RenderPassTimestampWrites { end_of_pass_write_index: None, ..whole.clone() },
            wgpu::RenderPassTimestampWrites { beginning_of_pass_write_index: None, ..whole },
        ]
    }

    /// The same for a compute pass.
    pub fn compute_writes(&self, pass: u32) -> wgpu::ComputePassTimestampWrites<'_> {
        self.encoded.fetch_or(1 << pass, Ordering::Relaxed);
        wgpu::ComputePassTimestampWrites {
            query_set: &self.queries,
            beginning_of_pass_write_index: Some(2 * pass),
            end_of_pass_write_index: Some(2 * pass + 1),
        }
    }

    /// Copies the frame's timestamps, unless an earlier frame's are still on their way; returns true if it did.
    pub fn resolve(&self, encoder: &mut wgpu::CommandEncoder) -> bool {
        let encoded = self.encoded.swap(0, Ordering::Relaxed);
        let is_free = self.state.compare_exchange(IDLE, COPIED, Ordering::AcqRel, Ordering::Acquire).is_ok();
        if is_free {
            // A query that was never written must not be resolved: drivers wait for it.
            for pass in (0..u64::BITS).filter(|pass| encoded >> pass & 1 == 1) {
                let range = 2 * pass..2 * pass + 2;
                encoder.resolve_query_set(&self.queries, range, &self.resolved, u64::from(pass) * STRIDE);
            }
            encoder.copy_buffer_to_buffer(&self.resolved, 0, &self.readable, 0, self.resolved.size());
            self.copied.store(encoded, Ordering::Relaxed);
        }
        is_free
    }

    /// Number of answers so far: it grows when `collect` has a new one.
    pub fn answers(&self) -> u32 {
        self.answers
    }

    /// Latest milliseconds of each pass; call it after submitting a frame. Never waits.
    pub fn collect(&mut self, device: &wgpu::Device) -> &[(&'static str, f32)] {
        if self.state.compare_exchange(COPIED, MAPPING, Ordering::AcqRel, Ordering::Acquire).is_ok() {
            let state = Arc::clone(&self.state);
            self.readable.map_async(wgpu::MapMode::Read, .., move |result| {
                state.store(if result.is_ok() { MAPPED } else { FAILED }, Ordering::Release);
            });
        }
        // A lost device shows elsewhere; here it only leaves the numbers as they were.
        let _ = device.poll(wgpu::PollType::Poll);
        match self.state.load(Ordering::Acquire) {
            MAPPED => {
                self.read();
                self.readable.unmap();
                self.state.store(IDLE, Ordering::Release);
            }
            FAILED => self.state.store(IDLE, Ordering::Release),
            _ => {}
        }
        &self.latest
    }

    fn read(&mut self) {
        let Ok(view) = self.readable.get_mapped_range(..) else { return };
        let ticks: Vec<u64> = bytemuck::pod_collect_to_vec(&view);
        let copied = self.copied.load(Ordering::Relaxed);
        self.answers = self.answers.wrapping_add(1);
        // A pass that the frame did without is left out.
        let stride = ticks.len() / self.passes.len();
        let passes = self.passes.iter().zip(ticks.chunks(stride)).enumerate();
        self.latest = passes
            .filter(|(pass, _)| copied >> pass & 1 == 1)
            .map(|(_, (&name, ticks))| {
                (name, ticks[1].saturating_sub(ticks[0]) as f32 * self.period_ns * 1.0e-6)
            })
            .collect();
    }
}
