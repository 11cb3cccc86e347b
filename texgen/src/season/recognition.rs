// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Season of a photographed leaf.

use super::pigments;
use crate::Shape;
use crate::lab::{Lab, from_linear};

/// Seasons that are tried.
const STEPS: u8 = 100;
/// Weight of lightness, which depends on the photo's exposure as much as on the leaf.
const LIGHTNESS: f32 = 0.4;

/// The season (0 to 1) and kind of leaf whose pigments look most like a colour; only seasons of `shape` if one is given.
pub(crate) fn recognise(mean: Lab, shape: Option<Shape>) -> (Shape, f32) {
    let given = shape.map(|shape| [shape]);
    let shapes: &[Shape] = given.as_ref().map_or(&Shape::ALL, |shape| shape);
    let candidates =
        shapes.iter().flat_map(|shape| (0..=STEPS).map(|step| (*shape, f32::from(step) / f32::from(STEPS))));
    let off = |&(shape, season): &(Shape, f32)| {
        let look = pigments(shape, season).appearance();
        // A leaf on white paper: what it lets through comes back through it.
        let on_paper =
            std::array::from_fn(|i| look.reflectance[i] + look.transmittance[i] * look.transmittance[i]);
        let lab = from_linear(on_paper);
        let [l, a, b] = [0, 1, 2].map(|i| lab[i] - mean[i]);
        LIGHTNESS * l * l + a * a + b * b
    };
    candidates.min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or((Shape::Beech, 0.5))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn green_yellow_and_brown_are_told_apart() {
        let season = |rgb| recognise(crate::lab::from_srgb(rgb), Some(Shape::Beech)).1;
        let (green, yellow, brown) = (season([62, 98, 38]), season([196, 162, 52]), season([128, 84, 48]));
        assert!(green < 0.35 && green < yellow && yellow < brown && brown > 0.7, "{green} {yellow} {brown}");
    }

    #[test]
    fn red_leaves_belong_to_a_kind_that_reddens() {
        let (shape, _) = recognise(crate::lab::from_srgb([150, 38, 30]), None);
        assert!(matches!(shape, Shape::Maple | Shape::JapaneseMaple), "{shape:?}");
    }
}
