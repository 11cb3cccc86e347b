// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The scene that goes on: its simulator, its pace, and everything that may change about it.

pub(crate) mod change;
mod compare;
mod history;
pub(crate) mod pace;
mod reading;
mod seek;
pub(crate) mod undo;

use std::ops::RangeInclusive;
use std::sync::Arc;
use std::time::{Duration, Instant};

use windfall_core::scene::limits;
use windfall_core::{CompiledScene, Scene, SimError, Simulator, Stats, World};
use windfall_cpu::CpuOptions;
use windfall_render::GpuTimer;
use windfall_wgpu::{Gpu, WorldColumns};

use crate::run::backend::{Backend, BackendKind, Device};
use crate::run::memory::check_memory;
use crate::view::session::history::History;
use crate::view::session::pace::Pace;
pub(crate) use compare::Difference;
use compare::Twin;
pub(crate) use seek::Timeline;

/// Assumed cost of a step before it is known, in seconds: a few steps in the first frames.
const UNKNOWN_STEP_S: f64 = 0.015;
/// Bytes of one record in one column.
const RECORD_BYTES: u64 = 16;

/// The scene that goes on.
#[derive(Debug)]
pub(crate) struct Session {
    pub(crate) pace: Pace,
    /// The scene with what the user has changed.
    scene: Arc<Scene>,
    /// The compiled `scene`.
    compiled: CompiledScene,
    gpu: Gpu,
    threads: Option<usize>,
    backend: Backend,
    /// The other backend, if both run.
    twin: Option<Twin>,
    history: History,
    /// Step that is to be reached before time goes on.
    target: Option<u32>,
    /// Time at which a moment was last kept, and the time that keeping took.
    kept: Option<(Instant, Duration)>,
    stats: Stats,
    counted: Option<Instant>,
    timer: Option<GpuTimer>,
    /// Steps of the submission that the timer is timing, and the number of its answers before.
    timed: (u32, u32),
    /// Seconds of one step on the device, lately.
    device_step_s: Option<f64>,
    /// Seconds of one step on the processor, lately.
    step_s: f64,
}

impl Session {
    /// A session of `world`, which `scene` describes, on `device`; `gpu` draws.
    ///
    /// # Errors
    /// More leaves than the device holds; a device that refuses or is lost.
    pub(crate) fn new(scene: Scene, world: &World, device: &Device, gpu: Gpu) -> Result<Self, SimError> {
        let threads = match device {
            Device::Cpu(options) => options.threads,
            Device::Wgpu(_) => None,
        };
        Ok(Self {
            pace: Pace::default(),
            scene: Arc::new(scene),
            compiled: world.compiled.clone(),
            threads,
            backend: device.simulator(world)?,
            twin: None,
            history: History::new(world),
            target: None,
            kept: None,
            stats: world.stats(),
            counted: None,
            timer: GpuTimer::new(gpu.device(), gpu.queue(), &["advance"]),
            timed: (1, 0),
            device_step_s: None,
            step_s: UNKNOWN_STEP_S,
            gpu,
        })
    }

    /// Number of steps that the `frame_s` seconds since the last frame ask for.
    pub(crate) fn due_steps(&mut self, frame_s: f64) -> u32 {
        let dt_s = f64::from(self.backend.clock().dt_s());
        // Submitting steps may wait for the frames before, which is no cost of theirs.
        let cost_s = self.device_step_s.unwrap_or(self.step_s);
        self.pace.steps(frame_s, dt_s, cost_s)
    }

    /// Takes `steps` steps.
    ///
    /// # Errors
    /// A lost device.
    pub(crate) fn step(&mut self, steps: u32) -> Result<(), SimError> {
        let mut left = steps;
        while left > 0 {
            let batch = self.steps_to_change().min(left);
            self.submit(batch)?;
            if let Some(twin) = &mut self.twin {
                twin.backend.step(batch)?;
            }
            self.take_note()?;
            left -= batch;
        }
        Ok(())
    }

    /// Takes at least one step, all under the same wind.
    fn submit(&mut self, steps: u32) -> Result<(), SimError> {
        let since = Instant::now();
        match (&mut self.backend, &self.timer) {
            (Backend::Wgpu(simulator), Some(timer)) => {
                simulator.step_timed(steps, Some(timer.compute_writes(0)))?;
                let mut encoder =
                    self.gpu.device().create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
                if timer.resolve(&mut encoder) {
                    self.timed = (steps, timer.answers());
                }
                self.gpu.queue().submit([encoder.finish()]);
            }
            (backend, _) => backend.step(steps)?,
        }
        let step_s = since.elapsed().as_secs_f64() / f64::from(steps);
        self.step_s += 0.2 * (step_s - self.step_s);
        Ok(())
    }

