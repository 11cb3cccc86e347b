// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Help on the keys, over the picture.

use egui::{Area, Frame, Grid, Id, Margin, Order, Rect, RichText, Ui};

use super::style;
use crate::view::panel::keys::HELP;

/// Width in points that two columns of help take.
const TWO_COLUMNS: f32 = 850.0;

/// Shows the help in the middle of the picture.
pub(super) fn show(ui: &Ui, picture: Rect) {
    let columns = if picture.width() < TWO_COLUMNS { 1 } else { 2 };
    sheet(ui, picture, |ui| {
        ui.spacing_mut().item_spacing = egui::vec2(24.0, 5.0);
        ui.horizontal_top(|ui| {
            for column in HELP.chunks(HELP.len() / columns) {
                ui.vertical(|ui| column.iter().for_each(|(title, rows)| section(ui, title, rows)));
            }
        });
    });
}

/// Says what becomes of a file that is being dragged over the window.
pub(super) fn show_drop_hint(ui: &Ui, picture: Rect) {
    sheet(ui, picture, |ui| {
        ui.label(RichText::new("Drop it to open it").strong().color(style::TITLE));
        ui.label("a scene (.ron), a sky (.hdr, .exr) or a tree (.gltf, .glb)");
    });
}

/// A sheet in the middle of the picture.
fn sheet(ui: &Ui, picture: Rect, content: impl FnOnce(&mut Ui)) {
    let area = Area::new(Id::unique("help")).order(Order::Foreground).interactable(false);
    area.pivot(egui::Align2::CENTER_CENTER).fixed_pos(picture.center()).show(ui.ctx(), |ui| {
        let frame = Frame::new().fill(style::sheet()).corner_radius(6).inner_margin(Margin::same(18));
        frame.show(ui, content);
    });
}

fn section(ui: &mut Ui, title: &str, rows: &[(&str, &str)]) {
    ui.label(RichText::new(title).strong().color(style::TITLE));
    Grid::new(title).spacing([14.0, 4.0]).show(ui, |ui| {
        for (keys, does) in rows {
            ui.label(RichText::new(*keys).color(style::TEXT));
            ui.label(RichText::new(*does).color(style::QUIET));
            ui.end_row();
        }
    });
    ui.add_space(8.0);
}
