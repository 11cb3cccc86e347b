// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Lists of a scene: which entry is shown, one more, one less.

use std::hash::Hash;

use egui::{ComboBox, Id, Ui, vec2};

use super::rows::row;

/// Width of the menu in points; two buttons stand beside it.
const MENU_WIDTH: f32 = 134.0;

/// A list as it is called, and how long it may be.
#[derive(Clone, Copy, Debug)]
pub(super) struct List<'a> {
    /// Label of the row.
    pub(super) name: &'a str,
    /// One entry in words: "species", "tree".
    pub(super) entry: &'a str,
    pub(super) fewest: usize,
    pub(super) most: usize,
}

impl List<'_> {
    /// The row that chooses an entry, and adds and removes some; the number of the chosen one, if there is any. A new
    /// entry is made by `fresh` from the chosen one.
    pub(super) fn show<T>(
        self,
        ui: &mut Ui,
        entries: &mut Vec<T>,
        name_of: impl Fn(usize, &T) -> String,
        fresh: impl FnOnce(Option<&T>, &[T]) -> T,
    ) -> Option<usize> {
        let id = place(ui, self.name);
        let mut chosen: usize = ui.data(|data| data.get_temp(id)).unwrap_or(0);
        chosen = chosen.min(entries.len().saturating_sub(1));
        let tip = format!("Which {} is shown below, of {}", self.entry, entries.len());
        row(ui, self.name, &tip, |ui| {
            let text = entries.get(chosen).map_or_else(|| "none".into(), |entry| name_of(chosen, entry));
            let combo = ComboBox::from_id_salt(self.name).selected_text(text).width(MENU_WIDTH).truncate();
            let menu = |ui: &mut Ui| {
                for (index, entry) in entries.iter().enumerate() {
                    if ui.selectable_label(index == chosen, name_of(index, entry)).clicked() {
                        chosen = index;
                    }
                }
            };
            let size = vec2(MENU_WIDTH, ui.spacing().interact_size.y);
            let response = ui.allocate_ui(size, |ui| combo.show_ui(ui, menu)).inner;
            let button = |ui: &mut Ui, text: &str, words: String, enabled: bool| {
                let response = ui.add_enabled(enabled, egui::Button::new(text).min_size(vec2(19.0, 18.0)));
                response.accessible_name(words.as_str()).on_hover_text(words).clicked()
            };
            if button(ui, "+", format!("Add {} like this", self.entry), entries.len() < self.most) {
                let entry = fresh(entries.get(chosen), entries);
                entries.push(entry);
                chosen = entries.len() - 1;
            }
            let is_spare = entries.len() > self.fewest;
            if button(ui, "\u{2212}", format!("Remove this {}", self.entry), is_spare) {
                entries.remove(chosen);
                chosen = chosen.min(entries.len().saturating_sub(1));
            }
            response.response
        });
        ui.data_mut(|data| data.insert_temp(id, chosen));
        (chosen < entries.len()).then_some(chosen)
    }
}

impl List<'_> {
    /// Shows another entry from the next frame on.
    pub(super) fn choose(self, ui: &Ui, index: usize) {
        let id = place(ui, self.name);
        ui.data_mut(|data| data.insert_temp(id, index));
    }
}

/// Key of the number of the chosen entry: the same list of two entries of another list has two.
fn place(ui: &Ui, name: impl Hash + std::fmt::Debug) -> Id {
    ui.scope_id().with(("list", format!("{name:?}")))
}

/// A name that none of `taken` is: `name` itself, or with a number.
pub(crate) fn free_name<'a>(name: &str, taken: impl Iterator<Item = &'a str> + Clone) -> String {
    let is_free = |name: &str| taken.clone().all(|other| other != name);
    if is_free(name) {
        return name.to_owned();
    }
    let stem = name.trim_end_matches(|c: char| c.is_ascii_digit()).trim_end();
    let free = (2..).map(|number| format!("{stem} {number}")).find(|name| is_free(name));
    free.expect("there are more numbers than names")
}

#[cfg(test)]
mod tests {
    use super::free_name;

    #[test]
    fn a_copy_has_a_name_of_its_own() {
        let taken = ["oak", "maple", "maple 2"];
        assert_eq!(free_name("birch", taken.into_iter()), "birch", "free");
        assert_eq!(free_name("oak", taken.into_iter()), "oak 2", "the second");
        assert_eq!(free_name("maple 2", taken.into_iter()), "maple 3", "and the next");
    }
}
