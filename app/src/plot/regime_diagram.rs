// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The plot of how discs and strips fall.

use std::f64::consts::TAU;

use plotters::coord::ranged1d::ValueFormatter;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::boundaries::boundaries;
use super::colors::color;
use crate::plot::picture::{Area, Drawn, INK, PAPER, UNIT, font, pixel};
use crate::study::regime::{COUNT, Regime};

/// Size of the picture in pixels.
pub(crate) const SIZE: (u32, u32) = (1600, 1540);
/// Heights in pixels of what is drawn of discs, and of strips below it.
const PARTS: [u32; 2] = [1054, 420];
/// Reynolds numbers that are shown.
const REYNOLDS: std::ops::Range<f64> = 60.0..40_000.0;
/// Dimensionless moments of inertia that are shown.
const INERTIA: std::ops::Range<f64> = 0.0014..0.3;
/// Froude numbers of strips that are shown.
const FROUDE: std::ops::Range<f64> = 0.2..1.8;
/// Aspect ratios of strips that are shown.
const ASPECT: std::ops::Range<f64> = 0.5..11.5;
/// Froude number at which strips begin to tumble, with its uncertainty.
///
/// # Source
/// Belmonte, Eisenberg and Moses, "From flutter to tumble: inertial drag and Froude similarity in falling paper",
/// Phys. Rev. Lett. 81 (1998), abstract.
const STRIPS_TUMBLE: [f64; 2] = [0.67, 0.05];
/// Radius of a pie in pixels.
const PIE: u32 = 16;

/// A piece that has been dropped.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spot {
    /// Place in its chart: Reynolds number and dimensionless moment of inertia of a disc, Froude number and aspect
    /// ratio of a strip.
    pub(crate) place: (f64, f64),
    /// Shares of drops in the order of [`Regime::ALL`].
    pub(crate) shares: [f64; COUNT],
}

impl Spot {
    /// The regime of most drops.
    pub(crate) fn prevailing(&self) -> Regime {
        let pairs = Regime::ALL.into_iter().zip(self.shares);
        pairs.max_by(|a, b| a.1.total_cmp(&b.1)).map_or(Regime::Steady, |(regime, _)| regime)
    }
}

/// Draws discs and strips over the measured boundaries.
pub(crate) fn draw(area: &Area<'_>, drops: u32, discs: &[Spot], strips: &[Spot]) -> Drawn {
    let (upper, below) = area.split_vertically(PARTS[0] * UNIT);
    let (middle, lower) = below.split_vertically(PARTS[1] * UNIT);
    draw_discs(&upper, discs)?;
    draw_strips(&middle, area, strips)?;
    legend(&lower, drops)
}

fn draw_discs(area: &Area<'_>, spots: &[Spot]) -> Drawn {
    let mut chart = ChartBuilder::on(area)
        .margin(28 * UNIT)
        .caption("How discs fall: Windfall and the boundaries of Field et al. (1997)", font(36))
        .x_label_area_size(72 * UNIT)
        .y_label_area_size(104 * UNIT)
        .build_cartesian_2d(REYNOLDS.log_scale(), INERTIA.log_scale())?;
    for (regime, corners) in regions() {
        chart.draw_series([Polygon::new(corners, color(regime).mix(0.13))])?;
    }
    draw_axes(
        &mut chart,
        ["Reynolds number, descent times diameter over viscosity", "dimensionless moment of inertia I*"],
        [&|reynolds| format!("{reynolds}"), &|inertia| format!("{inertia}")],
    )?;
    for boundary in boundaries() {
        let line = LineSeries::new(shown(&boundary.points), INK.mix(0.75).stroke_width(3 * UNIT));
        chart.draw_series(line)?;
    }
    for (regime, text, at) in [
        (Regime::Steady, "steady", (64.0, 0.0165)),
        (Regime::Flutter, "periodic", (128.0, 0.0052)),
        (Regime::Chaotic, "chaotic", (226.0, 0.0242)),
        (Regime::Tumble, "tumbling", (182.0, 0.25)),
    ] {
        let shade = color(regime);
        let style = font(26).color(&shade).pos(Pos::new(HPos::Left, VPos::Center));
        chart.draw_series([Text::new(text, at, style)])?;
    }
    let is_shown = |spot: &&Spot| REYNOLDS.contains(&spot.place.0) && INERTIA.contains(&spot.place.1);
    for spot in spots.iter().filter(is_shown) {
        pie(area, chart.backend_coord(&spot.place), spot)?;
    }
    Ok(())
}

/// Draws strips into a part of the whole picture, in whose pixels pies have their places.
fn draw_strips(part: &Area<'_>, whole: &Area<'_>, spots: &[Spot]) -> Drawn {
    let mut chart = ChartBuilder::on(part)
        .margin(28 * UNIT)
        .caption("Strips, and the end of fluttering after Belmonte et al. (1998)", font(36))
        .x_label_area_size(72 * UNIT)
        .y_label_area_size(104 * UNIT)
        .build_cartesian_2d(FROUDE, ASPECT)?;
    let [tumble, uncertainty] = STRIPS_TUMBLE;
    let between = |regime, from, to| {
        let corners = [(from, ASPECT.start), (to, ASPECT.end)];
        Rectangle::new(corners, color(regime).mix(0.13).filled())
    };
    chart.draw_series([
        between(Regime::Flutter, FROUDE.start, tumble - uncertainty),
        between(Regime::Tumble, tumble + uncertainty, FROUDE.end),
    ])?;
    draw_axes(
        &mut chart,
        ["Froude number, root of mass per area over density of the air times width", "length / width"],
        [&|froude| format!("{froude:.1}"), &|aspect| format!("{aspect:.0}")],
    )?;
    let line = [(tumble, ASPECT.start), (tumble, ASPECT.end)];
    chart.draw_series(LineSeries::new(line, INK.mix(0.75).stroke_width(3 * UNIT)))?;
    for spot in spots {
        pie(whole, chart.backend_coord(&spot.place), spot)?;
    }
    Ok(())
}

