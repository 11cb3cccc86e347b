// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The panel beside the scene, group by group.

mod compare;
mod graph;
mod leaves;
mod lens;
mod looking;
mod numbers;
mod overlay;
mod record;
mod rows;
pub(super) mod style;
mod time;
mod timeline;
mod wind;

use egui::{Area, Id, Pos2, Rect, RichText, ScrollArea, Sense, Ui, vec2};

use super::controls::{Facts, Message, Wish};
use super::pick::Projection;
use super::{keys, pointer};
use crate::camera::Camera;
use crate::land::Land;
pub(super) use rows::grouped;

/// Width of the panel in points.
const WIDTH: f32 = 316.0;

/// The panel and the picture beside it.
#[derive(Debug)]
pub(super) struct Panel {
    /// Whether it is shown.
    pub(super) is_open: bool,
    /// The number of leaves while its slider is being dragged.
    leaves: Option<u32>,
    /// The picture on the screen in points.
    picture: Rect,
    /// Left edge of the picture in pixels.
    picture_left: u32,
}

impl Panel {
    pub(super) fn new() -> Self {
        Self { is_open: true, leaves: None, picture: Rect::ZERO, picture_left: 0 }
    }

    /// The picture on the screen, in points, as it was last laid out.
    pub(super) fn picture(&self) -> Rect {
        self.picture
    }

    /// Corner and size in pixels of what the panel leaves of a window of `size`.
    pub(super) fn picture_area(&self, (width, height): (u32, u32)) -> ((u32, u32), (u32, u32)) {
        let left = self.picture_left.min(width.saturating_sub(1));
        ((left, 0), (width - left, height))
    }

    /// Shows the panel, lets the pointer steer the camera, and returns what the user asks for.
    pub(super) fn show(&mut self, ui: &mut Ui, facts: &Facts, camera: &mut Camera, land: &Land) -> Vec<Wish> {
        let mut wishes = keys::wishes(ui.ctx(), facts.is_paused);
        if self.is_open {
            egui::Panel::left("panel").resizable(false).exact_size(WIDTH).frame(style::panel_frame()).show(
                ui,
                |ui| {
                    ScrollArea::vertical()
                        .auto_shrink(false)
                        .show(ui, |ui| self.groups(ui, facts, camera, &mut wishes));
                },
            );
        }
        let picture = ui.available_rect_before_wrap();
        self.picture_left = pixels(picture.left() * ui.ctx().pixels_per_point());
        let response = ui.interact(picture, Id::unique("picture"), Sense::click_and_drag());
        pointer::steer(camera, &response, land);
        if let Some(pointer) = response.interact_pointer_pos().filter(|_| response.clicked()) {
            wishes.push(Wish::Pick(pointer));
        }
        self.picture = picture;
        overlay::show(ui, facts, &Projection::new(camera, picture), picture);
        if self.is_open {
            timeline::show(ui, facts, picture, &mut wishes);
        }
        self.notice(ui, facts, picture.left_top());
        wishes
    }

    fn groups(&mut self, ui: &mut Ui, facts: &Facts, camera: &mut Camera, wishes: &mut Vec<Wish>) {
        ui.label(RichText::new(&facts.scene).size(17.0).strong().color(style::TITLE));
        time::show(ui, facts, wishes);
        looking::show(ui, facts, wishes);
        record::show(ui, facts, wishes);
        leaves::show(ui, facts, &mut self.leaves, wishes);
        wind::show(ui, facts, wishes);
        lens::show(ui, facts, camera, wishes);
        numbers::backend(ui, facts, wishes);
        numbers::counts(ui, facts);
        numbers::timings(ui, facts);
        ui.add_space(5.0);
        ui.label(RichText::new(keys::HELP).small().color(style::QUIET));
    }

    /// A line over the picture, if there is something to say.
    fn notice(&self, ui: &Ui, facts: &Facts, corner: Pos2) {
        let text = match (&facts.message, facts.is_paused && !self.is_open) {
            (Some(Message { text, is_error: true }), _) => RichText::new(text).color(style::WARNING),
            (Some(Message { text, .. }), _) => RichText::new(text).color(style::GOOD),
            (None, true) => RichText::new("Paused. Space goes on, F1 shows the panel."),
            (None, false) => return,
        };
        let area = Area::new(Id::unique("notice")).fixed_pos(corner + vec2(12.0, 12.0)).interactable(false);
        area.show(ui.ctx(), |ui| {
            style::notice_frame().show(ui, |ui| ui.label(text));
        });
    }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within a window")]
fn pixels(points: f32) -> u32 {
    points.max(0.0).round() as u32
}

#[cfg(test)]
mod tests;
