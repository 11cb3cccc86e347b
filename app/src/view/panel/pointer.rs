// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Moves the camera by mouse and keys.

use egui::{PointerButton, Response};
use windfall_render::camera::Camera;
use windfall_render::land::Land;

use crate::view::panel::keys;

/// Radians per point of a drag.
const ORBIT_RAD: f32 = 0.006;
/// Zoom per point of scrolling: three notches of a wheel halve the distance.
const ZOOM: f32 = 0.0046;
/// Lowest the camera goes above the ground, in metres.
const CLEARANCE_M: f32 = 0.08;

/// Slowest flight in m/s; far from what it looks at, the camera flies so many distances to it in a second.
const FLIGHT_M_S: f32 = 2.5;
const FLIGHT_PER_S: f32 = 0.4;

/// Applies what the pointer did on the picture of the scene, and what keys are held.
pub(crate) fn steer(camera: &mut Camera, picture: &Response, land: &Land) {
    let ui = &picture.ctx;
    let (shift, ctrl, scroll, pinch, frame_s) = ui.input(|input| {
        let modifiers = input.modifiers;
        // A long pause is no flight.
        let frame_s = input.unstable_dt.min(0.1);
        (modifiers.shift, modifiers.ctrl, input.smooth_scroll_delta(), input.zoom_delta(), frame_s)
    });
    let flight = keys::flight(ui);
    let flies = flight != [0.0; 3];
    if flies {
        let step_m = frame_s * (FLIGHT_PER_S * camera.distance_m).max(FLIGHT_M_S);
        let [right_m, up_m, ahead_m] = flight.map(|axis| axis * step_m);
        camera.fly(right_m, up_m, ahead_m);
        ui.request_repaint();
    }
    let pans = picture.dragged_by(PointerButton::Secondary)
        || picture.dragged_by(PointerButton::Middle)
        || (shift && !flies && picture.dragged_by(PointerButton::Primary));
    let drag = picture.drag_delta();
    if pans {
        let height = picture.rect.height().max(1.0);
        camera.pan(-drag.x / height, drag.y / height);
    } else if picture.dragged_by(PointerButton::Primary) && (ctrl || flies) {
        let to_rad = camera.vertical_fov_rad / picture.rect.height().max(1.0);
        camera.look(drag.x * to_rad, drag.y * to_rad);
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
