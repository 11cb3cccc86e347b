// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Colours and measures of the panel: dark bark, leaves in autumn for what can be turned.

use egui::{Color32, CornerRadius, FontId, Frame, Margin, Stroke, TextStyle, Theme, Visuals, vec2};

/// Titles of scene and groups.
pub(super) const TITLE: Color32 = Color32::from_rgb(255, 196, 110);
/// Remarks.
pub(super) const QUIET: Color32 = Color32::from_rgb(150, 141, 130);
/// Numbers and names.
pub(super) const TEXT: Color32 = Color32::from_rgb(226, 219, 208);
/// Something is not as it was asked for.
pub(super) const WARNING: Color32 = Color32::from_rgb(255, 140, 90);
/// Something was done.
pub(super) const GOOD: Color32 = Color32::from_rgb(165, 205, 120);
/// Colour of what is chosen or filled.
pub(super) const ACCENT: Color32 = Color32::from_rgb(196, 98, 32);
/// Colour of what is not filled yet.
pub(super) const GROOVE: Color32 = Color32::from_rgb(58, 52, 46);
const BARK: Color32 = Color32::from_rgb(27, 24, 21);

/// Sets the style of everything.
pub(crate) fn apply(context: &egui::Context) {
    context.set_theme(Theme::Dark);
    let mut visuals = Visuals::dark();
    visuals.panel_fill = BARK;
    visuals.window_fill = BARK;
    visuals.override_text_color = Some(TEXT);
    visuals.slider_trailing_fill = true;
    visuals.selection.bg_fill = ACCENT;
    visuals.selection.stroke = Stroke::new(1.0, Color32::WHITE);
    visuals.extreme_bg_color = Color32::from_rgb(16, 14, 12);
    let widgets = &mut visuals.widgets;
    for (widget, fill) in [
        (&mut widgets.inactive, Color32::from_rgb(58, 52, 46)),
        (&mut widgets.hovered, Color32::from_rgb(80, 70, 60)),
        (&mut widgets.active, Color32::from_rgb(104, 82, 62)),
    ] {
        widget.bg_fill = fill;
        widget.weak_bg_fill = fill;
        widget.corner_radius = CornerRadius::same(3);
    }
    widgets.noninteractive.bg_stroke = Stroke::new(1.0, Color32::from_rgb(58, 52, 46));
    context.all_styles_mut(|style| {
        style.visuals = visuals.clone();
        for (text, size) in [(TextStyle::Body, 13.0), (TextStyle::Button, 13.0), (TextStyle::Small, 11.0)] {
            style.text_styles.insert(text, FontId::proportional(size));
        }
        style.text_styles.insert(TextStyle::Monospace, FontId::monospace(12.0));
        style.spacing.item_spacing = vec2(6.0, 2.0);
        style.spacing.interact_size.y = 18.0;
        style.interaction.tooltip_delay = 0.35;
    });
}

/// Ground of the panel.
pub(super) fn panel_frame() -> Frame {
    Frame::new().fill(BARK).inner_margin(Margin { left: 12, right: 6, top: 8, bottom: 6 })
}

/// Ground of a line over the picture.
pub(super) fn notice_frame() -> Frame {
    Frame::new()
        .fill(BARK.gamma_multiply(0.85))
        .corner_radius(CornerRadius::same(4))
        .inner_margin(Margin::symmetric(10, 6))
}

/// Ground of what covers the picture.
pub(super) fn sheet() -> Color32 {
    BARK.gamma_multiply(0.96)
}
