// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Steps on their way to the device.

use windfall_core::SimError;
use windfall_core::blocks::StepBlock;
use windfall_core::device::leaf::air::AIR_UNIT_SHIFT;

use super::WgpuSimulator;
use crate::buffers::buffer;
use crate::prelude::{MAX_GROUPS, WORKGROUP_SIZE};
use crate::shaders::KernelId;

/// Steps per compute pass: their blocks are copied at once.
pub(super) const STEPS_PER_PASS: u32 = 32;
/// One in this many workgroups resolves events, which about one leaf in a hundred has; a longer list is strided over.
const EVENT_SHARE: u32 = 64;

impl WgpuSimulator {
    /// Encodes `count` steps, for a program that submits several things at once: the clock moves on, and the commands are
    /// the caller's to submit on the simulator's queue.
    ///
    /// Encoders are submitted in the order in which steps were encoded, and before any other method that changes or reads
    /// the state: those submit at once, or take effect at the next submission. Everything that a step needs travels in the
    /// encoder, so that several calls may share one encoder and one submission. An encoder that is dropped instead of
    /// submitted leaves the clock ahead of the state until the next
    /// [`write_state`](windfall_core::Simulator::write_state).
    ///
    /// # Errors
    /// A lost device. Errors in commands show when the encoder is finished.
    pub fn encode_steps(&mut self, encoder: &mut wgpu::CommandEncoder, count: u32) -> Result<(), SimError> {
        let gpu = self.gpu.clone();
        let mut left = count;
        gpu.scoped(|| {
            while left > 0 {
                let batch = left.min(STEPS_PER_PASS);
                left -= batch;
                self.encode_pass(encoder, batch, None);
            }
        })
    }

    /// Submits steps as [`Simulator::step`](windfall_core::Simulator::step) does, with timestamps at the start of the
    /// first and the end of the last compute pass.
    ///
    /// # Errors
    /// A lost device.
    pub fn step_timed(
        &mut self,
        count: u32,
        timestamps: Option<wgpu::ComputePassTimestampWrites<'_>>,
    ) -> Result<(), SimError> {
        let mut left = count;
        while left > 0 {
            let batch = left.min(STEPS_PER_PASS);
            let first = left == count;
            left -= batch;
            let writes = timestamps.clone().map(|stamps| wgpu::ComputePassTimestampWrites {
                beginning_of_pass_write_index: stamps.beginning_of_pass_write_index.filter(|_| first),
                end_of_pass_write_index: stamps.end_of_pass_write_index.filter(|_| left == 0),
                ..stamps
            });
            // wgpu refuses timestamp writes that write nothing.
            let writes = writes.filter(|stamps| {
                stamps.beginning_of_pass_write_index.is_some() || stamps.end_of_pass_write_index.is_some()
            });
            let gpu = self.gpu.clone();
            gpu.scoped(|| {
                let mut encoder =
                    gpu.device().create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
                self.encode_pass(&mut encoder, batch, writes);
                gpu.queue().submit([encoder.finish()]);
            })?;
        }
        Ok(())
    }

    /// Most leaves of a page of so many that sample the air in a step.
    fn sampling_leaves(&self, leaves: u32, step: u32) -> u32 {
        let block = self.compiled.block();
        let interval = block.wind.interval_steps;
        // In a world that repeats all have the same turns.
        if block.ids_per_life == 0 {
            return if step.is_multiple_of(interval) { leaves } else { 0 };
        }
        leaves.div_ceil(interval << AIR_UNIT_SHIFT) << AIR_UNIT_SHIFT
    }

    /// Encodes a compute pass of at most [`STEPS_PER_PASS`] steps.
    fn encode_pass(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        count: u32,
        timestamp_writes: Option<wgpu::ComputePassTimestampWrites<'_>>,
    ) {
        let first = self.clock.step();
        let mut blocks = vec![0; (count * self.step_stride) as usize];
        for slot in blocks.chunks_exact_mut(self.step_stride as usize) {
            let block = self.compiled.step_block(&self.clock);
            slot[..size_of::<StepBlock>()].copy_from_slice(bytemuck::bytes_of(&block));
            self.compiled.advance(&mut self.clock);
        }
        // A write to a buffer takes effect before the whole submission, a copy between its passes: the blocks go into a
        // buffer of their own and are copied from there.
        let staged = buffer(&self.gpu, "steps", blocks.len() as u64, wgpu::BufferUsages::COPY_SRC);
        self.gpu.queue().write_buffer(&staged, 0, &blocks);
        encoder.copy_buffer_to_buffer(&staged, 0, &self.step_buffer, 0, blocks.len() as u64);
        let descriptor = wgpu::ComputePassDescriptor { label: Some("advance"), timestamp_writes };
        let mut pass = encoder.begin_compute_pass(&descriptor);
        let kernel = |kernel| self.pipelines.kernel(kernel);
        let has_bodies = self.compiled.block().has_bodies();
        for (step, index) in (0..count).zip(first..) {
            let offset = step * self.step_stride;
            if let Some(forest) = &self.forest {
                if self.compiled.block().sway.solves_joints(index) {
                    let sway = KernelId::of_scheme(self.compiled.scene().sway);
                    forest.encode(&mut pass, sway.map(kernel), offset);
                } else {
                    forest.encode_coast(&mut pass, kernel(KernelId::SwayCoast), offset);
                }
                pass.set_pipeline(kernel(KernelId::Carry));
            }
            for page in &self.pages {
                let Some(on_trees) = &page.on_trees else { continue };
                pass.set_bind_group(0, &page.in_motion, &[offset]);
                pass.set_bind_group(1, &on_trees.carriers, &[]);
                pass.dispatch_workgroups(on_trees.leaves.div_ceil(WORKGROUP_SIZE).min(MAX_GROUPS), 1, 1);
            }
            for page in &self.pages {
                pass.set_bind_group(0, &page.in_motion, &[offset]);
                let sampling = self.sampling_leaves(page.leaves, index);
                if sampling > 0 {
                    pass.set_pipeline(kernel(KernelId::SampleAir));
                    pass.dispatch_workgroups(sampling.div_ceil(WORKGROUP_SIZE).min(MAX_GROUPS), 1, 1);
                }
                pass.set_bind_group(1, &page.events, &[]);
                let groups = page.leaves.div_ceil(WORKGROUP_SIZE);
                pass.set_pipeline(kernel(KernelId::Advance));
                pass.dispatch_workgroups(groups.min(MAX_GROUPS), 1, 1);
                pass.set_bind_group(0, &page.columns, &[offset]);
                pass.set_pipeline(kernel(KernelId::ResolveEvents));
                pass.dispatch_workgroups(groups.div_ceil(EVENT_SHARE), 1, 1);
                if has_bodies {
                    pass.set_pipeline(kernel(KernelId::Fly));
                    pass.dispatch_workgroups(groups.min(MAX_GROUPS), 1, 1);
                }
            }
        }
    }
}
