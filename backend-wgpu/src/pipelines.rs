// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compute pipelines under either contract.

use std::borrow::Cow;
use std::collections::HashMap;
use std::sync::{Mutex, PoisonError};

use windfall_core::{Contract, SimError};

use crate::gpu::Gpu;
use crate::kernel_id::KernelId;
use crate::prelude::WORKGROUP_SIZE;
use crate::shaders::{Shaders, compile_exact};

/// A group of bindings that kernels share.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum GroupLayout {
    /// Blocks, tables and all leaf columns.
    Leaves,
    /// The same without identities, for leaves that have no event.
    LeavesInMotion,
    /// The same without airs, for leaves on twigs.
    LeavesOnTwigs,
    /// All leaf columns, and the tables to be written, behind which the litter is.
    LeavesAndLitter,
    /// One storage buffer that kernels only read: the active list or the event lists of a page, or the cells of collisions.
    ReadBuffer,
    /// One storage buffer that they write: the same while they are filled, or the counters.
    WrittenBuffer,
    /// Blocks and tables.
    Blocks,
    /// A level of the forest.
    Level,
    /// Segments that carry leaves.
    Carriers,
    /// A run of particles, the columns of its page, and the counts of what happens to them.
    Particles,
    /// A population whose particles attract one another, and their accelerations.
    Mutual,
    /// A population that carries a force, and the places of all carriers.
    ForceCarriers,
    /// A population of whose ways samples are kept, and all samples.
    History,
    /// Blocks, tables, and places and drifts of leaves.
    LeavesThatMove,
    /// Blocks, and the tables to be written, behind which fires and snow are.
    BlocksAndLitter,
    /// The burning of the leaves of a page, and sums of heat to be added to.
    Heat,
    /// The same with sums that are only read.
    Heated,
    /// Particles that are where leaves burn, and the burning of these leaves.
    OnLeaves,
    /// A run of flakes and their places.
    Flakes,
}

impl GroupLayout {
    const ALL: [Self; 19] = [
        Self::Leaves,
        Self::LeavesInMotion,
        Self::LeavesOnTwigs,
        Self::LeavesAndLitter,
        Self::ReadBuffer,
        Self::WrittenBuffer,
        Self::Blocks,
        Self::Level,
        Self::Carriers,
        Self::Particles,
        Self::Mutual,
        Self::ForceCarriers,
        Self::History,
        Self::LeavesThatMove,
        Self::BlocksAndLitter,
        Self::Heat,
        Self::Heated,
        Self::OnLeaves,
        Self::Flakes,
    ];

    /// Resources, binding by binding.
    fn slots(self) -> &'static [Slot] {
        use Slot::{Block, BlockOfMany, Read, Write};
        // The bindings of shaders/bindings.wgsl: all of them, or those up to the tables, the airs, the schedules.
        const ALL: &[Slot] = &[Block, BlockOfMany, Read, Write, Write, Write, Write, Write, Write];
        match self {
            Self::Leaves => ALL,
            Self::Blocks => &ALL[..3],
            Self::LeavesInMotion => &ALL[..8],
            Self::LeavesThatMove => &ALL[..5],
            Self::BlocksAndLitter => &[Block, BlockOfMany, Write],
            Self::LeavesOnTwigs => &ALL[..7],
            Self::LeavesAndLitter => &[Block, BlockOfMany, Write, Write, Write, Write, Write, Write, Write],
            Self::ReadBuffer => &[Read],
            Self::WrittenBuffer => &[Write],
            // The bindings of shaders/tree/bindings.wgsl.
            Self::Level => &[BlockOfMany, Read, Read, Write, Write, Read],
            // The bindings of shaders/leaf/carrier_bindings.wgsl.
            Self::Carriers => &[Block, Read, Write],
            // The bindings of shaders/particle/bindings.wgsl.
            Self::Particles => &[BlockOfMany, Write, Write, Write, Write, Read, Read, Write],
            // The bindings of shaders/particle/mutual_bindings.wgsl.
            Self::Mutual => &[BlockOfMany, Read, Read, Write],
            // The bindings of shaders/particle/force_carrier_bindings.wgsl.
            Self::ForceCarriers => &[Block, Read, Read, Read, Write],
            // The bindings of shaders/leaf/burn_bindings.wgsl, and the sums.
            Self::Heat => &[Block, Write, Write],
            Self::Heated => &[Block, Write, Read],
            // The bindings of shaders/particle/on_leaf_bindings.wgsl.
            Self::OnLeaves => &[Block, Write, Write, Write, Read],
            // The bindings of shaders/particle/flake_bindings.wgsl.
            Self::Flakes => &[Block, Read, Read],
            // The bindings of shaders/particle/history_bindings.wgsl.
            Self::History => &[Block, Read, Write],
        }
    }
}

