// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Recording: where to, and how many frames so far.

use egui::{Button, RichText, TextEdit, Ui, vec2};

use super::{Action, PanelInput, rows, style};
use crate::run::digits::grouped;
use crate::view::tools::clip::FPS;

pub(super) fn show(ui: &mut Ui, input: &PanelInput, actions: &mut Vec<Action>) {
    rows::title(ui, "Record");
    let recording = &input.recording;
    let tip = "FILE.mp4 (by ffmpeg), FILE.gif, or the name of a folder for numbered PNG files";
    ui.horizontal(|ui| {
        let mut path = recording.path.clone();
        let label = ui.label("To").on_hover_text(tip);
        let field = TextEdit::singleline(&mut path).desired_width(186.0);
        let field =
            ui.add_enabled(recording.frames.is_none(), field).labelled_by(label.id).on_hover_text(tip);
        if field.changed() {
            actions.push(Action::RecordTo(path));
        }
        let text = if recording.frames.is_some() { "Stop" } else { "Record" };
        let tip =
            "A clip of the picture without the panel, at a fixed rate however slow this machine is (F9)";
        if ui.add(Button::new(text).min_size(vec2(60.0, 22.0))).on_hover_text(tip).clicked() {
            actions.push(Action::ToggleRecord);
        }
    });
    if let Some(frames) = recording.frames {
        let seconds = f64::from(frames) / FPS;
        let text = format!("Recording: {} frames, {seconds:.1} s of {FPS:.0} frames/s", grouped(frames));
        ui.label(RichText::new(text).color(style::WARNING));
    }
}
