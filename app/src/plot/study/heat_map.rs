// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Maps of where drops land, seen from where each was let go.

use std::ops::Range;

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::plot::picture::{Area, Drawn, INK, PAPER, UNIT, font};

/// Size of the map of one point in pixels.
pub(super) const SIZE: (u32, u32) = (900, 640);
/// Size of a panel among others.
const PANEL: (u32, u32) = (380, 300);
/// Room above and beside the panels.
const HEAD: u32 = 66;
const BAR: u32 = 130;
/// Cells of a map.
const CELLS: (usize, usize) = (48, 32);
/// Share of drops that may lie beyond the map's edges at each of its four sides.
const BEYOND: f64 = 0.01;

/// Ranges and scale that all maps of a study share.
#[derive(Clone, Debug)]
pub(super) struct Frame {
    along: Range<f64>,
    across: Range<f64>,
    /// Smallest share of a point's drops that a cell can hold, and the largest that one does.
    shares: (f64, f64),
}

impl Frame {
    /// The frame that shows nearly all drops, and where they were let go.
    pub(super) fn around(points: &[Vec<(f64, f64)>]) -> Self {
        let along = range(points.iter().flatten().map(|drift| drift.0).collect());
        let across = range(points.iter().flatten().map(|drift| drift.1).collect());
        let mut frame = Self { along, across, shares: (1.0, 0.0) };
        for drifts in points.iter().filter(|drifts| !drifts.is_empty()) {
            let one = 1.0 / drifts.len() as f64;
            let most = frame.cells(drifts).into_iter().max().unwrap_or(0);
            frame.shares = (frame.shares.0.min(one), frame.shares.1.max(f64::from(most) * one));
        }
        if frame.shares.1 <= frame.shares.0 {
            frame.shares.1 = frame.shares.0 * 10.0;
        }
        frame
    }

    /// Numbers of drops in the cells, along running fastest.
    fn cells(&self, drifts: &[(f64, f64)]) -> Vec<u32> {
        let mut cells = vec![0; CELLS.0 * CELLS.1];
        for &(along, across) in drifts {
            let place = cell(&self.along, CELLS.0, along).zip(cell(&self.across, CELLS.1, across));
            if let Some((column, row)) = place {
                cells[row * CELLS.0 + column] += 1;
            }
        }
        cells
    }

    /// The colour of a share, on a logarithmic scale.
    fn color(&self, share: f64) -> RGBColor {
        let (low, high) = self.shares;
        ViridisRGB.get_color(((share / low).ln() / (high / low).ln()).clamp(0.0, 1.0))
    }
}

/// The cell that a place lies in.
fn cell(range: &Range<f64>, cells: usize, place: f64) -> Option<usize> {
    let share = (place - range.start) / (range.end - range.start);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within the cells")]
    let index = (share * cells as f64) as usize;
    (share >= 0.0 && index < cells).then_some(index)
}

/// From the lowest to the highest but for a few, with room around, and with zero.
fn range(mut values: Vec<f64>) -> Range<f64> {
    values.sort_by(f64::total_cmp);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an index")]
    let beyond = (values.len() as f64 * BEYOND) as usize;
    let low = values.get(beyond).map_or(0.0, |low| low.min(0.0));
    let high = values.iter().rev().nth(beyond).map_or(0.0, |high| high.max(0.0));
    let room = (0.06 * (high - low)).max(0.1);
    low - room..high + room
}

/// The map of one point.
pub(super) fn draw_one(area: &Area<'_>, frame: &Frame, title: &str, drifts: &[(f64, f64)]) -> Drawn {
    let (left, right) = area.split_horizontally((SIZE.0 - BAR) * UNIT);
    panel(&left, frame, title, drifts, 22)?;
    let (_, lower) = right.split_vertically(44 * UNIT);
    color_bar(&lower, frame, SIZE.1 - 150)
}

/// Size of the picture of so many panels.
pub(super) fn grid_size(columns: usize, panels: usize) -> (u32, u32) {
    let count = |number: usize| u32::try_from(number).unwrap_or(1);
    // A single panel leaves room for the heading.
    (PANEL.0 * count(columns.max(2)) + BAR, PANEL.1 * count(panels.div_ceil(columns)).max(1) + HEAD)
}

/// All maps side by side.
pub(super) fn draw_grid(
    area: &Area<'_>,
    frame: &Frame,
    heading: &str,
    columns: usize,
    panels: &[(&str, &[(f64, f64)])],
) -> Drawn {
    let (head, body) = area.split_vertically(HEAD * UNIT);
    let unit = UNIT as i32;
    let style = font(28).pos(Pos::new(HPos::Left, VPos::Center));
    head.draw(&Text::new(heading.to_owned(), (24 * unit, 36 * unit), style))?;
    let size = grid_size(columns, panels.len());
    let (maps, bar) = body.split_horizontally((size.0 - BAR) * UNIT);
    let areas = maps.split_evenly((panels.len().div_ceil(columns), columns));
    for (area, (title, drifts)) in areas.iter().zip(panels) {
        panel(area, frame, title, drifts, 17)?;
    }
    color_bar(&bar, frame, (size.1 - HEAD - 80).min(460))
}

