// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Drawing over the picture: legends of colours, the leaf or particle that is followed, arrows of the wind.

use egui::{
    Align2, Area, Color32, CornerRadius, FontId, Grid, Id, Label, Painter, Rect, RichText, Shape, Stroke, Ui,
    pos2, vec2,
};
use glam::Vec3;
use windfall_core::motion::Primitive;
use windfall_core::scene::Object;
use windfall_render::{ATTACHED, MOTIONS, RESTING, population_bytes, shade_bytes};

use super::{PanelInput, style};
use crate::view::tools::grab::outline;
use crate::view::tools::overlays::Overlays;
use crate::view::tools::pick::Projection;

/// Width of the scale of the legend in points.
const SCALE_WIDTH: f32 = 220.0;
/// Colours in it.
const STEPS: usize = 64;
/// Seconds of wind that an arrow shows.
const ARROW_S: f32 = 0.35;

/// Longest arrow in points: what is nearer to the camera would hide the picture.
const LONGEST: f32 = 90.0;

/// Draws everything that is asked for over `picture`.
pub(super) fn show(ui: &Ui, input: &PanelInput, projection: &Projection, picture: Rect) {
    let painter = ui.painter_at(picture);
    for (from, wind) in &input.arrows {
        arrow(&painter, projection, *from, *wind, input.arrow_most_m_s);
    }
    followed(&painter, input, projection);
    let mut corner = picture.right_top() + vec2(-12.0, 12.0);
    if input.overlays.measure.is_some() {
        corner.y = measure_legend(ui, &input.overlays, corner).bottom() + 8.0;
    }
    if input.overlays.particle_measure.is_some() && !input.scene.particles.is_empty() {
        corner.y = particle_legend(ui, input, corner).bottom() + 8.0;
    }
    if input.overlays.wind {
        let most = input.arrow_most_m_s;
        corner.y = scale_legend(ui, "wind", "Wind", ["0", &format!("{most:.1} m/s")], corner).bottom() + 8.0;
    }
    if input.overlays.landings {
        let (low, high) = windfall_render::LANDINGS_PER_M2;
        let ends = [format!("{low:.0}"), format!("{high:.0} leaves/m\u{b2}")];
        corner.y = scale_legend(ui, "landings", "Lying there", [&ends[0], &ends[1]], corner).bottom() + 8.0;
    }
    card(ui, input, corner);
}

/// An arrow of the wind as long as the air goes in a while, in the colour of its speed.
fn arrow(painter: &Painter, projection: &Projection, from: Vec3, wind: Vec3, most_m_s: f32) {
    let (Some(tail), Some(tip)) = (projection.place(from), projection.place(from + ARROW_S * wind)) else {
        return;
    };
    let color = rgb(shade_bytes(wind.length() / most_m_s.max(0.01)));
    let along = tip - tail;
    if along.length() < 2.0 {
        // Hardly any wind.
        painter.circle_filled(tail, 1.2, color);
    }
    if !(2.0..LONGEST).contains(&along.length()) {
        return;
    }
    let dark = Stroke::new(3.2, Color32::from_black_alpha(110));
    painter.line_segment([tail, tip], dark);
    painter.line_segment([tail, tip], Stroke::new(1.5, color));
    let head = along.normalized() * along.length().min(7.0);
    let wing = head.rot90() * 0.45;
    painter.add(Shape::convex_polygon(vec![tip, tip - head + wing, tip - head - wing], color, Stroke::NONE));
}

/// The track of what is followed, and a ring around it.
fn followed(painter: &Painter, input: &PanelInput, projection: &Projection) {
    let Some(track) = &input.track else { return };
    let mut line = Vec::new();
    let stroke = |line: &mut Vec<_>| {
        let points = std::mem::take(line);
        if points.len() > 1 {
            painter.add(Shape::line(points.clone(), Stroke::new(3.5, Color32::from_black_alpha(130))));
            painter.add(Shape::line(points, Stroke::new(1.6, style::TITLE)));
        }
    };
    for place in track {
        match projection.place(*place) {
            Some(point) => line.push(point),
            // Behind the camera a line has no place.
            None => stroke(&mut line),
        }
    }
    stroke(&mut line);
    if let Some(here) = track.last().and_then(|place| projection.place(*place)) {
        painter.circle_stroke(here, 11.0, Stroke::new(3.5, Color32::from_black_alpha(130)));
        painter.circle_stroke(here, 11.0, Stroke::new(1.6, style::TITLE));
    }
}

/// Edges of the box around an object that is being moved.
pub(super) fn object(ui: &Ui, object: &Object, projection: &Projection, picture: Rect) {
    let painter = ui.painter().with_clip_rect(picture);
    for [from, to] in outline(object) {
        if let (Some(from), Some(to)) = (projection.place(from), projection.place(to)) {
            painter.line_segment([from, to], Stroke::new(3.0, Color32::from_black_alpha(130)));
            painter.line_segment([from, to], Stroke::new(1.5, style::TITLE));
        }
    }
}

