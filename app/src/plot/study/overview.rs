// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Curves of a study's numbers over its first variation: one for every combination of the others.

use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::heat_map::short;
use super::page::motion_name;
use crate::plot::picture::{Area, Drawn, INK, UNIT, font, heading};
use crate::study::landing::MOTION_COUNT;
use crate::study::point::Point;
use crate::study::statistics::Distribution;
use crate::study::summary::Summary;
use crate::study::variation::Variation;

/// Size of the picture in pixels.
pub(super) const SIZE: (u32, u32) = (1800, 1180);
/// Names and units of the panels, which show [`Summary::quantities`].
pub(super) const PANELS: [(&str, &str); 5] = [
    ("time aloft", "s"),
    ("mean descent", "m/s"),
    ("horizontal distance", "m"),
    ("along the wind", "m"),
    ("across the wind", "m"),
];
/// Most curves that are drawn with bands, and most that are named.
const MOST_BANDS: usize = 4;
const MOST_NAMES: usize = 8;
/// Colours of the motions of synthesised leaves, and behind them of the regimes of bodies.
const MOTION_COLORS: [RGBColor; MOTION_COUNT] = [
    RGBColor(152, 160, 166),
    RGBColor(232, 170, 70),
    RGBColor(206, 98, 84),
    RGBColor(88, 152, 196),
    RGBColor(104, 166, 120),
    RGBColor(154, 120, 186),
    RGBColor(240, 160, 196),
    RGBColor(120, 132, 140),
    RGBColor(44, 124, 176),
    RGBColor(222, 142, 28),
    RGBColor(186, 60, 48),
    RGBColor(62, 138, 84),
    RGBColor(126, 84, 162),
    RGBColor(226, 116, 168),
];

/// The places of the first variation's values on the axis, and what they are called.
struct Axis<'a> {
    label: &'a str,
    places: Vec<f64>,
    names: Option<Vec<&'a str>>,
}

impl<'a> Axis<'a> {
    fn of(label: &'a str, variation: &'a Variation) -> Self {
        let count = variation.settings.len();
        match variation.numbers() {
            Some(places) => Self { label, places, names: None },
            None => Self {
                label,
                places: (0..count).map(|index| index as f64).collect(),
                names: Some(variation.settings.iter().map(|setting| setting.text.as_str()).collect()),
            },
        }
    }

    fn range(&self) -> std::ops::Range<f64> {
        let low = self.places.iter().copied().fold(f64::INFINITY, f64::min);
        let high = self.places.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let room = if high > low { 0.04 * (high - low) } else { 0.5 };
        low - room..high + room
    }

    /// Label below a place.
    fn name(&self, place: f64) -> String {
        let Some(names) = &self.names else {
            let text = format!("{place:.3}");
            return text.trim_end_matches('0').trim_end_matches('.').to_owned();
        };
        let found = self.places.iter().position(|own| (own - place).abs() < 1e-6);
        found.map_or(String::new(), |index| names[index].to_owned())
    }
}

/// Draws all panels.
pub(super) fn draw(
    area: &Area<'_>,
    name: &str,
    label: &str,
    variations: &[Variation],
    points: &[Point],
    summaries: &[Summary],
) -> Drawn {
    let Some((first, others)) = variations.split_first() else { return Ok(()) };
    let axis = Axis::of(label, first);
    // Points of one value of the first variation follow one another.
    let curves = points.len() / first.settings.len();
    let of_curve = |curve: usize| -> Vec<&Summary> { summaries.iter().skip(curve).step_by(curves).collect() };
    let (head, body) = area.split_vertically(64 * UNIT);
    let drops = summaries.iter().map(|summary| summary.drops).max().unwrap_or(0);
    let spread = if curves <= MOST_BANDS { "median and middle 80 % of" } else { "medians of" };
    heading(&head, format!("{name}: {spread} {drops} drops"), 30)?;
    let (panels, foot) = body.split_vertically((SIZE.1 - 64 - 60) * UNIT);
    let areas = panels.split_evenly((2, 3));
    for (index, (area, (title, in_units))) in areas.iter().zip(PANELS).enumerate() {
        let values: Vec<Vec<Distribution>> = (0..curves)
            .map(|curve| of_curve(curve).iter().map(|summary| summary.quantities[index]).collect())
            .collect();
        quantity(area, &axis, title, in_units, &values)?;
    }
    if let Some(area) = areas.last() {
        motions(area, &axis, curves, summaries)?;
    }
    if others.is_empty() {
        return Ok(());
    }
    let names: Vec<_> = points
        .iter()
        .take(curves)
        .map(|point| {
            let named = others.iter().zip(&point.settings[1..]);
            named
                .map(|(to, setting)| format!("{} = {}", to.path, setting.text))
                .collect::<Vec<_>>()
                .join(", ")
        })
        .collect();
    legend(&foot, &names)
}

