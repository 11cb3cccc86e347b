// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The steps of a frame: as many as are due, as a clip needs, or as lead to where the user wants to be.

use windfall_render::MAX_TRAILS;

use super::Viewer;

impl Viewer {
    /// Takes the steps that are due.
    pub(super) fn simulate(&mut self, frame_s: f64) -> anyhow::Result<()> {
        if self.session.is_seeking() {
            return Ok(self.session.pursue()?);
        }
        let steps = match &self.recording {
            Some(_) if self.session.pace.is_paused => 0,
            Some(recording) => recording.due_steps(),
            None => self.session.due_steps(frame_s),
        };
        if !self.renderer.has_trails() || self.session.leaf_count() > MAX_TRAILS {
            return Ok(self.session.step(steps)?);
        }
        // Few leaves, whose trails would be all corners if they only knew about what is shown.
        for _ in 1..steps {
            self.session.step(1)?;
            let time_s = self.session.simulator().clock().seconds();
            let columns = self.session.columns()?;
            let mut encoder =
                self.gpu.device().create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            self.renderer.observe(&mut encoder, &columns, time_s);
            self.gpu.queue().submit([encoder.finish()]);
        }
        Ok(self.session.step(steps.min(1))?)
    }
}
