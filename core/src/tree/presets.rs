// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The kinds of trees that travel in the program: grammar, wood, foliage.

use super::grammar::Grammar;
use crate::scene::{Foliage, LeafShape, TreeForm, TreeKind, TreePreset, Wood};

impl TreePreset {
    /// All of them.
    pub const ALL: [Self; 6] = [Self::Maple, Self::Birch, Self::Oak, Self::Bush, Self::Weed, Self::BerryBush];

    /// Name that a scene's trees refer to it by, in any mixture of capital and small letters.
    pub fn name(self) -> &'static str {
        match self {
            Self::Maple => "maple",
            Self::Birch => "birch",
            Self::Oak => "oak",
            Self::Bush => "bush",
            Self::Weed => "weed",
            Self::BerryBush => "berry-bush",
        }
    }

    /// The preset of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|preset| preset.name().eq_ignore_ascii_case(name))
    }

    /// The text of its grammar.
    pub fn text(self) -> &'static str {
        match self {
            Self::Maple => include_str!("../../trees/maple.lsys"),
            Self::Birch => include_str!("../../trees/birch.lsys"),
            Self::Oak => include_str!("../../trees/oak.lsys"),
            Self::Bush => include_str!("../../trees/bush.lsys"),
            Self::Weed => include_str!("../../trees/weed.lsys"),
            Self::BerryBush => include_str!("../../trees/berry-bush.lsys"),
        }
    }

    /// Its grammar.
    pub fn grammar(self) -> Grammar {
        Grammar::parse(self.text()).expect("presets are tested to be in order")
    }

    /// Most segments that one has, whatever its number.
    pub fn most_segments(self) -> usize {
        match self {
            Self::Maple => 900,
            Self::Birch => 1150,
            Self::Oak => 1150,
            Self::Bush => 750,
            Self::Weed => 60,
            Self::BerryBush => 300,
        }
    }

    /// Shapes that its leaves may have, the best first.
    pub fn leaf_shapes(self) -> &'static [LeafShape] {
        match self {
            Self::Maple => &[LeafShape::Maple, LeafShape::JapaneseMaple],
            Self::Birch => &[LeafShape::Birch],
            Self::Oak => &[LeafShape::Oak],
            Self::Bush => &[LeafShape::Hornbeam, LeafShape::Beech],
            Self::Weed => &[LeafShape::Linden, LeafShape::Birch],
            Self::BerryBush => &[LeafShape::Beech, LeafShape::Hornbeam],
        }
    }

    /// The kind with its usual wood and foliage, leaves of no species yet.
    ///
    /// # Source
    /// Green wood of trees: T. Jackson et al. (2019). Bushes and herbs are estimates.
    pub fn kind(self) -> TreeKind {
        let (youngs_modulus_gpa, density_kg_m3, anchorage, leaf_area_index, areal_density_kg_m2, strength_n) =
            match self {
                Self::Maple => (8.4, 721.0, 0.95, 4.5, 0.24, 3.2),
                Self::Birch => (9.9, 801.0, 1.5, 3.0, 0.36, 2.0),
                Self::Oak => (10.5, 865.0, 0.42, 5.0, 0.42, 4.0),
                Self::Bush => (7.0, 850.0, 2.0, 3.5, 0.25, 2.0),
                Self::Weed => (1.0, 900.0, 5.0, 3.0, 0.2, 1.0),
                Self::BerryBush => (5.0, 850.0, 2.0, 2.5, 0.25, 1.2),
            };
        TreeKind {
            name: self.name().into(),
            form: TreeForm::Preset(self),
            wood: Wood { youngs_modulus_gpa, density_kg_m3, anchorage, ..Wood::default() },
            foliage: Foliage { leaf_area_index, areal_density_kg_m2, strength_n, ..Foliage::default() },
        }
    }
}
