// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The latest frames as a graph: each a column of its parts, one on top of the other.

use egui::{
    Align2, Color32, CornerRadius, FontId, Rect, RichText, Sense, Stroke, Ui, WidgetInfo, pos2, vec2,
};

use super::style;
use crate::view::tools::frame_times::{Frames, MEMORY};
use crate::view::tools::meter::STAGES;

/// Height in points.
const HEIGHT: f32 = 64.0;
/// Colours of the stages, in their order: they differ in lightness as well.
const COLORS: [Color32; STAGES.len()] = [
    Color32::from_rgb(222, 142, 28),
    Color32::from_rgb(126, 84, 162),
    Color32::from_rgb(120, 180, 140),
    Color32::from_rgb(44, 124, 176),
    Color32::from_rgb(70, 64, 58),
];
/// Times in milliseconds that the graph may end at.
const ENDS_MS: [f32; 11] = [5.0, 10.0, 20.0, 34.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0, 5000.0];
/// Frame times at 60 and 30 frames a second.
const MARKS_MS: [f32; 2] = [1000.0 / 60.0, 1000.0 / 30.0];

pub(super) fn show(ui: &mut Ui, frames: &Frames) {
    let (Some(half), Some(nearly_all)) = (frames.quantile_ms(0.5), frames.quantile_ms(0.99)) else { return };
    let (area, response) = ui.allocate_exact_size(vec2(ui.available_width() - 4.0, HEIGHT), Sense::hover());
    let summary =
        format!("half of the frames take at most {half:.1} ms, 99 of 100 at most {nearly_all:.1} ms");
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Image, true, format!("Frame times: {summary}")));
    let painter = ui.painter_at(area);
    painter.rect_filled(area, CornerRadius::same(3), ui.visuals().extreme_bg_color);
    let end = ENDS_MS.into_iter().find(|end| *end >= 1.1 * nearly_all).unwrap_or(ENDS_MS[ENDS_MS.len() - 1]);
    let y_of = |ms: f32| area.bottom() - area.height() * (ms / end).min(1.0);
    let width = area.width() / MEMORY as f32;
    let first = area.right() - width * frames.iter().len() as f32;
    for (index, times) in frames.iter().enumerate() {
        let left = first + width * index as f32;
        let mut below = 0.0;
        // What no stage accounts for is waiting as well.
        let known: f32 = times.stages_ms.iter().sum();
        let rest = (times.whole_ms - known).max(0.0);
        for (stage, (ms, color)) in times.stages_ms.into_iter().zip(COLORS).enumerate() {
            let ms = if stage + 1 == STAGES.len() { ms + rest } else { ms };
            let top = below + ms;
            let bar = Rect::from_min_max(pos2(left, y_of(top)), pos2(left + width + 0.2, y_of(below)));
            painter.rect_filled(bar, CornerRadius::ZERO, color);
            below = top;
        }
    }
    for ms in MARKS_MS.into_iter().filter(|ms| *ms < end) {
        painter.hline(area.x_range(), y_of(ms), Stroke::new(1.0, Color32::from_white_alpha(40)));
    }
    let font = FontId::proportional(10.0);
    let corner = area.left_top() + vec2(4.0, 2.0);
    painter.text(corner, Align2::LEFT_TOP, format!("{end:.0} ms"), font, style::QUIET);
    response.on_hover_text(format!(
        "The last {MEMORY} frames: {summary}. Lines lie at 60 and 30 frames a second."
    ));
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for (name, color) in STAGES.into_iter().zip(COLORS) {
            let (swatch, _) = ui.allocate_exact_size(vec2(8.0, 8.0), Sense::hover());
            ui.painter().rect_filled(swatch, CornerRadius::same(2), color);
            ui.label(RichText::new(name).small().color(style::QUIET));
        }
    });
    ui.label(RichText::new(format!("p50 {half:.1} ms, p99 {nearly_all:.1} ms")).small());
}
