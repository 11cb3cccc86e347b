// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Copies buffers back to the host.

use windfall_core::SimError;

use crate::gpu::Gpu;

/// Largest staging buffer: larger reads go in pieces.
const PIECE_BYTES: usize = 64 << 20;

/// Copies a buffer from `offset` on into `out`, waiting for everything submitted before.
pub(crate) fn read_buffer(
    gpu: &Gpu,
    buffer: &wgpu::Buffer,
    offset: u64,
    out: &mut [u8],
) -> Result<(), SimError> {
    let device_error = |error: &dyn std::fmt::Display| SimError::Device { reason: error.to_string() };
    let mut at = offset;
    for piece in out.chunks_mut(PIECE_BYTES) {
        let size = piece.len() as u64;
        let staging = gpu.device().create_buffer(&wgpu::BufferDescriptor {
            label: Some("readback"),
            size,
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut encoder = gpu.device().create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_buffer_to_buffer(buffer, at, &staging, 0, size);
        gpu.queue().submit([encoder.finish()]);
        let (sender, receiver) = std::sync::mpsc::channel();
        staging.map_async(wgpu::MapMode::Read, .., move |result| {
            // The receiver waits below; a failed send means that it has already given up.
            let _ = sender.send(result);
        });
        gpu.wait()?;
        receiver.recv().map_err(|error| device_error(&error))?.map_err(|error| device_error(&error))?;
        let mapped = staging.get_mapped_range(..).map_err(|error| device_error(&error))?;
        piece.copy_from_slice(&mapped);
        at += size;
    }
    Ok(())
}
