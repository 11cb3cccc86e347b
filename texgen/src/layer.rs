// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! One leaf as a renderer wants it: pictures with their mips, and meshes.

use glam::Vec2;
use image::imageops::{self, FilterType};
use image::{GrayImage, RgbImage, Rgba, RgbaImage};

use crate::making::PETIOLE_DROOP_DEG;
use crate::math::{linear_from_srgb, luminance, single, to_byte};
use crate::{FolderLeaf, LeafForm, mipmap};

/// Margin of the meshes beyond the outline they follow, in sides of the picture, coarse first: as far as they miss it.
const WIDER: [f32; 3] = [0.035, 0.018, 0.008];
/// Pieces of the petiole, coarse first.
const STALK_PIECES: [usize; 3] = [1, 3, 8];
/// Light that passes through what says nothing of it, for each unit of light that it shows.
const PLAIN_CLEARNESS: f32 = 0.5;

/// One leaf: upright, petiole at the bottom, straight alpha, sRGB colour that runs on past the edge.
#[derive(Clone, Debug)]
pub struct Layer {
    /// Mip levels from full size down to one texel.
    pub mips: Vec<RgbaImage>,
    /// As many levels of its surface: normal x to the right and y up, -1 to 1 as 0 to 255; share of light that passes
    /// through, 0 to 1 as 0 to 255; 255, or the arrivals of a [`BurnMap`](crate::BurnMap).
    pub surface: Vec<RgbaImage>,
    /// Meshes, coarse first, a little wider than what the picture covers.
    pub form: LeafForm,
    /// Season from 0 (green) to 1 (brown), where it is known.
    pub season: Option<f32>,
    /// Share of the square that the leaf covers, petiole included.
    pub area_fraction: f32,
    /// Centre of the covered area: x to the right and y down, as shares of the square.
    pub centre: Vec2,
}

impl Layer {
    /// A layer from a square picture whose side is a power of two and whose colour runs on past the edge, such as
    /// [`LeafMaps::albedo`](crate::LeafMaps::albedo): a flat sheet.
    ///
    /// # Panics
    /// If the picture is not square or its side no power of two.
    pub fn from_picture(image: RgbaImage) -> Self {
        let surface = RgbaImage::from_fn(image.width(), image.height(), |x, y| {
            let [r, g, b, _] = image.get_pixel(x, y).0;
            Rgba([128, 128, to_byte(PLAIN_CLEARNESS * luminance([r, g, b].map(linear_from_srgb))), 255])
        });
        let form = LeafForm::of_picture(&image);
        Self::new(image, surface, form, None)
    }

    /// A leaf in pictures of `size_px`, a power of two, with its own meshes if it has any.
    ///
    /// # Panics
    /// If `size_px` is no power of two.
    pub fn of_leaf(leaf: &FolderLeaf, size_px: u32) -> Self {
        let picture = fitted(&leaf.maps.albedo, size_px);
        let (normal, through) = (&leaf.maps.normal, &leaf.maps.translucency);
        let normal: RgbImage = imageops::resize(normal, size_px, size_px, FilterType::Triangle);
        let through: GrayImage = imageops::resize(through, size_px, size_px, FilterType::Triangle);
        let surface = RgbaImage::from_fn(size_px, size_px, |x, y| {
            let [right, up, _] = normal.get_pixel(x, y).0;
            Rgba([right, up, through.get_pixel(x, y)[0], 255])
        });
        let form = leaf.form.as_ref().map_or_else(
            || LeafForm::of_picture(&picture),
            |form| {
                let mut form = form.clone();
                let petiole = leaf.facts.body.and_then(|body| body.petiole);
                let droop_deg = petiole.map_or(PETIOLE_DROOP_DEG, |petiole| petiole.droop_deg);
                form.add_stalk(&picture, droop_deg, STALK_PIECES);
                for (level, by) in form.levels.iter_mut().zip(WIDER) {
                    level.widen(by);
                }
                form
            },
        );
        Self::new(picture, surface, form, Some(leaf.facts.season))
    }

    fn new(image: RgbaImage, surface: RgbaImage, form: LeafForm, season: Option<f32>) -> Self {
        let size_px = image.width();
        assert!(size_px.is_power_of_two() && image.height() == size_px, "square, a power of two a side");
        let (mut covered, mut moment) = (0.0_f64, [0.0_f64; 2]);
        for (x, y, texel) in image.enumerate_pixels() {
            let alpha = f64::from(texel[3]) / 255.0;
            covered += alpha;
            moment[0] += alpha * (f64::from(x) + 0.5);
            moment[1] += alpha * (f64::from(y) + 0.5);
        }
        let side = f64::from(size_px);
        let centre = moment.map(|m| single(m / covered.max(1.0) / side));
        Self {
            mips: mipmap::chain(image),
            surface: mipmap::plain_chain(surface),
            form,
            season,
            area_fraction: single(covered / (side * side)),
            centre: centre.into(),
        }
    }
}

/// A picture in another size; halved step by step, colour weighted by coverage.
fn fitted(picture: &RgbaImage, size_px: u32) -> RgbaImage {
    if picture.width() < size_px {
        return imageops::resize(picture, size_px, size_px, FilterType::Triangle);
    }
    let fits = |level: &RgbaImage| level.width() == size_px;
    mipmap::chain(picture.clone()).into_iter().find(fits).unwrap_or_else(|| picture.clone())
}
