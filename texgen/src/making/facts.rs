// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Sizes and masses of leaves.

use crate::math::{lerp, smoothstep};
use crate::outline_model::centroid;
use crate::rng::Rng;
use crate::{BodyFacts, DrawnLeaf, LeafFacts, PetioleFacts, Shape};

/// Size and mass of a kind of leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Build {
    /// Diameter in metres of the disc with the blade's mean area.
    pub disc_m: f32,
    /// Mass per area of the blade in kg/m² of a fallen, dry leaf, petiole included.
    pub dry_kg_m2: f32,
    /// Mass per area of the blade in kg/m² of a fresh leaf, petiole included.
    pub fresh_kg_m2: f32,
    /// Share of the petiole in that mass.
    pub petiole_share: f32,
}

/// Half the range of diameters as a share of the mean.
const SIZE_SPREAD: f32 = 0.18;
/// Angle in degrees by which the petiole of a dry leaf hangs below the plane of its blade. An assumption: no measurement of it
/// was found.
pub(crate) const PETIOLE_DROOP_DEG: f32 = 15.0;

impl Default for Build {
    /// A middling broad leaf.
    fn default() -> Self {
        Self { disc_m: 0.07, dry_kg_m2: 0.055, fresh_kg_m2: 0.15, petiole_share: 0.1 }
    }
}

impl Build {
    /// Build of a kind of leaf: round numbers for orientation, not measurements of one tree.
    ///
    /// # Source
    /// Shares of petioles: 0.07 to 0.21 of the blade's dry mass in four trees, birch and linden among them (Niinemets and Kull 1999),
    /// 0.11 of the leaf's in the mean over 122 species (Niinemets and others 2007); the rest by length and thickness.
    pub fn of(shape: Shape) -> Self {
        let (disc_m, dry_kg_m2, petiole_share) = match shape {
            Shape::Maple => (0.105, 0.055, 0.14),
            Shape::JapaneseMaple => (0.055, 0.042, 0.1),
            Shape::Oak => (0.075, 0.07, 0.02),
            Shape::Birch => (0.042, 0.048, 0.065),
            Shape::Beech => (0.06, 0.05, 0.02),
            Shape::Hornbeam => (0.055, 0.048, 0.03),
            Shape::Linden => (0.065, 0.045, 0.09),
            Shape::Ginkgo => (0.062, 0.065, 0.12),
        };
        Self { disc_m, dry_kg_m2, petiole_share, ..Self::default() }
    }

    /// Numbers of a leaf that has been drawn.
    pub(super) fn facts(
        &self,
        kind: &str,
        number: u32,
        season: f32,
        leaf: &DrawnLeaf,
        rng: &mut Rng,
    ) -> LeafFacts {
        let disc_m = self.disc_m * (1.0 + SIZE_SPREAD * rng.bell());
        let area_m2 = std::f32::consts::FRAC_PI_4 * disc_m * disc_m;
        let blade_px = leaf.blade.mask.area().max(1) as f32;
        let pixel_m = (area_m2 / blade_px).sqrt();
        let length_px = leaf.blade.root.distance(leaf.blade.tip).max(1.0);
        let areal = lerp(self.fresh_kg_m2, self.dry_kg_m2, smoothstep(0.15, 0.85, season));
        LeafFacts {
            name: format!("{kind}-{:03}", number + 1),
            season,
            area_m2,
            mass_kg: area_m2 * areal,
            mean_chord_m: blade_px / length_px * pixel_m,
            side_m: leaf.blade.mask.width as f32 * pixel_m,
            body: leaf.blade.mask.planform().map(|(aspect, extent)| BodyFacts {
                aspect,
                extent,
                curl: 0.0,
                petiole: self.petiole(leaf),
            }),
            has_mesh: false,
        }
    }

    /// Petiole of a leaf that has been drawn.
    fn petiole(&self, leaf: &DrawnLeaf) -> Option<PetioleFacts> {
        let (end, _) = leaf.petiole.first()?;
        let radius_px = (leaf.blade.mask.area().max(1) as f32 / std::f32::consts::PI).sqrt();
        let root = leaf.blade.root;
        Some(PetioleFacts {
            base: root.distance(centroid(&leaf.blade.outline)) / radius_px,
            length: root.distance(*end) / radius_px,
            mass: self.petiole_share,
            droop_deg: PETIOLE_DROOP_DEG,
        })
    }
}
