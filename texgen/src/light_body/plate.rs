// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A disc of red card with a darker ring, so that its turning is seen.

use glam::Vec2;

use super::{Drawn, line, mix};
use crate::math::polar;

const CORNERS: u16 = 96;

pub(super) fn draw() -> Drawn {
    // Bearings run clockwise.
    let outline = (0..CORNERS).rev().map(|i| polar(360.0 * f32::from(i) / f32::from(CORNERS), 1.0)).collect();
    let colour = |p: Vec2| {
        let ring = line(p.length() - 0.78, 0.06);
        let stripe = line(p.x, 0.05) * if p.y > 0.0 && p.length() < 0.78 { 1.0 } else { 0.0 };
        mix([0.62, 0.06, 0.035], [0.85, 0.8, 0.7], ring.max(stripe))
    };
    Drawn { outline, extras: Vec::new(), colour: Box::new(colour) }
}
