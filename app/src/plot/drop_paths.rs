// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The picture of single drops.

use std::f64::consts::TAU;

use glam::{DQuat, DVec2, DVec3};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::colors::color;
use crate::plot::picture::{Area, Drawn, INK, PAPER, UNIT, font, pixel};
use crate::study::regime::Regime;
use crate::study::sample::Sample;

/// Drops beside each other and above each other.
const PANELS: (usize, usize) = (6, 2);
/// Size of the picture in pixels.
pub(crate) const SIZE: (u32, u32) = (1800, 1090);
/// Height of a panel in pixels.
const PANEL_PX: f64 = 510.0;
/// Pixels for a metre.
const SCALE_PX: f64 = 196.0;
/// Offset in the picture of a depth of one metre, in metres.
const DEPTH: DVec2 = DVec2::new(0.36, 0.27);
/// Half width and half depth of the ground of a panel in m.
const GROUND_M: (f64, f64) = (0.6, 0.3);
/// Distance of the lines of the ground in m.
const LINES_M: f64 = 0.1;
/// Time between two pictures of the piece in s.
const FLASH_S: f64 = 0.05;
/// Direction of the light.
const LIGHT: DVec3 = DVec3::new(-0.4, 0.85, -0.35);

/// A drop, from its release to the ground.
#[derive(Clone, Debug)]
pub(crate) struct Track {
    /// Name of the piece.
    pub(crate) name: String,
    /// Half axes of its area along and across, in m.
    pub(crate) half_axes_m: [f64; 2],
    /// Its way.
    pub(crate) samples: Vec<Sample>,
}

/// A panel: turns places into points of the picture.
#[derive(Clone, Copy, Debug)]
struct Panel {
    /// Point of the picture in the middle of the ground.
    foot: DVec2,
    /// Turns the drop so that it drifts to the right.
    turn: DQuat,
    /// Middle of the drop's way over the ground.
    middle: DVec3,
}

impl Panel {
    fn new(index: usize, track: &Track) -> Self {
        let ends = (track.samples.first(), track.samples.last());
        let (Some(first), Some(last)) = ends else {
            return Self { foot: DVec2::ZERO, turn: DQuat::IDENTITY, middle: DVec3::ZERO };
        };
        let way = last.position_m - first.position_m;
        let turn = DQuat::from_rotation_y(way.z.atan2(way.x));
        let turned = |position: DVec3| turn * position;
        let low = track.samples.iter().map(|sample| turned(sample.position_m)).reduce(DVec3::min);
        let high = track.samples.iter().map(|sample| turned(sample.position_m)).reduce(DVec3::max);
        let middle = 0.5 * (low.unwrap_or(DVec3::ZERO) + high.unwrap_or(DVec3::ZERO));
        let (column, row) = (index % PANELS.0, index / PANELS.0);
        let width = f64::from(SIZE.0) / PANELS.0 as f64;
        let foot = DVec2::new((column as f64 + 0.5) * width, 56.0 + (row as f64 + 1.0) * PANEL_PX - 100.0);
        Self { foot, turn, middle: middle.with_y(0.0) }
    }

    /// The point of the picture for a place of the drop.
    fn point(&self, place: DVec3) -> (i32, i32) {
        self.fixed(self.turn * place - self.middle)
    }

    /// The point of the picture for a place in the panel.
    fn fixed(&self, place: DVec3) -> (i32, i32) {
        let flat = DVec2::new(place.x, place.y) + DEPTH * place.z;
        let point = (self.foot + SCALE_PX * DVec2::new(flat.x, -flat.y)) * f64::from(UNIT);
        (pixel(point.x), pixel(point.y))
    }
}

/// Draws all drops.
pub(crate) fn draw(area: &Area<'_>, tracks: &[Track]) -> Drawn {
    let unit = UNIT as i32;
    let center = |size: u32| font(size).pos(Pos::new(HPos::Center, VPos::Center));
    let title = "Twelve drops from 1.8 m through still air, a picture every twentieth of a second";
    area.draw(&Text::new(title, (SIZE.0 as i32 * unit / 2, 44 * unit), center(34)))?;
    for (index, track) in tracks.iter().enumerate() {
        let panel = Panel::new(index, track);
        ground(area, &panel)?;
        shadow(area, &panel, track)?;
        path(area, &panel, track)?;
        flashes(area, &panel, track)?;
        let (x, y) = panel.fixed(DVec3::new(0.0, 0.0, -GROUND_M.1));
        area.draw(&Text::new(track.name.as_str(), (x, y + 26 * unit), center(23)))?;
        if index % PANELS.0 == 0 {
            scale(area, &panel)?;
        }
    }
    legend(area)
}