/// One map.
fn panel(area: &Area<'_>, frame: &Frame, title: &str, drifts: &[(f64, f64)], text: u32) -> Drawn {
    let cells = frame.cells(drifts);
    let beyond = drifts.len() as f64 - f64::from(cells.iter().sum::<u32>());
    let share = 100.0 * beyond / drifts.len().max(1) as f64;
    let caption = if beyond > 0.0 { format!("{title} ({share:.1} % farther out)") } else { title.to_owned() };
    let mut chart = ChartBuilder::on(area)
        .margin(10 * UNIT)
        .margin_top(14 * UNIT)
        .caption(caption, font(text))
        .x_label_area_size(text * 26 / 10 * UNIT)
        .y_label_area_size(text * 34 / 10 * UNIT)
        .build_cartesian_2d(frame.along.clone(), frame.across.clone())?;
    let width = (frame.along.end - frame.along.start) / CELLS.0 as f64;
    let height = (frame.across.end - frame.across.start) / CELLS.1 as f64;
    chart.draw_series(cells.iter().enumerate().filter(|(_, count)| **count > 0).map(|(index, &count)| {
        let (column, row) = ((index % CELLS.0) as f64, (index / CELLS.0) as f64);
        let corner = (frame.along.start + column * width, frame.across.start + row * height);
        let share = f64::from(count) / drifts.len() as f64;
        Rectangle::new([corner, (corner.0 + width, corner.1 + height)], frame.color(share).filled())
    }))?;
    chart
        .configure_mesh()
        .x_desc("along the wind, m")
        .y_desc("across, m")
        .axis_desc_style(font(text * 9 / 10))
        .label_style(font(text * 8 / 10))
        .axis_style(INK.stroke_width(UNIT))
        .bold_line_style(INK.mix(0.10).stroke_width(UNIT))
        .light_line_style(TRANSPARENT)
        .set_all_tick_mark_size(4 * UNIT)
        .x_labels(6)
        .y_labels(5)
        .x_label_formatter(&|metres| short(*metres))
        .y_label_formatter(&|metres| short(*metres))
        .draw()?;
    // Where all were let go.
    let at = chart.backend_coord(&(0.0, 0.0));
    let mark = (text / 3 * UNIT) as i32;
    let root = area.strip_coord_spec();
    let offset = area.get_base_pixel();
    let at = (at.0 - offset.0, at.1 - offset.1);
    for arm in [(mark, 0), (0, mark)] {
        let line = [(at.0 - arm.0, at.1 - arm.1), (at.0 + arm.0, at.1 + arm.1)];
        root.draw(&PathElement::new(line, PAPER.stroke_width(4 * UNIT)))?;
    }
    for arm in [(mark, 0), (0, mark)] {
        let line = [(at.0 - arm.0, at.1 - arm.1), (at.0 + arm.0, at.1 + arm.1)];
        root.draw(&PathElement::new(line, RGBColor(186, 60, 48).stroke_width(2 * UNIT)))?;
    }
    Ok(())
}

/// A number without digits that say nothing.
pub(super) fn short(number: f64) -> String {
    let text = format!("{number:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

/// Colour bar.
fn color_bar(area: &Area<'_>, frame: &Frame, height: u32) -> Drawn {
    let unit = UNIT as i32;
    let height = i32::try_from(height)? * unit;
    let (x, top) = (14 * unit, 58 * unit);
    let label = font(16).pos(Pos::new(HPos::Left, VPos::Center));
    area.draw(&Text::new("% of the drops", (x - 4 * unit, 16 * unit), label.clone()))?;
    area.draw(&Text::new("in a cell", (x - 4 * unit, 36 * unit), label.clone()))?;
    let (low, high) = frame.shares;
    let share_at = |y: i32| low * (high / low).powf(1.0 - f64::from(y) / f64::from(height));
    for y in 0..height {
        let line =
            Rectangle::new([(x, top + y), (x + 22 * unit, top + y + 1)], frame.color(share_at(y)).filled());
        area.draw(&line)?;
    }
    for tick in 0..=4 {
        let y = height * tick / 4;
        let percent = 100.0 * share_at(y);
        let text = if percent >= 10.0 { format!("{percent:.0}") } else { short(percent) };
        area.draw(&PathElement::new(
            [(x + 22 * unit, top + y), (x + 28 * unit, top + y)],
            INK.stroke_width(UNIT),
        ))?;
        area.draw(&Text::new(text, (x + 34 * unit, top + y), label.clone()))?;
    }
    Ok(())
}
