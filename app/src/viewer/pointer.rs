// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Moves the camera by mouse.

use egui::{PointerButton, Response};

use crate::camera::Camera;
use crate::land::Land;

/// Radians per point of a drag.
const ORBIT_RAD: f32 = 0.006;
/// Zoom per point of scrolling: three notches of a wheel halve the distance.
const ZOOM: f32 = 0.0046;
/// Lowest the camera goes above the ground, in metres.
const CLEARANCE_M: f32 = 0.08;

/// Applies what the pointer did on the picture of the scene.
pub(super) fn steer(camera: &mut Camera, picture: &Response, land: &Land) {
    let ui = &picture.ctx;
    let (shift, scroll, pinch) =
        ui.input(|input| (input.modifiers.shift, input.smooth_scroll_delta(), input.zoom_delta()));
    let pans = picture.dragged_by(PointerButton::Secondary)
        || picture.dragged_by(PointerButton::Middle)
        || (shift && picture.dragged_by(PointerButton::Primary));
    let drag = picture.drag_delta();
    if pans {
        let height = picture.rect.height().max(1.0);
        camera.pan(-drag.x / height, drag.y / height);
    } else if picture.dragged_by(PointerButton::Primary) {
        camera.orbit(-drag.x * ORBIT_RAD, drag.y * ORBIT_RAD);
    }
    if picture.hovered() {
        // Shift turns a wheel sideways.
        let turn = if scroll.y == 0.0 { scroll.x } else { scroll.y };
        camera.zoom((turn * ZOOM).exp() * pinch);
    }
    camera.stay_above(land, CLEARANCE_M);
}