    /// Milliseconds that the device last spent on the steps of a frame; empty where it has no timestamps or does not simulate.
    pub(crate) fn device_ms(&mut self) -> Vec<(&'static str, f32)> {
        match (&self.backend, &mut self.timer) {
            (Backend::Wgpu(_), Some(timer)) => {
                let latest = timer.collect(self.gpu.device()).to_vec();
                let (steps, answers) = self.timed;
                if let Some((_, ms)) = latest.first()
                    && timer.answers() != answers
                {
                    self.device_step_s = Some(f64::from(*ms) * 1.0e-3 / f64::from(steps));
                }
                latest
            }
            _ => Vec::new(),
        }
    }

    /// Takes over another scene, whose world is the same: from the next step on with the other numbers for wind, season
    /// and speeds, if they are others.
    ///
    /// # Errors
    /// A lost device.
    pub(crate) fn take_over(&mut self, scene: Arc<Scene>, has_other_numbers: bool) -> Result<(), SimError> {
        self.scene = scene;
        if has_other_numbers {
            self.compiled.retune(&self.scene);
            self.impose()?;
            self.history.change(self.backend.clock().step(), self.compiled.clone());
            self.target = None;
        }
        Ok(())
    }

    /// A simulator of another world, where this one simulates.
    ///
    /// # Errors
    /// More leaves than memory or the device hold; a device that refuses or is lost.
    pub(crate) fn simulator_of(&self, world: &World) -> anyhow::Result<Backend> {
        let scene = world.compiled.scene();
        check_memory(&scene.name, scene)?;
        Ok(self.device(self.kind()).simulator(world)?)
    }

    /// Begins another scene in its world, with the simulator that was made of it.
    ///
    /// # Errors
    /// A device that is lost, or cannot hold the leaves twice while both backends run.
    pub(crate) fn begin(
        &mut self,
        scene: Arc<Scene>,
        world: &World,
        simulator: Backend,
    ) -> Result<(), SimError> {
        let compares = self.is_comparing();
        self.twin = None;
        self.scene = scene;
        self.compiled = world.compiled.clone();
        self.backend = simulator;
        self.begin_again(world);
        self.set_comparing(compares)
    }

    /// Begins again at time zero, with the numbers as they are.
    ///
    /// # Errors
    /// A lost device.
    pub(crate) fn reset(&mut self) -> anyhow::Result<()> {
        let world = World::build(&self.scene)?;
        self.compiled = world.compiled.clone();
        self.put_back(&world)?;
        self.begin_again(&world);
        Ok(())
    }

    /// Goes on elsewhere: the leaves go on falling where they are.
    ///
    /// # Errors
    /// A device that is lost or cannot hold the leaves.
    pub(crate) fn switch(&mut self, kind: BackendKind) -> Result<(), SimError> {
        if kind == self.kind() {
            return Ok(());
        }
        let world = self.world()?;
        let compares = self.is_comparing();
        self.backend = self.device(kind).simulator(&world)?;
        self.twin = None;
        self.forget_cost();
        self.set_comparing(compares)
    }

    fn begin_again(&mut self, world: &World) {
        self.counted = None;
        self.history = History::new(world);
        self.target = None;
        self.forget_cost();
    }

    fn forget_cost(&mut self) {
        self.step_s = UNKNOWN_STEP_S;
        self.timed = (1, 0);
        self.device_step_s = None;
        self.timer = GpuTimer::new(self.gpu.device(), self.gpu.queue(), &["advance"]);
        self.pace.restart();
    }

    fn device(&self, kind: BackendKind) -> Device {
        match kind {
            BackendKind::Cpu => Device::Cpu(CpuOptions { threads: self.threads, ..CpuOptions::default() }),
            BackendKind::Wgpu => Device::Wgpu(Box::new(self.gpu.clone())),
        }
    }

    /// Backend that simulates.
    pub(crate) fn kind(&self) -> BackendKind {
        match self.backend {
            Backend::Cpu(_) => BackendKind::Cpu,
            Backend::Wgpu(_) => BackendKind::Wgpu,
        }
    }

    /// The scene as it is now.
    pub(crate) fn scene(&self) -> &Arc<Scene> {
        &self.scene
    }

    /// The simulator.
    pub(crate) fn simulator(&self) -> &dyn Simulator {
        &self.backend
    }

    /// Number of leaves.
    pub(crate) fn leaf_count(&self) -> u32 {
        self.scene.leaf_count()
    }

    /// Numbers of leaves that scene and device allow.
    pub(crate) fn leaf_range(&self) -> RangeInclusive<u32> {
        let fewest = u32::try_from(self.scene.sources.len()).unwrap_or(1).max(limits::COUNT.low);
        let held = self.gpu.device().limits().max_buffer_size / RECORD_BYTES;
        let most = u32::try_from(held).unwrap_or(u32::MAX).min(limits::COUNT.high);
        fewest..=most.max(fewest)
    }

    /// The leaves, to be drawn.
    ///
    /// # Errors
    /// A lost device, or one that cannot hold them.
    pub(crate) fn columns(&mut self) -> Result<WorldColumns<'_>, SimError> {
        self.backend.columns(&self.gpu)
    }
}

#[cfg(test)]
mod tests;
