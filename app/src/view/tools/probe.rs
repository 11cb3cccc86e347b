// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Brings one leaf's records back from the device, a frame or two late, without ever waiting for it.

use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

use windfall_core::leaf::LeafRecords;
use windfall_wgpu::LeafColumns;

/// Bytes of a record.
const RECORD_BYTES: u64 = 16;

const IDLE: u8 = 0;
const COPIED: u8 = 1;
const MAPPING: u8 = 2;
const MAPPED: u8 = 3;
const FAILED: u8 = 4;

/// A leaf at a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct LeafAt {
    pub(crate) step: u32,
    pub(crate) leaf: LeafRecords,
}

/// The way back.
#[derive(Debug)]
pub(crate) struct Probe {
    buffer: wgpu::Buffer,
    state: Arc<AtomicU8>,
    /// Slot and step of what is on its way.
    asked: (u32, u32),
}

impl Probe {
    pub(crate) fn new(device: &wgpu::Device) -> Self {
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("probe"),
            size: 5 * RECORD_BYTES,
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self { buffer, state: Arc::new(AtomicU8::new(IDLE)), asked: (0, 0) }
    }

    /// Copies the records of a slot as they are at `step`, unless earlier ones are still on their way.
    pub(crate) fn ask(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        leaves: &LeafColumns<'_>,
        slot: u32,
        step: u32,
    ) {
        let is_free = self.state.compare_exchange(IDLE, COPIED, Ordering::AcqRel, Ordering::Acquire).is_ok();
        if slot >= leaves.leaf_count || !is_free {
            return;
        }
        self.asked = (slot, step);
        let columns = [leaves.place, leaves.drift, leaves.attitude, leaves.schedule, leaves.identity];
        for (index, column) in (0..).zip(columns) {
            let from = u64::from(slot) * RECORD_BYTES;
            encoder.copy_buffer_to_buffer(column, from, &self.buffer, index * RECORD_BYTES, RECORD_BYTES);
        }
    }

    /// Slot and records that have come back; call it after submitting.
    pub(crate) fn collect(&mut self, device: &wgpu::Device) -> Option<(u32, LeafAt)> {
        if self.state.compare_exchange(COPIED, MAPPING, Ordering::AcqRel, Ordering::Acquire).is_ok() {
            let state = Arc::clone(&self.state);
            self.buffer.map_async(wgpu::MapMode::Read, .., move |result| {
                state.store(if result.is_ok() { MAPPED } else { FAILED }, Ordering::Release);
            });
        }
        // A lost device shows elsewhere; here it only leaves the leaf as it was.
        let _ = device.poll(wgpu::PollType::Poll);
        match self.state.load(Ordering::Acquire) {
            MAPPED => {
                let records = self.read();
                self.buffer.unmap();
                self.state.store(IDLE, Ordering::Release);
                records
            }
            FAILED => {
                self.state.store(IDLE, Ordering::Release);
                None
            }
            _ => None,
        }
    }

    fn read(&self) -> Option<(u32, LeafAt)> {
        let view = self.buffer.get_mapped_range(..).ok()?;
        let bytes = view.to_vec();
        let part = |index: usize| &bytes[index * 16..(index + 1) * 16];
        let (slot, step) = self.asked;
        let leaf = LeafRecords {
            place: bytemuck::pod_read_unaligned(part(0)),
            drift: bytemuck::pod_read_unaligned(part(1)),
            attitude: bytemuck::pod_read_unaligned(part(2)),
            schedule: bytemuck::pod_read_unaligned(part(3)),
            identity: bytemuck::pod_read_unaligned(part(4)),
        };
        Some((slot, LeafAt { step, leaf }))
    }
}
