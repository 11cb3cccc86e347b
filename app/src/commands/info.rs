// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! `windfall info`: what this machine offers, and what would be chosen.

use std::fmt::{Display, Write as _};

use windfall_core::leaf::LEAF_BYTES;
use windfall_core::scene::MAX_LEAVES;
use windfall_wgpu::{Gpu, instance_descriptor, list_adapters};

use crate::run::backend::Choice;
use crate::run::terminal;

/// Bytes of one record of a leaf: every column holds one for each leaf.
const RECORD_BYTES: u64 = 16;

/// Runs the command. It works without any adapter.
///
/// # Errors
/// A standard output that cannot be written.
pub(crate) fn run() -> anyhow::Result<()> {
    let instance = wgpu::Instance::new(instance_descriptor());
    let adapters = list_adapters(&instance);
    let mut text = String::new();
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    row(&mut text, "windfall", env!("CARGO_PKG_VERSION"));
    row(&mut text, "processor", format!("{threads} threads"));
    row(&mut text, "default", Choice::default_device().reason.unwrap_or_default());
    row(&mut text, "bytes per leaf", LEAF_BYTES);
    row(&mut text, "most leaves", format!("{MAX_LEAVES} in a scene"));
    row(&mut text, "adapters", adapters.len());
    for adapter in &adapters {
        text.push('\n');
        describe(&mut text, adapter);
    }
    if adapters.is_empty() {
        text.push_str(
            "\nFor the wgpu backend install a graphics driver, or software Vulkan (mesa-vulkan-drivers).\n",
        );
    }
    terminal::print(&text)
}

fn describe(text: &mut String, adapter: &wgpu::Adapter) {
    let (info, limits) = (adapter.get_info(), adapter.limits());
    let contract = match Gpu::from_adapter(adapter) {
        Ok(gpu) => gpu.contract().to_string(),
        Err(error) => format!("none: {error}"),
    };
    let has_timestamps = adapter.features().contains(wgpu::Features::TIMESTAMP_QUERY);
    let binding = limits.max_storage_buffer_binding_size;
    row(text, "adapter", &info.name);
    row(text, "  backend", format!("{:?}", info.backend));
    row(text, "  type", format!("{:?}", info.device_type));
    row(text, "  driver", format!("{} {}", info.driver, info.driver_info).trim());
    row(text, "  contract", contract);
    row(text, "  largest buffer", format!("{} MiB", limits.max_buffer_size >> 20));
    row(text, "  largest binding", format!("{} MiB", binding >> 20));
    row(text, "  storage buffers", format!("{} per stage", limits.max_storage_buffers_per_shader_stage));
    row(text, "  timestamps", if has_timestamps { "yes" } else { "no" });
    let most = (limits.max_buffer_size / RECORD_BYTES).min(MAX_LEAVES.into());
    row(text, "  most leaves", format!("{most}, {} per page", (binding / RECORD_BYTES).min(most)));
}

fn row(text: &mut String, name: &str, value: impl Display) {
    // Writing to a String cannot fail.
    let _ = writeln!(text, "{name:<19}{value}");
}
