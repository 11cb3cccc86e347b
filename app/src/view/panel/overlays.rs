// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! What to look at besides the picture: colours, trails, landings, wind.

use egui::{CollapsingHeader, RichText, Ui};
use windfall_core::scene::limits::Limit;
use windfall_render::Measure;

use super::field::field;
use super::{Facts, Wish, style};
use crate::view::tools::overlays::Looking;

/// Ends of the colours that can be chosen.
const MOST: [(&str, Limit<f32>); 3] = [
    ("Colours to", Limit { low: 0.1, high: 60.0, unit: "m/s" }),
    ("Colours to", Limit { low: 0.5, high: 600.0, unit: "s" }),
    ("Colours to", Limit { low: 0.5, high: 200.0, unit: "m" }),
];
/// Heights of the wind's slice.
const WIND_HEIGHT_M: Limit<f32> = Limit { low: 0.1, high: 100.0, unit: "m" };

pub(super) fn show(ui: &mut Ui, facts: &Facts, wishes: &mut Vec<Wish>) {
    let title = RichText::new("Look").strong().color(style::TITLE);
    CollapsingHeader::new(title).id_salt("look").default_open(true).show_unindented(ui, |ui| {
        let mut looking = facts.looking;
        colors(ui, &mut looking);
        ui.horizontal(|ui| {
            let tip = "Lines of where leaves have been (the first 4,096)";
            ui.checkbox(&mut looking.trails, "Trails").on_hover_text(tip);
            let tip = "How many leaves lie where on the ground";
            ui.checkbox(&mut looking.landings, "Landings").on_hover_text(tip);
            let tip = "Arrows of the wind in a slice at a height above the ground";
            ui.checkbox(&mut looking.wind, "Wind").on_hover_text(tip);
        });
        if looking.wind {
            let tip = "Height above the ground of the slice of arrows";
            field("Slice at", tip, WIND_HEIGHT_M).fine(0.1).show(ui, &mut looking.wind_height_m, None);
        }
        let hint = match &facts.card {
            Some(_) => "Click beside any leaf to let go of this one.",
            None => "Click on a leaf to follow it.",
        };
        ui.label(RichText::new(hint).small().color(style::QUIET));
        if looking != facts.looking {
            wishes.push(Wish::Look(looking));
        }
    });
}

/// What leaves are coloured by, and up to where.
fn colors(ui: &mut Ui, looking: &mut Looking) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        for (measure, label, tip) in [
            (None, "Autumn", "Leaves in their own colours"),
            (Some(Measure::Motion), "Motion", "Coloured by motion or regime"),
            (Some(Measure::Speed), "Speed", "Coloured by speed over the last frame"),
            (Some(Measure::Age), "Age", "Coloured by the time since release"),
            (Some(Measure::Height), "Height", "Coloured by height above the ground at the origin"),
        ] {
            if ui.selectable_label(looking.measure == measure, label).on_hover_text(tip).clicked() {
                looking.measure = measure;
            }
        }
    });
    if let Some(index) = looking.measure.and_then(Looking::scale_of) {
        let (name, limit) = MOST[index];
        let tip = "What the light end of the colours stands for";
        field(name, tip, limit).fine(0.1).show(ui, &mut looking.most[index], None);
    }
}
