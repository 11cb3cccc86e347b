// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Copies buffers back to the host, waiting for them or not.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;

use windfall_core::SimError;

use crate::gpu::Gpu;

/// Interval at which a copy is polled whose callback runs on another thread, and the most polls.
const ROUND: Duration = Duration::from_millis(1);
const MOST_ROUNDS: u32 = 10_000;

/// Largest staging buffer of a read that waits: larger reads go in pieces.
const PIECE_BYTES: usize = 64 << 20;

/// Bytes of a buffer.
pub(crate) struct Run<'a> {
    pub(crate) buffer: &'a wgpu::Buffer,
    pub(crate) offset: u64,
    pub(crate) size: u64,
}

/// Copies on their way to the host.
#[derive(Debug)]
pub(crate) struct Readback {
    gpu: Gpu,
    /// One buffer for each run; none for an empty one.
    staging: Vec<Option<wgpu::Buffer>>,
    /// Number of buffers that are not mapped yet.
    left: Arc<AtomicUsize>,
    has_failed: Arc<AtomicBool>,
}

impl Readback {
    /// Copies runs of bytes, after everything submitted before.
    pub(crate) fn new<'a>(gpu: &Gpu, runs: impl Iterator<Item = Run<'a>>) -> Result<Self, SimError> {
        let has_failed = Arc::new(AtomicBool::new(false));
        let left = Arc::new(AtomicUsize::new(0));
        let staging = gpu.scoped(|| {
            let mut encoder = gpu.device().create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            let mut copied = |Run { buffer, offset, size }: Run<'_>| {
                (size > 0).then(|| {
                    let staging = gpu.device().create_buffer(&wgpu::BufferDescriptor {
                        label: Some("readback"),
                        size,
                        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
                        mapped_at_creation: false,
                    });
                    encoder.copy_buffer_to_buffer(buffer, offset, &staging, 0, size);
                    staging
                })
            };
            let staging: Vec<_> = runs.map(&mut copied).collect();
            gpu.queue().submit([encoder.finish()]);
            left.store(staging.iter().flatten().count(), Ordering::Release);
            for buffer in staging.iter().flatten() {
                let (left, has_failed) = (Arc::clone(&left), Arc::clone(&has_failed));
                buffer.map_async(wgpu::MapMode::Read, .., move |result| {
                    has_failed.fetch_or(result.is_err(), Ordering::AcqRel);
                    left.fetch_sub(1, Ordering::AcqRel);
                });
            }
            staging
        })?;
        Ok(Self { gpu: gpu.clone(), staging, left, has_failed })
    }

    /// Returns true once all bytes are there. Never waits.
    pub(crate) fn poll(&self) -> Result<bool, SimError> {
        self.gpu.check()?;
        self.gpu
            .device()
            .poll(wgpu::PollType::Poll)
            .map_err(|error| SimError::Device { reason: error.to_string() })?;
        self.is_done()
    }

    /// Waits until all bytes are there. Where several threads use a device, another one may run the callback, a moment later.
    pub(crate) fn wait(&self) -> Result<(), SimError> {
        self.gpu.wait()?;
        for _ in 0..MOST_ROUNDS {
            if self.is_done()? {
                return Ok(());
            }
            std::thread::sleep(ROUND);
        }
        Err(self.gpu.lost("it did not finish a copy".into()))
    }

    fn is_done(&self) -> Result<bool, SimError> {
        let is_done = self.left.load(Ordering::Acquire) == 0;
        if self.has_failed.load(Ordering::Acquire) {
            return Err(self.gpu.lost("a copy could not be mapped".into()));
        }
        Ok(is_done)
    }

    /// Hands over the bytes, run by run, once they are there.
    pub(crate) fn take<'a>(&self, runs: impl Iterator<Item = &'a mut [u8]>) -> Result<(), SimError> {
        let error = |error: &dyn std::fmt::Display| SimError::Device { reason: error.to_string() };
        for (staging, run) in self.staging.iter().zip(runs) {
            if let Some(staging) = staging {
                run.copy_from_slice(&staging.get_mapped_range(..).map_err(|reason| error(&reason))?);
            }
        }
        Ok(())
    }
}

/// Copies a buffer from `offset` on into `out`, waiting for everything submitted before.
pub(crate) fn read_buffer(
    gpu: &Gpu,
    buffer: &wgpu::Buffer,
    offset: u64,
    out: &mut [u8],
) -> Result<(), SimError> {
    let mut offset = offset;
    for piece in out.chunks_mut(PIECE_BYTES) {
        let size = piece.len() as u64;
        let readback = Readback::new(gpu, std::iter::once(Run { buffer, offset, size }))?;
        readback.wait()?;
        readback.take(std::iter::once(piece))?;
        offset += size;
    }
    Ok(())
}
