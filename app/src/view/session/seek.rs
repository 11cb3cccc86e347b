// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Time there and back: any step that was reached is reached again, with the same bits.

use std::sync::Arc;
use std::time::{Duration, Instant};

use windfall_core::{Scene, SimError, Simulator, World};
use windfall_wgpu::Gpu;

use super::Session;
use crate::run::backend::BackendKind;

/// Time that the steps towards a target may take in one frame, in seconds: the window stays alive.
const BUDGET_S: f64 = 0.04;
/// Keeping a moment may take one part in so many of the time between two.
const KEEPING_SHARE: u32 = 20;

/// Range of steps that can be reached, and the step that is sought.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Timeline {
    /// First and latest step that can be reached.
    pub(crate) range: (u32, u32),
    /// Step on the way to which time is.
    pub(crate) target: Option<u32>,
    /// Steps that are kept whole.
    pub(crate) kept: Vec<u32>,
}

impl Session {
    /// Wants to be at `step`, or at the nearest that can be reached; [`Self::pursue`] goes there.
    pub(crate) fn seek(&mut self, step: u32) {
        let (first, last) = self.history.range();
        self.target = Some(step.clamp(first, last));
    }

    /// The step where time is or wants to be.
    pub(crate) fn heading(&self) -> u32 {
        self.target.unwrap_or(self.backend.clock().step())
    }

    /// Stays where it is.
    pub(crate) fn arrive(&mut self) {
        self.target = None;
    }

    /// Returns true while a step is being sought.
    pub(crate) fn is_seeking(&self) -> bool {
        self.target.is_some()
    }

    /// Goes on towards the target for as long as a frame allows.
    ///
    /// # Errors
    /// A lost device.
    pub(crate) fn pursue(&mut self) -> Result<(), SimError> {
        let Some(target) = self.target else { return Ok(()) };
        let since = Instant::now();
        let now = self.backend.clock().step();
        let nearest = self.history.step_before(target);
        if nearest.is_some_and(|step| target < now || step > now) {
            self.go_back(target)?;
        }
        while self.backend.clock().step() < target {
            let left = target - self.backend.clock().step();
            let cost_s = self.device_step_s.unwrap_or(self.step_s).max(1.0e-7);
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "saturating is right"
            )]
            let affordable = ((0.5 * BUDGET_S / cost_s) as u32).clamp(1, 64);
            self.step(affordable.min(left))?;
            self.backend.sync()?;
            if since.elapsed().as_secs_f64() > BUDGET_S {
                break;
            }
        }
        if self.backend.clock().step() >= target {
            self.target = None;
            self.pace.restart();
        }
        Ok(())
    }

    /// Puts back the last kept moment at or before `step`.
    fn go_back(&mut self, step: u32) -> Result<(), SimError> {
        let Some(world) = self.history.before(step) else { return Ok(()) };
        self.put_back(&world)?;
        self.adopt(world.compiled);
        self.counted = None;
        Ok(())
    }

    /// Goes on on the processor after the loss of the device; `gpu` draws from now on. What was on the lost one alone is reached again from the
    /// last kept moment, or, if none is kept, the scene begins again.
    ///
    /// # Errors
    /// Files of the scene that have changed, more leaves than memory holds.
    pub(crate) fn recover(&mut self, gpu: Gpu) -> anyhow::Result<()> {
        let wanted = self.heading();
        let kept = match self.kind() {
            BackendKind::Cpu => Some(self.world()?),
            BackendKind::Wgpu => self.history.before(self.backend.clock().step()),
        };
        let is_kept = kept.is_some();
        let world = kept.map_or_else(|| World::build(&self.scene), Ok)?;
        self.twin = None;
        self.gpu = gpu;
        self.backend = self.device(BackendKind::Cpu).simulator(&world)?;
        self.adopt(world.compiled.clone());
        self.counted = None;
        self.forget_cost();
        if is_kept {
            self.seek(wanted);
        } else {
            self.begin_again(&world);
        }
        Ok(())
    }

    /// Steps until another scene holds; as many as there are, if none ever does.
    pub(super) fn steps_to_change(&self) -> u32 {
        let now = self.backend.clock().step();
        self.history.next_change(now).map_or(u32::MAX, |step| step - now)
    }

    /// After a step: takes over what holds from here on, and keeps this moment if it is time.
    pub(super) fn take_note(&mut self) -> Result<(), SimError> {
        let now = self.backend.clock().step();
        if self.history.changes_at(now)
            && let Some(compiled) = self.history.compiled(now).cloned()
        {
            self.adopt(compiled);
            self.impose()?;
        }
        let is_rested = self.kept.is_none_or(|(since, took)| since.elapsed() >= took * KEEPING_SHARE);
        if self.history.reach(now) && is_rested {
            let since = Instant::now();
            let world = self.world()?;
            self.history.keep(world);
            self.kept = Some((Instant::now(), since.elapsed().max(Duration::from_micros(10))));
        }
        Ok(())
    }

    /// Takes over wind and speeds as they were; the picture stays as it is set now.
    fn adopt(&mut self, compiled: windfall_core::CompiledScene) {
        let view = self.scene.view.clone();
        self.scene = Arc::new(Scene { view, ..compiled.scene().clone() });
        self.compiled = compiled;
    }

    /// State of the time bar.
    pub(crate) fn timeline(&self) -> Timeline {
        let kept = self.history.kept().collect();
        Timeline { range: self.history.range(), target: self.target, kept }
    }
}
