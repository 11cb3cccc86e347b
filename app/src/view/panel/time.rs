// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Time: pause, step, reset, pace.

use egui::{Button, RichText, Ui, vec2};

use super::rows::{Scale, slider_in};
use super::{Action, PanelInput, rows, style};
use crate::run::digits::grouped;

/// Largest time scale.
const MOST: f32 = 4.0;

pub(super) fn show(ui: &mut Ui, input: &PanelInput, actions: &mut Vec<Action>) {
    rows::title(ui, "Time");
    ui.horizontal(|ui| {
        let mut button = |ui: &mut Ui, text: &str, tip: &str, action: Action| {
            let button = Button::new(text).min_size(vec2(52.0, 22.0));
            if ui.add(button).on_hover_text(tip).clicked() {
                actions.push(action);
            }
        };
        let text = if input.is_paused { "Go on" } else { "Pause" };
        button(ui, text, "Stop time or let it go on (Space)", Action::Pause(!input.is_paused));
        button(ui, "Back", "One step back, then stand still (, key)", Action::StepBack);
        button(ui, "Step", "One step, then stand still (. key)", Action::SingleStep);
        button(ui, "Reset", "Begin again at time zero (R)", Action::Reset);
        button(ui, "Camera", "Look from where the scene says (C)", Action::ResetCamera);
    });
    let mut scale = input.time_scale;
    let tip = "Simulated seconds in each second: below 1 is slow motion";
    if slider_in(ui, "Time scale", tip, &mut scale, 0.0..=MOST, "\u{d7}", Scale::Linear) {
        actions.push(Action::TimeScale(scale));
    }
    ui.horizontal(|ui| {
        ui.label(format!("{:.2} s", input.clock.seconds()));
        ui.label(RichText::new(format!("step {}", grouped(input.clock.step()))).color(style::QUIET));
        if let Some(behind) = input.behind {
            let tip = "A frame takes only so many steps. This machine would need more to keep up, so simulated \
                       time goes slower; the steps stay the same.";
            let text = RichText::new(format!("time goes slower: {behind:.2}\u{d7}")).color(style::WARNING);
            ui.label(text).on_hover_text(tip);
        } else if input.is_paused {
            ui.label(RichText::new("paused").color(style::WARNING));
        }
    });
}
