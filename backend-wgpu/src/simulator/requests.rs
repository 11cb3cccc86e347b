// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! State and counts on their way to the host, for programs that must not wait.

use windfall_core::stats::COUNTER_COUNT;
use windfall_core::store::StoreSize;
use windfall_core::{Clock, SimError, Stats, World};

use super::WgpuSimulator;
use crate::kernel_id::KernelId;
use crate::prelude::WORKGROUP_SIZE;
use crate::readback::{Readback, Run};

/// The state after the steps that had been submitted when it was requested.
#[derive(Debug)]
pub struct StateRequest {
    readback: Readback,
    clock: Clock,
    sizes: Vec<StoreSize>,
}

/// Counts over all leaves after the steps that had been submitted when they were requested.
#[derive(Debug)]
pub struct StatsRequest {
    readback: Readback,
    step: u32,
    unused_rows: u32,
}

impl WgpuSimulator {
    /// Starts to copy the state out. Steps that are submitted later do not change what arrives.
    ///
    /// # Errors
    /// A lost device.
    pub fn request_state(&self) -> Result<StateRequest, SimError> {
        let readback = self.buffers.request(&self.gpu)?;
        Ok(StateRequest { readback, clock: self.clock, sizes: self.buffers.sizes() })
    }

    /// Starts to count the leaves.
    ///
    /// # Errors
    /// A lost device.
    pub fn request_stats(&self) -> Result<StatsRequest, SimError> {
        self.gpu.scoped(|| {
            self.gpu.queue().write_buffer(&self.counters, 0, &[0; COUNTER_COUNT as usize * 4]);
            let mut encoder =
                self.gpu.device().create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            {
                let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
                pass.set_pipeline(self.pipelines.kernel(KernelId::Measure));
                pass.set_bind_group(1, &self.counters_group, &[]);
                for page in &self.pages {
                    pass.set_bind_group(0, &page.in_motion, &[0]);
                    pass.dispatch_workgroups(page.leaves.div_ceil(WORKGROUP_SIZE), 1, 1);
                }
            }
            self.gpu.queue().submit([encoder.finish()]);
        })?;
        let size = u64::from(COUNTER_COUNT) * 4;
        let run = Run { buffer: &self.counters, offset: 0, size };
        let readback = Readback::new(&self.gpu, std::iter::once(run))?;
        let unused_rows = self.compiled.shard_rows().unused_rows();
        Ok(StatsRequest { readback, step: self.clock.step(), unused_rows })
    }
}

impl StateRequest {
    /// Fills `world` and returns true once the state has arrived. Never waits; call it once a frame.
    ///
    /// # Errors
    /// [`SimError::Size`] if a store of the world is of another size; a lost device.
    pub fn poll(&self, world: &mut World) -> Result<bool, SimError> {
        world.fits(&self.sizes)?;
        if !self.readback.poll()? {
            return Ok(false);
        }
        let mut stores = world.stores_mut();
        self.readback.take(stores.iter_mut().flat_map(|store| store.columns_mut()))?;
        world.clock = self.clock;
        Ok(true)
    }
}

impl StatsRequest {
    /// The counts once they have arrived. Never waits; call it once a frame.
    ///
    /// # Errors
    /// A lost device.
    pub fn poll(&self) -> Result<Option<Stats>, SimError> {
        self.readback.poll()?.then(|| self.take()).transpose()
    }

    /// The counts, waited for.
    pub(super) fn wait(&self) -> Result<Stats, SimError> {
        self.readback.wait()?;
        self.take()
    }

    fn take(&self) -> Result<Stats, SimError> {
        let mut counters = [0u32; COUNTER_COUNT as usize];
        self.readback.take(std::iter::once(bytemuck::cast_slice_mut(&mut counters)))?;
        Ok(Stats::from_counters(&counters, self.step).without_unused(self.unused_rows))
    }
}
