// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! What the panel is told, and what becomes of the wishes it brings back.

use std::time::Instant;

use windfall_core::SimError;
use windfall_core::scene::FlightModel;
use windfall_wgpu::describe_adapter;

use super::{Next, Viewer};
use crate::backend::BackendKind;
use crate::camera::Camera;
use crate::viewer::controls::{Facts, Message, Wish};
use crate::viewer::meter::STAGES;
use crate::viewer::panel::grouped;
use crate::viewer::session::Session;
use crate::viewer::tuning::Tuning;

impl Viewer {
    /// Does what the user wants, or says why not.
    ///
    /// # Errors
    /// A lost device.
    pub(super) fn grant(&mut self, wish: Wish) -> anyhow::Result<()> {
        match wish {
            Wish::TimeScale(scale) => self.session.pace.time_scale = scale,
            Wish::Pause(pause) => self.session.pace.is_paused = pause,
            Wish::SingleStep => {
                self.session.pace.is_paused = true;
                self.session.arrive();
                self.session.step(1)?;
            }
            Wish::StepBack => {
                self.session.pace.is_paused = true;
                self.session.seek(self.session.simulator().clock().step().saturating_sub(1));
            }
            Wish::Seek(step) => self.session.seek(step),
            Wish::TogglePanel => self.panel.is_open = !self.panel.is_open,
            Wish::ResetCamera => {
                self.camera = Camera::from(&self.session.scene().view.camera);
                self.follows_path = true;
            }
            Wish::Lens(lens) => {
                self.session.set_lens(lens);
                self.renderer.set_lens(lens);
            }
            Wish::Look(looking) => self.look(looking),
            Wish::Compare(compares) => self.try_to(None, |session| Ok(session.set_comparing(compares)?))?,
            Wish::Pick(pointer) => self.pick(pointer)?,
            Wish::RecordTo(path) => self.record_to = Some(path),
            Wish::ToggleRecord => self.toggle_recording(),
            Wish::Quit => self.next = Next::Quit,
            Wish::Tune(tuning) => self.try_to(None, |session| session.tune(&tuning))?,
            Wish::Untune => {
                let own = self.session.own_tuning();
                self.try_to(None, |session| session.tune(&own))?;
            }
            Wish::Reset => self.try_to(Some("Begun again at time zero.".into()), Session::reset)?,
            Wish::Leaves(count) => {
                let done = format!("Begun again with {} leaves; the camera stays.", grouped(count));
                self.try_to(Some(done), |session| session.set_leaves(count))?;
                self.renderer.update_leaves(&self.session.stand(), self.session.leaf_count());
            }
            Wish::Backend(kind) => {
                let name = if kind == BackendKind::Cpu { "cpu" } else { "wgpu" };
                let done = format!("Goes on with backend {name}; the leaves are where they were.");
                self.try_to(Some(done), |session| Ok(session.switch(kind)?))?;
            }
        }
        Ok(())
    }

    /// Does something that may be refused, which the user is told; only a lost device ends the program.
    fn try_to(
        &mut self,
        done: Option<String>,
        work: impl FnOnce(&mut Session) -> anyhow::Result<()>,
    ) -> anyhow::Result<()> {
        match work(&mut self.session) {
            Ok(()) => {
                if let Some(text) = done {
                    self.say(text, false);
                }
                Ok(())
            }
            Err(error) => match error.downcast_ref::<SimError>() {
                Some(SimError::DeviceLost { .. } | SimError::Device { .. }) => Err(error),
                _ => {
                    self.say(error.to_string(), true);
                    Ok(())
                }
            },
        }
    }

    pub(super) fn say(&mut self, text: String, is_error: bool) {
        self.message = Some((Message { text, is_error }, Instant::now()));
    }

    /// What the panel shows.
    ///
    /// # Errors
    /// A lost device.
    pub(super) fn facts(&mut self) -> anyhow::Result<Facts> {
        let mut gpu_ms = self.session.device_ms();
        gpu_ms.extend(self.renderer.timings());
        let stats = self.session.stats()?;
        let difference = self.session.difference()?;
        let arrows = self.arrows();
        let arrow_most_m_s = self.arrow_most_m_s();
        let session = &self.session;
        let (scene, simulator) = (session.scene(), session.simulator());
        let tuning = Tuning::from(scene);
        let forward = self.camera.forward();
        Ok(Facts {
            scene: scene.name.clone(),
            info: simulator.info(),
            backend: session.kind(),
            adapter: self.gpu.info().name.clone(),
            driver: describe_adapter(self.gpu.info()),
            clock: simulator.clock(),
            timeline: session.timeline(),
            stats,
            has_motions: scene.species.iter().any(|species| species.flight == FlightModel::Synthesis),
            has_regimes: scene.species.iter().any(|species| species.flight != FlightModel::Synthesis),
            is_tuned: tuning != session.own_tuning(),
            recording: self.record_facts(),
            looking: self.instruments.looking,
            card: self.card(),
            track: self.track(),
            arrows,
            arrow_most_m_s,
            tuning,
            lens: scene.view.lens,
            time_scale: session.pace.time_scale,
            is_paused: session.pace.is_paused,
            behind: session.pace.behind(),
            leaf_count: session.leaf_count(),
            leaf_range: session.leaf_range(),
            frames: self.meter.frames().clone(),
            compares: session.is_comparing(),
            difference,
            fps: self.meter.fps(),
            cpu_ms: STAGES.into_iter().zip(self.meter.stages_ms()).collect(),
            gpu_ms,
            look_deg: forward.z.atan2(forward.x).to_degrees(),
            message: self.message.as_ref().map(|(message, _)| message.clone()),
        })
    }
}
