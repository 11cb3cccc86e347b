// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The wgpu backend: WGSL compute, with the state of all leaves on the GPU.
//!
//! On Vulkan the kernels are compiled WGSL to SPIR-V by naga, every float operation is decorated `NoContraction` and
//! the result loaded as it is, which makes the state equal to the CPU oracle's bit for bit ([`Contract::Exact`]).
//! Elsewhere the same WGSL runs under [`Contract::Tolerant`].
//!
//! The backend borrows the device it runs on ([`Gpu::from_parts`]) and lends its buffers
//! ([`WgpuSimulator::columns`]), so that a renderer on the same device draws them without a copy. A program with a loop of
//! its own encodes steps into its own submissions ([`WgpuSimulator::encode_steps`]) and reads state and counts back without
//! waiting ([`WgpuSimulator::request_state`], [`WgpuSimulator::request_stats`]); its shaders read the columns by the text of
//! [`leaf_wgsl`] and [`particle_wgsl`]. The [`wgpu`] that all this speaks of is
//! exported.
//!
//! [`Contract::Exact`]: windfall_core::Contract::Exact
//! [`Contract::Tolerant`]: windfall_core::Contract::Tolerant

#![warn(clippy::print_stdout, clippy::print_stderr)]

mod buffers;
mod columns;
mod exact;
mod forest;
mod gpu;
mod kernel_id;
mod lists;
mod particles;
mod pipelines;
mod prelude;
mod readback;
mod shaders;
mod simulator;

pub use columns::{
    BedColumn, BranchColumns, LeafColumns, ParticleColumns, StoreBuffers, WorldBuffers, WorldColumns,
};
pub use exact::decorate_no_contraction;
pub use gpu::{Gpu, describe_adapter, instance_descriptor, list_adapters, select_adapter};
pub use kernel_id::KernelId;
pub use prelude::{WORKGROUP_SIZE, leaf_wgsl, particle_wgsl};
pub use shaders::{ShaderError, Shaders};
pub use simulator::{StateRequest, StatsRequest, WgpuOptions, WgpuSimulator};
pub use wgpu;
