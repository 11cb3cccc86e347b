// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The leaf columns as GPU buffers.

use windfall_core::SimError;
use windfall_core::leaf::Leaves;

use crate::gpu::Gpu;

/// Bytes of one record.
pub(crate) const RECORD_BYTES: u64 = 16;

/// Borrowed leaf columns: one 16-byte record per leaf in each buffer (see `windfall_core::leaf`), usable as vertex
/// and storage buffers on the device they were made on.
#[derive(Clone, Copy, Debug)]
pub struct LeafColumns<'a> {
    /// `Place`: x, y, z in metres as `f32`; `u32` of state, blend, motion table and spin.
    pub place: &'a wgpu::Buffer,
    /// `Drift`: velocity x, y, z in m/s as `f32`; `u32` phase.
    pub drift: &'a wgpu::Buffer,
    /// `Attitude`: unit quaternion x, y, z, w as `f32`.
    pub attitude: &'a wgpu::Buffer,
    /// `Course`: four `u32`; the third's low half is the size relative to the species' in 2^-14.
    pub course: &'a wgpu::Buffer,
    /// `Identity`: four `u32`; the fourth holds tint (bits 0-15) and image variant (bits 16-23).
    pub identity: &'a wgpu::Buffer,
    /// Number of leaves.
    pub leaf_count: u32,
}

/// Borrowed columns of the segments of trees (see `windfall_core::tree`): one 16-byte record per row, usable as storage
/// buffers on the device they were made on.
#[derive(Clone, Debug)]
pub struct BranchColumns<'a> {
    /// Place of each segment's joint x, y, z in metres as `f32`; one unused.
    pub base: wgpu::BufferBinding<'a>,
    /// Orientation: unit quaternion x, y, z, w from the segment's frame, y along it, to the world's.
    pub pose: wgpu::BufferBinding<'a>,
    /// Number of segments.
    pub count: u32,
}

/// Buffers for all leaf columns.
#[derive(Debug)]
pub struct LeafBuffers {
    buffers: [wgpu::Buffer; 5],
    leaf_count: u32,
}

impl LeafBuffers {
    /// Buffers for `leaf_count` leaves.
    ///
    /// # Errors
    /// [`SimError::Capacity`] if a column is larger than the device's largest buffer.
    pub fn new(gpu: &Gpu, leaf_count: u32) -> Result<Self, SimError> {
        let size = u64::from(leaf_count) * RECORD_BYTES;
        let allowed = gpu.device().limits().max_buffer_size;
        if size > allowed {
            let device = gpu.info().name.clone();
            return Err(SimError::Capacity { leaves: leaf_count, needed: size, allowed, device });
        }
        let buffers = ["place", "drift", "attitude", "course", "identity"].map(|label| {
            gpu.device().create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage: wgpu::BufferUsages::STORAGE
                    | wgpu::BufferUsages::VERTEX
                    | wgpu::BufferUsages::COPY_SRC
                    | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        });
        gpu.check()?;
        Ok(Self { buffers, leaf_count })
    }

    /// Replaces all columns; `leaves` has as many leaves as the buffers.
    ///
    /// # Errors
    /// [`SimError::Size`] if it has not.
    pub fn write(&self, gpu: &Gpu, leaves: &Leaves) -> Result<(), SimError> {
        if leaves.len() != self.leaf_count as usize {
            return Err(SimError::Size { world: leaves.len(), simulator: self.leaf_count as usize });
        }
        for (buffer, column) in self.buffers.iter().zip(leaves.columns()) {
            gpu.queue().write_buffer(buffer, 0, column);
        }
        gpu.check()
    }

    /// The buffers, to draw from.
    pub fn columns(&self) -> LeafColumns<'_> {
        let [place, drift, attitude, course, identity] = &self.buffers;
        LeafColumns { place, drift, attitude, course, identity, leaf_count: self.leaf_count }
    }

    pub(crate) fn buffers(&self) -> &[wgpu::Buffer; 5] {
        &self.buffers
    }

    pub(crate) fn leaf_count(&self) -> u32 {
        self.leaf_count
    }
}
