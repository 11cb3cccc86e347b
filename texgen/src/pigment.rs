// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Colour of tissue from its pigments.
//!
//! Light passes through the tissue and is absorbed on the way, so pigments multiply (Beer and Lambert): their
//! absorbances add up, and the reflectance is the exponential of minus the sum. Mixing this way turns green over
//! olive into yellow; a straight blend of RGB colours would grey out half way.

use std::ops::{Add, Mul};

use crate::math::lerp;

/// Linear sRGB colour.
pub(crate) type Linear = [f32; 3];

/// Amounts of pigment; 1 is what a fully coloured leaf holds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Pigments {
    /// Green.
    pub(crate) chlorophyll: f32,
    /// Yellow.
    pub(crate) carotenoid: f32,
    /// Red.
    pub(crate) anthocyanin: f32,
    /// Brown, of dead tissue.
    pub(crate) tannin: f32,
}

/// Reflectance of living tissue without pigment.
const TISSUE: Linear = [0.86, 0.83, 0.66];
/// Reflectance of dry tissue without pigment.
const DRY_TISSUE: Linear = [0.72, 0.66, 0.55];
/// Absorbance of one unit of each pigment.
const CHLOROPHYLL: Linear = [2.0, 0.92, 0.75];
const CAROTENOID: Linear = [0.03, 0.17, 2.6];
const ANTHOCYANIN: Linear = [0.38, 2.75, 1.35];
const TANNIN: Linear = [0.72, 1.38, 1.9];

impl Pigments {
    /// Diffuse reflectance.
    pub(crate) fn albedo(self) -> Linear {
        let dryness = self.tannin.min(1.0);
        std::array::from_fn(|i| {
            let absorbance = self.chlorophyll * CHLOROPHYLL[i]
                + self.carotenoid * CAROTENOID[i]
                + self.anthocyanin * ANTHOCYANIN[i]
                + self.tannin * TANNIN[i];
            lerp(TISSUE[i], DRY_TISSUE[i], dryness) * (-absorbance.max(0.0)).exp()
        })
    }
}

impl Add for Pigments {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            chlorophyll: self.chlorophyll + other.chlorophyll,
            carotenoid: self.carotenoid + other.carotenoid,
            anthocyanin: self.anthocyanin + other.anthocyanin,
            tannin: self.tannin + other.tannin,
        }
    }
}

impl Mul<f32> for Pigments {
    type Output = Self;
    fn mul(self, factor: f32) -> Self {
        Self {
            chlorophyll: self.chlorophyll * factor,
            carotenoid: self.carotenoid * factor,
            anthocyanin: self.anthocyanin * factor,
            tannin: self.tannin * factor,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_pigment_has_its_hue() {
        let yellow = Pigments { carotenoid: 1.0, ..Pigments::default() };
        let green = Pigments { chlorophyll: 1.0, ..yellow };
        let red = Pigments { anthocyanin: 1.0, ..yellow };
        let [r, g, b] = green.albedo();
        assert!(g > 1.8 * r && g > 4.0 * b, "chlorophyll must look green: {r} {g} {b}");
        let [r, g, b] = yellow.albedo();
        assert!(r > 0.5 && g > 0.5 && b < 0.1, "carotenoid must look yellow: {r} {g} {b}");
        let [r, g, b] = red.albedo();
        assert!(r > 5.0 * g && r > 5.0 * b, "anthocyanin must look red: {r} {g} {b}");
    }
}
