// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Draws over a photo what was read from it.

use glam::Vec2;
use image::{Rgb, RgbImage, imageops};

use super::Extraction;
use crate::math::{floor_i32, segment_distance, to_byte};

/// √A of the drawing in pixels, at least.
const SIDE: f32 = 420.0;
/// Colours of the outline, the petiole, root, tip and veins by order.
const OUTLINE: [u8; 3] = [0, 176, 240];
const PETIOLE: [u8; 3] = [166, 90, 220];
const ROOT: [u8; 3] = [230, 40, 40];
const TIP: [u8; 3] = [30, 60, 220];
const VEINS: [[u8; 3]; 3] = [[255, 214, 0], [255, 120, 20], [240, 240, 240]];

/// A photo with outline, root, tip and veins on it; a bar at the top is as long as root and tip are sure.
#[derive(Clone, Debug)]
pub struct Overlay {
    image: RgbImage,
    scale: f32,
}

impl Overlay {
    /// Draws an extraction; small photos are enlarged.
    pub fn of(extraction: &Extraction) -> Self {
        let specimen = &extraction.specimen;
        let blade = &specimen.blade;
        let side = (blade.mask.area() as f32).sqrt().max(1.0);
        let longest = specimen.picture.width().max(specimen.picture.height()) as f32;
        let scale = (SIDE / side).clamp(1.0, 6.0).min((3000.0 / longest).max(1.0));
        let size = |pixels: u32| floor_i32(pixels as f32 * scale).max(1).unsigned_abs();
        let (width, height) = (size(specimen.picture.width()), size(specimen.picture.height()));
        let image = imageops::resize(&specimen.picture, width, height, imageops::FilterType::CatmullRom);
        let mut overlay = Self { image, scale };
        for (a, b) in blade.outline.iter().zip(blade.outline.iter().cycle().skip(1)) {
            overlay.line(*a, *b, 1.2, OUTLINE);
        }
        overlay.tint(extraction);
        for order in [3, 2, 1] {
            for node in specimen.veins.nodes.iter().filter(|node| node.order.clamp(1, 3) == order) {
                let Some(parent) = node.parent else { continue };
                let width = (2.0 * node.radius * scale).clamp(1.2, 8.0);
                let from = specimen.veins.nodes[parent as usize].position;
                overlay.line(from, node.position, width, VEINS[usize::from(order) - 1]);
            }
        }
        overlay.dot(blade.root, 6.0, ROOT);
        overlay.dot(blade.tip, 6.0, TIP);
        overlay.bar(blade.confidence);
        overlay
    }

    /// The drawing.
    pub fn image(&self) -> &RgbImage {
        &self.image
    }

    /// Tints the petiole.
    fn tint(&mut self, extraction: &Extraction) {
        let scale = self.scale;
        for (x, y, pixel) in self.image.enumerate_pixels_mut() {
            let from = |at: u32| floor_i32((at as f32 + 0.5) / scale);
            if extraction.petiole.contains(from(x), from(y)) {
                mix(pixel, PETIOLE, 0.6);
            }
        }
    }

    /// A line between two points of the photo, `width` pixels of the drawing wide.
    fn line(&mut self, a: Vec2, b: Vec2, width: f32, colour: [u8; 3]) {
        let (a, b) = (a * self.scale, b * self.scale);
        let reach = Vec2::splat(width / 2.0 + 1.0);
        let (low, high) = (a.min(b) - reach, a.max(b) + reach);
        let columns = floor_i32(low.x).max(0)..=floor_i32(high.x);
        for y in floor_i32(low.y).max(0)..=floor_i32(high.y) {
            for x in columns.clone() {
                let (column, row) = (x.unsigned_abs(), y.unsigned_abs());
                let Some(pixel) = self.image.get_pixel_mut_checked(column, row) else { continue };
                let distance = segment_distance(Vec2::new(x as f32 + 0.5, y as f32 + 0.5), a, b).0;
                mix(pixel, colour, (width / 2.0 + 0.5 - distance).clamp(0.0, 1.0));
            }
        }
    }

    /// A filled circle with a white rim.
    fn dot(&mut self, at: Vec2, radius: f32, colour: [u8; 3]) {
        self.line(at, at, 2.0 * radius + 4.0, [255; 3]);
        self.line(at, at, 2.0 * radius, colour);
    }

    /// A bar of a share of the width.
    fn bar(&mut self, share: f32) {
        let length = self.image.width() as f32 * share / self.scale;
        let y = 3.0 / self.scale;
        self.line(
            Vec2::new(0.0, y),
            Vec2::new(length, y),
            5.0,
            if share >= 0.6 { [40, 170, 70] } else { ROOT },
        );
    }
}

/// Blends a colour over a pixel.
fn mix(pixel: &mut Rgb<u8>, colour: [u8; 3], share: f32) {
    for (channel, target) in pixel.0.iter_mut().zip(colour) {
        *channel = to_byte((f32::from(*channel) * (1.0 - share) + f32::from(target) * share) / 255.0);
    }
}
