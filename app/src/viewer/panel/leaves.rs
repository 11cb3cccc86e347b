// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves: how many, how fast.

use egui::{Slider, Ui};
use windfall_core::scene::limits;

use super::rows::{Scale, slider};
use super::{Facts, Wish, rows};

/// `dragged` is the number while its slider is being dragged: a new world is made when it is let go.
pub(super) fn show(ui: &mut Ui, facts: &Facts, dragged: &mut Option<u32>, wishes: &mut Vec<Wish>) {
    rows::title(ui, "Leaves");
    let mut count = dragged.unwrap_or(facts.leaf_count);
    let tip = "Number of leaves. Another number makes a new world, which begins again; the camera stays.";
    let response = rows::row(ui, "Number", tip, |ui| {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within the range")]
        let format = |number: f64, _: std::ops::RangeInclusive<usize>| rows::grouped(number as u32);
        let slider = Slider::new(&mut count, facts.leaf_range.clone()).logarithmic(true);
        let parse = |text: &str| text.replace([',', ' ', '_'], "").parse().ok();
        ui.add(slider.custom_formatter(format).custom_parser(parse))
    });
    if response.changed() {
        *dragged = Some(count);
    }
    let is_done = !response.dragged() && !response.has_focus();
    if let Some(count) = dragged.take_if(|_| is_done)
        && count != facts.leaf_count
    {
        wishes.push(Wish::Leaves(count));
    }

    let mut tuning = facts.tuning;
    let tip = "Multiplies every leaf's own velocity through the air";
    slider(ui, "Fall speed", tip, &mut tuning.fall_speed, limits::FALL_SPEED, Scale::Linear);
    let tip = "Multiplies every leaf's turning and swinging; its path keeps its speed";
    slider(ui, "Rotation", tip, &mut tuning.rotation_speed, limits::ROTATION_SPEED, Scale::Linear);
    if tuning != facts.tuning {
        wishes.push(Wish::Tune(tuning));
    }
}
