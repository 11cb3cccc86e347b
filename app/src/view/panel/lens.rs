// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The lens: exposure, tone map, glare, focus.

use egui::Ui;
use windfall_core::scene::{Exposure, Focus, Lens, ToneMap, limits};

use super::field::{choice, field};

/// `distance_m` is how far away the camera's target is.
pub(super) fn show(ui: &mut Ui, lens: &mut Lens, own: &Lens, distance_m: f32) {
    exposure(ui, &mut lens.exposure, own.exposure);
    tone_map(ui, &mut lens.tone_map, own.tone_map);
    let tip = "Share of light beyond the threshold that glows around its source";
    let glare = field("Glare", tip, limits::GLARE_STRENGTH).fine(0.001);
    glare.show(ui, &mut lens.glare.strength, own.glare.strength);
    let tip = "Exposed light where glare begins; 1 is white";
    let threshold = field("Threshold", tip, limits::GLARE_THRESHOLD);
    threshold.show(ui, &mut lens.glare.threshold, own.glare.threshold);
    focus(ui, &mut lens.focus, own.focus, distance_m);
    let tip = "Colourfulness of the picture: grey at 0";
    let shutter = "How long the shutter is open: leaves are drawn along their way";
    field("Shutter", shutter, limits::SHUTTER_S).show(ui, &mut lens.shutter_s, own.shutter_s);
    field("Saturation", tip, limits::SATURATION).show(ui, &mut lens.saturation, own.saturation);
    let tip = "How much darker the corners are";
    field("Vignette", tip, limits::VIGNETTE).show(ui, &mut lens.vignette, own.vignette);
}

fn exposure(ui: &mut Ui, exposure: &mut Exposure, own: Exposure) {
    // Manual is a sunny day at first.
    let options = [("auto", Exposure::default()), ("manual", Exposure::Manual { ev100: 14.0 })];
    choice(ui, "Exposure", "Metered over the picture, or as set", exposure, Some(&own), &options);
    match (exposure, own) {
        (Exposure::Auto { compensation_ev, adaptation_s }, own) => {
            let own = match own {
                Exposure::Auto { compensation_ev, adaptation_s } => Some((compensation_ev, adaptation_s)),
                Exposure::Manual { .. } => None,
            };
            let tip = "Stops brighter than middle grey";
            let compensation = field("Brighter by", tip, limits::COMPENSATION_EV);
            compensation.show(ui, compensation_ev, own.map(|own| own.0));
            let tip = "How slowly it adapts from frame to frame";
            let adaptation = field("Adapts in", tip, limits::ADAPTATION_S).fine(0.05);
            adaptation.show(ui, adaptation_s, own.map(|own| own.1));
        }
        (Exposure::Manual { ev100 }, own) => {
            let own = if let Exposure::Manual { ev100 } = own { Some(ev100) } else { None };
            let tip = "Exposure value at ISO 100: 15 in the sun, 12 under clouds, 5 at dusk";
            field("EV 100", tip, limits::EV100).show(ui, ev100, own);
        }
    }
}

fn tone_map(ui: &mut Ui, tone_map: &mut ToneMap, own: ToneMap) {
    let options = [
        ("linear", ToneMap::Linear { gamma: 2.2 }),
        ("Reinhard", ToneMap::Reinhard { white: 4.0 }),
        ("AgX", ToneMap::AgX),
    ];
    let tip = "Linear with gamma, Reinhard et al. 2002, or the filmic AgX";
    choice(ui, "Tone map", tip, tone_map, Some(&own), &options);
    match (tone_map, own) {
        (ToneMap::Linear { gamma }, own) => {
            let own = if let ToneMap::Linear { gamma } = own { Some(gamma) } else { None };
            field("Gamma", "Exponent of the display", limits::GAMMA).show(ui, gamma, own);
        }
        (ToneMap::Reinhard { white }, own) => {
            let own = if let ToneMap::Reinhard { white } = own { Some(white) } else { None };
            let tip = "Smallest exposed luminance that becomes white";
            field("White", tip, limits::WHITE).fine(1.0).show(ui, white, own);
        }
        (ToneMap::AgX, _) => {}
    }
}

fn focus(ui: &mut Ui, focus: &mut Option<Focus>, own: Option<Focus>, distance_m: f32) {
    let range = limits::FOCUS_DISTANCE_M;
    // What the camera orbits about.
    let there = Focus { distance_m: distance_m.clamp(range.low, range.high), f_number: 2.8 };
    let options = [("all sharp", None), ("at a distance", Some(there))];
    choice(ui, "Focus", "Whether only what is in focus is sharp", focus, Some(&own), &options);
    if let Some(focus) = focus {
        let tip = "Distance along the view that is sharp";
        let distance = field("Distance", tip, range).fine(0.1);
        distance.show(ui, &mut focus.distance_m, own.map(|own| own.distance_m));
        let tip = "Focal length by aperture: small blurs more";
        let aperture = field("f-number", tip, limits::F_NUMBER).fine(0.5);
        aperture.show(ui, &mut focus.f_number, own.map(|own| own.f_number));
    }
}
