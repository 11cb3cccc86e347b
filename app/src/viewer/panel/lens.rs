// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Camera and lens: field of view, exposure, tone map, glare, focus.

use egui::Ui;
use windfall_core::scene::{Exposure, Focus, Lens, ToneMap, limits};

use super::rows::{Scale, slider};
use super::{Facts, Wish, rows};
use crate::camera::Camera;

pub(super) fn show(ui: &mut Ui, facts: &Facts, camera: &mut Camera, wishes: &mut Vec<Wish>) {
    rows::title(ui, "Lens");
    let mut fov_deg = camera.vertical_fov_rad.to_degrees();
    let tip = "Field of view from the top of the picture to its bottom";
    if slider(ui, "Field of view", tip, &mut fov_deg, limits::VERTICAL_FOV_DEG, Scale::Linear) {
        camera.vertical_fov_rad = fov_deg.to_radians();
    }
    let mut lens = facts.lens;
    exposure(ui, &mut lens);
    tone_map(ui, &mut lens);
    let tip = "Share of light beyond the threshold that glows around its source";
    slider(ui, "Glare", tip, &mut lens.glare.strength, limits::GLARE_STRENGTH, Scale::Logarithmic(0.001));
    let tip = "Exposed light where glare begins; 1 is white";
    slider(ui, "Threshold", tip, &mut lens.glare.threshold, limits::GLARE_THRESHOLD, Scale::Linear);
    focus(ui, &mut lens, camera.distance_m);
    let tip = "Colourfulness of the picture";
    slider(ui, "Saturation", tip, &mut lens.saturation, limits::SATURATION, Scale::Linear);
    let tip = "How much darker the corners are";
    slider(ui, "Vignette", tip, &mut lens.vignette, limits::VIGNETTE, Scale::Linear);
    if lens != facts.lens {
        wishes.push(Wish::Lens(lens));
    }
}

/// Labels of which one is chosen, in a row; the number of another one that was clicked.
fn choice(ui: &mut Ui, name: &str, tip: &str, labels: &[&str], chosen: usize) -> Option<usize> {
    let mut clicked = None;
    rows::row(ui, name, tip, |ui| {
        let inner = ui.horizontal(|ui| {
            for (index, label) in labels.iter().enumerate() {
                if ui.selectable_label(index == chosen, *label).clicked() && index != chosen {
                    clicked = Some(index);
                }
            }
        });
        inner.response
    });
    clicked
}

fn exposure(ui: &mut Ui, lens: &mut Lens) {
    let is_manual = usize::from(matches!(lens.exposure, Exposure::Manual { .. }));
    let tip = "Metered over the picture, or as set";
    match choice(ui, "Exposure", tip, &["auto", "manual"], is_manual) {
        Some(0) => lens.exposure = Exposure::default(),
        // A sunny day.
        Some(_) => lens.exposure = Exposure::Manual { ev100: 14.0 },
        None => {}
    }
    match &mut lens.exposure {
        Exposure::Auto { compensation_ev, .. } => {
            let tip = "Stops brighter than middle grey";
            slider(ui, "Brighter by", tip, compensation_ev, limits::COMPENSATION_EV, Scale::Linear);
        }
        Exposure::Manual { ev100 } => {
            let tip = "Exposure value at ISO 100: 15 in the sun, 12 under clouds, 5 at dusk";
            slider(ui, "EV 100", tip, ev100, limits::EV100, Scale::Linear);
        }
    }
}

fn tone_map(ui: &mut Ui, lens: &mut Lens) {
    let chosen = match lens.tone_map {
        ToneMap::Linear { .. } => 0,
        ToneMap::Reinhard { .. } => 1,
        ToneMap::AgX => 2,
    };
    let tip = "Linear with gamma, Reinhard et al. 2002, or the filmic AgX";
    match choice(ui, "Tone map", tip, &["linear", "Reinhard", "AgX"], chosen) {
        Some(0) => lens.tone_map = ToneMap::Linear { gamma: 2.2 },
        Some(1) => lens.tone_map = ToneMap::Reinhard { white: 4.0 },
        Some(_) => lens.tone_map = ToneMap::AgX,
        None => {}
    }
    match &mut lens.tone_map {
        ToneMap::Linear { gamma } => {
            let tip = "Exponent of the display";
            slider(ui, "Gamma", tip, gamma, limits::GAMMA, Scale::Linear);
        }
        ToneMap::Reinhard { white } => {
            let tip = "Smallest exposed luminance that becomes white";
            slider(ui, "White", tip, white, limits::WHITE, Scale::Logarithmic(1.0));
        }
        ToneMap::AgX => {}
    }
}

fn focus(ui: &mut Ui, lens: &mut Lens, distance_m: f32) {
    let tip = "Whether only what is in focus is sharp";
    match choice(ui, "Focus", tip, &["all sharp", "at a distance"], usize::from(lens.focus.is_some())) {
        Some(0) => lens.focus = None,
        // What the camera orbits about.
        Some(_) => {
            let range = limits::FOCUS_DISTANCE_M;
            lens.focus = Some(Focus { distance_m: distance_m.clamp(range.low, range.high), f_number: 2.8 });
        }
        None => {}
    }
    if let Some(focus) = &mut lens.focus {
        let tip = "Distance along the view that is sharp";
        let scale = Scale::Logarithmic(0.1);
        slider(ui, "Distance", tip, &mut focus.distance_m, limits::FOCUS_DISTANCE_M, scale);
        let tip = "Focal length by aperture: small blurs more";
        slider(ui, "f-number", tip, &mut focus.f_number, limits::F_NUMBER, Scale::Logarithmic(0.5));
    }
}
