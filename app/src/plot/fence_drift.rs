// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Plot of the drift behind a fence as it grows, beside the dimensions that were measured.

use plotters::prelude::*;

use super::picture::{Area, Drawn, INK, PAPER, UNIT, font};
use crate::study::fence_drift::Drift;

/// Size of the picture in pixels.
pub(crate) const SIZE: (u32, u32) = (1600, 760);
/// Length and greatest depth in heights of drifts behind fences of horizontal slats of which half is open (Tabler, Journal of Glaciology 26, 1980).
const TABLER: [f64; 2] = [30.0, 1.2];
/// Their section in heights squared.
const TABLER_SECTION: f64 = 19.3;
/// Part of the plot, in heights before and behind the fence.
const SHOWN: [f64; 2] = [-10.0, 60.0];
const SNOW: RGBColor = RGBColor(52, 104, 158);

/// Draws the drift at all its hours.
///
/// # Errors
/// Errors of the plotting library.
pub(crate) fn draw(area: &Area<'_>, caption: &str, drifts: &[Drift]) -> Drawn {
    let unit = UNIT;
    let mut chart = ChartBuilder::on(area)
        .margin(28 * unit)
        .caption(caption, font(36))
        .x_label_area_size(76 * unit)
        .y_label_area_size(106 * unit)
        .build_cartesian_2d(SHOWN[0]..SHOWN[1], 0.0..1.6)?;
    chart
        .configure_mesh()
        .x_desc("distance behind the fence, heights")
        .y_desc("depth, heights")
        .axis_desc_style(font(26))
        .label_style(font(24))
        .axis_style(INK.stroke_width(unit))
        .bold_line_style(INK.mix(0.16).stroke_width(unit))
        .light_line_style(INK.mix(0.0).stroke_width(unit))
        .set_all_tick_mark_size(6 * unit)
        .draw()?;
    let [length, depth] = TABLER;
    let corner = [(0.0, depth), (length, depth), (length, 0.0)];
    let label = format!("Tabler (1980): {length} long, {depth} deep, section {TABLER_SECTION}");
    chart
        .draw_series(DashedLineSeries::new(corner, 14 * unit, 10 * unit, INK.stroke_width(2 * unit)))?
        .label(label)
        .legend(|(x, y)| PathElement::new([(x, y), (x + (44 * UNIT) as i32, y)], INK.stroke_width(2 * UNIT)));
    for (number, drift) in drifts.iter().enumerate() {
        let strength = (number + 1) as f64 / drifts.len() as f64;
        let color = SNOW.mix(0.25 + 0.75 * strength);
        let shown = drift.profile.iter().filter(|[behind, _]| (SHOWN[0]..=SHOWN[1]).contains(behind));
        let line = shown.map(|[behind, depth]| (*behind, *depth));
        let label = format!("{:.0} h: {:.0} long, section {:.1}", drift.hours, drift.length, drift.section);
        let stroke = color.stroke_width(4 * unit);
        chart
            .draw_series(LineSeries::new(line, stroke))?
            .label(label)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + (44 * UNIT) as i32, y)], stroke));
    }
    chart.draw_series([PathElement::new([(0.0, 0.0), (0.0, 1.0)], INK.stroke_width(7 * unit))])?;
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperRight)
        .legend_area_size(60 * unit)
        .margin(20 * unit)
        .background_style(PAPER.mix(0.92))
        .border_style(INK.mix(0.25))
        .label_font(font(23))
        .draw()?;
    Ok(())
}
