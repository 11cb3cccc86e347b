// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Makes buffers and binds them.

use std::sync::Arc;

use windfall_core::SimError;
use windfall_core::layout::{Uint4, WgslStruct};

use crate::gpu::Gpu;

/// A buffer that can be written, of zeros.
pub(crate) fn buffer(gpu: &Gpu, label: &str, size: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
    gpu.device().create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size,
        usage: usage | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

/// A storage buffer that holds these bytes.
pub(crate) fn filled(gpu: &Gpu, label: &str, bytes: &[u8]) -> wgpu::Buffer {
    let buffer = buffer(gpu, label, bytes.len() as u64, wgpu::BufferUsages::STORAGE);
    gpu.queue().write_buffer(&buffer, 0, bytes);
    buffer
}

/// A uniform buffer that holds this block.
pub(crate) fn uniform<T: WgslStruct>(gpu: &Gpu, label: &str, block: &T) -> wgpu::Buffer {
    let bytes = bytemuck::bytes_of(block);
    let buffer = buffer(gpu, label, bytes.len() as u64, wgpu::BufferUsages::UNIFORM);
    gpu.queue().write_buffer(&buffer, 0, bytes);
    buffer
}

/// A storage buffer that holds these rows and has room for a bed of litter behind them, and the rows, to know them again.
///
/// # Errors
/// [`SimError::Capacity`] if they do not fit in one binding.
pub(crate) fn table(
    gpu: &Gpu,
    rows: &Arc<[Uint4]>,
    bed_bytes: u64,
) -> Result<(Arc<[Uint4]>, wgpu::Buffer), SimError> {
    let needed = size_of_val(&**rows) as u64 + bed_bytes;
    let limits = gpu.device().limits();
    let allowed = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
    if needed > allowed {
        let (store, device) = ("rows of tables", gpu.info().name.clone());
        return Err(SimError::Capacity { store, rows: rows.len(), needed, allowed, device });
    }
    let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
    let tables = buffer(gpu, "tables", needed, usage);
    gpu.queue().write_buffer(&tables, 0, bytemuck::cast_slice(rows));
    Ok((Arc::clone(rows), tables))
}

/// Resources bound one after another.
pub(crate) fn group<'a>(
    gpu: &Gpu,
    layout: &wgpu::BindGroupLayout,
    resources: impl IntoIterator<Item = wgpu::BindingResource<'a>>,
) -> wgpu::BindGroup {
    let entries: Vec<_> =
        (0..).zip(resources).map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource }).collect();
    let descriptor = wgpu::BindGroupDescriptor { label: None, layout, entries: &entries };
    gpu.device().create_bind_group(&descriptor)
}
