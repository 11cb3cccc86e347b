// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Seasons: which pigments a leaf holds on which day, and the colour that they give it.
//!
//! A small model of senescence runs day by day through an autumn ([`Course`]): short days start the loss of
//! chlorophyll, cold speeds it, cold and sunny days make anthocyanin, dead tissue turns brown. A leaf optical model
//! (`prospect`) turns pigments into reflectance and transmittance, which integrate to linear sRGB.
//!
//! A season is a number from 0 (green) over 0.6 (chlorophyll gone) to 1 (dry and brown); every species passes it in
//! its own days.

mod absorption;
mod climate;
mod course;
mod light;
mod pigments;
mod prospect;
mod recognition;
mod strip;
mod table;

pub use climate::Climate;
pub use course::{Course, Senescence};
pub use pigments::Pigments;
pub(crate) use recognition::recognise;
pub use strip::strip;
pub use table::Appearance;

use crate::Shape;

/// Pigments of a species at a season from 0 (green) to 1 (brown) in a temperate autumn.
pub fn pigments(shape: Shape, season: f32) -> Pigments {
    Course::of(shape).pigments(season)
}

/// Factor for each linear sRGB channel that carries a picture of a leaf from one stage of its pigments to another:
/// `texture = photo × R_to / R_from`. Photos keep their light, grain and blemishes this way; where the model is wrong
/// about the absolute colour, it cancels.
pub fn change(from: &Pigments, to: &Pigments) -> [f32; 3] {
    // Below this reflectance a photo holds noise rather than colour.
    const DARKEST: f32 = 0.02;
    let (from, to) = (from.appearance().reflectance, to.appearance().reflectance);
    std::array::from_fn(|i| to[i].max(DARKEST) / from[i].max(DARKEST))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn leaves_go_from_green_to_brown() {
        for shape in Shape::ALL {
            let [r, g, b] = pigments(shape, 0.0).albedo();
            assert!(g > r && r > b, "{shape:?} starts green: {r} {g} {b}");
            let [r, g, b] = pigments(shape, 1.0).albedo();
            assert!(r > g && g > b, "{shape:?} ends brown: {r} {g} {b}");
        }
    }

    #[test]
    fn change_leads_from_one_colour_to_the_other_and_back() {
        let (green, yellow) = (pigments(Shape::Birch, 0.0), pigments(Shape::Birch, 0.5));
        let (there, back) = (change(&green, &yellow), change(&yellow, &green));
        assert!(there[0] > 2.0, "red light rises when chlorophyll goes, got {there:?}");
        for i in 0..3 {
            assert!((there[i] * back[i] - 1.0).abs() < 1e-5, "channel {i} returns");
        }
        assert_eq!(change(&green, &green), [1.0; 3], "no change changes nothing");
    }
}
