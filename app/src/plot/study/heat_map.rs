// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Maps of where drops land, seen from where each was let go.

use std::ops::Range;

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::plot::picture::{Area, Drawn, INK, PAPER, UNIT, font, heading};

/// Widths in pixels of the picture of one point, and of a panel among others.
const WIDTH: u32 = 900;
const PANEL_WIDTH: u32 = 380;
/// Size of the text of either in pixels, and margin of a map.
const TEXT: u32 = 22;
const PANEL_TEXT: u32 = 17;
const MARGIN: u32 = 10;
/// Room above and beside the panels.
const HEAD: u32 = 66;
const BAR: u32 = 130;
/// Square cells of a map along the wind, and fewest and most across.
const COLUMNS: u32 = 48;
const ROWS: std::ops::RangeInclusive<u32> = 16..=48;
/// Largest share of a map's width that its scale bar takes.
const SCALE_BAR_SHARE: f64 = 0.25;
/// Share of drops that may lie beyond the map's edges at each of its four sides.
const BEYOND: f64 = 0.01;

/// Ranges and scale that all maps of a study share.
#[derive(Clone, Debug)]
pub(super) struct Frame {
    along: Range<f64>,
    across: Range<f64>,
    /// Cells across.
    rows: u32,
    /// Smallest share of a point's drops that a cell can hold, and the largest that one does.
    shares: (f64, f64),
}

impl Frame {
    /// The frame that shows nearly all drops, and where they were let go.
    pub(super) fn around(points: &[Vec<(f64, f64)>]) -> Self {
        let along = range(points.iter().flatten().map(|drift| drift.0).collect());
        let across = range(points.iter().flatten().map(|drift| drift.1).collect());
        let size = |range: &Range<f64>| range.end - range.start;
        let (columns, most) = (f64::from(COLUMNS), f64::from(*ROWS.end()));
        let cell_m = (size(&along) / columns).max(size(&across) / most);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a number of cells")]
        let rows = ((size(&across) / cell_m).ceil() as u32).clamp(*ROWS.start(), *ROWS.end());
        let [along, across] = [(along, COLUMNS), (across, rows)].map(|(range, cells)| {
            let (middle, half) = (0.5 * (range.start + range.end), 0.5 * cell_m * f64::from(cells));
            middle - half..middle + half
        });
        let mut frame = Self { along, across, rows, shares: (1.0, 0.0) };
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
        let mut cells = vec![0; (COLUMNS * self.rows) as usize];
        for &(along, across) in drifts {
            let place = cell(&self.along, COLUMNS, along).zip(cell(&self.across, self.rows, across));
            if let Some((column, row)) = place {
                cells[(row * COLUMNS + column) as usize] += 1;
            }
        }
        cells
    }

    /// Size in pixels of the map of one point.
    pub(super) fn size(&self) -> (u32, u32) {
        (WIDTH, self.panel_height(WIDTH - BAR, TEXT))
    }

    /// Size in pixels of the maps of so many points, side by side in columns.
    pub(super) fn grid_size(&self, columns: u32, panels: u32) -> (u32, u32) {
        // A single panel leaves room for the heading.
        let width = PANEL_WIDTH * columns.max(2) + BAR;
        (width, self.panel_height(PANEL_WIDTH, PANEL_TEXT) * panels.div_ceil(columns).max(1) + HEAD)
    }

    /// Height of a panel in which a metre is as long across as along.
    fn panel_height(&self, width: u32, text: u32) -> u32 {
        let Rooms { head, below, beside } = Rooms::of(text);
        head + below + 2 * MARGIN + (width - beside - 2 * MARGIN) * self.rows / COLUMNS
    }

    /// The colour of a share, on a logarithmic scale.
    fn color(&self, share: f64) -> RGBColor {
        let (low, high) = self.shares;
        ViridisRGB.get_color(((share / low).ln() / (high / low).ln()).clamp(0.0, 1.0))
    }
}

/// Rooms in pixels for the text around a map: its title, and the labels of its axes.
struct Rooms {
    head: u32,
    below: u32,
    beside: u32,
}

impl Rooms {
    fn of(text: u32) -> Self {
        Self { head: text * 2, below: text * 26 / 10, beside: text * 34 / 10 }
    }
}

/// The cell that a place lies in.
fn cell(range: &Range<f64>, cells: u32, place: f64) -> Option<u32> {
    let share = (place - range.start) / (range.end - range.start);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within the cells")]
    let index = (share * f64::from(cells)) as u32;
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
    let (left, right) = area.split_horizontally((WIDTH - BAR) * UNIT);
    panel(&left, frame, title, drifts, TEXT)?;
    let (_, lower) = right.split_vertically(44 * UNIT);
    color_bar(&lower, frame, frame.size().1 - 150)
}

/// All maps side by side.
pub(super) fn draw_grid(
    area: &Area<'_>,
    frame: &Frame,
    title: &str,
    columns: u32,
    panels: &[(&str, &[(f64, f64)])],
) -> Drawn {
    let (head, body) = area.split_vertically(HEAD * UNIT);
    heading(&head, title.to_owned(), 28)?;
    let (width, height) = frame.grid_size(columns, u32::try_from(panels.len())?);
    let (maps, bar) = body.split_horizontally((width - BAR) * UNIT);
    let areas = maps.split_evenly((panels.len().div_ceil(columns as usize), columns as usize));
    for (area, (title, drifts)) in areas.iter().zip(panels) {
        panel(area, frame, title, drifts, PANEL_TEXT)?;
    }
    color_bar(&bar, frame, (height - HEAD - 80).min(460))
}

