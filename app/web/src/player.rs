// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A scene that goes on, for the page.

use wasm_bindgen::JsError;
use wasm_bindgen::prelude::wasm_bindgen;
use windfall_core::LeafStats;
use windfall_render::camera::Camera;

use crate::camera_numbers::{camera_of, numbers_of};
use crate::error::WebError;
use crate::leaf_pictures;
use crate::session::Session;

/// A scene, its simulator on the processor, and the camera that looks at it.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Player {
    pub(crate) session: Session,
    pub(crate) camera: Camera,
}

impl Player {
    fn of(session: Session) -> Self {
        let camera = Camera::from(&session.scene().view.camera);
        Self { session, camera }
    }
}

#[wasm_bindgen]
impl Player {
    /// The preset of this name, with another number of leaves if one is given.
    ///
    /// # Errors
    /// A name that is no preset's, a number of leaves that the scene cannot have, more than a page can hold.
    pub fn of_preset(name: &str, leaves: Option<u32>) -> Result<Self, JsError> {
        Ok(Self::of(Session::of_preset(name, leaves)?))
    }

    /// The text of a scene file; `file` is the name that errors give it.
    ///
    /// # Errors
    /// Text that is no scene, a scene that names files or holds more than a page can.
    pub fn of_ron(text: &str, file: &str, leaves: Option<u32>) -> Result<Self, JsError> {
        Ok(Self::of(Session::of_ron(text, file, leaves)?))
    }

    /// Title of the scene.
    pub fn title(&self) -> String {
        self.session.scene().name.clone()
    }

    /// Preset or file.
    pub fn name(&self) -> String {
        self.session.name().to_owned()
    }

    /// The scene as text, with the number of leaves that it has now.
    pub fn ron(&self) -> String {
        self.session.scene().to_ron()
    }

    /// Sky that the scene names and that only the reader has.
    pub fn sky(&self) -> Option<String> {
        self.session.sky().map(|sky| sky.path.clone())
    }

    /// Names of the packs of leaf pictures that the scene needs.
    pub fn leaf_packs(&self) -> Vec<String> {
        leaf_pictures::wanted(self.session.scene()).into_iter().map(str::to_owned).collect()
    }

    /// Number of leaves.
    pub fn leaves(&self) -> u32 {
        self.session.scene().leaf_count()
    }

    /// Leaves of the scene as it is written.
    pub fn own_leaves(&self) -> u32 {
        self.session.own_leaves()
    }

    /// Fewest leaves that it can have.
    pub fn fewest_leaves(&self) -> u32 {
        u32::try_from(self.session.scene().sources.len()).unwrap_or(u32::MAX).max(1)
    }

    /// Length of a step in seconds.
    pub fn dt_s(&self) -> f64 {
        f64::from(self.session.scene().dt_s)
    }

    /// Steps since the beginning.
    pub fn step(&self) -> u32 {
        self.session.step()
    }

    /// Takes so many steps.
    ///
    /// # Errors
    /// A simulator that cannot go on.
    pub fn advance(&mut self, count: u32) -> Result<(), JsError> {
        Ok(self.session.advance(count)?)
    }

    /// Goes to the last kept moment at or before a step, from which `advance` reaches it.
    ///
    /// # Errors
    /// A simulator that cannot go on.
    pub fn go_towards(&mut self, step: u32) -> Result<(), JsError> {
        Ok(self.session.go_towards(step)?)
    }

    /// Hash of the whole state: what `windfall simulate` prints after as many steps.
    pub fn state_hash(&self) -> String {
        self.session.state_hash()
    }

    /// Leaves on branches, in the air, at rest and not let go yet.
    pub fn counts(&self) -> Vec<u32> {
        let LeafStats { attached, falling, resting, dormant, .. } = self.session.world().stats().leaves;
        vec![attached, falling, resting, dormant]
    }

    /// The camera: point looked at, yaw, pitch, distance, vertical field of view; metres and radians.
    pub fn camera(&self) -> Vec<f32> {
        numbers_of(&self.camera).to_vec()
    }

    /// Looks from elsewhere, by numbers in the same order.
    ///
    /// # Errors
    /// A number that is missing or not allowed; the camera stays.
    pub fn set_camera(&mut self, numbers: &[f32]) -> Result<(), JsError> {
        self.camera = camera_of(numbers).map_err(|error: WebError| JsError::from(error))?;
        Ok(())
    }

    /// Looks from where the scene says.
    pub fn reset_camera(&mut self) {
        self.camera = Camera::from(&self.session.scene().view.camera);
    }

    /// Turns the camera about what it looks at, in radians.
    pub fn orbit(&mut self, yaw_rad: f32, pitch_rad: f32) {
        self.camera.orbit(yaw_rad, pitch_rad);
    }

    /// Goes nearer by a factor above 1, or away.
    pub fn zoom(&mut self, factor: f32) {
        self.camera.zoom(factor);
    }

    /// Moves the camera across the view, in heights of the picture.
    pub fn pan(&mut self, right: f32, up: f32) {
        self.camera.pan(right, up);
    }
}
