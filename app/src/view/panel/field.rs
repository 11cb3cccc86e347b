// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Rows that edit one field of a scene: a number, a vector, a choice. Each knows its range and what the loaded scene says,
//! and offers to go back to that.

use std::f32::consts::TAU;
use std::ops::RangeInclusive;

use egui::emath::Numeric;
use egui::{
    ComboBox, DragValue, Painter, Pos2, Response, RichText, Role, Sense, Slider, Stroke, Ui, Vec2,
    WidgetInfo, vec2,
};
use glam::Vec3;
use windfall_core::scene::limits::{CENTER_M, Limit};

use super::rows::{Scale, decimals, row};
use super::style;
use crate::run::digits::grouped;

/// Width of a control and its number in points.
pub(super) const CONTROL_WIDTH: f32 = 184.0;
/// Most options that stand beside each other instead of in a menu.
const MOST_BESIDE: usize = 3;
/// Most letters of such options, so that all of them are in the panel.
const MOST_LETTERS: usize = 28;

/// A number of a scene.
#[derive(Clone, Copy, Debug)]
pub(super) struct Field<'a, T> {
    name: &'a str,
    tip: &'a str,
    limit: Limit<T>,
    scale: Option<Scale>,
}

/// A number with a slider.
pub(super) fn field<'a, T>(name: &'a str, tip: &'a str, limit: Limit<T>) -> Field<'a, T> {
    Field { name, tip, limit, scale: Some(Scale::Linear) }
}

impl<T: Numeric> Field<'_, T> {
    /// A slider that is finer near zero; `smallest` is the smallest number above zero.
    pub(super) fn fine(self, smallest: f64) -> Self {
        Self { scale: Some(Scale::Logarithmic(smallest)), ..self }
    }

    /// No slider: the range is too wide for one.
    pub(super) fn wide(self) -> Self {
        Self { scale: None, ..self }
    }

    /// The row of a number for which the loaded scene has `own`, if it has any.
    pub(super) fn show(self, ui: &mut Ui, value: &mut T, own: impl Into<Option<T>>) {
        let own = own.into().filter(|own| own != value);
        let tip = self.tip(own);
        let mut back = false;
        row(ui, self.name, &tip, |ui| {
            let response = self.control(ui, value);
            back = own.is_some() && reset(ui, self.name);
            response
        });
        if let Some(own) = own.filter(|_| back) {
            *value = own;
        }
    }

    /// The row of a number that may be left out, with a box to check; checked it is `first` at first, and `without` says
    /// what holds otherwise.
    pub(super) fn optional(
        self,
        ui: &mut Ui,
        value: &mut Option<T>,
        own: impl Into<Option<Option<T>>>,
        (first, without): (T, &str),
    ) {
        let own = own.into().filter(|own| own != value);
        let tip = self.tip(own.flatten());
        let mut back = false;
        row(ui, self.name, &tip, |ui| {
            let mut is_set = value.is_some();
            let checked = ui.checkbox(&mut is_set, "");
            if checked.changed() {
                *value = is_set.then(|| own.flatten().unwrap_or(first));
            }
            ui.spacing_mut().slider_width -= checked.rect.width() + ui.spacing().item_spacing.x;
            let response = match value {
                Some(number) => {
                    // The row's name is that of the number then.
                    checked.clone().accessible_name(format!("{} is set", self.name));
                    self.control(ui, number)
                }
                None => {
                    ui.label(RichText::new(without).color(style::QUIET));
                    checked
                }
            };
            back = own.is_some() && reset(ui, self.name);
            response
        });
        if let Some(own) = own.filter(|_| back) {
            *value = own;
        }
    }

    fn control(self, ui: &mut Ui, value: &mut T) -> Response {
        let suffix = suffix(self.limit.unit);
        let range = self.limit.low..=self.limit.high;
        let format = |number: f64, _: RangeInclusive<usize>| {
            if T::INTEGRAL { whole(number) } else { decimals(number) }
        };
        let parse = |text: &str| text.replace([',', ' ', '_'], "").parse().ok();
        let Some(scale) = self.scale else {
            let speed = if T::INTEGRAL { 1.0 } else { 0.05 };
            let drag = DragValue::new(value).range(range).speed(speed).suffix(suffix);
            return ui.add_sized(
                vec2(CONTROL_WIDTH, ui.spacing().interact_size.y),
                drag.update_while_editing(false).custom_formatter(format).custom_parser(parse),
            );
        };
        let mut slider = Slider::new(value, range).suffix(suffix).update_while_editing(false);
        if T::INTEGRAL {
            // What a press of an arrow key does; less than one would round to nothing.
            slider = slider.drag_value_speed(1.0);
        }
        if let Scale::Logarithmic(smallest) = scale {
            slider = slider.logarithmic(true).smallest_positive(smallest);
        }
        ui.add(slider.custom_formatter(format).custom_parser(parse))
    }

    /// Meaning of the number, its range, and the loaded scene's value if that is another.
    fn tip(&self, own: Option<T>) -> String {
        let text = |number: T| {
            let number = number.to_f64();
            #[expect(
                clippy::cast_possible_truncation,
                reason = "fields that are not whole are in single precision"
            )]
            let single = number as f32;
            if T::INTEGRAL { whole(number) } else { format!("{single}") }
        };
        let unit = suffix(self.limit.unit);
        let mut tip = format!("{}\n{} to {}{unit}", self.tip, text(self.limit.low), text(self.limit.high));
        if let Some(own) = own {
            tip += &format!("; loaded: {}{unit}", text(own));
        }
        tip
    }
}

