// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Steps on their way to the device.

use windfall_core::SimError;
use windfall_core::blocks::StepBlock;
use windfall_core::scene::SwayScheme;

use super::{MAX_GROUPS, WgpuSimulator};
use crate::prelude::WORKGROUP_SIZE;

/// Steps per submission: their blocks travel in one write.
pub(super) const STEPS_PER_SUBMIT: u32 = 32;
/// One in this many workgroups attends to due leaves, about one leaf in a hundred; a longer list is strided over.
const ATTEND_SHARE: u32 = 64;

impl WgpuSimulator {
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
            self.gpu.check()?;
            let batch = left.min(STEPS_PER_SUBMIT);
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
            self.submit_steps(batch, writes);
        }
        self.gpu.check()
    }

    fn submit_steps(&mut self, count: u32, timestamp_writes: Option<wgpu::ComputePassTimestampWrites<'_>>) {
        let mut blocks = vec![0; (count * self.step_stride) as usize];
        for slot in blocks.chunks_exact_mut(self.step_stride as usize) {
            let block = self.environment.step_block(&self.clock);
            slot[..size_of::<StepBlock>()].copy_from_slice(bytemuck::bytes_of(&block));
            self.clock.advance(&self.environment);
        }
        self.gpu.queue().write_buffer(&self.step_buffer, 0, &blocks);
        let mut encoder =
            self.gpu.device().create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let descriptor = wgpu::ComputePassDescriptor { label: Some("advance"), timestamp_writes };
            let mut pass = encoder.begin_compute_pass(&descriptor);
            let has_bodies = self.environment.block().has_bodies();
            let scheme = usize::from(self.environment.scene().sway != SwayScheme::Articulated);
            for step in 0..count {
                let offset = step * self.step_stride;
                if let Some(forest) = &self.forest {
                    forest.encode(&mut pass, &self.pipelines.sway[scheme], offset);
                    pass.set_pipeline(&self.pipelines.carry);
                }
                for on_trees in self.pages.iter().filter_map(|page| page.on_trees.as_ref()) {
                    pass.set_bind_group(0, &on_trees.carried, &[offset]);
                    pass.set_bind_group(1, &on_trees.carriers, &[]);
                    pass.dispatch_workgroups(on_trees.leaves.div_ceil(WORKGROUP_SIZE).min(MAX_GROUPS), 1, 1);
                }
                for page in &self.pages {
                    pass.set_bind_group(0, &page.columns, &[offset]);
                    pass.set_bind_group(1, &page.due, &[]);
                    let groups = page.leaves.div_ceil(WORKGROUP_SIZE);
                    pass.set_pipeline(&self.pipelines.advance);
                    pass.dispatch_workgroups(groups.min(MAX_GROUPS), 1, 1);
                    pass.set_pipeline(&self.pipelines.attend);
                    pass.dispatch_workgroups(groups.div_ceil(ATTEND_SHARE), 1, 1);
                    if let Some(fly) = self.pipelines.fly.as_ref().filter(|_| has_bodies) {
                        pass.set_pipeline(fly);
                        pass.dispatch_workgroups(groups.min(MAX_GROUPS), 1, 1);
                    }
                }
            }
        }
        self.gpu.queue().submit([encoder.finish()]);
    }
}
