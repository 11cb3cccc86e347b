// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Rows that line up across all groups.

use std::ops::RangeInclusive;

use egui::{Align, Label, Layout, Response, RichText, Sense, Slider, Ui, vec2};

use super::style;

/// Width of the names in points.
const NAME_WIDTH: f32 = 100.0;
/// Width of the sliders.
const SLIDER_WIDTH: f32 = 106.0;
/// Width of the numbers.
const VALUE_WIDTH: f32 = 72.0;

/// The title of a group.
pub(super) fn title(ui: &mut Ui, text: &str) {
    ui.add_space(5.0);
    let response = ui.label(RichText::new(text).strong().color(style::TITLE));
    let line = response.rect.right() + 8.0..=ui.max_rect().right() - 4.0;
    let stroke = ui.visuals().widgets.noninteractive.bg_stroke;
    ui.painter().hline(line, response.rect.center().y + 1.0, stroke);
}

/// A name with a control to its right.
pub(super) fn row(ui: &mut Ui, name: &str, tip: &str, control: impl FnOnce(&mut Ui) -> Response) -> Response {
    ui.horizontal(|ui| {
        let size = vec2(NAME_WIDTH, ui.spacing().interact_size.y);
        let layout = Layout::left_to_right(Align::Center);
        let label = ui.allocate_ui_with_layout(size, layout, |ui| {
            ui.set_min_width(NAME_WIDTH);
            let label = Label::new(name).selectable(false).sense(Sense::hover()).truncate();
            ui.add(label).on_hover_text(tip)
        });
        ui.spacing_mut().slider_width = SLIDER_WIDTH;
        ui.spacing_mut().interact_size.x = VALUE_WIDTH;
        control(ui).labelled_by(label.inner.id).on_hover_text(tip)
    })
    .inner
}

/// Scale of a slider.
#[derive(Clone, Copy, Debug)]
pub(super) enum Scale {
    Linear,
    /// Finer near zero; the smallest number above zero.
    Logarithmic(f64),
}

/// A number in a range. True if it has changed.
pub(super) fn slider_in(
    ui: &mut Ui,
    name: &str,
    tip: &str,
    value: &mut f32,
    range: RangeInclusive<f32>,
    suffix: &str,
    scale: Scale,
) -> bool {
    row(ui, name, tip, |ui| {
        // A slider that rounds would change numbers that nobody has touched.
        let format = |number: f64, _: RangeInclusive<usize>| decimals(number);
        let mut slider = Slider::new(value, range).suffix(suffix).custom_formatter(format);
        if let Scale::Logarithmic(smallest) = scale {
            slider = slider.logarithmic(true).smallest_positive(smallest);
        }
        ui.add(slider)
    })
    .changed()
}

/// A number with as many decimals as matter.
pub(super) fn decimals(number: f64) -> String {
    match number.abs() {
        size if size >= 100.0 => format!("{number:.0}"),
        size if size >= 10.0 => format!("{number:.1}"),
        size if size >= 1.0 || size == 0.0 => format!("{number:.2}"),
        size if size >= 0.1 => {
            let text = format!("{number:.3}");
            text.strip_suffix('0').map(str::to_owned).unwrap_or(text)
        }
        size if size >= 0.01 => format!("{number:.3}"),
        size if size >= 0.001 => format!("{number:.4}"),
        _ => format!("{number:.1e}"),
    }
}
