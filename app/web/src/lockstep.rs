// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The simulator on WebGPU beside that on the processor, step by step, and the difference of their leaves.

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use windfall_core::leaf::{LeafState, Place};
use windfall_core::{Simulator, World};
use windfall_wgpu::{Gpu, StateRequest, WgpuOptions, WgpuSimulator};

use crate::error::WebError;
use crate::session::Session;

/// Most steps that the device takes at once.
const MOST_STEPS: u32 = 16;
/// Steps from one reading of the state to the next while time goes on.
const READ_EVERY: u32 = 24;

/// Difference of the two at a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Difference {
    /// Step.
    pub(crate) step: u32,
    /// Step at which both were last the same.
    pub(crate) since: u32,
    /// Largest distance in metres between two leaves of the same slot.
    pub(crate) farthest_m: f32,
    /// Slots in which one leaf is in another state than the other.
    pub(crate) other_states: u32,
}

/// A state on its way from the device, and the world on the processor at the same step.
#[derive(Debug)]
struct Reading {
    request: StateRequest,
    mine: World,
}

/// A simulator on WebGPU.
#[derive(Debug)]
pub(crate) struct Lockstep {
    simulator: WgpuSimulator,
    /// Step at which it took over the processor's state.
    since: u32,
    /// State that was last read from the device; at first the one that both began with, so that what was never read shows as different.
    other: World,
    reading: Option<Reading>,
    difference: Option<Difference>,
    /// Step of the processor when it was followed last.
    followed: u32,
    /// Submissions that the device still works on.
    pending: Arc<AtomicU32>,
}

impl Lockstep {
    /// A simulator of the session's world as it is now.
    ///
    /// # Errors
    /// [`WebError::Sim`] if the device cannot hold it.
    pub(crate) fn of(gpu: &Gpu, session: &Session) -> Result<Self, WebError> {
        let world = session.world();
        let (simulator, other) = (WgpuSimulator::new(gpu, world, &WgpuOptions::default())?, world.clone());
        let since = world.clock.step();
        Ok(Self {
            simulator,
            since,
            other,
            reading: None,
            difference: None,
            followed: since,
            pending: Arc::default(),
        })
    }

    /// Goes towards the step of the session, and reads the state there now and then, at once when time stands still.
    ///
    /// # Errors
    /// [`WebError::Sim`] for a lost device or a session of another scene.
    pub(crate) fn follow(&mut self, gpu: &Gpu, session: &Session) -> Result<(), WebError> {
        let world = session.world();
        let step = world.clock.step();
        let is_still = std::mem::replace(&mut self.followed, step) == step;
        if let Some(reading) = self.reading.take() {
            if reading.request.poll(&mut self.other)? {
                self.difference = Some(difference(&reading.mine, &self.other, self.since));
            } else {
                self.reading = Some(reading);
            }
        }
        if step < self.simulator.clock().step() {
            self.simulator.write_state(world)?;
            (self.since, self.difference, self.reading) = (step, None, None);
        }
        let missing = step - self.simulator.clock().step();
        if missing > 0 && self.pending.load(Ordering::Relaxed) == 0 {
            self.simulator.step(missing.min(MOST_STEPS))?;
            let pending = Arc::clone(&self.pending);
            pending.fetch_add(1, Ordering::Relaxed);
            gpu.queue().on_submitted_work_done(move || {
                pending.fetch_sub(1, Ordering::Relaxed);
            });
        }
        let read = self.difference.map_or(self.since, |found| found.step);
        let is_due =
            if is_still { self.difference.is_none() || read != step } else { step >= read + READ_EVERY };
        if is_due && self.reading.is_none() && !self.is_behind(session) {
            let request = self.simulator.request_state()?;
            self.reading = Some(Reading { request, mine: world.clone() });
        }
        Ok(())
    }

    /// Returns true while steps are missing.
    pub(crate) fn is_behind(&self, session: &Session) -> bool {
        self.simulator.clock().step() < session.step()
    }

    /// The latest difference that is known.
    pub(crate) fn difference(&self) -> Option<Difference> {
        self.difference
    }
}

/// Compares two worlds of as many leaves.
fn difference(mine: &World, other: &World, since: u32) -> Difference {
    let pairs = || mine.leaves.place.iter().zip(&other.leaves.place);
    // Leaves that wait are nowhere.
    let apart = |(a, b): (&Place, &Place)| {
        let is_there = a.state() != LeafState::Dormant || b.state() != LeafState::Dormant;
        let squared: f32 = a.position.iter().zip(b.position).map(|(a, b)| (a - b) * (a - b)).sum();
        if is_there { squared.sqrt() } else { 0.0 }
    };
    let other_states = pairs().filter(|(a, b)| a.state() != b.state()).count();
    Difference {
        step: mine.clock.step(),
        since,
        farthest_m: pairs().map(apart).fold(0.0, f32::max),
        other_states: u32::try_from(other_states).unwrap_or(u32::MAX),
    }
}
