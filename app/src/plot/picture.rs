// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Layout that plots share: paper, ink, text, and writing to files.

use anyhow::anyhow;
use image::RgbImage;
use image::imageops::{FilterType, resize};
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontStyle, register_font};

use crate::files::OutputFile;

/// Pictures are drawn so many times larger and then reduced, for smooth edges.
pub(crate) const UNIT: u32 = 3;
/// Lines and text.
pub(crate) const INK: RGBColor = RGBColor(46, 42, 38);
/// Background.
pub(crate) const PAPER: RGBColor = RGBColor(252, 250, 246);
const FONT: &str = "Ubuntu";

/// Drawing area.
pub(crate) type Area<'a> = DrawingArea<BitMapBackend<'a>, Shift>;
/// Outcome of drawing.
pub(crate) type Drawn = Result<(), Box<dyn std::error::Error>>;

/// Text of a size in pixels of the finished picture.
pub(crate) fn font(size: u32) -> TextStyle<'static> {
    (FONT, size * UNIT).into_font().color(&INK)
}

/// Writes the heading of a plot into the strip above it.
pub(crate) fn heading(strip: &Area<'_>, text: String, size: u32) -> Drawn {
    let unit = UNIT as i32;
    let style = font(size).pos(Pos::new(HPos::Left, VPos::Center));
    strip.draw(&Text::new(text, (28 * unit, 36 * unit), style))?;
    Ok(())
}

/// The pixel nearest to a coordinate.
pub(crate) fn pixel(coordinate: f64) -> i32 {
    #[expect(clippy::cast_possible_truncation, reason = "pictures have a few thousand pixels")]
    let pixel = coordinate.round() as i32;
    pixel
}

/// Draws a picture of a size in pixels and writes it to a file that has been begun.
///
/// # Errors
/// Errors of the plotting library or the system, named with the path.
pub(crate) fn write(
    file: OutputFile,
    size: (u32, u32),
    draw: impl FnOnce(&Area<'_>) -> Drawn,
) -> anyhow::Result<()> {
    let name = file.destination().display();
    let large = enlarged(size, draw).map_err(|error| anyhow!("{name}: cannot draw: {error}"))?;
    let picture = resize(&large, size.0, size.1, FilterType::Triangle);
    Ok(file.finish_png(&picture)?)
}

fn enlarged(
    size: (u32, u32),
    draw: impl FnOnce(&Area<'_>) -> Drawn,
) -> Result<RgbImage, Box<dyn std::error::Error>> {
    register_font(FONT, FontStyle::Normal, epaint_default_fonts::UBUNTU_LIGHT)
        .map_err(|_| "the font is not usable")?;
    let (width, height) = (size.0 * UNIT, size.1 * UNIT);
    let mut large = RgbImage::new(width, height);
    {
        let area = BitMapBackend::with_buffer(&mut large, (width, height)).into_drawing_area();
        area.fill(&PAPER)?;
        draw(&area)?;
        area.present()?;
    }
    Ok(large)
}