impl KernelId {
    /// The groups that the kernel binds.
    fn layouts(self) -> &'static [GroupLayout] {
        match self {
            Self::SwayInward | Self::SwayOutward | Self::SwayGather | Self::SwayFollow | Self::SwayCoast => {
                &[GroupLayout::Blocks, GroupLayout::Level]
            }
            Self::StepParticles => &[GroupLayout::Blocks, GroupLayout::Particles],
            Self::PullParticles => &[GroupLayout::Blocks, GroupLayout::Mutual],
            Self::CarryForces => &[GroupLayout::Blocks, GroupLayout::ForceCarriers],
            Self::KeepHistory => &[GroupLayout::Blocks, GroupLayout::History],
            Self::GatherHeat => &[GroupLayout::LeavesOnTwigs, GroupLayout::ReadBuffer, GroupLayout::Heat],
            Self::BurnLeaves => {
                &[GroupLayout::LeavesOnTwigs, GroupLayout::WrittenBuffer, GroupLayout::Heated]
            }
            Self::SettleFires => &[GroupLayout::BlocksAndLitter, GroupLayout::WrittenBuffer],
            Self::LandFlakes => &[GroupLayout::BlocksAndLitter, GroupLayout::Flakes],
            Self::StepBranchSnow => &[GroupLayout::BlocksAndLitter, GroupLayout::Level],
            Self::StepSnow | Self::PressSnow => &[GroupLayout::BlocksAndLitter],
            Self::FollowLeaves => &[GroupLayout::LeavesThatMove, GroupLayout::OnLeaves],
            Self::Carry => &[GroupLayout::LeavesOnTwigs, GroupLayout::WrittenBuffer, GroupLayout::Carriers],
            Self::ListActive | Self::Measure => &[GroupLayout::LeavesInMotion, GroupLayout::WrittenBuffer],
            Self::PushLying | Self::CheckCover | Self::WakeLying => {
                &[GroupLayout::LeavesInMotion, GroupLayout::WrittenBuffer]
            }
            Self::StackLitter => &[GroupLayout::LeavesAndLitter, GroupLayout::ReadBuffer],
            Self::SampleAir => &[GroupLayout::LeavesInMotion, GroupLayout::ReadBuffer],
            Self::Collide => &[GroupLayout::LeavesInMotion, GroupLayout::ReadBuffer, GroupLayout::ReadBuffer],
            Self::GatherCollisions | Self::ClearCollisions => {
                &[GroupLayout::LeavesInMotion, GroupLayout::ReadBuffer, GroupLayout::WrittenBuffer]
            }
            Self::Advance => {
                &[GroupLayout::LeavesInMotion, GroupLayout::ReadBuffer, GroupLayout::WrittenBuffer]
            }
            Self::ResolveEvents | Self::Fly => &[GroupLayout::Leaves, GroupLayout::ReadBuffer],
        }
    }
}

/// All that a device has compiled, by kernel, contract and text: its simulators share it, as drivers take up to seconds for a kernel.
pub(crate) type CompiledKernels = Mutex<HashMap<(KernelId, Contract, String), wgpu::ComputePipeline>>;

/// Binding layouts, and the pipelines of the kernels that have been needed so far.
#[derive(Debug)]
pub(crate) struct Pipelines {
    layouts: [wgpu::BindGroupLayout; GroupLayout::ALL.len()],
    kernels: [Option<wgpu::ComputePipeline>; KernelId::ALL.len()],
    shaders: Shaders,
    contract: Contract,
}

/// Resource bound at one place of a layout.
#[derive(Clone, Copy)]
enum Slot {
    Block,
    /// A block at an offset that the pass sets.
    BlockOfMany,
    Read,
    Write,
}

/// A layout of bindings that follow one another without a gap: Vulkan numbers them so, and exact shaders are passed
/// through to it as they are.
fn layout(gpu: &Gpu, label: &str, slots: &[Slot]) -> wgpu::BindGroupLayout {
    let entries: Vec<_> = (0..)
        .zip(slots)
        .map(|(binding, slot)| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Buffer {
                ty: match slot {
                    Slot::Block | Slot::BlockOfMany => wgpu::BufferBindingType::Uniform,
                    Slot::Read => wgpu::BufferBindingType::Storage { read_only: true },
                    Slot::Write => wgpu::BufferBindingType::Storage { read_only: false },
                },
                has_dynamic_offset: matches!(slot, Slot::BlockOfMany),
                min_binding_size: None,
            },
            count: None,
        })
        .collect();
    let descriptor = wgpu::BindGroupLayoutDescriptor { label: Some(label), entries: &entries };
    gpu.device().create_bind_group_layout(&descriptor)
}

impl Pipelines {
    /// No pipelines yet.
    pub(crate) fn new(gpu: &Gpu, shaders: Shaders, contract: Contract) -> Result<Self, SimError> {
        let layouts = GroupLayout::ALL.map(|group| layout(gpu, &format!("{group:?}"), group.slots()));
        Ok(Self { layouts, kernels: [const { None }; KernelId::ALL.len()], shaders, contract })
    }

