// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! What the keys do, over the picture.

use egui::{Area, Frame, Grid, Id, Margin, Order, RichText, Ui};

use super::style;
use crate::viewer::keys::HELP;

/// Shows the help in the middle of the window.
pub(super) fn show(ui: &Ui) {
    sheet(ui, |ui| {
        ui.spacing_mut().item_spacing = egui::vec2(24.0, 5.0);
        ui.horizontal_top(|ui| {
            for half in HELP.chunks(2) {
                ui.vertical(|ui| half.iter().for_each(|(title, rows)| section(ui, title, rows)));
            }
        });
    });
}

/// Says what becomes of a file that is being dragged over the window.
pub(super) fn show_drop_hint(ui: &Ui) {
    sheet(ui, |ui| {
        ui.label(RichText::new("Drop it to open it").strong().color(style::TITLE));
        ui.label("a scene (.ron), a sky (.hdr, .exr) or a tree (.gltf, .glb)");
    });
}

/// A sheet in the middle of the window.
fn sheet(ui: &Ui, content: impl FnOnce(&mut Ui)) {
    let screen = ui.ctx().content_rect();
    let area = Area::new(Id::unique("help")).order(Order::Foreground).interactable(false);
    area.pivot(egui::Align2::CENTER_CENTER).fixed_pos(screen.center()).show(ui.ctx(), |ui| {
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
