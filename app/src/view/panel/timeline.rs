// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The bar of time over the lower edge of the picture: drag it to go back and forth.

use egui::accesskit;
use egui::{
    Align2, Color32, CornerRadius, FontId, Id, Key, Rect, Response, Sense, Stroke, Ui, WidgetInfo, pos2, vec2,
};

use super::{Action, PanelInput, style};
use crate::run::digits::grouped;

/// Height of the strip, and of what there is to grip within, in points.
const HEIGHT: f32 = 34.0;
const BAR: f32 = 6.0;
/// Room at both ends for the numbers.
const ENDS: f32 = 74.0;

/// Shows the bar at the lower edge of `picture`.
pub(super) fn show(ui: &mut Ui, input: &PanelInput, picture: Rect, actions: &mut Vec<Action>) {
    let (first, last) = input.timeline.range;
    let strip = Rect::from_min_max(pos2(picture.left(), picture.bottom() - HEIGHT), picture.right_bottom());
    let bar = Rect::from_center_size(strip.center(), vec2((strip.width() - 2.0 * ENDS).max(40.0), BAR));
    let now = input.timeline.target.unwrap_or(input.clock.step());
    let response = ui.interact(strip, Id::unique("timeline"), Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::slider(ui.is_enabled(), f64::from(now), "Time"));
    let span = f64::from(last.saturating_sub(first).max(1));
    let share = |step: u32| (f64::from(step.saturating_sub(first)) / span).clamp(0.0, 1.0);
    #[expect(clippy::cast_possible_truncation, reason = "a place on the screen")]
    let x_of = |step: u32| bar.left() + bar.width() * share(step) as f32;

    if let Some(pointer) = response.interact_pointer_pos().filter(|_| response.is_pointer_button_down_on()) {
        let along = f64::from(((pointer.x - bar.left()) / bar.width()).clamp(0.0, 1.0));
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within the range")]
        let step = first + (along * span).round() as u32;
        if step != now {
            actions.push(Action::Seek(step.min(last)));
        }
    }
    let (back, on) = steps_asked(ui, &response);
    if back + on > 0 {
        actions.push(Action::Seek(now.saturating_sub(back).saturating_add(on)));
    }

    let painter = ui.painter_at(strip);
    painter.rect_filled(strip, CornerRadius::ZERO, Color32::from_black_alpha(150));
    let round = CornerRadius::same(3);
    painter.rect_filled(bar, round, style::GROOVE);
    let passed = Rect::from_min_max(bar.min, pos2(x_of(now), bar.bottom()));
    painter.rect_filled(passed, round, style::ACCENT);
    for step in &input.timeline.kept {
        let x = x_of(*step);
        painter.vline(x, bar.bottom() + 2.0..=bar.bottom() + 5.0, Stroke::new(1.0, style::QUIET));
    }
    let radius = if response.hovered() || response.has_focus() { 7.0 } else { 5.5 };
    painter.circle(pos2(x_of(now), bar.center().y), radius, style::TITLE, Stroke::new(1.5, Color32::BLACK));
    if let Some(target) = input.timeline.target {
        // Where the way there has come to.
        let x = x_of(input.clock.step());
        painter.vline(x, bar.top() - 4.0..=bar.bottom() + 4.0, Stroke::new(1.5, Color32::WHITE));
        let text = format!("going to step {}", grouped(target));
        let at = pos2(bar.center().x, strip.top() + 2.0);
        painter.text(at, Align2::CENTER_TOP, text, FontId::proportional(10.0), style::TITLE);
    }
    let seconds = |step: u32| format!("{:.2} s", f64::from(step) * f64::from(input.clock.dt_s()));
    let font = FontId::proportional(12.0);
    let left = pos2(bar.left() - 12.0, strip.center().y);
    painter.text(left, Align2::RIGHT_CENTER, seconds(now), font.clone(), style::TEXT);
    let right = pos2(bar.right() + 12.0, strip.center().y);
    painter.text(right, Align2::LEFT_CENTER, seconds(last), font, style::QUIET);
    let dt_s = f64::from(input.clock.dt_s());
    let tip = if input.timeline.kept.is_empty() {
        "So many leaves that nothing of their past is kept in memory".to_owned()
    } else {
        let from = f64::from(first) * dt_s;
        format!(
            "Drag to go back and forth from {from:.2} s on; arrow keys go step by step. Ticks are moments kept in \
             memory; the steps in between are taken again, with the same bits."
        )
    };
    response.on_hover_text(tip);
}

/// Steps back and on that keys ask for, or who reads the screen to the user.
fn steps_asked(ui: &Ui, response: &Response) -> (u32, u32) {
    let has_focus = response.has_focus();
    let asked = |key, action| {
        ui.input(|input| {
            let presses = if has_focus { input.num_presses(key) } else { 0 };
            u32::try_from(presses + input.num_accesskit_action_requests(response.id, action)).unwrap_or(0)
        })
    };
    (
        asked(Key::ArrowLeft, accesskit::Action::Decrement),
        asked(Key::ArrowRight, accesskit::Action::Increment),
    )
}
