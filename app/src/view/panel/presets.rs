// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The scenes that travel in the program, to choose from.

use egui::text::LayoutJob;
use egui::{Button, FontId, TextFormat, Ui};
use windfall_core::scene::PRESETS;

use super::{Action, style};

pub(super) fn show(ui: &mut Ui, actions: &mut Vec<Action>) {
    let width = ui.available_width();
    for (name, text) in PRESETS {
        let format =
            |size, color| TextFormat { font_id: FontId::proportional(size), color, ..Default::default() };
        let mut job = LayoutJob::default();
        job.append(name, 0.0, format(13.0, style::TEXT));
        job.append("\n", 0.0, format(3.0, style::TEXT));
        job.append(&description(text), 0.0, format(11.0, style::QUIET));
        job.wrap.max_width = width - 16.0;
        let button =
            Button::new(job).wrap().frame_when_inactive(false).min_size(egui::vec2(width - 6.0, 0.0));
        let response = ui.add(button).accessible_name(format!("Preset {name}"));
        if response.on_hover_text("Opens this scene; Ctrl+Z goes back").clicked() {
            actions.push(Action::Open((*name).to_owned()));
        }
    }
}

/// The first sentence of the comment that a scene file begins with, as far as a colon.
fn description(text: &str) -> String {
    let lines = text.lines().map_while(|line| line.strip_prefix("//"));
    let lines = lines.map(str::trim).filter(|line| !line.starts_with("SPDX"));
    let words = lines.collect::<Vec<_>>().join(" ");
    let end = words.find([':', '.']).unwrap_or(words.len());
    words[..end].trim().to_owned() + "."
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_preset_says_what_it_is_in_a_sentence() {
        for (name, text) in PRESETS {
            let sentence = description(text);
            assert!((20..=120).contains(&sentence.len()) && sentence.ends_with('.'), "{name}: {sentence:?}");
        }
    }
}