/// The colour of a curve.
fn color(curve: usize, curves: usize) -> RGBColor {
    if curves == 1 {
        return RGBColor(44, 108, 158);
    }
    // The lightest end would not show on paper.
    ViridisRGB.get_color(0.88 * curve as f64 / (curves - 1) as f64)
}

/// A chart with its axes.
fn chart<'a, 'b>(
    area: &'a Area<'b>,
    axis: &Axis<'_>,
    title: &str,
    in_units: &str,
    range: std::ops::Range<f64>,
) -> Result<
    ChartContext<'a, BitMapBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>,
    Box<dyn std::error::Error + 'a>,
>
where
    'b: 'a,
{
    let mut chart = ChartBuilder::on(area)
        .margin(14 * UNIT)
        .caption(title, font(24))
        .x_label_area_size(60 * UNIT)
        .y_label_area_size(84 * UNIT)
        .build_cartesian_2d(axis.range(), range)
        .map_err(|error| error.to_string())?;
    let labels = axis.names.as_ref().map_or(7, Vec::len);
    chart
        .configure_mesh()
        .x_desc(axis.label)
        .y_desc(in_units)
        .axis_desc_style(font(20))
        .label_style(font(18))
        .axis_style(INK.stroke_width(UNIT))
        .bold_line_style(INK.mix(0.12).stroke_width(UNIT))
        .light_line_style(TRANSPARENT)
        .set_all_tick_mark_size(5 * UNIT)
        .x_labels(labels)
        .y_labels(7)
        .x_label_formatter(&|place| axis.name(*place))
        .y_label_formatter(&|value| short(*value))
        .draw()
        .map_err(|error| error.to_string())?;
    Ok(chart)
}

/// One quantity: a curve of medians, within a band of the middle eight in ten.
fn quantity(
    area: &Area<'_>,
    axis: &Axis<'_>,
    title: &str,
    in_units: &str,
    curves: &[Vec<Distribution>],
) -> Drawn {
    let has_bands = curves.len() <= MOST_BANDS;
    let there = curves.iter().flatten().filter(|quantity| !quantity.median.is_nan());
    let ends = there.flat_map(|quantity| match has_bands {
        true => [quantity.p10, quantity.p90],
        false => [quantity.median; 2],
    });
    let (low, high) = ends.fold((0.0f64, 0.0f64), |(low, high), end| (low.min(end), high.max(end)));
    let room = (0.06 * (high - low)).max(0.05);
    // All these quantities have a natural zero, which stays in sight.
    let low = if low < 0.0 { low - room } else { 0.0 };
    let range = low..high + room;
    let mut chart = chart(area, axis, title, in_units, range).map_err(|error| error.to_string())?;
    for (index, curve) in curves.iter().enumerate() {
        let color = color(index, curves.len());
        let there: Vec<_> =
            axis.places.iter().zip(curve).filter(|(_, quantity)| !quantity.median.is_nan()).collect();
        if has_bands && there.len() > 1 {
            let lower = there.iter().map(|&(&x, quantity)| (x, quantity.p10));
            let upper = there.iter().map(|&(&x, quantity)| (x, quantity.p90));
            let corners: Vec<_> = upper.chain(lower.rev()).collect();
            chart.draw_series([Polygon::new(corners, color.mix(0.16))])?;
        }
        let line: Vec<_> = there.iter().map(|&(&x, quantity)| (x, quantity.median)).collect();
        if axis.names.is_none() {
            chart.draw_series(LineSeries::new(line.clone(), color.stroke_width(3 * UNIT)))?;
        }
        chart.draw_series(line.into_iter().map(|at| Circle::new(at, 5 * UNIT, color.filled())))?;
    }
    Ok(())
}

