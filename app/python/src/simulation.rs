// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A world and what steps and draws it, without Python.

use std::time::{Duration, Instant};

use windfall::backend::{BackendArguments, BackendKind, Device};
use windfall::cancel::Cancel;
use windfall::drawing::Drawing;
use windfall::scenes::atlas_at_once;
use windfall::studio::Studio;
use windfall_core::{Clock, SimError, Simulator, SimulatorInfo, World};
use windfall_cpu::CpuSimulator;
use windfall_wgpu::{WgpuOptions, WgpuSimulator};

/// Longest that stepping goes on without a look at what the user wants.
const PORTION: Duration = Duration::from_millis(100);
/// Most steps of a portion.
const MOST_STEPS: u32 = 4096;

/// The state where it is on this side of the device, and the simulator that moves it.
enum Backend {
    Cpu(Box<CpuSimulator>),
    /// The copy is read back when it is asked for.
    Wgpu {
        simulator: Box<WgpuSimulator>,
        copy: Box<World>,
        is_current: bool,
    },
}

/// Pictures that one studio can draw.
#[derive(Clone, Copy, PartialEq)]
struct PictureKind {
    size: (u32, u32),
    is_draft: bool,
}

/// A world that goes on.
pub(crate) struct Simulation {
    backend: Backend,
    /// Steps that fit into a portion.
    portion: u32,
    adapter: Option<String>,
    /// Studio of the latest picture.
    studio: Option<(PictureKind, Studio)>,
}

impl Simulation {
    /// A world on the device that the arguments choose; with it the reason, if they leave it to us.
    ///
    /// # Errors
    /// Arguments that exclude each other, a device that is missing or too small.
    pub(crate) fn new(world: World, arguments: &BackendArguments) -> anyhow::Result<(Self, Option<String>)> {
        let choice = arguments.choose()?;
        let backend = match choice.device {
            Device::Cpu(options) => Backend::Cpu(Box::new(CpuSimulator::new(&world, options)?)),
            Device::Wgpu(gpu) => {
                let simulator = Box::new(WgpuSimulator::new(&gpu, &world, &WgpuOptions::default())?);
                Backend::Wgpu { simulator, copy: Box::new(world), is_current: true }
            }
        };
        let adapter = arguments.adapter.clone();
        Ok((Self { backend, portion: 1, adapter, studio: None }, choice.reason))
    }

    /// Backend, adapter and contract.
    pub(crate) fn info(&self) -> SimulatorInfo {
        match &self.backend {
            Backend::Cpu(simulator) => simulator.info(),
            Backend::Wgpu { simulator, .. } => simulator.info(),
        }
    }

    /// Steps and seconds since the scene began.
    pub(crate) fn clock(&self) -> Clock {
        match &self.backend {
            Backend::Cpu(simulator) => simulator.clock(),
            Backend::Wgpu { simulator, .. } => simulator.clock(),
        }
    }

    /// The state as it is now, read back from the device if it is there. It stays where it is until the next step.
    ///
    /// # Errors
    /// A lost device.
    pub(crate) fn world(&mut self) -> Result<&World, SimError> {
        match &mut self.backend {
            Backend::Cpu(simulator) => Ok(simulator.world()),
            Backend::Wgpu { simulator, copy, is_current } => {
                if !*is_current {
                    simulator.read_state(copy)?;
                    *is_current = true;
                }
                Ok(copy)
            }
        }
    }

    /// Steps for about a tenth of a second, `most` times at most. Returns the number of steps.
    ///
    /// # Errors
    /// A lost device.
    pub(crate) fn step(&mut self, most: u32) -> Result<u32, SimError> {
        let count = self.portion.min(most);
        let simulator: &mut dyn Simulator = match &mut self.backend {
            Backend::Cpu(simulator) => simulator.as_mut(),
            Backend::Wgpu { simulator, is_current, .. } => {
                *is_current = false;
                simulator.as_mut()
            }
        };
        let began = Instant::now();
        simulator.step(count)?;
        simulator.sync()?;
        let fitting = f64::from(count) * PORTION.as_secs_f64() / began.elapsed().as_secs_f64().max(1e-6);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within the bounds")]
        let fitting = fitting.clamp(1.0, f64::from(MOST_STEPS)) as u32;
        // Rather twice too short than jumping to and fro.
        self.portion = fitting.min(self.portion.saturating_mul(4));
        Ok(count)
    }

    /// A picture of the state, `since_s` seconds after the one before; infinite for one that has none before it. A draft is drawn at once, with small
    /// leaves where others would have to be made.
    ///
    /// # Errors
    /// No adapter to draw on, a size that it cannot draw, leaves that cannot be made.
    pub(crate) fn draw(&mut self, size: (u32, u32), since_s: f64, is_draft: bool) -> anyhow::Result<Vec<u8>> {
        let kind = PictureKind { size, is_draft };
        let studio = self.studio.take().filter(|(drawn, _)| *drawn == kind);
        let adapter = self.adapter.clone();
        let world = self.world()?;
        let mut studio = match studio {
            Some((_, studio)) => studio,
            None => {
                // Pictures are drawn of a copy, so what steps it does not matter; the processor needs no shaders compiled.
                let arguments =
                    BackendArguments { backend: Some(BackendKind::Cpu), adapter, threads: Some(1) };
                let drawing = Drawing::without_window(&arguments)?;
                let cancel = Cancel::default();
                if is_draft {
                    let (atlas, _) = atlas_at_once(world.compiled.scene())?;
                    Studio::with_leaves(world, &atlas, drawing, size, &cancel)?
                } else {
                    Studio::of_world(world, drawing, size, &cancel, &|_, _| ())?
                }
            }
        };
        studio.go_on_from(world)?;
        let picture = studio.draw(since_s)?;
        self.studio = Some((kind, studio));
        Ok(picture.into_raw())
    }
}