/// One map.
fn panel(area: &Area<'_>, frame: &Frame, title: &str, drifts: &[(f64, f64)], text: u32) -> Drawn {
    let cells = frame.cells(drifts);
    let rooms = Rooms::of(text);
    let (head, body) = area.split_vertically(rooms.head * UNIT);
    let (width, height) = head.dim_in_pixel();
    let bottom = Pos::new(HPos::Center, VPos::Bottom);
    // A long title is written smaller.
    let (title_width, _) = head.estimate_text_size(title, &font(text))?;
    let title_size = if title_width > width { text * width / title_width } else { text };
    let place = (i32::try_from(width / 2)?, i32::try_from(height)?);
    head.draw(&Text::new(title.to_owned(), place, font(title_size).pos(bottom)))?;
    let mut chart = ChartBuilder::on(&body)
        .margin(MARGIN * UNIT)
        .x_label_area_size(rooms.below * UNIT)
        .y_label_area_size(rooms.beside * UNIT)
        .build_cartesian_2d(frame.along.clone(), frame.across.clone())?;
    let width = (frame.along.end - frame.along.start) / f64::from(COLUMNS);
    let height = (frame.across.end - frame.across.start) / f64::from(frame.rows);
    chart.draw_series((0u32..).zip(&cells).filter(|(_, count)| **count > 0).map(|(index, &count)| {
        let (column, row) = (f64::from(index % COLUMNS), f64::from(index / COLUMNS));
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
    let root = body.strip_coord_spec();
    let offset = body.get_base_pixel();
    let pixel_of = |place: (f64, f64)| {
        let at = chart.backend_coord(&place);
        (at.0 - offset.0, at.1 - offset.1)
    };
    let at = pixel_of((0.0, 0.0));
    let mark = (text / 3 * UNIT) as i32;
    for arm in [(mark, 0), (0, mark)] {
        let line = [(at.0 - arm.0, at.1 - arm.1), (at.0 + arm.0, at.1 + arm.1)];
        root.draw(&PathElement::new(line, PAPER.stroke_width(4 * UNIT)))?;
    }
    for arm in [(mark, 0), (0, mark)] {
        let line = [(at.0 - arm.0, at.1 - arm.1), (at.0 + arm.0, at.1 + arm.1)];
        root.draw(&PathElement::new(line, RGBColor(186, 60, 48).stroke_width(2 * UNIT)))?;
    }
    let length_m = round_length((frame.along.end - frame.along.start) * SCALE_BAR_SHARE);
    let end = pixel_of((frame.along.end, frame.across.start));
    let start = pixel_of((frame.along.end - length_m, frame.across.start));
    scale_bar(&root, (end.0 - start.0, end), length_m, text)?;
    let beyond = drifts.len() as f64 - f64::from(cells.iter().sum::<u32>());
    if beyond > 0.0 {
        let share = format!("{:.1} % farther out", 100.0 * beyond / drifts.len() as f64);
        let (right, top) = pixel_of((frame.along.end, frame.across.end));
        let style = font(text * 8 / 10).pos(Pos::new(HPos::Right, VPos::Top));
        root.draw(&Text::new(share, (right - mark, top + mark), style))?;
    }
    Ok(())
}

/// Scale bar of so many pixels in the lower right corner of a map.
fn scale_bar(area: &Area<'_>, (pixels, corner): (i32, (i32, i32)), length_m: f64, text: u32) -> Drawn {
    let unit = UNIT as i32;
    let size = text as i32 * unit;
    let (right, y) = (corner.0 - size, corner.1 - size * 3 / 4);
    let left = right - pixels;
    let around = [(left - size / 3, y - size * 5 / 4), (right + size / 3, y + size / 3)];
    area.draw(&Rectangle::new(around, PAPER.mix(0.85).filled()))?;
    let tick = size / 5;
    let line = vec![(left, y - tick), (left, y), (right, y), (right, y - tick)];
    area.draw(&PathElement::new(line, INK.stroke_width(2 * UNIT)))?;
    let style = font(text * 8 / 10).pos(Pos::new(HPos::Center, VPos::Bottom));
    area.draw(&Text::new(format!("{} m", short(length_m)), (i32::midpoint(left, right), y - tick), style))?;
    Ok(())
}

/// Largest length of one, two or five and zeros that is not above `most`.
fn round_length(most: f64) -> f64 {
    let power = 10f64.powf(most.log10().floor());
    [5.0, 2.0, 1.0].into_iter().map(|digit| digit * power).find(|length| *length <= most).unwrap_or(power)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_map_has_square_cells_and_shows_nearly_all() {
        for (breadth, rows) in [(0.1, 16), (1.0, 46), (20.0, 48)] {
            let drifts: Vec<_> = (0..400).map(|n| (f64::from(n % 20), breadth * f64::from(n / 20))).collect();
            let frame = Frame::around(std::slice::from_ref(&drifts));
            let size = |range: &Range<f64>, cells: u32| (range.end - range.start) / f64::from(cells);
            let cell = (size(&frame.along, COLUMNS), size(&frame.across, frame.rows));
            assert!((cell.0 / cell.1 - 1.0).abs() < 1e-12, "{frame:?}");
            assert!(frame.rows.abs_diff(rows) <= 2, "{frame:?}");
            assert!(frame.cells(&drifts).iter().sum::<u32>() >= 384, "of 400: {frame:?}");
        }
    }

    #[test]
    fn lengths_of_scale_bars_are_round() {
        for (most, length) in [(1.0, 1.0), (1.9, 1.0), (4.99, 2.0), (5.0, 5.0), (73.0, 50.0), (0.03, 0.02)] {
            assert!((round_length(most) / length - 1.0).abs() < 1e-12, "{most}: {}", round_length(most));
        }
    }
}
