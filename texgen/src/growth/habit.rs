// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Differences between the veins of one kind of leaf and another's.

use crate::Shape;

/// Arrangement of the main veins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Layout {
    /// One midrib.
    Pinnate,
    /// Main veins fan out from the root, one to each lobe; at most so many.
    Palmate(u32),
    /// Veins fork again and again and never meet (ginkgo).
    Fan,
}

/// Ends of the laterals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LateralTargets {
    /// Evenly along the margin, wherever the lateral's angle leads.
    Even,
    /// In the tooth nearest to that place; size of a tooth as a share of √A.
    Teeth(f32),
    /// One in each lobe, and finer ones between; size of a lobe as a share of √A.
    Lobes(f32),
}

/// Courses of veins. Lengths are shares of √A, angles degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Habit {
    /// Arrangement of the main veins.
    pub layout: Layout,
    /// Fewest and most pairs of laterals on the midrib.
    pub lateral_pairs: (u32, u32),
    /// Angle between a lateral and its main vein, 25 to 70.
    pub divergence_deg: f32,
    /// Bow of the laterals towards the tip: 0 straight, 1 strongly.
    pub bow: f32,
    /// Ends of the laterals.
    pub targets: LateralTargets,
    /// Offset of the laterals of one side against the other's, in spacings: 0 opposite, 0.5 alternate.
    pub stagger: f32,
    /// Greatest turn of a growth step, 0 to 30.
    pub wander_deg: f32,
    /// Half the midrib's width at the root.
    pub root_radius: f32,
}

impl Default for Habit {
    /// A pinnate leaf of no particular kind.
    fn default() -> Self {
        Self {
            layout: Layout::Pinnate,
            lateral_pairs: (5, 8),
            divergence_deg: 46.0,
            bow: 0.25,
            targets: LateralTargets::Even,
            stagger: 0.3,
            wander_deg: 9.0,
            root_radius: 0.0105,
        }
    }
}

impl Habit {
    /// Habit of a kind of leaf.
    pub fn of(shape: Shape) -> Self {
        let base = Self::default();
        match shape {
            Shape::Maple => Self {
                layout: Layout::Palmate(5),
                lateral_pairs: (3, 4),
                divergence_deg: 42.0,
                targets: LateralTargets::Lobes(0.09),
                ..base
            },
            Shape::JapaneseMaple => Self {
                layout: Layout::Palmate(9),
                lateral_pairs: (5, 7),
                divergence_deg: 44.0,
                bow: 0.4,
                wander_deg: 6.0,
                root_radius: 0.009,
                ..base
            },
            Shape::Oak => Self {
                lateral_pairs: (4, 7),
                divergence_deg: 44.0,
                bow: 0.2,
                targets: LateralTargets::Lobes(0.13),
                stagger: 0.4,
                wander_deg: 11.0,
                root_radius: 0.0125,
                ..base
            },
            Shape::Birch => Self {
                lateral_pairs: (5, 7),
                divergence_deg: 46.0,
                targets: LateralTargets::Teeth(0.05),
                wander_deg: 8.0,
                root_radius: 0.009,
                ..base
            },
            Shape::Beech => Self {
                lateral_pairs: (5, 9),
                divergence_deg: 46.0,
                bow: 0.12,
                targets: LateralTargets::Teeth(0.08),
                stagger: 0.35,
                wander_deg: 6.0,
                ..base
            },
            Shape::Hornbeam => Self {
                lateral_pairs: (10, 15),
                divergence_deg: 44.0,
                bow: 0.06,
                targets: LateralTargets::Teeth(0.03),
                stagger: 0.3,
                wander_deg: 4.0,
                root_radius: 0.0095,
                ..base
            },
            Shape::Linden => {
                Self { lateral_pairs: (4, 6), divergence_deg: 50.0, bow: 0.45, stagger: 0.2, ..base }
            }
            Shape::Ginkgo => Self {
                layout: Layout::Fan,
                lateral_pairs: (0, 0),
                wander_deg: 2.0,
                root_radius: 0.008,
                ..base
            },
        }
    }
}
