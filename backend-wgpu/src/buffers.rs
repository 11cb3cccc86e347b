// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Makes buffers and binds them.

use std::sync::Arc;

use windfall_core::layout::Wgsl;

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

/// A storage buffer that holds these rows, and the rows, to know them again.
pub(crate) fn table<T: Wgsl>(gpu: &Gpu, label: &str, rows: &Arc<[T]>) -> (Arc<[T]>, wgpu::Buffer) {
    (Arc::clone(rows), filled(gpu, label, bytemuck::cast_slice(rows)))
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
