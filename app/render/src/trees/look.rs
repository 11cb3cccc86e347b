// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Appearance of a tree: its bark, and the season of its own leaves.

use glam::Vec3;
use windfall_core::Scene;
use windfall_core::arith::rng::{random, unit_float};
use windfall_core::scene::{LeafShape, Tree, TreeForm, TreeKind, TreePreset};

/// Stream of the random numbers of looks.
const STREAM: u32 = 0x6c6f_6f6b;

/// Kinds of bark that are painted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BarkKind {
    /// Flat grey-brown ridges.
    Maple,
    /// White, with dark lenticels across.
    Birch,
    /// Deep furrows.
    Oak,
    /// Smooth and green-brown, with pale lenticels.
    Shrub,
    /// The green, ribbed stalk of a herb.
    Herb,
}

impl BarkKind {
    /// All, in the order of their numbers.
    pub const ALL: [Self; 5] = [Self::Maple, Self::Birch, Self::Oak, Self::Shrub, Self::Herb];

    /// The bark of a kind of trees; that of unknown ones goes by their leaves.
    fn of(kind: &TreeKind, shape: Option<LeafShape>) -> Self {
        match &kind.form {
            TreeForm::Preset(TreePreset::Maple) => Self::Maple,
            TreeForm::Preset(TreePreset::Birch) => Self::Birch,
            TreeForm::Preset(TreePreset::Oak) => Self::Oak,
            TreeForm::Preset(TreePreset::Bush | TreePreset::BerryBush) => Self::Shrub,
            TreeForm::Preset(TreePreset::Weed) => Self::Herb,
            _ => match shape {
                Some(LeafShape::Birch) => Self::Birch,
                Some(LeafShape::Oak) => Self::Oak,
                _ => Self::Maple,
            },
        }
    }
}

/// Differences of one tree from the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// Its bark.
    pub bark: BarkKind,
    /// Place of its leaf pictures in the species' order of the year: 0 the greenest, 1 the brownest.
    pub turned: f32,
    /// Range of that order over its leaves.
    pub turned_range: f32,
    /// Factor on the colour of its leaves.
    pub(crate) tint: Vec3,
    /// Random number of its own, 0 to 1.
    pub(crate) own: f32,
    /// True if its wood hides under leaves from the ground up.
    pub(crate) is_low: bool,
}

impl Look {
    /// The look of a tree of this kind, whose leaves belong to a species of the scene.
    pub(super) fn of(scene: &Scene, tree: &Tree, kind: &TreeKind, species: Option<u32>) -> Self {
        let shape = species.and_then(|index| scene.species.get(index as usize)).map(|species| species.shape);
        let [x, z] = tree.at_m.map(f32::to_bits);
        let draw = random([x, z], tree.number, STREAM).map(unit_float);
        let turned = (0.1 + 0.8 * scene.autumn + 0.55 * (draw[0] - 0.5)).clamp(0.0, 1.0);
        let warm = 0.10 * (draw[1] - 0.5);
        let bright = 1.0 + 0.18 * (draw[2] - 0.5);
        let bark = BarkKind::of(kind, shape);
        Self {
            bark,
            turned,
            turned_range: 0.15 + 0.45 * scene.autumn,
            tint: bright * Vec3::new(1.0 + warm, 1.0, 1.0 - warm),
            own: draw[3],
            is_low: matches!(bark, BarkKind::Shrub | BarkKind::Herb),
        }
    }
}
