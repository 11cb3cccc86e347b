// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compute pipelines under either contract.

use std::borrow::Cow;

use windfall_core::{Contract, SimError};

use crate::gpu::Gpu;
use crate::prelude::WORKGROUP_SIZE;
use crate::shaders::{KernelId, Shaders, compile_exact};

/// Binding layouts and pipelines of all kernels.
#[derive(Debug)]
pub(crate) struct Pipelines {
    pub(crate) leaves_layout: wgpu::BindGroupLayout,
    /// One storage buffer: the due leaves of a page, or the counters.
    pub(crate) extra_layout: wgpu::BindGroupLayout,
    /// Blocks and wind tables, for trees.
    pub(crate) sway_layout: wgpu::BindGroupLayout,
    /// A level of the forest.
    pub(crate) level_layout: wgpu::BindGroupLayout,
    /// Blocks, wind tables and hot leaf columns, for leaves on twigs.
    pub(crate) carried_layout: wgpu::BindGroupLayout,
    /// What carries them.
    pub(crate) carrier_layout: wgpu::BindGroupLayout,
    pub(crate) advance: wgpu::ComputePipeline,
    /// For worlds in which leaves fly as bodies: it takes longest to compile.
    pub(crate) fly: Option<wgpu::ComputePipeline>,
    shaders: Shaders,
    contract: Contract,
    pub(crate) attend: wgpu::ComputePipeline,
    pub(crate) measure: wgpu::ComputePipeline,
    /// Towards the foot and towards the tips: of articulated bodies, and of the schemes that move joints one by one.
    pub(crate) sway: [[wgpu::ComputePipeline; 2]; 2],
    pub(crate) carry: wgpu::ComputePipeline,
}

/// What is bound in one place of a layout.
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
    pub(crate) fn new(gpu: &Gpu, shaders: &Shaders, contract: Contract) -> Result<Self, SimError> {
        use Slot::{Block, BlockOfMany, Read, Write};
        // The bindings of shaders/bindings.wgsl: all of them, those up to the wind, those up to the courses.
        let all = [Block, BlockOfMany, Read, Write, Write, Write, Write, Write, Read];
        let leaves_layout = layout(gpu, "leaves", &all);
        let sway_layout = layout(gpu, "sway", &all[..3]);
        let carried_layout = layout(gpu, "carried", &all[..7]);
        let extra_layout = layout(gpu, "extra", &[Write]);
        // The bindings of shaders/tree/bindings.wgsl.
        let level_layout = layout(gpu, "level", &[BlockOfMany, Read, Read, Write, Write, Read]);
        // The bindings of shaders/leaf/petioles.wgsl.
        let carrier_layout = layout(gpu, "carriers", &[Block, Read, Read, Write]);
        let pipeline = |kernel: KernelId| {
            let layouts = match kernel {
                KernelId::SwayInward
                | KernelId::SwayOutward
                | KernelId::SwayGather
                | KernelId::SwayFollow => [&sway_layout, &level_layout],
                KernelId::Carry => [&carried_layout, &carrier_layout],
                _ => [&leaves_layout, &extra_layout],
            };
            pipeline(gpu, shaders, contract, kernel, layouts)
        };
        let advance = pipeline(KernelId::Advance)?;
        let attend = pipeline(KernelId::Attend)?;
        let measure = pipeline(KernelId::Measure)?;
        let sway = [
            [pipeline(KernelId::SwayInward)?, pipeline(KernelId::SwayOutward)?],
            [pipeline(KernelId::SwayGather)?, pipeline(KernelId::SwayFollow)?],
        ];
        let carry = pipeline(KernelId::Carry)?;
        Ok(Self {
            leaves_layout,
            extra_layout,
            sway_layout,
            level_layout,
            carried_layout,
            carrier_layout,
            advance,
            fly: None,
            shaders: shaders.clone(),
            contract,
            attend,
            measure,
            sway,
            carry,
        })
    }

    /// Makes ready to fly bodies.
    pub(crate) fn add_fly(&mut self, gpu: &Gpu) -> Result<(), SimError> {
        if self.fly.is_none() {
            let layouts = [&self.leaves_layout, &self.extra_layout];
            self.fly = Some(pipeline(gpu, &self.shaders, self.contract, KernelId::Fly, layouts)?);
        }
        Ok(())
    }
}

/// The pipeline of one kernel on bindings of these layouts.
fn pipeline(
    gpu: &Gpu,
    shaders: &Shaders,
    contract: Contract,
    kernel: KernelId,
    layouts: [&wgpu::BindGroupLayout; 2],
) -> Result<wgpu::ComputePipeline, SimError> {
    let source = shaders.kernel(kernel).map_err(|error| SimError::Device { reason: error.to_string() })?;
    let module = shader_module(gpu, &source, kernel.name(), contract)?;
    let layout = gpu.device().create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(kernel.name()),
        bind_group_layouts: &layouts.map(Some),
        immediate_size: 0,
    });
    let pipeline = gpu.device().create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some(kernel.name()),
        layout: Some(&layout),
        module: &module,
        entry_point: Some(kernel.name()),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    });
    gpu.check().map(|()| pipeline)
}

/// A shader module: plain WGSL, or SPIR-V whose every float operation keeps its own rounding.
pub(crate) fn shader_module(
    gpu: &Gpu,
    source: &str,
    entry_point: &'static str,
    contract: Contract,
) -> Result<wgpu::ShaderModule, SimError> {
    if contract == Contract::Tolerant {
        return Ok(gpu.device().create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(entry_point),
            source: wgpu::ShaderSource::Wgsl(Cow::Borrowed(source)),
        }));
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
    let module = unsafe { gpu.device().create_shader_module_passthrough(descriptor) };
    gpu.check().map(|()| module)
}