/// Ground with lines.
fn ground(area: &Area<'_>, panel: &Panel) -> Drawn {
    let (wide, deep) = GROUND_M;
    let corners = [(-wide, -deep), (wide, -deep), (wide, deep), (-wide, deep)];
    let corners: Vec<_> = corners.map(|(x, z)| panel.fixed(DVec3::new(x, 0.0, z))).into();
    area.draw(&Polygon::new(corners, INK.mix(0.07).filled()))?;
    let style = INK.mix(0.14).stroke_width(UNIT);
    let count = |half: f64| pixel(half / LINES_M);
    for line in -count(wide)..=count(wide) {
        let x = f64::from(line) * LINES_M;
        let ends = [-deep, deep].map(|z| panel.fixed(DVec3::new(x, 0.0, z)));
        area.draw(&PathElement::new(ends, style))?;
    }
    for line in -count(deep)..=count(deep) {
        let z = f64::from(line) * LINES_M;
        let ends = [-wide, wide].map(|x| panel.fixed(DVec3::new(x, 0.0, z)));
        area.draw(&PathElement::new(ends, style))?;
    }
    Ok(())
}

/// The way of the shadow of a light overhead.
fn shadow(area: &Area<'_>, panel: &Panel, track: &Track) -> Drawn {
    let points: Vec<_> =
        track.samples.iter().map(|sample| panel.point(sample.position_m.with_y(0.0))).collect();
    area.draw(&PathElement::new(points, INK.mix(0.34).stroke_width(3 * UNIT)))?;
    Ok(())
}

/// The way through the air.
fn path(area: &Area<'_>, panel: &Panel, track: &Track) -> Drawn {
    for pair in track.samples.windows(2) {
        let ends = [pair[0], pair[1]].map(|sample| panel.point(sample.position_m));
        area.draw(&PathElement::new(ends, color(pair[1].regime).stroke_width(2 * UNIT)))?;
    }
    Ok(())
}

/// The piece itself every now and then.
fn flashes(area: &Area<'_>, panel: &Panel, track: &Track) -> Drawn {
    let [along, across] = track.half_axes_m;
    let mut next_s = 0.0;
    for sample in &track.samples {
        if sample.time_s + 1e-9 < next_s {
            continue;
        }
        next_s += FLASH_S;
        let rim: Vec<_> = (0..48).map(|step| TAU * f64::from(step) / 48.0).collect();
        let corner = |angle: &f64| {
            let place = DVec3::new(across * angle.sin(), 0.0, along * angle.cos());
            panel.point(sample.position_m + sample.attitude * place)
        };
        let corners: Vec<_> = rim.iter().map(corner).collect();
        let light = (panel.turn * (sample.attitude * DVec3::Y)).dot(LIGHT.normalize()).abs();
        area.draw(&Polygon::new(corners.clone(), PAPER.mix(0.8).filled()))?;
        area.draw(&Polygon::new(corners.clone(), color(sample.regime).mix(0.75 - 0.5 * light).filled()))?;
        let closed: Vec<_> = corners.iter().chain(corners.first()).copied().collect();
        area.draw(&PathElement::new(closed, color(sample.regime).stroke_width(UNIT)))?;
    }
    Ok(())
}

/// Scale bar of half a metre, upwards.
fn scale(area: &Area<'_>, panel: &Panel) -> Drawn {
    let unit = UNIT as i32;
    let at = |height: f64| {
        let (x, y) = panel.fixed(DVec3::new(-0.58, height, 0.0));
        (x, y)
    };
    let style = INK.stroke_width(2 * UNIT);
    area.draw(&PathElement::new([at(1.0), at(1.5)], style))?;
    for height in [1.0, 1.5] {
        let (x, y) = at(height);
        area.draw(&PathElement::new([(x - 6 * unit, y), (x + 6 * unit, y)], style))?;
    }
    let (x, y) = at(1.25);
    let text = font(20).pos(Pos::new(HPos::Left, VPos::Center));
    area.draw(&Text::new("0.5 m", (x + 10 * unit, y), text))?;
    Ok(())
}

/// Legend of the colours, at the foot.
fn legend(area: &Area<'_>) -> Drawn {
    let unit = UNIT as i32;
    let row = (SIZE.1 as i32 - 30) * unit;
    let style = font(23).pos(Pos::new(HPos::Left, VPos::Center));
    let mut x = 300 * unit;
    for regime in Regime::ALL {
        let name = match regime {
            Regime::Steady => "steady, or not classified yet",
            _ => regime.name(),
        };
        area.draw(&Circle::new((x, row), 9 * UNIT, color(regime).filled()))?;
        area.draw(&Text::new(name, (x + 18 * unit, row), style.clone()))?;
        let width = area.estimate_text_size(name, &style)?.0;
        x += i32::try_from(width)? + 50 * unit;
    }
    let line = [(x - 9 * unit, row), (x + 9 * unit, row)];
    area.draw(&PathElement::new(line, INK.mix(0.34).stroke_width(3 * UNIT)))?;
    area.draw(&Text::new("way over the ground", (x + 18 * unit, row), style))?;
    Ok(())
}
