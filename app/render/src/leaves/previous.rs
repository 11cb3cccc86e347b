// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves a frame before: copies of their columns.

use windfall_wgpu::LeafColumns;

use super::record::COLUMN_BYTES;

/// Frames farther apart than this do not belong together, in seconds.
const LONGEST_S: f64 = 0.25;

/// Places and attitudes as they were last noted.
#[derive(Debug)]
pub(crate) struct PreviousLeaves {
    pub(crate) place: wgpu::Buffer,
    pub(crate) attitude: wgpu::Buffer,
    /// Number of leaves there is room for.
    room: u32,
    noted: Option<Noted>,
}

#[derive(Clone, Copy, Debug)]
struct Noted {
    time_s: f64,
    leaf_count: u32,
}

impl PreviousLeaves {
    pub(crate) fn new(device: &wgpu::Device, leaf_count: u32) -> Self {
        let column = |label| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: u64::from(leaf_count.max(1)) * COLUMN_BYTES,
                usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        Self {
            place: column("past places"),
            attitude: column("past attitudes"),
            room: leaf_count,
            noted: None,
        }
    }

    /// Seconds from what was noted to `time_s`, if it was the same leaves a moment ago.
    pub(crate) fn since_s(&self, leaves: &LeafColumns<'_>, time_s: f64) -> Option<f64> {
        let noted = self.noted.filter(|noted| noted.leaf_count == leaves.leaf_count)?;
        let since_s = time_s - noted.time_s;
        (since_s > 0.0 && since_s <= LONGEST_S).then_some(since_s)
    }

    /// Copies the columns as they are at `time_s`.
    pub(crate) fn note(&mut self, encoder: &mut wgpu::CommandEncoder, leaves: &LeafColumns<'_>, time_s: f64) {
        let leaf_count = leaves.leaf_count.min(self.room);
        let bytes = u64::from(leaf_count) * COLUMN_BYTES;
        if bytes > 0 {
            encoder.copy_buffer_to_buffer(leaves.place, 0, &self.place, 0, bytes);
            encoder.copy_buffer_to_buffer(leaves.attitude, 0, &self.attitude, 0, bytes);
        }
        self.noted = Some(Noted { time_s, leaf_count });
    }
}
