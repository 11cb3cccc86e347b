// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Colours of regimes, those of the window.

use plotters::style::RGBColor;
use windfall_render::MOTIONS;

use crate::study::regime::Regime;

/// Colour of a regime.
pub(super) fn color(regime: Regime) -> RGBColor {
    let motion = match regime {
        Regime::Steady => 0,
        Regime::Tumble => 1,
        Regime::Chaotic => 2,
        Regime::Flutter => 3,
        Regime::Helical => 4,
        Regime::Spiral => 5,
        Regime::Autorotation => 6,
    };
    let [red, green, blue] = MOTIONS[motion].1;
    RGBColor(red, green, blue)
}
