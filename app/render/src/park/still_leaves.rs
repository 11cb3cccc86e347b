// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Columns of leaves that no simulator moves: scenery, drawn through the same passes as the simulated ones.

use windfall_wgpu::LeafColumns;

use crate::gpu::upload;

/// Columns of leaves that stay where they are.
#[derive(Debug)]
pub(crate) struct StillLeaves {
    place: wgpu::Buffer,
    attitude: wgpu::Buffer,
    schedule: wgpu::Buffer,
    identity: wgpu::Buffer,
    count: u32,
}

impl StillLeaves {
    /// Columns of `count` leaves, at least one, from the bytes of places, attitudes, schedules and identities, laid out like a
    /// simulator's.
    pub(crate) fn new(device: &wgpu::Device, queue: &wgpu::Queue, columns: [&[u8]; 4], count: u32) -> Self {
        let usage = wgpu::BufferUsages::STORAGE;
        let [place, attitude, schedule, identity] =
            columns.map(|bytes| upload::buffer(device, queue, "still leaves", usage, bytes));
        Self { place, attitude, schedule, identity, count }
    }

    /// Number of the leaves.
    pub(crate) fn count(&self) -> u32 {
        self.count
    }

    /// The leaves as columns.
    pub(crate) fn columns(&self) -> LeafColumns<'_> {
        LeafColumns {
            place: &self.place,
            // Drawing reads no drift, so any column will do.
            drift: &self.place,
            attitude: &self.attitude,
            schedule: &self.schedule,
            identity: &self.identity,
            leaf_count: self.count,
        }
    }
}
