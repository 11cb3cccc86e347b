// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Input of the panel, and handling of the actions that it returns.

use std::sync::Arc;
use std::time::Instant;

use windfall_core::SimError;
use windfall_core::scene::FlightModel;
use windfall_render::camera::Camera;
use windfall_wgpu::describe_adapter;

use super::{Next, Viewer};
use crate::run::backend::BackendKind;
use crate::view::panel::action::Action;
use crate::view::panel::panel_input::{Message, PanelInput};
use crate::view::tools::meter::STAGES;

impl Viewer {
    /// Does what the user wants, or says why not.
    ///
    /// # Errors
    /// A lost device.
    pub(super) fn handle(&mut self, action: Action) -> anyhow::Result<()> {
        match action {
            Action::TimeScale(scale) => self.session.pace.time_scale = scale,
            Action::Pause(pause) => self.session.pace.is_paused = pause,
            Action::SingleStep => {
                self.session.pace.is_paused = true;
                self.session.arrive();
                self.session.step(1)?;
            }
            Action::StepBack => {
                self.session.pace.is_paused = true;
                self.session.seek(self.session.heading().saturating_sub(1));
            }
            Action::Seek(step) => self.session.seek(step),
            Action::TogglePanel => self.panel.is_open = !self.panel.is_open,
            Action::ResetCamera => {
                self.camera = Camera::from(&self.session.scene().view.camera);
                self.follows_path = true;
            }
            Action::SetOverlays(overlays) => self.set_overlays(overlays),
            Action::Compare(compares) => {
                self.try_it(|viewer| Ok(viewer.session.set_comparing(compares)?))?
            }
            Action::Pick(pointer) => self.pick(pointer)?,
            Action::RecordTo(path) => self.record_to = Some(path),
            Action::ToggleRecord => self.toggle_recording(),
            Action::Quit => self.next = Next::Quit,
            // The panel sees to these itself.
            Action::Save | Action::ToggleHelp => {}
            Action::ShowError(text) => self.say(text, true),
            Action::Edit { scene, gesture } => self.try_it(|viewer| viewer.edit(*scene, gesture))?,
            Action::Undo => self.try_it(|viewer| viewer.step_back(true))?,
            Action::Redo => self.try_it(|viewer| viewer.step_back(false))?,
            Action::Open(name) => self.try_it(|viewer| viewer.open(&name))?,
            Action::Drop(path) => self.try_it(|viewer| viewer.take_in(&path))?,
            Action::SaveTo(path) => self.try_it(|viewer| viewer.save(&path))?,
            Action::Reset => self.try_it(|viewer| {
                viewer.session.reset()?;
                viewer.say("Begun again at time zero.".into(), false);
                Ok(())
            })?,
            Action::Quality(quality) => self.try_it(|viewer| viewer.set_quality(quality))?,
            Action::Backend(kind) => {
                let name = if kind == BackendKind::Cpu { "cpu" } else { "wgpu" };
                self.try_it(|viewer| {
                    viewer.session.switch(kind)?;
                    viewer
                        .say(format!("Goes on with backend {name}; the leaves are where they were."), false);
                    Ok(())
                })?;
            }
        }
        Ok(())
    }

    /// Does something that may be refused, with a message to the user; only a lost device ends the program.
    fn try_it(&mut self, work: impl FnOnce(&mut Self) -> anyhow::Result<()>) -> anyhow::Result<()> {
        match work(self) {
            Ok(()) => Ok(()),
            Err(error) => match error.downcast_ref::<SimError>() {
                Some(SimError::DeviceLost { .. } | SimError::Device { .. }) => Err(error),
                _ => {
                    self.say(format!("{error:#}"), true);
                    Ok(())
                }
            },
        }
    }

    pub(super) fn say(&mut self, text: String, is_error: bool) {
        self.message = Some((Message { text, is_error }, Instant::now()));
    }

    /// Collects the input of the panel.
    ///
    /// # Errors
    /// A lost device.
    pub(super) fn panel_input(&mut self) -> anyhow::Result<PanelInput> {
        let mut gpu_ms = self.session.device_ms();
        gpu_ms.extend(self.renderer.timings());
        let stats = self.session.stats()?;
        let difference = self.session.difference()?;
        let arrows = self.arrows();
        let recording = self.clip_status();
        let arrow_most_m_s = self.arrow_most_m_s();
        let session = &self.session;
        let (scene, simulator) = (session.scene(), session.simulator());
        let forward = self.camera.forward();
        Ok(PanelInput {
            scene: Arc::clone(scene),
            loaded: Arc::clone(&self.loaded),
            history: self.history.depths(),
            is_building: self.building.is_some(),
            info: simulator.info(),
            backend: session.kind(),
            adapter: self.gpu.info().name.clone(),
            driver: describe_adapter(self.gpu.info()),
            quality: self.quality,
            clock: simulator.clock(),
            timeline: session.timeline(),
            stats,
            has_motions: scene.species.iter().any(|species| species.flight == FlightModel::Synthesis),
            has_regimes: scene.species.iter().any(|species| species.flight != FlightModel::Synthesis),
            recording,
            overlays: self.instruments.overlays,
            card: self.card(),
            track: self.track(),
            arrows,
            arrow_most_m_s,
            time_scale: session.pace.time_scale,
            is_paused: session.pace.is_paused,
            behind: session.pace.behind(),
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