fn measure_legend(ui: &Ui, overlays: &Overlays, corner: egui::Pos2) -> Rect {
    match overlays.scale() {
        Some((title, end)) => scale_legend(ui, "legend", title, ["0", &end], corner),
        None => {
            // Bodies have the colours of the motions like theirs.
            let (_, cone_spiral) = MOTIONS[Primitive::ConeSpiral.index()];
            let others = [("autorotation", cone_spiral), ("at rest", RESTING), ("on its twig", ATTACHED)];
            kind_legend(ui, "legend", MOTIONS.iter().chain(&others).copied(), corner)
        }
    }
}

fn particle_legend(ui: &Ui, input: &PanelInput, corner: egui::Pos2) -> Rect {
    match input.overlays.particle_scale() {
        Some((title, end)) => scale_legend(ui, "particle legend", title, ["0", &end], corner),
        None => {
            let names = input.scene.particles.iter().map(|population| population.name.as_str());
            let kinds = names.enumerate().map(|(number, name)| (name, population_bytes(number)));
            kind_legend(ui, "particle legend", kinds, corner)
        }
    }
}

/// A strip of colours with its ends; its upper right corner is given.
fn scale_legend(ui: &Ui, id: &str, title: &str, ends: [&str; 2], corner: egui::Pos2) -> Rect {
    let area = Area::new(Id::unique(id)).pivot(Align2::RIGHT_TOP).fixed_pos(corner).interactable(false);
    area.show(ui.ctx(), |ui| {
        style::notice_frame().show(ui, |ui| {
            ui.set_width(SCALE_WIDTH);
            ui.add(Label::new(RichText::new(title).small().color(style::TITLE)));
            let (strip, _) = ui.allocate_exact_size(vec2(SCALE_WIDTH, 9.0), egui::Sense::hover());
            let step = strip.width() / STEPS as f32;
            for index in 0..STEPS {
                let left = strip.left() + step * index as f32;
                let share = index as f32 / (STEPS - 1) as f32;
                let cell = Rect::from_min_size(pos2(left, strip.top()), vec2(step + 0.5, strip.height()));
                ui.painter().rect_filled(cell, CornerRadius::ZERO, rgb(shade_bytes(share)));
            }
            let (line, _) = ui.allocate_exact_size(vec2(SCALE_WIDTH, 12.0), egui::Sense::hover());
            let font = FontId::proportional(11.0);
            let painter = ui.painter();
            painter.text(line.left_center(), Align2::LEFT_CENTER, ends[0], font.clone(), style::TEXT);
            painter.text(line.right_center(), Align2::RIGHT_CENTER, ends[1], font, style::TEXT);
        });
    })
    .response
    .rect
}

/// Names of kinds beside their colours.
fn kind_legend<'a>(
    ui: &Ui,
    id: &str,
    kinds: impl Iterator<Item = (&'a str, [u8; 3])>,
    corner: egui::Pos2,
) -> Rect {
    let area = Area::new(Id::unique(id)).pivot(Align2::RIGHT_TOP).fixed_pos(corner).interactable(false);
    area.show(ui.ctx(), |ui| {
        style::notice_frame().show(ui, |ui| {
            for (name, color) in kinds {
                ui.horizontal(|ui| {
                    let (swatch, _) = ui.allocate_exact_size(vec2(12.0, 12.0), egui::Sense::hover());
                    ui.painter().rect_filled(swatch, CornerRadius::same(2), rgb(color));
                    ui.label(RichText::new(name).small());
                });
            }
        });
    })
    .response
    .rect
}

/// Card of what is followed.
fn card(ui: &Ui, input: &PanelInput, corner: egui::Pos2) {
    let Some(card) = &input.card else { return };
    let area = Area::new(Id::unique("card")).pivot(Align2::RIGHT_TOP).fixed_pos(corner).interactable(false);
    area.show(ui.ctx(), |ui| {
        style::notice_frame().show(ui, |ui| {
            ui.set_max_width(SCALE_WIDTH + 40.0);
            ui.label(RichText::new(&card.title).strong().color(style::TITLE));
            Grid::new("card").num_columns(2).spacing([10.0, 1.0]).show(ui, |ui| {
                for (name, text) in &card.rows {
                    ui.label(RichText::new(*name).small().color(style::QUIET));
                    ui.add(Label::new(RichText::new(text).small()).wrap());
                    ui.end_row();
                }
            });
        });
    });
}

fn rgb([r, g, b]: [u8; 3]) -> Color32 {
    Color32::from_rgb(r, g, b)
}