/// A unit as it stands behind a number.
pub(super) fn suffix(unit: &str) -> String {
    match unit {
        "" => String::new(),
        "degrees" => "\u{b0}".to_owned(),
        unit => format!("\u{a0}{unit}"),
    }
}

/// A whole number with a comma between groups of three digits.
fn whole(number: f64) -> String {
    let text = format!("{number:.0}");
    let (sign, digits) = text.strip_prefix('-').map_or(("", &*text), |digits| ("-", digits));
    digits.parse().map_or_else(|_| text.clone(), |number| format!("{sign}{}", grouped(number)))
}

/// The three components of a vector.
pub(super) fn vector(
    ui: &mut Ui,
    name: &str,
    tip: &str,
    value: &mut Vec3,
    own: Option<Vec3>,
    limit: Limit<f32>,
) {
    let own = own.filter(|own| own != value);
    let mut back = false;
    let tip = format!("{tip}\nx, y, z: {limit}");
    row(ui, name, &tip, |ui| {
        let size = vec2((CONTROL_WIDTH - 12.0) / 3.0, ui.spacing().interact_size.y);
        ui.spacing_mut().interact_size.x = size.x;
        for (axis, number) in ["x", "y", "z"].into_iter().zip(value.as_mut()) {
            let format = |number: f64, _: RangeInclusive<usize>| decimals(number);
            let drag = DragValue::new(number).range(limit.low..=limit.high).speed(0.05);
            let drag = drag.update_while_editing(false).custom_formatter(format);
            let this = ui.add_sized(size, drag).on_hover_text(&tip);
            this.accessible_name(format!("{name} {axis}"));
        }
        back = own.is_some() && reset(ui, name);
        // A label of the whole row is none of one component.
        ui.allocate_response(vec2(0.0, 0.0), Sense::hover())
    });
    if let Some(own) = own.filter(|_| back) {
        *value = own;
    }
}