/// Shares of the time in the air, one above the other; of several curves their mean.
fn motions(area: &Area<'_>, axis: &Axis<'_>, curves: usize, summaries: &[Summary]) -> Drawn {
    let title = if curves == 1 { "motions" } else { "motions, mean over all curves" };
    let means: Vec<[f64; MOTION_COUNT]> = summaries
        .chunks(curves)
        .map(|chunk| {
            std::array::from_fn(|motion| {
                chunk.iter().map(|summary| summary.motions[motion]).sum::<f64>() / chunk.len() as f64
            })
        })
        .collect();
    let (plot, key) = area.split_horizontally(area.dim_in_pixel().0 - 116 * UNIT);
    let mut chart =
        chart(&plot, axis, title, "share of the time aloft", 0.0..1.0).map_err(|error| error.to_string())?;
    let mut below = vec![0.0; means.len()];
    let unit = UNIT as i32;
    let mut row = 70 * unit;
    for motion in 0..MOTION_COUNT {
        if means.iter().all(|shares| shares[motion].is_nan() || shares[motion] <= 0.0) {
            continue;
        }
        let above: Vec<f64> = below.iter().zip(&means).map(|(sum, shares)| sum + shares[motion]).collect();
        let color = MOTION_COLORS[motion];
        if axis.names.is_none() && means.len() > 1 {
            let lower = axis.places.iter().zip(&below).map(|(&x, &y)| (x, y));
            let upper = axis.places.iter().zip(&above).map(|(&x, &y)| (x, y));
            let corners: Vec<_> = lower.chain(upper.rev()).filter(|corner| !corner.1.is_nan()).collect();
            chart.draw_series([Polygon::new(corners, color.filled())])?;
        } else {
            chart.draw_series(axis.places.iter().zip(below.iter().zip(&above)).map(
                |(&x, (&low, &high))| Rectangle::new([(x - 0.3, low), (x + 0.3, high)], color.filled()),
            ))?;
        }
        below = above;
        let name = motion_name(motion);
        key.draw(&Rectangle::new([(0, row - 8 * unit), (16 * unit, row + 8 * unit)], color.filled()))?;
        let style = font(18).pos(Pos::new(HPos::Left, VPos::Center));
        key.draw(&Text::new(name, (24 * unit, row), style))?;
        row += 28 * unit;
    }
    Ok(())
}

/// Legend of the curves, below the panels.
fn legend(area: &Area<'_>, names: &[String]) -> Drawn {
    let unit = UNIT as i32;
    let style = font(20).pos(Pos::new(HPos::Left, VPos::Center));
    // Of many curves the colours alone run from the first to the last.
    let shown: Vec<usize> = match names.len() {
        few @ ..=MOST_NAMES => (0..few).collect(),
        many => vec![0, many - 1],
    };
    let step = (SIZE.0 - 80) / u32::try_from(shown.len())?;
    for (place, &curve) in shown.iter().enumerate() {
        let x = (40 + i32::try_from(step)? * i32::try_from(place)?) * unit;
        let color = color(curve, names.len());
        area.draw(&PathElement::new(
            [(x, 26 * unit), (x + 36 * unit, 26 * unit)],
            color.stroke_width(4 * UNIT),
        ))?;
        let last = place + 1 == shown.len() && shown.len() < names.len();
        let text = if last {
            format!("to {} (last of {})", names[curve], names.len())
        } else {
            names[curve].clone()
        };
        area.draw(&Text::new(text, (x + 46 * unit, 26 * unit), style.clone()))?;
    }
    Ok(())
}
