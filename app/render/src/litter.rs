// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Buffers of the litter, drawn through the same pass as the simulated leaves.

use glam::Vec3;
use windfall_wgpu::LeafColumns;

use super::scenery::{Shedding, scatter};
use super::upload;
use crate::land::Land;

/// Most leaves of litter.
const MAX_LITTER: u32 = 100_000;

/// Leaves that fell before the scene began.
#[derive(Debug)]
pub(super) struct Litter {
    place: wgpu::Buffer,
    attitude: wgpu::Buffer,
    course: wgpu::Buffer,
    identity: wgpu::Buffer,
    count: u32,
}

impl Litter {
    /// `None` for no leaves.
    pub(super) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        count: u32,
        species_count: u32,
        land: &Land,
        center: Vec3,
        trees: &[Shedding],
    ) -> Option<Self> {
        let count = count.min(MAX_LITTER);
        let columns = scatter(count, species_count, land, center, trees);
        let column =
            |bytes: &[u8]| upload::buffer(device, queue, "litter", wgpu::BufferUsages::STORAGE, bytes);
        (count > 0).then(|| Self {
            place: column(bytemuck::cast_slice(&columns.place)),
            attitude: column(bytemuck::cast_slice(&columns.attitude)),
            course: column(bytemuck::cast_slice(&columns.course)),
            identity: column(bytemuck::cast_slice(&columns.identity)),
            count,
        })
    }

    /// The litter as leaf columns.
    pub(super) fn columns(&self) -> LeafColumns<'_> {
        LeafColumns {
            place: &self.place,
            // Drawing reads no drift, so any column will do.
            drift: &self.place,
            attitude: &self.attitude,
            course: &self.course,
            identity: &self.identity,
            leaf_count: self.count,
        }
    }
}
