// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The picture of a player in a canvas, for the page.

use wasm_bindgen::JsError;
use wasm_bindgen::prelude::wasm_bindgen;
use web_sys::HtmlCanvasElement;
use windfall_core::scene::SkyMap;
use windfall_render::light::Daylight;

use crate::error::WebError;
use crate::leaf_pictures::LeafPictures;
use crate::lockstep::Lockstep;
use crate::picture::Picture;
use crate::player::Player;

/// A canvas with a WebGPU device, and the leaf pictures that the page has fetched.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Screen {
    picture: Picture,
    leaves: LeafPictures,
    /// The simulator on WebGPU, while both run.
    lockstep: Option<Lockstep>,
}

#[wasm_bindgen]
impl Screen {
    /// A screen in a canvas, which shows nothing yet.
    ///
    /// # Errors
    /// No WebGPU, or no adapter for it.
    pub async fn open(canvas: HtmlCanvasElement) -> Result<Self, JsError> {
        let picture = Picture::open(canvas).await?;
        Ok(Self { picture, leaves: LeafPictures::default(), lockstep: None })
    }

    /// Name of the adapter.
    pub fn adapter(&self) -> String {
        self.picture.adapter().to_owned()
    }

    /// Takes over a pack of leaf pictures.
    ///
    /// # Errors
    /// Bytes that are no pack.
    pub fn give_leaves(&mut self, name: &str, bytes: &[u8]) -> Result<(), JsError> {
        Ok(self.leaves.give(name, bytes)?)
    }

    /// Shows the scene of a player from now on.
    ///
    /// # Errors
    /// A scene that the device cannot draw.
    pub fn show(&mut self, player: &Player) -> Result<(), JsError> {
        self.lockstep = None;
        let atlas = self.leaves.atlas_of(player.session.scene())?;
        Ok(self.picture.show(&player.session, &atlas)?)
    }

    /// Draws under the sky of a picture (Radiance or OpenEXR) from now on.
    ///
    /// # Errors
    /// A picture that cannot be used; the sky stays.
    pub fn set_sky(&mut self, player: &Player, file: &str, bytes: &[u8]) -> Result<(), JsError> {
        let named = player.session.sky().cloned();
        let map = SkyMap { path: file.to_owned(), ..named.unwrap_or_else(|| SkyMap::new(file.to_owned())) };
        let daylight = Daylight::of_picture_bytes(&map, bytes).map_err(WebError::from)?;
        self.picture.set_daylight(daylight);
        Ok(())
    }

    /// Draws pictures of another size in pixels.
    ///
    /// # Errors
    /// A size that the renderer refuses.
    pub fn resize(&mut self, width: u32, height: u32) -> Result<(), JsError> {
        Ok(self.picture.resize(width, height)?)
    }

    /// Draws the player's world, `since_s` seconds after the picture before; returns true if it was drawn.
    ///
    /// # Errors
    /// A player of another scene than the one shown.
    pub fn draw(&mut self, player: &Player, since_s: f64) -> Result<bool, JsError> {
        Ok(self.picture.draw(&player.session, player.camera, since_s)?)
    }

    /// Runs the simulator on WebGPU beside that of the player from now on, or no longer.
    ///
    /// # Errors
    /// A device that cannot hold the leaves twice.
    pub fn compare(&mut self, player: &Player, compares: bool) -> Result<(), JsError> {
        self.lockstep =
            if compares { Some(Lockstep::of(self.picture.gpu(), &player.session)?) } else { None };
        Ok(())
    }

    /// Returns true while the simulator on WebGPU has steps to take that the player has taken.
    pub fn is_behind(&self, player: &Player) -> bool {
        self.lockstep.as_ref().is_some_and(|lockstep| lockstep.is_behind(&player.session))
    }

    /// Returns true while both simulators run.
    pub fn compares(&self) -> bool {
        self.lockstep.is_some()
    }

    /// Lets the simulator on WebGPU follow the player. Returns what is known of the difference: its step, the step since which both have gone
    /// their own ways, the largest distance of two leaves in metres, and the number of leaves in another state.
    ///
    /// # Errors
    /// A lost device.
    pub fn difference(&mut self, player: &Player) -> Result<Option<Vec<f64>>, JsError> {
        let Some(lockstep) = &mut self.lockstep else { return Ok(None) };
        lockstep.follow(self.picture.gpu(), &player.session)?;
        let numbers = lockstep.difference().map(|found| {
            vec![found.step.into(), found.since.into(), found.farthest_m.into(), found.other_states.into()]
        });
        Ok(numbers)
    }

    /// Returns true while the device works on a frame.
    pub fn is_busy(&self) -> bool {
        self.picture.is_busy()
    }

    /// Milliseconds that the device last spent on all passes of a frame; nothing where it has no timestamps.
    pub fn device_ms(&mut self) -> Option<f32> {
        let timings = self.picture.timings();
        (!timings.is_empty()).then(|| timings.iter().map(|(_, ms)| ms).sum())
    }

    /// Reason for the device's loss, if it is lost.
    pub fn lost(&self) -> Option<String> {
        self.picture.lost()
    }

    /// The first error of the device since this was asked last, if there was one.
    pub fn take_complaint(&self) -> Option<String> {
        self.picture.take_complaint()
    }

    /// Destroys the device, as a driver may at any time: to try what the page does then.
    pub fn lose(&self) {
        self.picture.lose();
    }
}
