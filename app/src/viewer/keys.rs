// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! What the keys do, in the window and in words.

use egui::{Event, Key};

use super::controls::Wish;

/// Keys and what they do, for the panel.
pub(super) const HELP: &str = "Drag to orbit, right-drag or Shift-drag to pan, wheel to zoom. Space pauses, . steps, \
                               R resets, C camera, F1 hides this, Esc quits.";

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
        _ if repeat => None,
        Key::Space => Some(Wish::Pause(!is_paused)),
        Key::R => Some(Wish::Reset),
        Key::C => Some(Wish::ResetCamera),
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
        for key in ["Space", ".", "R ", "C ", "F1", "Esc"] {
            assert!(HELP.contains(key), "{key} is explained");
        }
    }
}
