// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Wind: where it blows, how fast, how unsteadily.

use egui::{Painter, Pos2, RichText, Sense, Stroke, Ui, Vec2, vec2};
use windfall_core::scene::limits;

use super::rows::{Scale, slider};
use super::{Facts, Wish, rows, style};
use crate::viewer::beaufort::beaufort_label;

/// Edge of the dial in points.
const DIAL: f32 = 22.0;

pub(super) fn show(ui: &mut Ui, facts: &Facts, wishes: &mut Vec<Wish>) {
    rows::title(ui, "Wind");
    let mut tuning = facts.tuning;
    let tip = "Where the wind blows to: 0\u{b0} is to +x, 90\u{b0} to +z";
    slider(ui, "Direction", tip, &mut tuning.direction_deg, limits::DIRECTION_DEG, Scale::Linear);
    let tip = "Mean speed at the reference height, 10 m unless the scene says otherwise";
    let scale = Scale::Logarithmic(0.05);
    slider(ui, "Speed", tip, &mut tuning.speed_m_s, limits::METRES_PER_SECOND, scale);
    ui.horizontal(|ui| {
        dial(ui, facts.tuning.direction_deg - facts.look_deg, facts.tuning.speed_m_s > 0.0);
        ui.label(RichText::new(beaufort_label(f64::from(facts.tuning.speed_m_s))).color(style::QUIET));
        if facts.is_tuned
            && ui.small_button("Undo all").on_hover_text("The scene's own wind and speeds").clicked()
        {
            wishes.push(Wish::Untune);
        }
    });
    let tip = "How far a typical gust goes beyond the mean speed, relative to it";
    slider(ui, "Gust strength", tip, &mut tuning.gust_strength, limits::STRENGTH, Scale::Linear);
    let tip = "Mean time between gusts at a fixed place";
    let scale = Scale::Logarithmic(0.5);
    slider(ui, "Gust interval", tip, &mut tuning.gust_interval_s, limits::INTERVAL_S, scale);
    let tip = "Standard deviation of the speed along the wind, relative to the mean speed";
    slider(ui, "Turbulence", tip, &mut tuning.turbulence, limits::INTENSITY, Scale::Linear);
    let tip = "Turbulence that remains without any wind, as a standard deviation";
    let scale = Scale::Logarithmic(0.01);
    slider(ui, "In calm air", tip, &mut tuning.calm_m_s, limits::CALM_M_S, scale);
    if tuning != facts.tuning {
        wishes.push(Wish::Tune(tuning));
    }
}

/// An arrow that shows from above where the wind blows, seen from the camera: up is away from it.
fn dial(ui: &mut Ui, turned_deg: f32, blows: bool) {
    let (rect, response) = ui.allocate_exact_size(vec2(DIAL, DIAL), Sense::hover());
    response.on_hover_text("The wind from above, as the camera stands: up is away from you");
    let painter = ui.painter();
    let stroke = ui.visuals().widgets.hovered.bg_fill;
    painter.circle_stroke(rect.center(), 0.5 * DIAL - 1.0, Stroke::new(1.0, stroke));
    if blows {
        // From +x turning to +z is clockwise from above.
        let (sin, cos) = turned_deg.to_radians().sin_cos();
        arrow(painter, rect.center(), vec2(sin, -cos));
    }
}

fn arrow(painter: &Painter, center: Pos2, toward: Vec2) {
    let (tip, tail) = (center + toward * 7.0, center - toward * 7.0);
    let stroke = Stroke::new(1.6, style::TITLE);
    painter.line_segment([tail, tip], stroke);
    for side in [toward.rot90(), -toward.rot90()] {
        painter.line_segment([tip, tip - toward * 4.5 + side * 3.2], stroke);
    }
}
