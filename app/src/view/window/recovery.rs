// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! After the loss of the graphics device: all that was on it is made anew on another one.

use windfall_render::LensMoment;

use super::editing::renderer_of;
use super::{Next, Viewer};
use crate::run::drawing::Drawing;
use crate::run::terminal;
use crate::view::window::leaf_making::pictures_at_once;
use crate::view::window::screen::Screen;

/// Times that a device may be lost before the window gives up.
const MOST_LOSSES: u32 = 3;

impl Viewer {
    /// Goes on after an error of a frame: the adapter is opened again to draw, and the processor simulates.
    ///
    /// # Errors
    /// The error, if it is not for the loss of the device; an adapter that is gone or is lost again and again.
    pub(crate) fn recover(&mut self, error: anyhow::Error) -> anyhow::Result<()> {
        if !self.gpu.is_lost() || self.losses == MOST_LOSSES {
            return Err(error);
        }
        self.losses += 1;
        // Its pictures were drawn on the device; those that are taken are a clip.
        self.finish_recording();
        let size = self.renderer.size();
        let surface = Screen::surface(&self.instance, &self.window)?;
        let Drawing { gpu, adapter, .. } = Drawing::choose(&self.backend, &self.instance, Some(&surface))?;
        self.screen.reopen(surface, &adapter, &gpu)?;
        self.session.recover(gpu.clone())?;
        let (compiled, scene) = (self.session.compiled(), self.session.scene());
        let atlas = pictures_at_once(&mut self.leaf_making, scene)?;
        self.renderer = renderer_of(&gpu, compiled, scene, &atlas, self.screen.format(), size, self.quality)?;
        self.gui.reopen(&self.window, &gpu, self.screen.format());
        self.instruments.reopen(gpu.device());
        self.gpu = gpu;
        self.set_overlays(self.instruments.overlays);
        let step = self.session.simulator().clock().step();
        let text = format!(
            "the graphics device is lost ({error}); going on with a new one that draws, and simulating on the cpu, from step {step}"
        );
        terminal::note(&text);
        self.say(text, true);
        self.moment = LensMoment::FIRST;
        self.was_idle = true;
        self.next = Next::Frame;
        Ok(())
    }
}