/// Rows of a rectangle on the ground, centre and edges: names of the centre along x and z, and of the edges along them.
pub(super) fn rectangle(
    ui: &mut Ui,
    [x, z, width, depth]: [&str; 4],
    edges: Limit<f32>,
    (center_m, size_m): (&mut glam::Vec2, &mut glam::Vec2),
    own: Option<(glam::Vec2, glam::Vec2)>,
) {
    let rows = [
        (x, "Centre of the rectangle along x", CENTER_M, &mut center_m.x, own.map(|own| own.0.x)),
        (z, "Centre of the rectangle along z", CENTER_M, &mut center_m.y, own.map(|own| own.0.y)),
        (width, "Edge of the rectangle along x", edges, &mut size_m.x, own.map(|own| own.1.x)),
        (depth, "Edge of the rectangle along z", edges, &mut size_m.y, own.map(|own| own.1.y)),
    ];
    for (name, tip, limit, value, own) in rows {
        field(name, tip, limit).show(ui, value, own);
    }
}

/// One of several variants, each with what it holds at first. A variant that the loaded scene has as well holds what it
/// holds there.
pub(super) fn choice<T: Clone + PartialEq>(
    ui: &mut Ui,
    name: &str,
    tip: &str,
    value: &mut T,
    own: Option<&T>,
    options: &[(&str, T)],
) {
    let is = |a: &T, b: &T| std::mem::discriminant(a) == std::mem::discriminant(b);
    let chosen = options.iter().position(|(_, option)| is(option, value));
    let own = own.filter(|own| !is(own, value));
    let mut clicked = None;
    let mut back = false;
    row(ui, name, tip, |ui| {
        let letters: usize = options.iter().map(|(label, _)| label.len()).sum();
        let response = if options.len() <= MOST_BESIDE && letters <= MOST_LETTERS {
            let inner = ui.horizontal(|ui| {
                for (index, (label, _)) in options.iter().enumerate() {
                    if ui.selectable_label(chosen == Some(index), *label).on_hover_text(tip).clicked() {
                        clicked = Some(index);
                    }
                }
            });
            inner.response
        } else {
            let text = chosen.map_or("", |index| options[index].0);
            let combo = ComboBox::from_id_salt(name).selected_text(text).width(CONTROL_WIDTH);
            let inner = combo.show_ui(ui, |ui| {
                for (index, (label, _)) in options.iter().enumerate() {
                    if ui.selectable_label(chosen == Some(index), *label).clicked() {
                        clicked = Some(index);
                    }
                }
            });
            inner.response
        };
        back = own.is_some() && reset(ui, name);
        response
    });
    if let Some(index) = clicked.filter(|index| chosen != Some(*index)) {
        let option = &options[index].1;
        *value = own.filter(|own| is(own, option)).unwrap_or(option).clone();
    }
    if let Some(own) = own.filter(|_| back) {
        *value = own.clone();
    }
}

/// The little arrow behind what was changed; true if it was pressed.
pub(super) fn reset(ui: &mut Ui, name: &str) -> bool {
    let (rect, response) = ui.allocate_exact_size(vec2(16.0, 16.0), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, format!("Reset {name}")));
    let is_chosen = response.hovered() || response.has_focus();
    let color = if is_chosen { style::TEXT } else { style::TITLE };
    turning_arrow(ui.painter(), rect.center(), Stroke::new(1.5, color));
    response.on_hover_text(format!("{name}: as loaded")).clicked()
}

/// Three quarters of a circle against the clock, with a head.
fn turning_arrow(painter: &Painter, center: Pos2, stroke: Stroke) {
    const RADIUS: f32 = 4.5;
    let at = |turn: f32| center + RADIUS * Vec2::angled(turn * TAU);
    // From the left by the bottom and the right to the top.
    let arc: Vec<Pos2> = (0..=18u8).map(|part| at(0.5 - 0.75 * f32::from(part) / 18.0)).collect();
    painter.line(arc, stroke);
    let tip = at(-0.25);
    painter.line(vec![tip + vec2(2.6, -2.8), tip + vec2(-0.6, 0.0), tip + vec2(2.6, 2.8)], stroke);
}
