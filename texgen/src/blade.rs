// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The area that a leaf covers in a picture, and where its ends are.
//!
//! Coordinates are pixels, x to the right and y down; the centre of the first pixel is (0.5, 0.5). Lengths that
//! mean something for a leaf are shares of √A, A being the blade's area in pixels.

use glam::Vec2;

/// Pixels that belong to a leaf.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mask {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Row after row, `true` inside.
    pub inside: Vec<bool>,
}

/// A leaf's blade without its petiole.
#[derive(Clone, Debug, PartialEq)]
pub struct Blade {
    /// Pixels of the blade.
    pub mask: Mask,
    /// Margin: a closed polygon, counter-clockwise with y up, first point not repeated.
    pub outline: Vec<Vec2>,
    /// Junction of petiole and blade.
    pub root: Vec2,
    /// The far end of the midrib.
    pub tip: Vec2,
    /// Confidence of root and tip: 0 (guessed) to 1 (known, as for a blade that was drawn).
    pub confidence: f32,
}

impl Mask {
    /// A mask without any pixel inside.
    pub fn empty(width: u32, height: u32) -> Self {
        Self { width, height, inside: vec![false; width as usize * height as usize] }
    }

    /// Returns true if a pixel is inside; pixels off the grid are not.
    pub fn contains(&self, x: i32, y: i32) -> bool {
        match (u32::try_from(x), u32::try_from(y)) {
            (Ok(x), Ok(y)) if x < self.width && y < self.height => {
                self.inside[y as usize * self.width as usize + x as usize]
            }
            _ => false,
        }
    }

    /// Number of pixels inside.
    pub fn area(&self) -> usize {
        self.inside.iter().filter(|inside| **inside).count()
    }
}
