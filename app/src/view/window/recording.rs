// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Recording what the window shows. Whatever goes wrong with a clip is shown to the user and ends the clip, not the program.

use std::path::Path;

use windfall_render::FrameInput;

use super::Viewer;
use crate::run::cancel::Cancel;
use crate::run::digits::grouped;
use crate::run::terminal;
use crate::view::tools::clip::{ClipStatus, Recording, free_name};

impl Viewer {
    /// Begins a clip, or completes the one that is being made.
    pub(super) fn toggle_recording(&mut self) {
        if self.recording.is_some() {
            self.finish_recording();
            return;
        }
        let (_, size) = self.panel.picture_area(self.screen.size());
        let pace = (self.session.pace.time_scale, self.session.simulator().clock().dt_s());
        let path = self.record_path();
        match Recording::start(&path, &self.gpu, self.screen.format(), size, pace) {
            Ok(recording) => {
                // Ending the program completes the clip from now on.
                self.cancel = Cancel::on_interrupt();
                self.recording = Some(recording);
            }
            Err(error) => self.say(error.to_string(), true),
        }
    }

    /// Path of the next clip.
    fn record_path(&mut self) -> String {
        let is_taken = |name: &str| Path::new(name).exists();
        let name = || free_name(&self.session.scene().name, is_taken);
        self.record_to.get_or_insert_with(name).clone()
    }

    /// State of recording.
    pub(super) fn clip_status(&mut self) -> ClipStatus {
        ClipStatus { path: self.record_path(), frames: self.recording.as_ref().map(Recording::frames) }
    }

    /// Completes the clip, if there is one; true if there was.
    pub(crate) fn finish_recording(&mut self) -> bool {
        let Some(recording) = self.recording.take() else { return false };
        let frames = grouped(recording.frames());
        self.session.pace.restart();
        match recording.finish() {
            Ok(path) => {
                let text = format!("Recorded {frames} frames: {}", path.display());
                terminal::note(&text);
                self.say(text, false);
                self.record_to = None;
            }
            Err(error) => self.say(error.to_string(), true),
        }
        true
    }

    /// Takes a frame of the scene as it is now.
    ///
    /// # Errors
    /// A lost device.
    pub(super) fn record_frame(&mut self) -> anyhow::Result<()> {
        let Some(mut recording) = self.recording.take() else { return Ok(()) };
        let (_, size) = self.panel.picture_area(self.screen.size());
        if !recording.fits(size) {
            self.recording = Some(recording);
            self.finish_recording();
            self.say("The window became smaller than the clip, which ends here.".into(), true);
            return Ok(());
        }
        self.renderer.resize(recording.size)?;
        let time_s = self.session.simulator().clock().seconds();
        let columns = self.session.columns()?;
        let device = self.gpu.device();
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.moment = self.moment.after(1.0 / crate::view::tools::clip::FPS);
        let input = FrameInput { camera: self.camera, time_s, moment: self.moment, origin: (0, 0) };
        let view = recording.target.view();
        self.renderer.draw(&mut encoder, &view, &columns, &input);
        let picture = recording.target.submit_and_read(device, self.gpu.queue(), encoder);
        self.gpu.check()?;
        match recording.push(&picture?) {
            Ok(()) => self.recording = Some(recording),
            Err(error) => self.say(format!("The clip ends here: {error}"), true),
        }
        // The window shows the same moment: for it no time passes.
        self.moment = self.moment.after(0.0);
        Ok(())
    }
}
