// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Keys: their actions, and help on them.

use egui::{Event, Key, Modifiers};

use crate::view::panel::action::Action;

/// Help on keys and mouse, group by group.
pub(crate) const HELP: [(&str, &[(&str, &str)]); 4] = [
    (
        "Look",
        &[
            ("Drag", "orbit about what you look at; move an object over the ground"),
            ("Right-drag, Shift-drag", "move sideways"),
            ("Ctrl-drag", "look around"),
            ("Wheel, pinch", "go nearer or farther"),
            ("W A S D", "fly ahead, left, back, right"),
            ("E, Q", "fly up, down"),
            ("Shift while flying", "five times as fast"),
            ("C", "back to the scene's camera"),
        ],
    ),
    ("Time", &[("Space", "pause, go on"), (". ,", "one step on, back"), ("R", "begin again at time zero")]),
    (
        "Scene",
        &[
            ("Ctrl+Z", "undo"),
            ("Ctrl+Shift+Z, Ctrl+Y", "redo"),
            ("Ctrl+S", "save"),
            ("Drop a file", "open a .ron scene; .hdr or .exr as sky; .gltf or .glb as a tree"),
        ],
    ),
    (
        "Window",
        &[
            ("Tab, Shift+Tab", "next control, the one before"),
            ("Arrows", "turn the chosen control"),
            ("Enter", "press it, or type a number"),
            ("F9", "begin or end recording"),
            ("H", "show or hide the panel"),
            ("F1, ?", "show or hide this help"),
            ("Esc", "leave a control, close this help, quit"),
        ],
    ),
];

/// Flight of the camera by the keys held down: right, up, ahead, each -1 to 1 times the speed.
pub(crate) fn flight(context: &egui::Context) -> [f32; 3] {
    if context.egui_wants_keyboard_input() {
        return [0.0; 3];
    }
    context.input(|input| {
        if input.modifiers.command {
            return [0.0; 3];
        }
        let speed = if input.modifiers.shift { FAST } else { 1.0 };
        let axis = |more, less| f32::from(input.key_down(more)) - f32::from(input.key_down(less));
        [axis(Key::D, Key::A), axis(Key::E, Key::Q), axis(Key::W, Key::S)].map(|axis| speed * axis)
    })
}

/// Factor by which Shift flies faster.
const FAST: f32 = 5.0;

/// Actions of the keys pressed since the last frame.
pub(crate) fn actions(context: &egui::Context, is_paused: bool) -> Vec<Action> {
    // A text has an undo of its own.
    let (is_busy, is_typing) = (context.egui_wants_keyboard_input(), context.text_edit_focused());
    let events = context.input(|input| input.events.clone());
    let actions = events.iter().filter_map(|event| match action(event, is_paused)? {
        action @ Action::Save => Some(action),
        action @ (Action::Undo | Action::Redo) => (!is_typing).then_some(action),
        action => (!is_busy).then_some(action),
    });
    actions.collect()
}

fn action(event: &Event, is_paused: bool) -> Option<Action> {
    if matches!(event, Event::Text(text) if text == "?") {
        return Some(Action::ToggleHelp);
    }
    let Event::Key { key, pressed: true, repeat, modifiers, .. } = *event else { return None };
    let Modifiers { shift, command, .. } = modifiers;
    match key {
        Key::Z if command && shift => Some(Action::Redo),
        Key::Z if command => Some(Action::Undo),
        Key::Y if command => Some(Action::Redo),
        Key::S if command && !repeat => Some(Action::Save),
        _ if command => None,
        // Held down it steps on and on.
        Key::Period => Some(Action::SingleStep),
        Key::Comma => Some(Action::StepBack),
        _ if repeat => None,
        Key::Space => Some(Action::Pause(!is_paused)),
        Key::R => Some(Action::Reset),
        Key::C => Some(Action::ResetCamera),
        Key::F9 => Some(Action::ToggleRecord),
        Key::F1 => Some(Action::ToggleHelp),
        Key::H => Some(Action::TogglePanel),
        Key::Escape => Some(Action::Quit),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn press(key: Key, modifiers: Modifiers, repeat: bool) -> Option<Action> {
        action(&Event::Key { key, physical_key: None, pressed: true, repeat, modifiers }, false)
    }

    #[test]
    fn keys_mean_what_the_help_says() {
        let plain = |key| press(key, Modifiers::NONE, false);
        assert_eq!(plain(Key::Space), Some(Action::Pause(true)), "space pauses");
        assert_eq!(press(Key::Space, Modifiers::NONE, true), None, "once");
        assert_eq!(
            press(Key::Period, Modifiers::NONE, true),
            Some(Action::SingleStep),
            "a held step goes on"
        );
        assert_eq!(plain(Key::Escape), Some(Action::Quit), "Esc quits");
        assert_eq!(plain(Key::Z), None, "Z alone is no command");
        let redo = Modifiers::COMMAND | Modifiers::SHIFT;
        assert_eq!(press(Key::Z, Modifiers::COMMAND, true), Some(Action::Undo), "held down it goes on");
        assert_eq!(press(Key::Z, redo, false), Some(Action::Redo), "the other way");
        assert_eq!(press(Key::R, Modifiers::COMMAND, false), None, "R is another key then");
    }

    #[test]
    fn the_help_lists_every_key() {
        let listed = |key: &str| {
            let mut rows = HELP.iter().flat_map(|(_, rows)| rows.iter());
            // A comma ends a key, or is one.
            let names = |keys: &'static str| {
                keys.split([' ', '+'])
                    .map(|word| if word.len() > 1 { word.trim_end_matches(',') } else { word })
            };
            rows.any(|(keys, _)| names(keys).any(|other| other.eq_ignore_ascii_case(key)))
        };
        for key in Key::ALL {
            let name = if *key == Key::Escape { "Esc" } else { key.symbol_or_name() };
            let name = match key {
                Key::Period => ".",
                Key::Comma => ",",
                _ => name,
            };
            for modifiers in [Modifiers::NONE, Modifiers::COMMAND] {
                let does = press(*key, modifiers, false);
                assert!(does.is_none() || listed(name), "{name} does {does:?} and is not in the help");
            }
        }
        for key in ["W", "A", "S", "D", "E", "Q", "Shift", "?"] {
            assert!(listed(key), "{key}");
        }
    }
}
