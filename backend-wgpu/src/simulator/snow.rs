// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Bindings of the snow, and its part of a step.

use windfall_core::blocks::NEVER;
use windfall_core::device::particle::record::{POPULATION_BRANCH_SNOW, POPULATION_SNOW};
use windfall_core::device::terrain::snow::{SNOW_AGES, snow_turn};
use windfall_core::device::terrain::snow_print::snow_is_pressed;
use windfall_core::device::tree::branch_snow::CROWN_TURN;
use windfall_core::particle::ParticleRun;

use super::WgpuSimulator;
use crate::buffers::{group, uniform};
use crate::kernel_id::KernelId;
use crate::particles::WINDOW_STEP;
use crate::pipelines::GroupLayout;
use crate::prelude::WORKGROUP_SIZE;

/// Bindings of the snow of a world.
#[derive(Debug)]
pub(super) struct SnowBindings {
    /// Blocks, and the tables to be written.
    written: wgpu::BindGroup,
    /// Runs of flakes, and how many.
    flakes: Vec<(wgpu::BindGroup, u32)>,
    cells: u32,
}

impl WgpuSimulator {
    /// Binds the snow, where there is any.
    pub(super) fn bind_snow(&mut self) {
        let block = self.compiled.block();
        if !block.has_snow() {
            return;
        }
        let written =
            group(&self.gpu, self.pipelines.layout(GroupLayout::BlocksAndLitter), self.shared_blocks());
        let mut flakes = Vec::new();
        let falls = |flags: u32| (flags & (POPULATION_SNOW | POPULATION_BRANCH_SNOW)) != 0;
        for population in block.populations.iter().filter(|one| falls(one.flags)) {
            let end = population.first_slot + population.count;
            for first in (population.first_slot..end).step_by(self.page_leaves as usize) {
                let count = (end - first).min(self.page_leaves);
                let aligned = first / WINDOW_STEP * WINDOW_STEP;
                let run = ParticleRun { first: first - aligned, count, page_slot: aligned, unused: 0 };
                let run_block = uniform(&self.gpu, "flakes", &run);
                let window = |column| {
                    let window = self.buffers.particles().window(column, aligned, run.first + count);
                    wgpu::BindingResource::Buffer(window)
                };
                let resources = [run_block.as_entire_binding(), window(0), window(2)];
                let bound = group(&self.gpu, self.pipelines.layout(GroupLayout::Flakes), resources);
                flakes.push((bound, count));
            }
        }
        let cells = block.snow.columns * block.snow.lines;
        self.snow = Some(SnowBindings { written, flakes, cells });
    }

    /// Encodes what becomes of the snow in step number `index`, whose block lies at `offset`.
    pub(super) fn encode_snow(&self, pass: &mut wgpu::ComputePass<'_>, offset: u32, index: u32) {
        let Some(snow) = &self.snow else { return };
        pass.set_pipeline(self.pipelines.kernel(KernelId::LandFlakes));
        pass.set_bind_group(0, &snow.written, &[offset]);
        for (flakes, count) in &snow.flakes {
            pass.set_bind_group(1, flakes, &[]);
            pass.dispatch_workgroups(count.div_ceil(WORKGROUP_SIZE), 1, 1);
        }
        let branches = self.compiled.block().snow.branches;
        if matches!(snow_turn(index), CROWN_TURN | SNOW_AGES)
            && branches != 0
            && let Some(forest) = &self.forest
        {
            pass.set_pipeline(self.pipelines.kernel(KernelId::StepBranchSnow));
            forest.encode_segments(pass, branches);
        }
        if snow_turn(index) != NEVER {
            pass.set_pipeline(self.pipelines.kernel(KernelId::StepSnow));
            pass.dispatch_workgroups(snow.cells.div_ceil(WORKGROUP_SIZE), 1, 1);
        }
        if self.compiled.block().has_movers() && snow_is_pressed(index) {
            pass.set_pipeline(self.pipelines.kernel(KernelId::PressSnow));
            pass.dispatch_workgroups(snow.cells.div_ceil(WORKGROUP_SIZE), 1, 1);
        }
    }
}
