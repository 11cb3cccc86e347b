// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Amounts of pigment in a leaf.

use std::ops::{Add, Mul};

use super::table::Appearance;

/// Pigments per area of leaf.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pigments {
    /// Green, 0 to 90 µg/cm².
    pub chlorophyll: f32,
    /// Yellow, 0 to 24 µg/cm².
    pub carotenoid: f32,
    /// Red, 0 to 40 µg/cm².
    pub anthocyanin: f32,
    /// Brown of dead tissue, 0 to 4 in the unit of PROSPECT.
    pub brown: f32,
}

impl Pigments {
    /// Appearance of the pigments.
    pub fn appearance(&self) -> Appearance {
        Appearance::of([self.chlorophyll, self.carotenoid, self.anthocyanin, self.brown])
    }

    /// Linear sRGB colour in daylight from both sides.
    pub fn albedo(&self) -> [f32; 3] {
        self.appearance().in_daylight()
    }

    /// Blend with another state, `share` 0 (self) to 1.
    pub fn blend(&self, other: &Self, share: f32) -> Self {
        *self * (1.0 - share) + *other * share
    }
}

impl Add for Pigments {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            chlorophyll: self.chlorophyll + other.chlorophyll,
            carotenoid: self.carotenoid + other.carotenoid,
            anthocyanin: self.anthocyanin + other.anthocyanin,
            brown: self.brown + other.brown,
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
            brown: self.brown * factor,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_pigment_has_its_hue() {
        let yellow = Pigments { carotenoid: 9.0, ..Pigments::default() };
        let green = Pigments { chlorophyll: 40.0, ..yellow };
        let red = Pigments { anthocyanin: 20.0, ..yellow };
        let [r, g, b] = green.albedo();
        assert!(g > 1.6 * r && g > 3.0 * b, "chlorophyll must look green: {r} {g} {b}");
        let [r, g, b] = yellow.albedo();
        assert!(r > 0.4 && g > 0.4 && b < 0.15, "carotenoid must look yellow: {r} {g} {b}");
        let [r, g, b] = red.albedo();
        assert!(r > 4.0 * g && r > 4.0 * b, "anthocyanin must look red: {r} {g} {b}");
    }
}
