// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The scene as a whole: its name, its file, undo.

use std::path::{Path, PathBuf};

use egui::{Button, RichText, TextEdit, Ui};
use windfall_core::Scene;

use super::words::text;
use super::{Action, PanelInput, style};

/// Path that the scene is saved to.
#[derive(Debug, Default)]
pub(crate) struct SceneFile {
    /// Text in the field.
    path: String,
    /// Files that were loaded or saved here, which may be written over without asking.
    known: Vec<PathBuf>,
    /// A file that is there already, while the user is asked.
    asked: Option<PathBuf>,
}

impl SceneFile {
    /// Begins with a preset's name or a file's path.
    pub(crate) fn opened(&mut self, name_or_path: &str) {
        let path = Path::new(name_or_path);
        self.asked = None;
        if path.is_file() {
            self.path = name_or_path.to_owned();
            self.saved(path);
        } else {
            self.path = format!("{name_or_path}.ron");
        }
    }

    /// The file lies there now.
    pub(crate) fn saved(&mut self, path: &Path) {
        self.asked = None;
        // What cannot be found is not known.
        self.known.extend(path.canonicalize());
    }

    /// Returns the action of saving, unless the user has to be asked first.
    pub(super) fn save(&mut self) -> Option<Action> {
        let path = PathBuf::from(self.path.trim());
        let is_known = |there: PathBuf| self.known.contains(&there);
        if path.exists() && !path.canonicalize().is_ok_and(is_known) {
            self.asked = Some(path);
            return None;
        }
        Some(Action::SaveTo(path))
    }

    /// Text in the field.
    #[cfg(test)]
    pub(super) fn path(&self) -> &str {
        &self.path
    }

    /// Returns true if there is a question that has to be answered.
    pub(super) fn is_asking(&self) -> bool {
        self.asked.is_some()
    }

    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        scene: &mut Scene,
        own: &Scene,
        input: &PanelInput,
        actions: &mut Vec<Action>,
    ) {
        text(
            ui,
            "Title",
            "Name of the scene, shown in titles and reports",
            &mut scene.name,
            Some(&own.name),
            1,
        );
        super::rows::row(
            ui,
            "File",
            "Where the scene is saved, as RON; relative to the working folder",
            |ui| {
                let edit = TextEdit::singleline(&mut self.path).desired_width(128.0);
                let response = ui.add(edit);
                let button = ui.button("Save").on_hover_text("Saves the scene as it is now (Ctrl+S)");
                if button.clicked() || response.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter))
                {
                    actions.extend(self.save());
                }
                if response.changed() {
                    self.asked = None;
                }
                response
            },
        );
        if let Some(path) = self.asked.clone() {
            ui.horizontal_wrapped(|ui| {
                let question = format!("{} is there already.", path.display());
                ui.label(RichText::new(question).color(style::WARNING));
                if ui.button("Overwrite").clicked() {
                    self.asked = None;
                    actions.push(Action::SaveTo(path));
                }
                if ui.button("Keep it").clicked() {
                    self.asked = None;
                }
            });
        }
        ui.horizontal(|ui| {
            let (undo, redo) = input.history;
            let mut button = |ui: &mut Ui, text: &str, tip: &str, is_on: bool, action: Action| {
                let button = Button::new(text).min_size(egui::vec2(66.0, 20.0));
                if ui.add_enabled(is_on, button).on_hover_text(tip).clicked() {
                    actions.push(action);
                }
            };
            button(ui, "Undo", "The edit before (Ctrl+Z)", undo > 0, Action::Undo);
            button(ui, "Redo", "The edit that was undone (Ctrl+Shift+Z, Ctrl+Y)", redo > 0, Action::Redo);
            let as_loaded = Button::new("As loaded").min_size(egui::vec2(80.0, 20.0));
            let response = ui.add_enabled(scene != own, as_loaded);
            if response.on_hover_text("Takes all edits back at once").clicked() {
                scene.clone_from(own);
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_files_that_were_loaded_or_saved_are_written_over_without_asking() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = |name: &str| folder.path().join(name);
        for name in ["own.ron", "other.ron"] {
            std::fs::write(path(name), "()").expect("writable");
        }
        let mut file = SceneFile::default();
        file.opened(&path("own.ron").to_string_lossy());
        assert_eq!(file.save(), Some(Action::SaveTo(path("own.ron"))), "it was loaded from there");
        file.path = path("other.ron").to_string_lossy().into_owned();
        assert_eq!(file.save(), None, "somebody else's");
        assert!(file.is_asking(), "the user is asked");
        file.saved(&path("other.ron"));
        assert_eq!(file.save(), Some(Action::SaveTo(path("other.ron"))), "it was saved there");
        file.opened("storm");
        assert_eq!(file.save(), Some(Action::SaveTo("storm.ron".into())), "a preset gets a file of its name");
    }
}
