// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Plot of the share of lying leaves that the wind moves.

use plotters::prelude::*;
use windfall_core::wind::beaufort_speed;

use super::picture::{Area, Drawn, INK, PAPER, UNIT, font};
use crate::study::litter_tunnel::{TunnelGround, TunnelPoint};

/// Size of the picture in pixels.
pub(crate) const SIZE: (u32, u32) = (1600, 1000);
/// Colours of the kinds of leaves, in turn.
const COLORS: [RGBColor; 6] = [
    RGBColor(208, 92, 32),
    RGBColor(62, 124, 58),
    RGBColor(40, 96, 150),
    RGBColor(160, 110, 20),
    RGBColor(124, 46, 34),
    RGBColor(110, 70, 140),
];

/// Draws the points of all kinds and grounds.
///
/// # Errors
/// Errors of the plotting library.
pub(crate) fn draw(area: &Area<'_>, seconds: f64, points: &[TunnelPoint]) -> Drawn {
    let unit = UNIT;
    let fastest = points.iter().map(|point| point.u10_m_s).fold(1.0, f64::max);
    let mut chart = ChartBuilder::on(area)
        .margin(28 * unit)
        .caption("Lying leaves that the wind moves", font(38))
        .x_label_area_size(76 * unit)
        .y_label_area_size(106 * unit)
        .build_cartesian_2d(0.0..fastest, 0.0..100.0)?;
    // Bands of the Beaufort numbers, halfway between their speeds.
    for number in (0..12u8).step_by(2) {
        let limit = |number: u8| 0.5 * (beaufort_speed(number) + beaufort_speed(number + 1));
        let (low, high) = (if number == 0 { 0.0 } else { limit(number - 1) }, limit(number).min(fastest));
        if low < fastest {
            let band = Rectangle::new([(low, 0.0), (high, 100.0)], INK.mix(0.05).filled());
            chart.draw_series([band])?;
        }
    }
    for number in 1..12u8 {
        let at = beaufort_speed(number);
        if at < fastest {
            let text = Text::new(format!("{number}"), (at - 0.05, 99.0), font(20));
            chart.draw_series([text])?;
        }
    }
    chart
        .configure_mesh()
        .x_desc("mean wind at 10 m, m/s; shaded and numbered: Beaufort")
        .y_desc(format!("moved by more than 0.5 m in {seconds:.0} s, %"))
        .axis_desc_style(font(26))
        .label_style(font(24))
        .axis_style(INK.stroke_width(unit))
        .bold_line_style(INK.mix(0.16).stroke_width(unit))
        .light_line_style(INK.mix(0.0).stroke_width(unit))
        .set_all_tick_mark_size(6 * unit)
        .draw()?;
    let mut kinds: Vec<&str> = Vec::new();
    for curve in points.chunk_by(|a, b| a.species == b.species && a.ground == b.ground) {
        let Some(first) = curve.first() else { continue };
        let kind = kinds.iter().position(|kind| *kind == first.species).unwrap_or_else(|| {
            kinds.push(&first.species);
            kinds.len() - 1
        });
        let color = COLORS[kind % COLORS.len()];
        let width = match first.ground {
            TunnelGround::Pavement => 5 * unit,
            TunnelGround::Lawn => 2 * unit,
            TunnelGround::Litter => unit,
        };
        let line = curve.iter().map(|point| (point.u10_m_s, 100.0 * point.moved_share));
        let label = format!("{}, {}", first.species, first.ground.name());
        chart.draw_series(LineSeries::new(line.clone(), color.stroke_width(width)))?.label(label).legend(
            move |(x, y)| PathElement::new([(x, y), (x + (44 * UNIT) as i32, y)], color.stroke_width(width)),
        );
        chart.draw_series(line.map(|at| Circle::new(at, 4 * unit, color.filled())))?;
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::LowerRight)
        .legend_area_size(60 * unit)
        .margin(20 * unit)
        .background_style(PAPER.mix(0.92))
        .border_style(INK.mix(0.25))
        .label_font(font(23))
        .draw()?;
    Ok(())
}