    /// Compiles those of these kernels that are not there yet.
    pub(crate) fn prepare(
        &mut self,
        gpu: &Gpu,
        kernels: impl IntoIterator<Item = KernelId>,
    ) -> Result<(), SimError> {
        for kernel in kernels {
            if self.kernels[kernel as usize].is_none() {
                let layouts: Vec<_> =
                    kernel.layouts().iter().map(|&group| Some(self.layout(group))).collect();
                let pipeline = pipeline(gpu, &self.shaders, self.contract, kernel, &layouts)?;
                self.kernels[kernel as usize] = Some(pipeline);
            }
        }
        Ok(())
    }

    /// The pipeline of a kernel that has been prepared.
    pub(crate) fn kernel(&self, kernel: KernelId) -> &wgpu::ComputePipeline {
        self.kernels[kernel as usize]
            .as_ref()
            .expect("the kernels that an compiled needs are prepared with it")
    }

    /// The layout of a group.
    pub(crate) fn layout(&self, group: GroupLayout) -> &wgpu::BindGroupLayout {
        &self.layouts[group as usize]
    }
}

/// The pipeline of one kernel on bindings of these layouts, compiled if the device has not done so before.
fn pipeline(
    gpu: &Gpu,
    shaders: &Shaders,
    contract: Contract,
    kernel: KernelId,
    layouts: &[Option<&wgpu::BindGroupLayout>],
) -> Result<wgpu::ComputePipeline, SimError> {
    let source = shaders.kernel(kernel).map_err(|error| SimError::Device { reason: error.to_string() })?;
    let key = (kernel, contract, source);
    // Not held while a kernel is compiled: others go on meanwhile.
    let compiled = || gpu.compiled().lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(pipeline) = compiled().get(&key) {
        return Ok(pipeline.clone());
    }
    let module = shader_module(gpu, &key.2, kernel.name(), contract)?;
    let pipeline = gpu.scoped(|| {
        let layout = gpu.device().create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(kernel.name()),
            bind_group_layouts: layouts,
            immediate_size: 0,
        });
        gpu.device().create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(kernel.name()),
            layout: Some(&layout),
            module: &module,
            entry_point: Some(kernel.name()),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        })
    })?;
    compiled().insert(key, pipeline.clone());
    Ok(pipeline)
}

/// A shader module: plain WGSL, or SPIR-V whose every float operation keeps its own rounding.
pub(crate) fn shader_module(
    gpu: &Gpu,
    source: &str,
    entry_point: &'static str,
    contract: Contract,
) -> Result<wgpu::ShaderModule, SimError> {
    if contract == Contract::Tolerant {
        let descriptor = wgpu::ShaderModuleDescriptor {
            label: Some(entry_point),
            source: wgpu::ShaderSource::Wgsl(Cow::Borrowed(source)),
        };
        return gpu.scoped(|| gpu.device().create_shader_module(descriptor));
    }
    if gpu.contract() != Contract::Exact {
        let reason = format!("{} cannot keep the exact contract: it needs Vulkan", gpu.info().name);
        return Err(SimError::Device { reason });
    }
    let spirv = compile_exact(source).map_err(|error| SimError::Device { reason: error.to_string() })?;
    let descriptor = wgpu::ShaderModuleDescriptorPassthrough {
        label: Some(entry_point),
        entry_points: Cow::Owned(vec![wgpu::PassthroughShaderEntryPoint {
            name: entry_point.into(),
            workgroup_size: (WORKGROUP_SIZE, 1, 1),
        }]),
        spirv: Some(spirv.into()),
        ..Default::default()
    };
    // SAFETY: the words are a module that naga has validated and written, with decorations added that only restrict
    // how results are rounded; every index in the kernels is bounded by the length of the column or table it reads.
    #[expect(unsafe_code, reason = "WGSL has no way to forbid contraction; SPIR-V has")]
    let module = gpu.scoped(|| unsafe { gpu.device().create_shader_module_passthrough(descriptor) });
    module
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Layouts count as well as what kernels use of them: browsers and many devices allow eight storage buffers.
    #[test]
    fn layouts_have_at_most_eight_storage_buffers() {
        for kernel in KernelId::ALL {
            let slots = kernel.layouts().iter().flat_map(|layout| layout.slots());
            let count = slots.filter(|slot| matches!(slot, Slot::Read | Slot::Write)).count();
            assert!(count <= 8, "{} has {count}", kernel.name());
        }
    }

    /// Another simulator on the device gets the same pipeline, one with another text its own.
    #[test]
    fn a_device_compiles_a_kernel_once() {
        let gpu = Gpu::request(None).expect("a graphics adapter; software Vulkan will do");
        let prepared = |shaders: Shaders| {
            let mut pipelines = Pipelines::new(&gpu, shaders, gpu.contract()).expect("layouts");
            pipelines.prepare(&gpu, [KernelId::ClearCollisions]).expect("it compiles");
            pipelines.kernel(KernelId::ClearCollisions).clone()
        };
        let first = prepared(Shaders::default());
        assert_eq!(first, prepared(Shaders::default()), "the same text");
        let edited = Shaders::default().edited("kernels/clear_collisions", "fn ", "fn  ");
        assert_ne!(first, prepared(edited.expect("it has a function")), "another text");
    }
}
