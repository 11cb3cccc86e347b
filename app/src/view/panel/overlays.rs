// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Switches of the overlays: colours, trails, landings, wind.

use egui::{CollapsingHeader, RichText, Ui};
use windfall_core::scene::limits::Limit;
use windfall_render::{Measure, ParticleMeasure};

use super::field::field;
use super::{Action, PanelInput, style};
use crate::view::tools::overlays::Overlays;

/// Ends of the colours that can be chosen.
const MOST: [(&str, Limit<f32>); 6] = [
    ("Colours to", Limit { low: 0.1, high: 60.0, unit: "m/s" }),
    ("Colours to", Limit { low: 0.5, high: 600.0, unit: "s" }),
    ("Colours to", Limit { low: 0.5, high: 200.0, unit: "m" }),
    ("Colours to", Limit { low: 0.5, high: 30.0, unit: "m/s" }),
    ("Colours to", Limit { low: 0.01, high: 5.0, unit: "m" }),
    ("Colours to", Limit { low: 0.1, high: 1.0, unit: "" }),
];
/// Ends of the colours of particles that can be chosen.
const PARTICLE_MOST: [Limit<f32>; 2] =
    [Limit { low: 0.1, high: 100.0, unit: "m/s" }, Limit { low: 0.1, high: 100.0, unit: "s" }];
/// Heights of the wind's slice.
const WIND_HEIGHT_M: Limit<f32> = Limit { low: 0.1, high: 100.0, unit: "m" };

pub(super) fn show(ui: &mut Ui, input: &PanelInput, actions: &mut Vec<Action>) {
    let title = RichText::new("Look").strong().color(style::TITLE);
    CollapsingHeader::new(title).id_salt("look").default_open(true).show_unindented(ui, |ui| {
        let mut overlays = input.overlays;
        colors(ui, &mut overlays);
        if !input.scene.particles.is_empty() {
            particle_colors(ui, &mut overlays);
        }
        ui.horizontal(|ui| {
            let tip = "Lines of where leaves have been (the first 4,096)";
            ui.checkbox(&mut overlays.trails, "Trails").on_hover_text(tip);
            let tip = "How many leaves lie where on the ground";
            ui.checkbox(&mut overlays.landings, "Landings").on_hover_text(tip);
            let tip = "Arrows of the wind in a slice at a height above the ground";
            ui.checkbox(&mut overlays.wind, "Wind").on_hover_text(tip);
        });
        if overlays.wind {
            let tip = "Height above the ground of the slice of arrows";
            field("Slice at", tip, WIND_HEIGHT_M).fine(0.1).show(ui, &mut overlays.wind_height_m, None);
        }
        let hint = match &input.card {
            Some(_) => "Click beside any to let go of this one.",
            None if input.scene.particles.is_empty() => "Click on a leaf to follow it.",
            None => "Click on a leaf or a particle to follow it.",
        };
        ui.label(RichText::new(hint).small().color(style::QUIET));
        if overlays != input.overlays {
            actions.push(Action::SetOverlays(overlays));
        }
    });
}

/// Measure that leaves are coloured by, and the end of its scale.
fn colors(ui: &mut Ui, overlays: &mut Overlays) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        for (measure, label, tip) in [
            (None, "Autumn", "Leaves in their own colours"),
            (Some(Measure::Motion), "Motion", "Coloured by motion or regime"),
            (Some(Measure::Speed), "Speed", "Coloured by speed over the last frame"),
            (Some(Measure::Age), "Age", "Coloured by the time since release"),
            (Some(Measure::Height), "Height", "Coloured by height above the ground at the origin"),
            (
                Some(Measure::Wake),
                "Wakes at",
                "Lying leaves coloured by the wind at their edge that takes them; covered ones brown",
            ),
            (Some(Measure::Depth), "Depth", "Lying leaves coloured by the depth of the litter under them"),
            (
                Some(Measure::Shelter),
                "Shelter",
                "Ground and lying leaves coloured by the share of the mean wind that is left there",
            ),
        ] {
            if ui.selectable_label(overlays.measure == measure, label).on_hover_text(tip).clicked() {
                overlays.measure = measure;
            }
        }
    });
    if let Some(index) = overlays.measure.and_then(Overlays::scale_of) {
        let (name, limit) = MOST[index];
        let tip = "What the light end of the colours stands for";
        field(name, tip, limit).fine(0.1).show(ui, &mut overlays.most[index], None);
    }
}

/// Measure that particles are coloured by, and the end of its scale.
fn particle_colors(ui: &mut Ui, overlays: &mut Overlays) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        ui.label(RichText::new("Particles").small().color(style::QUIET));
        for (measure, label, tip) in [
            (None, "Own", "Particles in their own colours"),
            (Some(ParticleMeasure::Population), "Kind", "Coloured by population"),
            (Some(ParticleMeasure::Speed), "Particle speed", "Particles coloured by speed"),
            (Some(ParticleMeasure::Age), "Particle age", "Particles coloured by the time since birth"),
        ] {
            let is_chosen = overlays.particle_measure == measure;
            if ui.selectable_label(is_chosen, label).on_hover_text(tip).clicked() {
                overlays.particle_measure = measure;
            }
        }
    });
    if let Some(index) = overlays.particle_measure.and_then(Overlays::particle_scale_of) {
        let tip = "What the light end of the particles' colours stands for";
        let most = &mut overlays.particle_most[index];
        field("Particles to", tip, PARTICLE_MOST[index]).fine(0.1).show(ui, most, None);
    }
}
