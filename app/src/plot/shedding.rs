// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Plot of the leaves that a crown loses.

use plotters::prelude::*;

use super::picture::{Area, Drawn, INK, PAPER, UNIT, font};
use crate::run::digits::grouped_by;
use crate::study::shedding::{FASTEST_M_S, Season};

/// Size of the picture in pixels.
pub(crate) const SIZE: (u32, u32) = (1600, 1000);
/// From summer to late autumn.
const COLORS: [RGBColor; 5] = [
    RGBColor(62, 124, 58),
    RGBColor(150, 160, 40),
    RGBColor(222, 160, 28),
    RGBColor(208, 92, 32),
    RGBColor(124, 46, 34),
];

/// Draws the seasons of a kind of tree.
///
/// # Errors
/// Errors of the plotting library.
pub(crate) fn draw(area: &Area<'_>, kind: &str, minutes: u32, seasons: &[Season]) -> Drawn {
    let unit = UNIT;
    let most = seasons.iter().flat_map(|season| &season.curve).fold(10.0, |a: f64, b| a.max(*b));
    let most = 10f64.powf(most.log10().ceil());
    let title = format!("Leaves that a full-grown {kind} sheds");
    let mut chart = ChartBuilder::on(area)
        .margin(28 * unit)
        .caption(title, font(38))
        .x_label_area_size(76 * unit)
        .y_label_area_size(116 * unit)
        .build_cartesian_2d(0.0..f64::from(FASTEST_M_S), (1.0..most).log_scale())?;
    chart
        .configure_mesh()
        .x_desc("mean wind speed, m/s")
        .y_desc(format!("leaves per hour and crown, over the first {}", span(minutes)))
        .axis_desc_style(font(26))
        .label_style(font(24))
        .axis_style(INK.stroke_width(unit))
        .bold_line_style(INK.mix(0.16).stroke_width(unit))
        .light_line_style(INK.mix(0.05).stroke_width(unit))
        .set_all_tick_mark_size(6 * unit)
        .x_labels(7)
        .y_labels(10)
        .x_label_formatter(&|speed| format!("{speed:.0}"))
        .y_label_formatter(&|count| grouped_by(&format!("{count:.0}"), ' '))
        .draw()?;
    for (season, color) in seasons.iter().zip(COLORS) {
        let points = above_one(&season.curve);
        let none = if points.is_empty() { ", sheds none" } else { "" };
        let hanging = 100.0 * season.hanging;
        let label = format!("{}, {hanging:.0} % of the leaves left{none}", name(season.autumn));
        chart.draw_series(LineSeries::new(points, color.stroke_width(4 * unit)))?.label(label).legend(
            move |(x, y)| {
                let length = (44 * UNIT) as i32;
                PathElement::new([(x, y), (x + length, y)], color.stroke_width(4 * UNIT))
            },
        );
        for mark in season.marks.iter().filter(|mark| mark.leaves_per_h >= 1.0) {
            let low = (mark.leaves_per_h - mark.error_per_h).max(1.0);
            let high = mark.leaves_per_h + mark.error_per_h;
            let bar = [(mark.speed_m_s, low), (mark.speed_m_s, high)];
            chart.draw_series([PathElement::new(bar, color.stroke_width(2 * unit))])?;
            let at = (mark.speed_m_s, mark.leaves_per_h);
            chart.draw_series([Circle::new(at, 8 * unit, PAPER.filled())])?;
            let (size, style) = match mark.is_gusty {
                false => (7 * unit, color.filled()),
                true => (6 * unit, color.stroke_width(3 * unit)),
            };
            chart.draw_series([Circle::new(at, size, style)])?;
        }
    }
    for (text, style) in [
        ("simulated, steady wind", INK.filled()),
        ("simulated, gusts and turbulence", INK.stroke_width(3 * unit)),
    ] {
        let at = (-1.0, 0.5);
        chart
            .draw_series([Circle::new(at, 0, style)])?
            .label(text)
            .legend(move |(x, y)| Circle::new((x + (22 * UNIT) as i32, y), 6 * UNIT, style));
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

/// The part of a curve that lies above one, cut off where it crosses that. Kernels round the speed of the air down to
/// whole m/s: each point stands in the middle of the speeds that it is for.
fn above_one(curve: &[f64]) -> Vec<(f64, f64)> {
    let logs = curve.iter().map(|count| count.max(1e-6).ln());
    let points: Vec<(f64, f64)> =
        (0u32..).zip(logs).map(|(speed, log)| (f64::from(speed) + 0.5, log)).collect();
    let mut above = Vec::new();
    for (index, &(speed, log)) in points.iter().enumerate() {
        if let Some(&(earlier, from)) = index.checked_sub(1).and_then(|index| points.get(index))
            && (from < 0.0) != (log < 0.0)
        {
            above.push((earlier + (speed - earlier) * from / (from - log), 1.0));
        }
        if log >= 0.0 {
            above.push((speed, log.exp()));
        }
    }
    above
}

fn span(minutes: u32) -> String {
    if minutes == 1 { "minute".into() } else { format!("{minutes} minutes") }
}

/// Name of a time of the year.
fn name(autumn: f32) -> String {
    match autumn {
        0.0 => "summer".into(),
        _ => format!("autumn {autumn}"),
    }
}
