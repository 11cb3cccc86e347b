// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Sizes and masses of leaves.

use crate::math::{lerp, smoothstep};
use crate::rng::Rng;
use crate::{BodyFacts, DrawnLeaf, LeafFacts, LeafMaps, Shape};

/// Size and mass of a kind of leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Build {
    /// Diameter in metres of the disc with the blade's mean area.
    pub disc_m: f32,
    /// Mass per area in kg/m² of a fallen, dry leaf.
    pub dry_kg_m2: f32,
    /// Mass per area in kg/m² of a fresh leaf.
    pub fresh_kg_m2: f32,
}

/// Half the range of diameters as a share of the mean.
const SIZE_SPREAD: f32 = 0.18;

impl Default for Build {
    /// A middling broad leaf.
    fn default() -> Self {
        Self { disc_m: 0.07, dry_kg_m2: 0.055, fresh_kg_m2: 0.15 }
    }
}

impl Build {
    /// Build of a kind of leaf: round numbers for orientation, not measurements of one tree.
    pub fn of(shape: Shape) -> Self {
        let (disc_m, dry_kg_m2) = match shape {
            Shape::Maple => (0.105, 0.055),
            Shape::JapaneseMaple => (0.055, 0.042),
            Shape::Oak => (0.075, 0.07),
            Shape::Birch => (0.042, 0.048),
            Shape::Beech => (0.06, 0.05),
            Shape::Hornbeam => (0.055, 0.048),
            Shape::Linden => (0.065, 0.045),
            Shape::Ginkgo => (0.062, 0.065),
        };
        Self { disc_m, dry_kg_m2, ..Self::default() }
    }

    /// Numbers of a leaf that has been drawn.
    pub(super) fn facts(
        &self,
        kind: &str,
        number: u32,
        season: f32,
        leaf: &DrawnLeaf,
        maps: &LeafMaps,
        rng: &mut Rng,
    ) -> LeafFacts {
        let disc_m = self.disc_m * (1.0 + SIZE_SPREAD * rng.bell());
        let area_m2 = std::f32::consts::FRAC_PI_4 * disc_m * disc_m;
        let blade_px = leaf.blade.mask.area().max(1) as f32;
        let pixel_m = (area_m2 / blade_px).sqrt();
        let length_px = leaf.blade.root.distance(leaf.blade.tip).max(1.0);
        let covered: f32 = maps.albedo.pixels().map(|pixel| f32::from(pixel[3]) / 255.0).sum();
        let areal = lerp(self.fresh_kg_m2, self.dry_kg_m2, smoothstep(0.15, 0.85, season));
        LeafFacts {
            name: format!("{kind}-{:03}", number + 1),
            season,
            area_m2,
            mass_kg: covered * pixel_m * pixel_m * areal,
            mean_chord_m: blade_px / length_px * pixel_m,
            side_m: leaf.blade.mask.width as f32 * pixel_m,
            body: leaf.blade.mask.planform().map(|(aspect, extent)| BodyFacts { aspect, extent, curl: 0.0 }),
            has_mesh: false,
        }
    }
}