/// Draws the grid of a chart, its axes with their names, and numbers as these functions write them.
fn draw_axes<X, Y>(
    chart: &mut ChartContext<'_, BitMapBackend<'_>, Cartesian2d<X, Y>>,
    [across, up]: [&str; 2],
    [number_across, number_up]: [&dyn Fn(&f64) -> String; 2],
) -> Drawn
where
    X: Ranged<ValueType = f64> + ValueFormatter<f64>,
    Y: Ranged<ValueType = f64> + ValueFormatter<f64>,
{
    chart
        .configure_mesh()
        .x_desc(across)
        .y_desc(up)
        .axis_desc_style(font(25))
        .label_style(font(22))
        .axis_style(INK.stroke_width(UNIT))
        .bold_line_style(INK.mix(0.12).stroke_width(UNIT))
        .light_line_style(INK.mix(0.04).stroke_width(UNIT))
        .set_all_tick_mark_size(6 * UNIT)
        .x_label_formatter(number_across)
        .y_label_formatter(number_up)
        .draw()?;
    Ok(())
}

/// The measured regions, as far as their boundaries were measured.
fn regions() -> Vec<(Regime, Vec<(f64, f64)>)> {
    let all = boundaries();
    let [steady, periodic, tumbling] =
        [0, 1, 2].map(|index| all.get(index).map_or(Vec::new(), |boundary| shown(&boundary.points)));
    let (Some(foot), Some(head)) = (steady.first(), steady.last()) else { return Vec::new() };
    let (Some(split), Some(end)) = (periodic.first(), periodic.last()) else { return Vec::new() };
    let (Some(begin), Some(last)) = (tumbling.first(), tumbling.last()) else { return Vec::new() };
    let (low, high) = (INERTIA.start, INERTIA.end);
    let mut still = vec![(REYNOLDS.start, low), (foot.0, low)];
    still.extend(&steady);
    still.push((REYNOLDS.start, head.1));
    let mut swinging = vec![(foot.0, low)];
    swinging.extend(steady.iter().filter(|point| point.1 <= split.1));
    swinging.extend(&periodic);
    swinging.push((end.0, low));
    let mut wild: Vec<_> = periodic.clone();
    wild.extend(tumbling.iter().rev().filter(|point| point.0 <= end.0));
    let mut turning = vec![(begin.0, high)];
    turning.extend(&tumbling);
    turning.push((last.0, high));
    vec![
        (Regime::Steady, still),
        (Regime::Flutter, swinging),
        (Regime::Chaotic, wild),
        (Regime::Tumble, turning),
    ]
}

/// The part of a boundary that begins where the plot does.
fn shown(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let low = INERTIA.start;
    let mut part: Vec<_> = points.iter().copied().filter(|point| point.1 >= low).collect();
    if let Some(&[from, to]) = points.array_windows().find(|&&[from, to]| from.1 < low && low < to.1) {
        let share = (low / from.1).ln() / (to.1 / from.1).ln();
        part.insert(0, (from.0 * (to.0 / from.0).powf(share), low));
    }
    part
}

/// Shares of drops, around a point of the picture.
fn pie(area: &Area<'_>, (x, y): (i32, i32), spot: &Spot) -> Drawn {
    let radius = PIE * UNIT;
    let rim = color(spot.prevailing());
    area.draw(&Circle::new((x, y), radius + 2 * UNIT, PAPER.filled()))?;
    let mut from = 0.0;
    for (regime, share) in Regime::ALL.into_iter().zip(spot.shares) {
        if share > 0.0 {
            area.draw(&Polygon::new(
                slice((x, y), f64::from(radius), from, from + share),
                color(regime).filled(),
            ))?;
        }
        from += share;
    }
    area.draw(&Circle::new((x, y), radius, rim.stroke_width(2 * UNIT)))?;
    Ok(())
}

/// Corners of a slice of a pie, from one share of a turn to another, clockwise from the top.
fn slice((x, y): (i32, i32), radius: f64, from: f64, to: f64) -> Vec<(i32, i32)> {
    let steps = 90;
    let rim = (0..=steps).map(|step| {
        let angle = TAU * (from + (to - from) * f64::from(step) / f64::from(steps));
        (x + pixel(radius * angle.sin()), y - pixel(radius * angle.cos()))
    });
    [(x, y)].into_iter().chain(rim).collect()
}

/// Legend of the colours, below the plot.
fn legend(area: &Area<'_>, drops: u32) -> Drawn {
    let unit = UNIT as i32;
    let row = 22 * unit;
    let style = font(23).pos(Pos::new(HPos::Left, VPos::Center));
    for (index, regime) in (0..).zip(Regime::ALL) {
        let x = (40 + 128 * index) * unit;
        area.draw(&Circle::new((x, row), 9 * UNIT, color(regime).filled()))?;
        area.draw(&Text::new(regime.name(), (x + 16 * unit, row), style.clone()))?;
    }
    let text = format!("shares of {drops} drops each, let go any way round");
    area.draw(&Text::new(text, (990 * unit, row), style))?;
    Ok(())
}
