// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Colours of particles that stand for something, in place of their own.

use windfall_core::layout::Float4;
use windfall_core::shared_constants;

shared_constants! {
    /// Particles have their own colours.
    pub(crate) const PAINT_NONE: u32 = 0;
    /// Colours stand for populations.
    pub(crate) const PAINT_POPULATION: u32 = 1;
    /// Colours stand for the speed.
    pub(crate) const PAINT_SPEED: u32 = 2;
    /// Colours stand for the time since birth.
    pub(crate) const PAINT_AGE: u32 = 3;
    /// Number of the colours.
    pub(crate) const PAINT_COLORS: u32 = 16;
}

/// Colours that stand for something.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PaintedParticles {
    /// Number of what they stand for, such as [`PAINT_SPEED`].
    pub(crate) measure: u32,
    /// Amount at their end, in m/s or s.
    pub(crate) most: f32,
    /// Linear sRGB, from low to high or by population. w unused.
    pub(crate) colors: [Float4; PAINT_COLORS as usize],
}

impl Default for PaintedParticles {
    fn default() -> Self {
        Self { measure: PAINT_NONE, most: 1.0, colors: [Float4::default(); PAINT_COLORS as usize] }
    }
}
