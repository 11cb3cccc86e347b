// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Rows that edit names and texts of a scene.

use egui::{ComboBox, Key, TextEdit, Ui};

use super::field::{CONTROL_WIDTH, reset};
use super::rows::row;

/// A name out of several.
pub(super) fn name_of(
    ui: &mut Ui,
    name: &str,
    tip: &str,
    value: &mut String,
    own: Option<&String>,
    names: &[String],
) {
    let own = own.filter(|own| *own != value);
    let mut back = false;
    row(ui, name, tip, |ui| {
        let combo = ComboBox::from_id_salt(name).selected_text(value.as_str()).width(CONTROL_WIDTH);
        let inner = combo.show_ui(ui, |ui| {
            for other in names {
                if ui.selectable_label(other == value, other).clicked() {
                    value.clone_from(other);
                }
            }
        });
        back = own.is_some() && reset(ui, name);
        inner.response
    });
    if let Some(own) = own.filter(|_| back) {
        value.clone_from(own);
    }
}

/// A line of text, or several; it counts when it is left, and Esc leaves it as it was.
pub(super) fn text(ui: &mut Ui, name: &str, tip: &str, value: &mut String, own: Option<&str>, rows: usize) {
    let own = own.filter(|own| own != value);
    let mut back = false;
    row(ui, name, tip, |ui| {
        let id = ui.scope_id().with(("text", name));
        let mut typed = ui.data(|data| data.get_temp::<String>(id)).unwrap_or_else(|| value.clone());
        let edit = if rows > 1 { TextEdit::multiline(&mut typed) } else { TextEdit::singleline(&mut typed) };
        let edit = edit.id(id).desired_width(CONTROL_WIDTH - 8.0).desired_rows(rows);
        let response = ui.add(if rows > 1 { edit.code_editor() } else { edit });
        if response.has_focus() {
            ui.data_mut(|data| data.insert_temp(id, typed));
        } else {
            ui.data_mut(|data| data.remove::<String>(id));
            let is_meant = response.lost_focus() && !ui.input(|input| input.key_pressed(Key::Escape));
            if is_meant && typed != *value {
                *value = typed;
            }
        }
        back = own.is_some() && reset(ui, name);
        response
    });
    if let Some(own) = own.filter(|_| back) {
        *value = own.to_owned();
    }
}

/// A text that may be left out.
pub(super) fn optional_text(
    ui: &mut Ui,
    name: &str,
    tip: &str,
    value: &mut Option<String>,
    own: Option<&Option<String>>,
) {
    let mut typed = value.clone().unwrap_or_default();
    let own = own.map(|own| own.as_deref().unwrap_or_default());
    text(ui, name, tip, &mut typed, own, 1);
    if typed != value.as_deref().unwrap_or_default() {
        *value = Some(typed).filter(|text| !text.is_empty());
    }
}
