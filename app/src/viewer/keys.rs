// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! What the keys do, in the window and in words.

use egui::{Event, Key};

use super::controls::Wish;

/// Keys and what they do, for the panel.
pub(super) const HELP: &str = "Drag to orbit, right-drag or Shift-drag to pan, wheel to zoom. W A S D fly, E and Q up \
                               and down, Shift faster; Ctrl-drag, or drag while flying, to look around. Space pauses, \
                               . and , step on and back, R resets, C camera, F9 records, F1 hides this, Esc quits.";

/// Where the keys held down fly to: right, up, ahead, each -1 to 1 times the speed.
pub(super) fn flight(context: &egui::Context) -> [f32; 3] {
    if context.egui_wants_keyboard_input() {
        return [0.0; 3];
    }
    context.input(|input| {
        let speed = if input.modifiers.shift { FAST } else { 1.0 };
        let axis = |more, less| f32::from(input.key_down(more)) - f32::from(input.key_down(less));
        [axis(Key::D, Key::A), axis(Key::E, Key::Q), axis(Key::W, Key::S)].map(|axis| speed * axis)
    })
}

/// How much faster Shift flies.
const FAST: f32 = 5.0;

/// What the keys pressed since the last frame ask for.
pub(super) fn wishes(context: &egui::Context, is_paused: bool) -> Vec<Wish> {
    if context.egui_wants_keyboard_input() {
        return Vec::new();
    }
    context.input(|input| input.events.iter().filter_map(|event| wish(event, is_paused)).collect())
}

fn wish(event: &Event, is_paused: bool) -> Option<Wish> {
    let Event::Key { key, pressed: true, repeat, .. } = *event else { return None };
    match key {
        // Held down it steps on and on.
        Key::Period => Some(Wish::SingleStep),
        Key::Comma => Some(Wish::StepBack),
        _ if repeat => None,
        Key::Space => Some(Wish::Pause(!is_paused)),
        Key::R => Some(Wish::Reset),
        Key::C => Some(Wish::ResetCamera),
        Key::F9 => Some(Wish::ToggleRecord),
        Key::F1 | Key::H => Some(Wish::TogglePanel),
        Key::Escape => Some(Wish::Quit),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use egui::Modifiers;

    use super::*;

    #[test]
    fn keys_mean_what_the_help_says() {
        let press = |key, repeat| {
            let modifiers = Modifiers::NONE;
            wish(&Event::Key { key, physical_key: None, pressed: true, repeat, modifiers }, false)
        };
        assert_eq!(press(Key::Space, false), Some(Wish::Pause(true)), "space pauses");
        assert_eq!(press(Key::Space, true), None, "once");
        assert_eq!(press(Key::Period, true), Some(Wish::SingleStep), "a held step goes on");
        assert_eq!(press(Key::Escape, false), Some(Wish::Quit), "Esc quits");
        for key in ["Space", ". and ,", "R ", "C ", "F1", "F9", "Esc", "W A S D", "E ", "Q ", "Shift", "Ctrl"]
        {
            assert!(HELP.contains(key), "{key} is explained");
        }
    }
}
