// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Brings the records of one leaf or particle back from the device, a frame or two late, without ever waiting for it.

use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

use windfall_core::leaf::LeafRecords;
use windfall_core::particle::{ParticleMotion, ParticlePlace, ParticleStore, ParticleTraits};
use windfall_wgpu::WorldColumns;

use crate::view::tools::pick::Picked;

/// Bytes of a record.
const RECORD_BYTES: u64 = 16;

const IDLE: u8 = 0;
const COPIED: u8 = 1;
const MAPPING: u8 = 2;
const MAPPED: u8 = 3;
const FAILED: u8 = 4;

/// The records of a leaf or a particle at a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct At<T> {
    pub(crate) step: u32,
    pub(crate) records: T,
}

/// The records of a particle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct ParticleRecords {
    pub(crate) place: ParticlePlace,
    pub(crate) motion: ParticleMotion,
    pub(crate) traits: ParticleTraits,
}

impl ParticleRecords {
    /// Those of a slot.
    pub(crate) fn of(particles: &ParticleStore, slot: usize) -> Self {
        Self { place: particles.place[slot], motion: particles.motion[slot], traits: particles.traits[slot] }
    }
}

/// Records that have come back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Found {
    Leaf(u32, At<LeafRecords>),
    Particle(u32, At<ParticleRecords>),
}

/// The way back.
#[derive(Debug)]
pub(crate) struct Probe {
    buffer: wgpu::Buffer,
    state: Arc<AtomicU8>,
    /// Leaf or particle whose records are on their way, and the step at which it was asked for.
    asked: (Picked, u32),
}

impl Probe {
    pub(crate) fn new(device: &wgpu::Device) -> Self {
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("probe"),
            size: 5 * RECORD_BYTES,
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self { buffer, state: Arc::new(AtomicU8::new(IDLE)), asked: (Picked::Leaf(0), 0) }
    }

    /// Copies the records of a leaf or particle as they are at `step`, unless earlier ones are still on their way.
    pub(crate) fn ask(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        columns: &WorldColumns<'_>,
        picked: Picked,
        step: u32,
    ) {
        let leaves = &columns.leaves;
        let (buffers, slot, count) = match (picked, &columns.particles) {
            (Picked::Leaf(slot), _) => {
                let all = [leaves.place, leaves.drift, leaves.attitude, leaves.schedule, leaves.identity];
                (all.to_vec(), slot, leaves.leaf_count)
            }
            (Picked::Particle(slot), Some(particles)) => {
                (vec![particles.place, particles.motion, particles.traits], slot, particles.count)
            }
            (Picked::Particle(_), None) => return,
        };
        let is_free = self.state.compare_exchange(IDLE, COPIED, Ordering::AcqRel, Ordering::Acquire).is_ok();
        if slot >= count || !is_free {
            return;
        }
        self.asked = (picked, step);
        for (index, column) in (0..).zip(buffers) {
            let start = u64::from(slot) * RECORD_BYTES;
            encoder.copy_buffer_to_buffer(column, start, &self.buffer, index * RECORD_BYTES, RECORD_BYTES);
        }
    }

    /// Records that have come back; call it after submitting.
    pub(crate) fn collect(&mut self, device: &wgpu::Device) -> Option<Found> {
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

    fn read(&self) -> Option<Found> {
        let view = self.buffer.get_mapped_range(..).ok()?;
        let bytes = view.to_vec();
        let part = |index: usize| &bytes[index * 16..(index + 1) * 16];
        let (picked, step) = self.asked;
        Some(match picked {
            Picked::Leaf(slot) => {
                let records = LeafRecords {
                    place: bytemuck::pod_read_unaligned(part(0)),
                    drift: bytemuck::pod_read_unaligned(part(1)),
                    attitude: bytemuck::pod_read_unaligned(part(2)),
                    schedule: bytemuck::pod_read_unaligned(part(3)),
                    identity: bytemuck::pod_read_unaligned(part(4)),
                };
                Found::Leaf(slot, At { step, records })
            }
            Picked::Particle(slot) => {
                let records = ParticleRecords {
                    place: bytemuck::pod_read_unaligned(part(0)),
                    motion: bytemuck::pod_read_unaligned(part(1)),
                    traits: bytemuck::pod_read_unaligned(part(2)),
                };
                Found::Particle(slot, At { step, records })
            }
        })
    }
}
