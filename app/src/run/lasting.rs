// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A simulator that outlives the graphics device it runs on.
//!
//! Of a state that is on a lost device nothing can be read any more. So a state is kept on this side from time to time; the processor goes on
//! from there, through the steps that are lost first. Steps depend on nothing but the state, so under the exact contract its bits are the same.

use std::time::{Duration, Instant};

use windfall_core::{Clock, CompiledScene, Contract, SimError, Simulator, SimulatorInfo, Stats, World};
use windfall_cpu::CpuOptions;
use windfall_wgpu::Gpu;

use super::backend::{Backend, Device};
use super::memory::free_memory;
use super::planned_loss::lose_if_planned;
use super::terminal;

/// Time from one kept state to the next, at least.
const SHORTEST: Duration = Duration::from_secs(2);
/// Least time from one kept state to the next, as a multiple of what keeping the last one took.
const PAUSES: u32 = 50;

/// A simulator that goes on on the processor when its device is lost.
#[derive(Debug)]
pub struct Lasting {
    backend: Backend,
    /// `None` where there is no device to lose.
    kept: Option<KeptState>,
}

/// A state on this side of a device.
#[derive(Debug)]
struct KeptState {
    gpu: Gpu,
    world: World,
    /// Moment at which it was kept, and the time that took.
    last: (Instant, Duration),
}

impl Lasting {
    /// A simulator of a world on a device.
    ///
    /// # Errors
    /// [`SimError::Capacity`] for more leaves than the device holds; a device that refuses or is lost from the start.
    pub fn new(device: &Device, world: &World) -> Result<Self, SimError> {
        let kept = match device {
            Device::Cpu(_) => None,
            Device::Wgpu(gpu) => Some(KeptState {
                gpu: gpu.as_ref().clone(),
                world: world.clone(),
                last: (Instant::now(), Duration::ZERO),
            }),
        };
        Ok(Self { backend: device.simulator(world)?, kept })
    }

    /// Does some work, and does it again on the processor if the device is lost on the way.
    fn attempt<T>(
        &mut self,
        mut work: impl FnMut(&mut Backend) -> Result<T, SimError>,
    ) -> Result<T, SimError> {
        let step = self.backend.clock().step();
        let error = match work(&mut self.backend) {
            Ok(value) => return Ok(value),
            Err(error) => error,
        };
        match self.kept.take_if(|kept| is_loss(&error, &kept.gpu)) {
            Some(kept) => self.go_on_without(kept, step, &error)?,
            None => return Err(error),
        }
        work(&mut self.backend)
    }

    /// Takes the kept state to the processor, and there to the step at which the device was lost.
    fn go_on_without(&mut self, kept: KeptState, step: u32, loss: &SimError) -> Result<(), SimError> {
        let world = kept.world;
        let bits = match self.backend.info().contract {
            Contract::Exact => "with the same bits",
            Contract::Tolerant => "which rounds otherwise",
        };
        terminal::note(&format!("{loss}; going on on the cpu, {bits}, from step {}", world.clock.step()));
        let again = step.saturating_sub(world.clock.step());
        self.backend = Device::Cpu(CpuOptions::default()).simulator(&world)?;
        self.backend.step(again)
    }

    /// Keeps the state if it is time, and if there is room for it beside the one that is kept.
    fn keep(&mut self) -> Result<(), SimError> {
        let Some(kept) = &mut self.kept else { return Ok(()) };
        let (when, took) = kept.last;
        if when.elapsed() < SHORTEST.max(took * PAUSES) {
            return Ok(());
        }
        let began = Instant::now();
        let has_room = free_memory().is_none_or(|free| free / 2 > kept.world.state_bytes() as u64);
        // One that is lost on its way must not take the place of the one before.
        let mut world = has_room.then(|| World::zeroed(kept.world.compiled.clone(), kept.world.clock));
        if let Some(world) = &mut world {
            self.attempt(|backend| backend.read_state(world))?;
        }
        if let Some(kept) = &mut self.kept {
            if let Some(world) = world {
                kept.world = world;
            }
            kept.last = (Instant::now(), began.elapsed());
        }
        Ok(())
    }
}

/// Returns true if an error comes of the loss of the device.
pub(crate) fn is_loss(error: &SimError, gpu: &Gpu) -> bool {
    match error {
        SimError::DeviceLost { .. } => true,
        SimError::Device { .. } => gpu.is_lost(),
        _ => false,
    }
}

impl Simulator for Lasting {
    fn info(&self) -> SimulatorInfo {
        self.backend.info()
    }

    fn clock(&self) -> Clock {
        self.backend.clock()
    }

    fn write_state(&mut self, world: &World) -> Result<(), SimError> {
        self.attempt(|backend| backend.write_state(world))?;
        if let Some(kept) = &mut self.kept {
            kept.world = world.clone();
        }
        Ok(())
    }

    fn read_state(&mut self, world: &mut World) -> Result<(), SimError> {
        self.attempt(|backend| backend.read_state(world))
    }

    fn set_scene(&mut self, compiled: &CompiledScene) -> Result<(), SimError> {
        // From here on steps are others than those from the kept state.
        if let Some(mut world) = self.kept.as_ref().map(|kept| kept.world.clone()) {
            self.read_state(&mut world)?;
            world.compiled = compiled.clone();
            if let Some(kept) = &mut self.kept {
                kept.world = world;
            }
        }
        self.attempt(|backend| backend.set_scene(compiled))
    }

    fn step(&mut self, count: u32) -> Result<(), SimError> {
        self.attempt(|backend| backend.step(count))?;
        if let Some(kept) = &self.kept {
            lose_if_planned(&kept.gpu, self.backend.clock().step().into());
        }
        Ok(())
    }

    fn sync(&mut self) -> Result<(), SimError> {
        self.attempt(Backend::sync)?;
        self.keep()
    }

    fn stats(&mut self) -> Result<Stats, SimError> {
        self.attempt(Backend::stats)
    }
}
