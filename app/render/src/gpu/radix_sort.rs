// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Stable radix sort on the device: equal keys stay in order, so that pictures repeat to the bit.

use windfall_core::layout::WgslStruct;
use windfall_core::{shared_constants, shared_struct};

use super::pipeline::{bind_buffers, buffer_entry, layout};
use super::shaders::{Shaders, compile, declarations, wgsl_files};
use super::upload;

shared_constants! {
    /// Values of a digit of a key.
    const DIGITS: u32 = 16;
    /// Threads of a workgroup. Their tallies of all digits are 8 KiB, half of what every device has room for.
    const SORT_THREADS: u32 = 128;
    /// Pairs of a thread.
    const PAIRS_PER_THREAD: u32 = 8;
}

/// Digits of a key of 32 bits: even, so that what has gone to and fro between two buffers ends in the first.
const ROUNDS: u32 = u32::BITS / DIGITS.ilog2();
/// Bytes of a pair of a key and a value.
const PAIR_BYTES: u64 = 8;

shared_struct! {
    /// Digit by which a round sorts.
    struct SortUniform {
        /// Number of pairs.
        count: u32,
        /// Number of blocks.
        blocks: u32,
        /// Place of the digit in the key.
        shift: u32,
        /// Zero.
        unused: u32,
    }
}

/// Shader modules of the sort.
pub(crate) fn shaders() -> impl Iterator<Item = (&'static str, String)> {
    let structs = declarations([wgsl_constants()]) + &SortUniform::declaration();
    wgsl_files!("gpu": "sort_pair", "radix_sort").into_iter().chain([("gpu/radix_sort_structs", structs)])
}

/// A buffer of pairs of a key and a value, each a word, and the pipelines that sort it.
#[derive(Debug)]
pub(crate) struct RadixSort {
    /// The pairs, key before value: those to sort, and after sorting those in order.
    pub(crate) pairs: wgpu::Buffer,
    /// Bind groups of the rounds.
    rounds: Vec<wgpu::BindGroup>,
    blocks: u32,
    count_digits: wgpu::ComputePipeline,
    sum_counts: wgpu::ComputePipeline,
    place_pairs: wgpu::ComputePipeline,
}

impl RadixSort {
    /// A sort of `count` pairs, 1 to 2^26.
    pub(crate) fn new(device: &wgpu::Device, queue: &wgpu::Queue, count: u32) -> Self {
        let blocks = count.div_ceil(SORT_THREADS * PAIRS_PER_THREAD);
        let buffer = |label, size| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage: wgpu::BufferUsages::STORAGE
                    | wgpu::BufferUsages::COPY_SRC
                    | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let pairs = buffer("sorted pairs", u64::from(count) * PAIR_BYTES);
        let other = buffer("pairs on their way", u64::from(count) * PAIR_BYTES);
        let counts = buffer("digit counts", u64::from(blocks * DIGITS) * 4);
        let compute = wgpu::ShaderStages::COMPUTE;
        let storage = |read_only| wgpu::BufferBindingType::Storage { read_only };
        let group_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("sort"),
            entries: &[
                buffer_entry(0, wgpu::BufferBindingType::Uniform, compute),
                buffer_entry(1, storage(true), compute),
                buffer_entry(2, storage(false), compute),
                buffer_entry(3, storage(false), compute),
            ],
        });
        let rounds = (0..ROUNDS).map(|round| {
            let uniform = SortUniform { count, blocks, shift: round * DIGITS.ilog2(), unused: 0 };
            let uniform = upload::buffer(
                device,
                queue,
                "sort",
                wgpu::BufferUsages::UNIFORM,
                bytemuck::bytes_of(&uniform),
            );
            let (before, after) = if round % 2 == 0 { (&pairs, &other) } else { (&other, &pairs) };
            bind_buffers(device, "sort", &group_layout, &[&uniform, before, after, &counts])
        });
        let rounds = rounds.collect();
        let module = compile(device, &Shaders::from_iter(shaders()), "gpu/radix_sort");
        let pipeline = |entry_point| {
            device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(entry_point),
                layout: Some(&layout(device, &[Some(&group_layout)])),
                module: &module,
                entry_point: Some(entry_point),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            })
        };
        Self {
            pairs,
            rounds,
            blocks,
            count_digits: pipeline("count_digits"),
            sum_counts: pipeline("sum_counts"),
            place_pairs: pipeline("place_pairs"),
        }
    }

    /// Sorts the pairs by rising keys; equal ones stay in order.
    pub(crate) fn run(&self, pass: &mut wgpu::ComputePass<'_>) {
        for group in &self.rounds {
            pass.set_bind_group(0, group, &[]);
            for (pipeline, groups) in
                [(&self.count_digits, self.blocks), (&self.sum_counts, 1), (&self.place_pairs, self.blocks)]
            {
                pass.set_pipeline(pipeline);
                pass.dispatch_workgroups(groups, 1, 1);
            }
        }
    }
}
