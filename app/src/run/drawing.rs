// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Chooses where to draw and where to simulate what is drawn.
//!
//! Drawing needs a graphics adapter, a software one at least, whichever backend simulates; the wgpu backend then runs on
//! that same device.

use anyhow::{anyhow, bail};
use windfall_core::SimError;
use windfall_render::Quality;
use windfall_wgpu::{Gpu, instance_descriptor, select_adapter};

use crate::run::backend::{BackendArguments, BackendKind, Device};

/// Devices that simulate and draw.
#[derive(Debug)]
pub struct Drawing {
    /// Simulates.
    pub device: Device,
    /// Draws.
    pub gpu: Gpu,
    /// The adapter of `gpu`.
    pub adapter: wgpu::Adapter,
    /// Effort spent on pictures.
    pub quality: Quality,
    /// Backend that was chosen by default and the reason: a line for the user.
    pub reason: Option<String>,
}

impl Drawing {
    /// Devices for pictures and clips, without a window.
    ///
    /// # Errors
    /// Options that exclude each other, or no adapter.
    pub fn without_window(arguments: &BackendArguments) -> anyhow::Result<Self> {
        let instance = wgpu::Instance::new(instance_descriptor());
        Self::choose(arguments, &instance, None)
    }

    /// Devices in place of lost ones: the adapter is opened again to draw, and the processor simulates.
    ///
    /// # Errors
    /// An adapter that is gone.
    pub fn after_loss(arguments: &BackendArguments) -> anyhow::Result<Self> {
        Ok(Self { device: arguments.cpu(), reason: None, ..Self::without_window(arguments)? })
    }

    /// Devices for pictures on `surface`, or anywhere for `None`. Here `--adapter` also goes with the cpu backend: it
    /// names the adapter that draws.
    ///
    /// # Errors
    /// Options that exclude each other, or no adapter.
    pub fn choose(
        arguments: &BackendArguments,
        instance: &wgpu::Instance,
        surface: Option<&wgpu::Surface<'_>>,
    ) -> anyhow::Result<Self> {
        let kind = match (arguments.backend, &arguments.adapter, arguments.threads) {
            (Some(BackendKind::Wgpu), _, Some(threads)) => {
                bail!("--threads is {threads}; allowed: only with --backend cpu")
            }
            (Some(kind), ..) => Some(kind),
            (None, _, Some(_)) => Some(BackendKind::Cpu),
            (None, Some(_), None) => Some(BackendKind::Wgpu),
            (None, None, None) => None,
        };
        let adapter = select_adapter(instance, arguments.adapter.as_deref(), surface)
            .map_err(|error| no_adapter(&error))?;
        let gpu = Gpu::from_adapter(&adapter).map_err(|error| no_adapter(&error))?;
        let is_software = gpu.info().device_type == wgpu::DeviceType::Cpu;
        let name = &gpu.info().name;
        let reason = match (kind, is_software) {
            (Some(_), _) => None,
            (None, true) => {
                Some(format!("backend cpu: no hardware graphics adapter found, only {name}, which draws"))
            }
            (None, false) => Some(format!("backend wgpu: hardware adapter {name}")),
        };
        let simulates_on_cpu = kind.map_or(is_software, |kind| kind == BackendKind::Cpu);
        let device = if simulates_on_cpu { arguments.cpu() } else { Device::Wgpu(Box::new(gpu.clone())) };
        Ok(Self { device, gpu, adapter, quality: Quality::Full, reason })
    }
}

/// Says that there is nothing to draw with.
pub(crate) fn no_adapter(error: &SimError) -> anyhow::Error {
    anyhow!("nothing to draw with: {error}")
}
