// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The pictures that a renderer needs of a leaf: colour with coverage, relief, and the light that passes through.

mod petiole;
mod relief;
mod translucency;

use glam::Vec2;
use image::{GrayImage, Luma, Rgb, RgbImage, Rgba, RgbaImage};

use crate::math::to_byte;
use crate::raster::{Frame, coverage, stroke};
use crate::{Blade, TexgenError, VeinGraph, bleed};
pub(crate) use petiole::PetioleColour;
use relief::Relief;

/// Pictures of one leaf, all of one size, petiole included.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LeafMaps {
    /// sRGB colour, carried on past the edge, and straight alpha.
    pub albedo: RgbaImage,
    /// Tangent-space normal of the upper side: x to the right, y up, z towards the viewer, each -1 to 1 as 0 to 255.
    pub normal: RgbImage,
    /// Height of the upper side; 128 is the plane of the margin, 255 steps are 0.05 √A.
    pub height: GrayImage,
    /// Share of light that passes through, 0 to 1 as 0 to 255.
    pub translucency: GrayImage,
    /// The leaf, petiole included: 255 inside.
    pub mask: GrayImage,
}

/// A blade that has been painted, and its petiole.
pub(crate) struct Dressed<'a> {
    /// The blade; its picture must be square.
    pub(crate) blade: &'a Blade,
    /// Its veins.
    pub(crate) veins: &'a VeinGraph,
    /// Petiole from its free end to the blade: point and half width in pixels; may be empty.
    pub(crate) petiole: &'a [(Vec2, f32)],
    /// Colour of the blade, of the blade's size.
    pub(crate) colour: &'a RgbImage,
    /// Colour of the petiole.
    pub(crate) stem: PetioleColour,
    /// Light that passes through the blade for each unit of light that it shows.
    pub(crate) clearness: f32,
}

impl LeafMaps {
    /// Makes all maps of a leaf.
    ///
    /// # Errors
    /// [`TexgenError::OutOfRange`] for a picture that is not square or not of the blade's size.
    pub(crate) fn new(leaf: &Dressed<'_>) -> Result<Self, TexgenError> {
        let (width, height) = (leaf.blade.mask.width, leaf.blade.mask.height);
        if width != height || leaf.colour.dimensions() != (width, height) {
            let (w, h) = leaf.colour.dimensions();
            let value = format!("{width}x{height} with a picture of {w}x{h}");
            return Err(TexgenError::out_of_range("blade size", value, "square, with a picture of its size"));
        }
        let size = width as usize;
        // The raster's y points up.
        let flip = |p: Vec2| Vec2::new(p.x, -p.y);
        let frame = Frame { scale: 1.0, origin: Vec2::ZERO, size };
        let blade: Vec<Vec2> = leaf.blade.outline.iter().map(|p| flip(*p)).collect();
        let path: Vec<(Vec2, f32)> = leaf.petiole.iter().map(|(p, radius)| (flip(*p), *radius)).collect();
        let stem = if path.len() > 1 { stroke(&path) } else { Vec::new() };
        let blade_cover = coverage(&[&blade], frame);
        let cover = coverage(&[&blade, &stem], frame);
        let relief = Relief::new(leaf, &blade_cover);
        let mut albedo = RgbaImage::new(width, height);
        for (at, pixel) in albedo.pixels_mut().enumerate() {
            let alpha = to_byte(cover[at]);
            if alpha > 0 {
                let tissue = leaf.colour.as_raw()[at * 3..at * 3 + 3].try_into().unwrap_or([0; 3]);
                let [r, g, b] = leaf.stem.over(tissue, &relief.stem[at], 1.0 - blade_cover[at]);
                *pixel = Rgba([r, g, b, alpha]);
            }
        }
        bleed::bleed(&mut albedo);
        let byte = |x: f32| to_byte(x * 0.5 + 0.5);
        let normal = RgbImage::from_fn(width, height, |x, y| {
            let normal = relief.normal(x as usize, y as usize);
            Rgb([byte(normal.x), byte(normal.y), byte(normal.z)])
        });
        let at = |x: u32, y: u32| y as usize * size + x as usize;
        let heights =
            GrayImage::from_fn(width, height, |x, y| Luma([to_byte(relief.height_share(at(x, y)))]));
        let translucency = GrayImage::from_fn(width, height, |x, y| {
            let [r, g, b, _] = albedo.get_pixel(x, y).0;
            let through = translucency::transmittance([r, g, b], leaf.clearness, relief.thickness[at(x, y)]);
            Luma([to_byte(through)])
        });
        let mask =
            GrayImage::from_fn(width, height, |x, y| Luma([if cover[at(x, y)] >= 0.5 { 255 } else { 0 }]));
        Ok(Self { albedo, normal, height: heights, translucency, mask })
    }
}
