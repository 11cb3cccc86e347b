// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Chooses where to simulate, and lets everything else not care.

#[cfg(test)]
mod tests;

use std::fmt;

use anyhow::bail;
use clap::{Args, ValueEnum};
use windfall_core::leaf::Leaves;
use windfall_core::particle::ParticleStore;
use windfall_core::{Clock, CompiledScene, Contract, SimError, Simulator, SimulatorInfo, Stats, World};
use windfall_cpu::{CpuOptions, CpuSimulator};
use windfall_wgpu::{
    Gpu, WgpuOptions, WgpuSimulator, WorldBuffers, WorldColumns, describe_adapter, instance_descriptor,
    list_adapters,
};

use crate::run::parse::whole;

/// Backends by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum BackendKind {
    /// Threads of this machine's processor.
    Cpu,
    /// A graphics adapter, real or software.
    Wgpu,
}

/// Backend that simulates.
#[derive(Clone, Debug, Default, Args)]
pub struct BackendArguments {
    /// Backend that simulates [default: wgpu if there is a hardware graphics adapter, else cpu].
    #[arg(long, value_name = "BACKEND")]
    pub backend: Option<BackendKind>,
    /// Graphics adapter whose name or driver contains this, in any case; implies --backend wgpu.
    #[arg(long, value_name = "NAME")]
    pub adapter: Option<String>,
    /// Threads of the cpu backend [default: one for each core]; implies --backend cpu.
    #[arg(long, value_name = "N", value_parser = whole::<usize, 1, 1024>)]
    pub threads: Option<usize>,
}

impl BackendArguments {
    /// The backend that the options ask for, by themselves or by what they imply.
    ///
    /// # Errors
    /// Options that exclude each other.
    pub fn kind(&self) -> anyhow::Result<Option<BackendKind>> {
        match (self.backend, &self.adapter, self.threads) {
            (Some(BackendKind::Cpu), Some(name), _) => {
                bail!("--adapter is '{name}'; allowed: only with --backend wgpu")
            }
            (Some(BackendKind::Wgpu), _, Some(threads)) => {
                bail!("--threads is {threads}; allowed: only with --backend cpu")
            }
            (None, Some(name), Some(_)) => {
                bail!(
                    "--adapter is '{name}'; allowed: not together with --threads, which is for --backend cpu"
                )
            }
            (Some(kind), ..) => Ok(Some(kind)),
            (None, Some(_), None) => Ok(Some(BackendKind::Wgpu)),
            (None, None, Some(_)) => Ok(Some(BackendKind::Cpu)),
            (None, None, None) => Ok(None),
        }
    }

    /// The device to simulate on.
    ///
    /// # Errors
    /// Options that exclude each other; [`SimError::NoAdapter`] if an adapter was asked for and there is none.
    pub fn choose(&self) -> anyhow::Result<Choice> {
        Ok(match self.kind()? {
            Some(BackendKind::Cpu) => Choice { device: self.cpu(), reason: None },
            Some(BackendKind::Wgpu) => Choice { device: self.wgpu()?, reason: None },
            None => Choice::default_device(),
        })
    }

    /// The device to simulate on: the processor, if nothing else is asked for.
    ///
    /// # Errors
    /// Options that exclude each other; [`SimError::NoAdapter`] if an adapter was asked for and there is none.
    pub fn or_cpu(&self) -> anyhow::Result<Device> {
        match self.kind()? {
            None | Some(BackendKind::Cpu) => Ok(self.cpu()),
            Some(BackendKind::Wgpu) => Ok(self.wgpu()?),
        }
    }

    /// The processor, with the threads asked for.
    pub fn cpu(&self) -> Device {
        Device::Cpu(CpuOptions { threads: self.threads, ..CpuOptions::default() })
    }

    /// The adapter asked for, or the best.
    ///
    /// # Errors
    /// [`SimError::NoAdapter`] if there is none.
    pub fn wgpu(&self) -> Result<Device, SimError> {
        Gpu::request(self.adapter.as_deref()).map(|gpu| Device::Wgpu(Box::new(gpu)))
    }
}

/// A device, and why it was chosen if nobody asked for it.
#[derive(Debug)]
pub struct Choice {
    /// Backend that simulates.
    pub device: Device,
    /// Backend that was chosen by default and the reason: a line for the user.
    pub reason: Option<String>,
}

impl Choice {
    /// The best hardware adapter, or the processor if there is none or it does not work.
    pub fn default_device() -> Self {
        let instance = wgpu::Instance::new(instance_descriptor());
        let adapters = list_adapters(&instance);
        let mut why = match adapters.as_slice() {
            [] => "no graphics adapter found".to_owned(),
            [first, ..] => format!("no hardware graphics adapter found, only {}", first.get_info().name),
        };
        for adapter in &adapters {
            let info = adapter.get_info();
            if info.device_type == wgpu::DeviceType::Cpu {
                continue;
            }
            match Gpu::from_adapter(adapter) {
                Ok(gpu) => {
                    let reason = format!("backend wgpu: hardware adapter {}", info.name);
                    return Self { device: Device::Wgpu(Box::new(gpu)), reason: Some(reason) };
                }
                Err(error) => why = error.to_string(),
            }
        }
        let reason = Some(format!("backend cpu: {why}"));
        Self { device: Device::Cpu(CpuOptions::default()), reason }
    }
}

