// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Steps on their way to the device.

use windfall_core::SimError;
use windfall_core::blocks::StepBlock;
use windfall_core::device::leaf::air::AIR_UNIT_SHIFT;

use super::WgpuSimulator;
use super::pages::List;
use crate::buffers::buffer;
use crate::kernel_id::KernelId;
use crate::lists::{
    ACTIVE_HEAD_BYTES, ALL_GROUPS, SAMPLING_GROUPS, empty_active, event_groups, window_steps,
};
use crate::prelude::WORKGROUP_SIZE;

/// Steps per compute pass: their blocks are copied at once.
pub(super) const STEPS_PER_PASS: u32 = 32;

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
                let batch = left.min(self.longest_pass());
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
            let batch = left.min(self.longest_pass());
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

    /// Most steps of the next pass, which ends with the window of the active lists.
    fn longest_pass(&self) -> u32 {
        let left =
            if self.listed_steps == 0 { window_steps(self.compiled.block()) } else { self.listed_steps };
        left.min(STEPS_PER_PASS)
    }

    /// Returns true if some leaves sample the air in a step: in a world that repeats they all do so in the same steps.
    fn samples_air(&self, step: u32) -> bool {
        let block = self.compiled.block();
        block.ids_per_life != 0 || step.is_multiple_of(block.wind.interval_steps)
    }

    /// Encodes a compute pass of at most [`Self::longest_pass`] steps.
    fn encode_pass(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        count: u32,
        timestamp_writes: Option<wgpu::ComputePassTimestampWrites<'_>>,
    ) {
        let first = self.clock.step();
        let mut blocks = vec![0; (count * self.step_stride) as usize];
        let steps_bytes = blocks.len() as u64;
        for slot in blocks.chunks_exact_mut(self.step_stride as usize) {
            let block = self.compiled.step_block(&self.clock);
            slot[..size_of::<StepBlock>()].copy_from_slice(bytemuck::bytes_of(&block));
            self.compiled.advance(&mut self.clock);
        }
        let is_window_start = self.listed_steps == 0;
        if is_window_start {
            self.listed_steps = window_steps(self.compiled.block());
            blocks.extend_from_slice(bytemuck::cast_slice(&empty_active()));
        }
        self.listed_steps -= count;
        // A write to a buffer takes effect before the whole submission, a copy between its passes: what changes from pass to pass
        // goes into a buffer of its own and is copied from there.
        let staged = buffer(&self.gpu, "steps", blocks.len() as u64, wgpu::BufferUsages::COPY_SRC);
        self.gpu.queue().write_buffer(&staged, 0, &blocks);
        encoder.copy_buffer_to_buffer(&staged, 0, &self.step_buffer, 0, steps_bytes);
        if is_window_start {
            for page in &self.pages {
                encoder.copy_buffer_to_buffer(
                    &staged,
                    steps_bytes,
                    &page.active.buffer,
                    0,
                    ACTIVE_HEAD_BYTES,
                );
            }
        }
        let descriptor = wgpu::ComputePassDescriptor { label: Some("advance"), timestamp_writes };
        let mut pass = encoder.begin_compute_pass(&descriptor);
        if is_window_start {
            self.encode_lists(&mut pass);
        }
        for (step, index) in (0..count).zip(first..) {
            self.encode_step(&mut pass, step * self.step_stride, index);
        }
    }

    /// Lists the leaves that the steps of a window can change; the first of them has its block in front.
    fn encode_lists(&self, pass: &mut wgpu::ComputePass<'_>) {
        pass.set_pipeline(self.pipelines.kernel(KernelId::ListActive));
        for page in &self.pages {
            pass.set_bind_group(0, &page.in_motion, &[0]);
            pass.set_bind_group(1, &page.active.filled, &[]);
            pass.dispatch_workgroups(page.leaves.div_ceil(WORKGROUP_SIZE), 1, 1);
        }
    }

    /// Encodes step number `index`, whose block lies at `offset`.
    fn encode_step(&self, pass: &mut wgpu::ComputePass<'_>, offset: u32, index: u32) {
        let kernel = |kernel| self.pipelines.kernel(kernel);
        let mut heats = None;
        if let Some(particles) = &self.particles {
            particles.encode_carriers(pass, || kernel(KernelId::CarryForces), offset);
            particles.encode_pulls(pass, || kernel(KernelId::PullParticles), offset);
            particles.encode(pass, kernel(KernelId::StepParticles), offset);
            particles.encode_history(pass, || kernel(KernelId::KeepHistory), (index, offset));
        }
        if let Some(cells) = &self.collisions
            && self.compiled.block().collides(index)
        {
            self.encode_collisions(pass, cells, offset);
        }
        if let Some(heat) = self.heat.as_ref().filter(|_| self.compiled.block().heats(index)) {
            self.encode_burning(pass, offset);
            heats = Some(heat);
        }
        if let Some(forest) = &self.forest {
            if self.compiled.block().sway.solves_joints(index) {
                let sway = KernelId::of_scheme(self.compiled.scene().sway);
                forest.encode(pass, sway.map(kernel), offset);
            } else {
                forest.encode_coast(pass, kernel(KernelId::SwayCoast), offset);
            }
            pass.set_pipeline(kernel(KernelId::Carry));
        }
        for page in &self.pages {
            let Some(on_trees) = &page.on_trees else { continue };
            pass.set_bind_group(0, &on_trees.columns, &[offset]);
            pass.set_bind_group(1, &page.active.filled, &[]);
            pass.set_bind_group(2, &on_trees.carriers, &[]);
            pass.dispatch_workgroups(on_trees.leaves.div_ceil(WORKGROUP_SIZE), 1, 1);
        }
        for page in &self.pages {
            let active = &page.active.buffer;
            pass.set_bind_group(0, &page.in_motion, &[offset]);
            pass.set_bind_group(1, &page.active.read, &[]);
            if self.samples_air(index) {
                pass.set_pipeline(kernel(KernelId::SampleAir));
                pass.dispatch_workgroups_indirect(active, SAMPLING_GROUPS);
            }
            pass.set_pipeline(kernel(KernelId::Advance));
            pass.set_bind_group(2, &page.events.filled, &[]);
            pass.dispatch_workgroups_indirect(active, ALL_GROUPS);
            pass.set_pipeline(kernel(KernelId::ResolveEvents));
            pass.set_bind_group(0, &page.columns, &[offset]);
            pass.set_bind_group(1, &page.events.read, &[]);
            pass.dispatch_workgroups_indirect(&page.events.buffer, event_groups(index));
            if self.compiled.block().has_bodies() {
                pass.set_pipeline(kernel(KernelId::Fly));
                pass.set_bind_group(1, &page.active.read, &[]);
                pass.dispatch_workgroups_indirect(active, ALL_GROUPS);
            }
        }
        if self.compiled.block().has_living_litter() {
            self.encode_litter(pass, offset);
        }
        if let Some(heat) = heats {
            pass.set_pipeline(kernel(KernelId::SettleFires));
            pass.set_bind_group(0, &heat.fires, &[offset]);
            pass.set_bind_group(1, &heat.written, &[]);
            pass.dispatch_workgroups(heat.words.div_ceil(WORKGROUP_SIZE), 1, 1);
        }
        self.encode_snow(pass, offset, index);
        self.encode_following(pass, offset);
    }

    /// Encodes the heating of leaves, and their burning: all release their heat before the first takes any up.
    fn encode_burning(&self, pass: &mut wgpu::ComputePass<'_>, offset: u32) {
        for kernel in [KernelId::GatherHeat, KernelId::BurnLeaves] {
            pass.set_pipeline(self.pipelines.kernel(kernel));
            for page in &self.pages {
                let Some(burning) = &page.burning else { continue };
                let gathers = kernel == KernelId::GatherHeat;
                pass.set_bind_group(0, &burning.columns, &[offset]);
                pass.set_bind_group(1, if gathers { &page.active.read } else { &page.active.filled }, &[]);
                pass.set_bind_group(2, if gathers { &burning.heat } else { &burning.heated }, &[]);
                pass.dispatch_workgroups(page.leaves.div_ceil(WORKGROUP_SIZE), 1, 1);
            }
        }
    }

    /// Encodes the places of particles that are where leaves burn.
    fn encode_following(&self, pass: &mut wgpu::ComputePass<'_>, offset: u32) {
        for (page, burning) in self.pages.iter().filter_map(|page| Some((page, page.burning.as_ref()?))) {
            for bound in &burning.on_leaves {
                pass.set_pipeline(self.pipelines.kernel(KernelId::FollowLeaves));
                pass.set_bind_group(0, &burning.moved, &[offset]);
                pass.set_bind_group(1, bound, &[]);
                pass.dispatch_workgroups(page.leaves.div_ceil(WORKGROUP_SIZE), 1, 1);
            }
        }
    }

    /// Encodes the collisions of bodies with each other, as they are at the start of a step.
    fn encode_collisions(&self, pass: &mut wgpu::ComputePass<'_>, cells: &List, offset: u32) {
        let rounds = [
            (KernelId::GatherCollisions, &cells.filled),
            (KernelId::Collide, &cells.read),
            (KernelId::ClearCollisions, &cells.filled),
        ];
        for (kernel, bound) in rounds {
            pass.set_pipeline(self.pipelines.kernel(kernel));
            pass.set_bind_group(2, bound, &[]);
            for page in &self.pages {
                pass.set_bind_group(0, &page.in_motion, &[offset]);
                pass.set_bind_group(1, &page.active.read, &[]);
                pass.dispatch_workgroups_indirect(&page.active.buffer, ALL_GROUPS);
            }
        }
    }

    /// Encodes a kernel that may let leaves of the litter go, for the units of slots that have their turn, of so many turns.
    fn encode_turn(&self, pass: &mut wgpu::ComputePass<'_>, kernel: KernelId, turns: u32, offset: u32) {
        pass.set_pipeline(self.pipelines.kernel(kernel));
        for page in &self.pages {
            let units = page.leaves.div_ceil(1 << AIR_UNIT_SHIFT).div_ceil(turns);
            pass.set_bind_group(0, &page.in_motion, &[offset]);
            pass.set_bind_group(1, &page.active.filled, &[]);
            pass.dispatch_workgroups((units << AIR_UNIT_SHIFT).div_ceil(WORKGROUP_SIZE), 1, 1);
        }
    }

    /// Encodes what leaves do to the litter in a step: all of them sample the heights before any changes.
    fn encode_litter(&self, pass: &mut wgpu::ComputePass<'_>, offset: u32) {
        let block = self.compiled.block();
        // Solid parts that move may come upon any leaf.
        if block.has_movers() {
            self.encode_turn(pass, KernelId::PushLying, 1, offset);
        }
        self.encode_turn(pass, KernelId::CheckCover, block.litter.cover_steps, offset);
        if !block.is_calm() {
            self.encode_turn(pass, KernelId::WakeLying, block.litter.wake_steps, offset);
        }
        pass.set_pipeline(self.pipelines.kernel(KernelId::StackLitter));
        for page in &self.pages {
            pass.set_bind_group(0, &page.with_litter, &[offset]);
            pass.set_bind_group(1, &page.active.read, &[]);
            pass.dispatch_workgroups_indirect(&page.active.buffer, ALL_GROUPS);
        }
    }
}
