// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Runs one device function on many inputs, on a GPU.

use windfall_core::particle::place_carriers;
use windfall_core::{Contract, SimError, World};
use windfall_wgpu::{Gpu, Shaders, WORKGROUP_SIZE};

use crate::functions::Function;

/// Input and output words of one case.
pub type Words = [u32; 64];
/// No words yet.
pub const NO_WORDS: Words = [0; 64];

/// Access of a function's statements to the words of their case.
const ACCESS: &str = include_str!("runner/access.wgsl");
/// The same for matrices, for what trees are made of and for what holds leaves; each for modules that know such things.
const RECORDS: [(&str, &str); 3] = [
    ("struct Sym3 ", include_str!("runner/access_matrix.wgsl")),
    ("struct Body ", include_str!("runner/access_tree.wgsl")),
    ("struct Petiole ", include_str!("runner/access_carry.wgsl")),
];

/// Binding of shaders/particle/bindings.wgsl of particles that carry forces.
const CARRIERS_BINDING: &str = "@group(1) @binding(6)";

/// A generated kernel around a device function: [`Words`] in, as many out.
pub struct FunctionRunner<'a> {
    gpu: &'a Gpu,
    pipeline: wgpu::ComputePipeline,
    context_layout: wgpu::BindGroupLayout,
    cases_layout: wgpu::BindGroupLayout,
}

/// The kernel's text: the module that holds the function, then an entry point that calls it.
fn kernel_source(shaders: &Shaders, function: &Function) -> String {
    let module = shaders.compose(function.module).expect("the function table names existing modules");
    let bindings = shaders.compose("bindings").expect("the bindings module exists");
    // A module that needs no bindings still gets the same pipeline layout.
    let head = if module.contains("@group(0)") { module } else { module + &bindings_only(&bindings) };
    let records: String =
        RECORDS.iter().filter(|(known, _)| head.contains(known)).map(|(_, text)| *text).collect();
    // Carriers are bound beside the tables.
    let head = head.replace(CARRIERS_BINDING, "@group(0) @binding(3)");
    format!("{head}\n{ACCESS}\n{records}\nfn statements() {{\n{}\n}}\n", statements(function.wgsl))
}

/// A function's statements between the words that all of them see.
fn statements(wgsl: &str) -> String {
    format!(
        "let a = in_words(0u);
    let b = in_words(4u);
    var r = vec4<u32>();
    var s = vec4<u32>();
    {wgsl}
    answer[0] |= r;
    answer[1] |= s;"
    )
}

/// The binding declarations without the prelude, which the module has already.
fn bindings_only(bindings: &str) -> String {
    bindings.lines().filter(|line| line.starts_with("@group(0)")).flat_map(|line| [line, "\n"]).collect()
}

fn entry(binding: u32, ty: wgpu::BufferBindingType) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None },
        count: None,
    }
}

impl<'a> FunctionRunner<'a> {
    /// Compiles the kernel of a function.
    pub fn new(
        gpu: &'a Gpu,
        contract: Contract,
        shaders: &Shaders,
        function: &Function,
    ) -> Result<Self, SimError> {
        let device = gpu.device();
        let uniform = wgpu::BufferBindingType::Uniform;
        let storage = |read_only| wgpu::BufferBindingType::Storage { read_only };
        // Of the bindings of a kernel those that do not depend on a leaf.
        let entries =
            [entry(0, uniform), entry(1, uniform), entry(2, storage(true)), entry(3, storage(true))];
        let layout = |entries: &[wgpu::BindGroupLayoutEntry]| {
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: None, entries })
        };
        let context_layout = layout(&entries);
        let cases_layout = layout(&[entry(0, storage(true)), entry(1, storage(false))]);
        let source = kernel_source(shaders, function);
        let module = gpu.compute_module(&source, "evaluate", contract)?;
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &[Some(&context_layout), None, Some(&cases_layout)],
            immediate_size: 0,
        });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(function.name),
            layout: Some(&pipeline_layout),
            module: &module,
            entry_point: Some("evaluate"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        gpu.check()?;
        Ok(Self { gpu, pipeline, context_layout, cases_layout })
    }

    /// Tables and blocks of a world, for the function to see.
    pub fn context(&self, world: &World) -> wgpu::BindGroup {
        let gpu = self.gpu;
        let step = world.compiled.step_block(&world.clock);
        let tables: &[u8] = bytemuck::cast_slice(world.compiled.tables());
        let bed: &[u8] = bytemuck::cast_slice(&world.bed.words);
        let buffers = [
            upload(gpu, bytemuck::bytes_of(world.compiled.block()), wgpu::BufferUsages::UNIFORM),
            upload(gpu, bytemuck::bytes_of(&step), wgpu::BufferUsages::UNIFORM),
            upload(gpu, &[tables, bed].concat(), wgpu::BufferUsages::STORAGE),
            upload(gpu, bytemuck::cast_slice(&carriers_of(world)), wgpu::BufferUsages::STORAGE),
        ];
        bind(gpu, &self.context_layout, &buffers)
    }

    /// The function's results for these cases in such a context.
    pub fn run(&self, context: &wgpu::BindGroup, cases: &[Words]) -> Result<Vec<Words>, SimError> {
        let bytes: &[u8] = bytemuck::cast_slice(cases);
        let input = upload(self.gpu, bytes, wgpu::BufferUsages::STORAGE);
        let output = upload(
            self.gpu,
            &vec![0; bytes.len()],
            wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        );
        let group = bind(self.gpu, &self.cases_layout, &[input, output.clone()]);
        let mut encoder =
            self.gpu.device().create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, context, &[]);
            pass.set_bind_group(2, &group, &[]);
            let count = u32::try_from(cases.len()).expect("a few thousand cases");
            pass.dispatch_workgroups(count.div_ceil(WORKGROUP_SIZE), 1, 1);
        }
        self.gpu.queue().submit([encoder.finish()]);
        let mut results = vec![NO_WORDS; cases.len()];
        self.gpu.read(&output, bytemuck::cast_slice_mut(&mut results))?;
        Ok(results)
    }
}

/// Rows of the particles of a world that carry forces; one row of zeros without any.
pub fn carriers_of(world: &World) -> Vec<[f32; 4]> {
    let step = world.compiled.step_block(&world.clock);
    let mut rows = Vec::new();
    place_carriers(&world.compiled.context(&step), world.compiled.carriers(), &world.particles, &mut rows);
    rows.resize(rows.len().max(1), [0.0; 4]);
    rows
}

fn upload(gpu: &Gpu, bytes: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
    let buffer = gpu.device().create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: bytes.len() as u64,
        usage: usage | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    gpu.queue().write_buffer(&buffer, 0, bytes);
    buffer
}

fn bind(gpu: &Gpu, layout: &wgpu::BindGroupLayout, buffers: &[wgpu::Buffer]) -> wgpu::BindGroup {
    let entries: Vec<_> = (0..)
        .zip(buffers)
        .map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
        .collect();
    gpu.device().create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries })
}