/// Something that simulators can be made on.
#[derive(Clone, Debug)]
pub enum Device {
    /// The processor.
    Cpu(CpuOptions),
    /// A graphics adapter.
    Wgpu(Box<Gpu>),
}

impl Device {
    /// Agreement of its states with the oracle's.
    pub fn contract(&self) -> Contract {
        match self {
            Self::Cpu(_) => Contract::Exact,
            Self::Wgpu(gpu) => gpu.contract(),
        }
    }

    /// A simulator with a copy of the world.
    ///
    /// # Errors
    /// [`SimError::Capacity`] for more leaves than the device holds; a device that refuses or is lost.
    pub fn simulator(&self, world: &World) -> Result<Backend, SimError> {
        match self {
            Self::Cpu(options) => Ok(Backend::Cpu(Box::new(Mirrored {
                simulator: CpuSimulator::new(world, *options)?,
                buffers: None,
                is_current: false,
            }))),
            Self::Wgpu(gpu) => {
                Ok(Backend::Wgpu(Box::new(WgpuSimulator::new(gpu, world, &WgpuOptions::default())?)))
            }
        }
    }
}

impl fmt::Display for Device {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Cpu(_) => f.write_str("cpu"),
            Self::Wgpu(gpu) => write!(f, "wgpu on {}", describe_adapter(gpu.info())),
        }
    }
}

/// A simulator on either backend, which can be drawn the same way.
#[derive(Debug)]
pub enum Backend {
    /// On the processor.
    Cpu(Box<Mirrored>),
    /// On a graphics adapter.
    Wgpu(Box<WgpuSimulator>),
}

/// A simulator on the processor, and a copy of its state to draw from.
#[derive(Debug)]
pub struct Mirrored {
    simulator: CpuSimulator,
    buffers: Option<WorldBuffers>,
    is_current: bool,
}

impl Backend {
    /// The leaves and branches on the device that draws: lent by the wgpu backend, which runs on that device; copied there by
    /// the cpu backend if they have changed since the last time. `gpu` is the same at every call.
    ///
    /// # Errors
    /// [`SimError::Capacity`] for more leaves than the device holds; a lost device.
    pub fn columns(&mut self, gpu: &Gpu) -> Result<WorldColumns<'_>, SimError> {
        match self {
            Self::Wgpu(simulator) => Ok(simulator.columns()),
            Self::Cpu(cpu) => {
                let world = cpu.simulator.world();
                let buffers = match &mut cpu.buffers {
                    Some(buffers) => buffers,
                    empty => empty.insert(WorldBuffers::new(gpu, world)?),
                };
                if !cpu.is_current {
                    buffers.write(gpu, world)?;
                    cpu.is_current = true;
                }
                Ok(buffers.columns())
            }
        }
    }

    /// The leaves where they are on this side of the device; `None` if they are on the other.
    pub fn host_leaves(&self) -> Option<&Leaves> {
        match self {
            Self::Cpu(cpu) => Some(&cpu.simulator.world().leaves),
            Self::Wgpu(_) => None,
        }
    }

    /// The particles where they are on this side of the device; `None` if they are on the other.
    pub fn host_particles(&self) -> Option<&ParticleStore> {
        match self {
            Self::Cpu(cpu) => Some(&cpu.simulator.world().particles),
            Self::Wgpu(_) => None,
        }
    }

    fn simulator(&self) -> &dyn Simulator {
        match self {
            Self::Cpu(cpu) => &cpu.simulator,
            Self::Wgpu(simulator) => simulator.as_ref(),
        }
    }

    fn simulator_mut(&mut self) -> &mut dyn Simulator {
        match self {
            Self::Cpu(cpu) => &mut cpu.simulator,
            Self::Wgpu(simulator) => simulator.as_mut(),
        }
    }

    /// The same for what changes leaves.
    fn changing(&mut self) -> &mut dyn Simulator {
        if let Self::Cpu(cpu) = self {
            cpu.is_current = false;
        }
        self.simulator_mut()
    }
}

impl Simulator for Backend {
    fn info(&self) -> SimulatorInfo {
        self.simulator().info()
    }

    fn clock(&self) -> Clock {
        self.simulator().clock()
    }

    fn write_state(&mut self, world: &World) -> Result<(), SimError> {
        self.changing().write_state(world)
    }

    fn read_state(&mut self, world: &mut World) -> Result<(), SimError> {
        self.simulator_mut().read_state(world)
    }

    fn set_scene(&mut self, compiled: &CompiledScene) -> Result<(), SimError> {
        self.simulator_mut().set_scene(compiled)
    }

    fn step(&mut self, count: u32) -> Result<(), SimError> {
        self.changing().step(count)
    }

    fn sync(&mut self) -> Result<(), SimError> {
        self.simulator_mut().sync()
    }

    fn stats(&mut self) -> Result<Stats, SimError> {
        self.simulator_mut().stats()
    }
}
