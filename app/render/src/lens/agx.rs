// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The curve of the filmic tone map: AgX, Troy Sobotka 2022.
//!
//! Light on a logarithmic scale, 10 stops below to 6.5 above middle grey, becomes encoded light by a sigmoid with a straight
//! middle: t / (1 + |t|^p)^(1/p), scaled on either side of middle grey so that it ends exactly in black and in white.

use windfall_core::shared_constants;

shared_constants! {
    /// Luminance that automatic exposure makes of the log-average, and every tone map of itself but for Reinhard's.
    pub(crate) const MIDDLE_GREY: f32 = 0.18;
    /// Stops below middle grey.
    const STOPS_BELOW: f32 = 10.0;
    /// All stops.
    const STOPS: f32 = 16.5;
    /// Exponent of the display.
    const DISPLAY: f32 = 2.2;
}

/// Contrast of middle greys: 1 is that of the scene. Film, and what people like in pictures, has more.
const CONTRAST: f32 = 1.25;
/// Exponent of the curve's toe and shoulder: that of AgX in Blender.
const BEND: f32 = 1.5;

/// The curve through black, middle grey and white.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Curve {
    contrast: f32,
}

/// The curve in use.
pub(crate) const CURVE: Curve = Curve { contrast: CONTRAST };

impl Curve {
    /// Place of middle grey on the logarithmic scale and on that of encoded light.
    fn pivot() -> (f32, f32) {
        (STOPS_BELOW / STOPS, MIDDLE_GREY.powf(1.0 / DISPLAY))
    }

    /// Encoded light for each unit of the logarithmic scale, at middle grey.
    fn slope(self) -> f32 {
        // d(2^(stops / display)) / d(stops) there, over all stops.
        self.contrast * Self::pivot().1 * std::f32::consts::LN_2 / DISPLAY * STOPS
    }

    /// Slope at middle grey, height of the sigmoid below and above it, exponent of its bend.
    pub(crate) fn constants(self) -> [f32; 4] {
        let (x, y) = Self::pivot();
        let slope = self.slope();
        // The height h for which h · sigmoid(slope · width / h) is `rise`.
        let height = |width: f32, rise: f32| {
            let line = slope * width;
            (rise.powf(-BEND) - line.powf(-BEND)).powf(-1.0 / BEND)
        };
        [slope, height(x, y), height(1.0 - x, 1.0 - y), BEND]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_has_room_on_both_sides() {
        let (x, y) = Curve::pivot();
        assert!(CURVE.slope() * x > y && CURVE.slope() * (1.0 - x) > 1.0 - y, "steeper than a straight line");
        let [_, low, high, _] = CURVE.constants();
        assert!(low > y && high > 1.0 - y, "the sigmoid is cut before it is flat: {low} {high}");
    }
}
