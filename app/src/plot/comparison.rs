// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The plot of simulated figures over measured ones.

use std::ops::Range;

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::plot::picture::{Area, Drawn, INK, UNIT, font, heading};
use crate::study::figure::{CLOSE, Figure, is_close};

/// Size of the picture in pixels.
pub(crate) const SIZE: (u32, u32) = (1800, 1180);
/// Room of the heading.
const HEAD: u32 = 64;
/// Releases and their colours.
const RELEASES: [(&str, RGBColor); 3] = [
    ("broadside", RGBColor(44, 124, 176)),
    ("edge-on", RGBColor(206, 98, 44)),
    ("random", RGBColor(104, 130, 84)),
];

/// A figure of a piece, measured and simulated.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair {
    pub(crate) figure: Figure,
    pub(crate) release: &'static str,
    pub(crate) measured: f64,
    pub(crate) simulated: f64,
}

/// Draws a panel for each figure.
pub(crate) fn draw(area: &Area<'_>, name: &str, drops: u32, pairs: &[Pair]) -> Drawn {
    let (head, body) = area.split_vertically(HEAD * UNIT);
    heading(&head, format!("{name}: simulated over measured, {drops} drops a piece"), 30)?;
    let panels = body.split_evenly((2, 3));
    for (area, figure) in panels.iter().zip(Figure::ALL) {
        let own: Vec<_> = pairs.iter().filter(|pair| pair.figure == figure).collect();
        panel(area, figure, &own)?;
    }
    panels.last().map_or(Ok(()), |area| legend(area, pairs))
}

/// Simulated over measured values of a figure, around the line on which they are equal.
fn panel(area: &Area<'_>, figure: Figure, pairs: &[&Pair]) -> Drawn {
    let met = pairs.iter().filter(|pair| is_close(pair.simulated, pair.measured)).count();
    let range = range(pairs);
    let mut chart = ChartBuilder::on(area)
        .margin(14 * UNIT)
        .margin_right(40 * UNIT)
        .caption(format!("{} ({met} of {} within a quarter)", figure.short_title(), pairs.len()), font(24))
        .x_label_area_size(60 * UNIT)
        .y_label_area_size(84 * UNIT)
        .build_cartesian_2d(range.clone(), range.clone())?;
    let (low, high) = (range.start, range.end);
    let band = [1.0 + CLOSE, 1.0 - CLOSE].map(|share| {
        let end = if share > 1.0 { high / share } else { high };
        [(low, low * share), (end, end * share)]
    });
    let [[a, b], [c, d]] = band;
    chart.draw_series([Polygon::new(vec![a, b, (high, high), d, c], INK.mix(0.07))])?;
    chart
        .configure_mesh()
        .x_desc(format!("measured: {}", figure.title()))
        .y_desc("simulated")
        .axis_desc_style(font(20))
        .label_style(font(18))
        .axis_style(INK.stroke_width(UNIT))
        .bold_line_style(INK.mix(0.12).stroke_width(UNIT))
        .light_line_style(TRANSPARENT)
        .set_all_tick_mark_size(5 * UNIT)
        .x_labels(6)
        .y_labels(6)
        .draw()?;
    chart.draw_series(LineSeries::new([(low, low), (high, high)], INK.mix(0.5).stroke_width(2 * UNIT)))?;
    for (release, color) in RELEASES {
        let own = pairs.iter().filter(|pair| pair.release == release);
        chart.draw_series(
            own.map(|pair| Circle::new((pair.measured, pair.simulated), 6 * UNIT, color.mix(0.85).filled())),
        )?;
    }
    Ok(())
}

/// From zero to a little above the largest of all values.
fn range(pairs: &[&Pair]) -> Range<f64> {
    let most = pairs.iter().map(|pair| pair.measured.max(pair.simulated)).fold(0.0, f64::max);
    0.0..if most > 0.0 { 1.06 * most } else { 1.0 }
}

/// Colours of the releases, and how many figures are met in all.
fn legend(area: &Area<'_>, pairs: &[Pair]) -> Drawn {
    let unit = UNIT as i32;
    let style = font(24).pos(Pos::new(HPos::Left, VPos::Center));
    let mut row = 120 * unit;
    for (release, color) in
        RELEASES.into_iter().filter(|(name, _)| pairs.iter().any(|pair| pair.release == *name))
    {
        area.draw(&Circle::new((100 * unit, row), 8 * UNIT, color.filled()))?;
        area.draw(&Text::new(format!("released {release}"), (124 * unit, row), style.clone()))?;
        row += 40 * unit;
    }
    let met = pairs.iter().filter(|pair| is_close(pair.simulated, pair.measured)).count();
    for text in [
        format!("{met} of {} figures within a quarter", pairs.len()),
        "of the measured ones (shaded)".to_owned(),
    ] {
        row += 36 * unit;
        area.draw(&Text::new(text, (92 * unit, row), style.clone()))?;
    }
    Ok(())
}
