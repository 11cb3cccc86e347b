// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Drawn outlines as pixels.

use glam::Vec2;

use super::Outline;
use super::bend::Bend;
use crate::raster::{Frame, coverage};
use crate::rng::Rng;
use crate::{Blade, Mask, Shape, TexgenError};

/// A leaf drawn without any photo: blade and petiole, upright, petiole down.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnLeaf {
    /// Blade on a square picture; root and tip are known.
    pub blade: Blade,
    /// Petiole from its free end to the blade: point and half width in pixels.
    pub petiole: Vec<(Vec2, f32)>,
}

/// Empty border around blade and petiole, as a share of the picture's side.
const BORDER: f32 = 0.016;

impl Shape {
    /// Draws the outline of one leaf of this shape on a square picture; equal arguments give equal leaves.
    ///
    /// # Errors
    /// [`TexgenError::OutOfRange`] unless `size_px` is 16 to 8192.
    pub fn draw(self, size_px: u32, seed: u64) -> Result<DrawnLeaf, TexgenError> {
        if !(16..=8192).contains(&size_px) {
            return Err(TexgenError::out_of_range("size_px", size_px, "16 to 8192"));
        }
        let rng = Rng::new(seed);
        let mut outline = Outline::draw(self, &rng.fork(10));
        let bend = Bend::draw(&mut rng.fork(12));
        outline.tip = bend.apply(outline.tip);
        for p in outline.blade.iter_mut().chain(outline.petiole.iter_mut().map(|(p, _)| p)) {
            *p = bend.apply(*p);
        }
        Ok(rasterise(&outline, size_px))
    }
}

/// Puts an outline on a grid.
fn rasterise(outline: &Outline, size_px: u32) -> DrawnLeaf {
    let size = size_px as usize;
    let stem = crate::raster::stroke(&outline.petiole);
    let around = outline.blade.iter().chain(&stem).copied();
    let frame = Frame::around(around, size, BORDER * size_px as f32);
    let inside = coverage(&[&outline.blade], frame).iter().map(|share| *share >= 0.5).collect();
    let blade = Blade {
        mask: Mask { width: size_px, height: size_px, inside },
        outline: outline.blade.iter().map(|p| frame.to_texel(*p)).collect(),
        root: frame.to_texel(Vec2::NEG_Y),
        tip: frame.to_texel(outline.tip),
        confidence: 1.0,
    };
    let petiole =
        outline.petiole.iter().map(|(p, radius)| (frame.to_texel(*p), radius * frame.scale)).collect();
    DrawnLeaf { blade, petiole }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mask_and_outline_agree() {
        for shape in Shape::ALL {
            let leaf = shape.draw(256, 3).expect("the size is allowed");
            let outline = &leaf.blade.outline;
            let next = outline.iter().cycle().skip(1);
            let area = outline.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum::<f32>() / -2.0;
            let pixels = leaf.blade.mask.area() as f32;
            assert!((pixels / area - 1.0).abs() < 0.01, "{shape:?}: {pixels} pixels, polygon {area}");
            let (root, tip) = (leaf.blade.root, leaf.blade.tip);
            assert!(root.y > tip.y, "{shape:?} stands with its petiole down");
        }
    }

    #[test]
    fn sizes_are_checked() {
        let refused = Shape::Oak.draw(8, 1);
        assert!(matches!(refused, Err(TexgenError::OutOfRange { .. })), "8 pixels are too few");
    }
}
