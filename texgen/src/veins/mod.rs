// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Veins: ribs and laterals led to the outline's tips, smaller ones filling the space between.

mod dichotomous;
mod ladder;
mod pinnate;
mod territory;

use glam::Vec2;

use crate::Shape;
use crate::contour::Outline;
use crate::math::lerp;
use crate::rng::Rng;

/// Rank of a vein.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Order {
    /// Midrib and the ribs of lobes.
    Primary,
    /// Laterals of a rib.
    Secondary,
    /// Fine veins between laterals.
    Tertiary,
}

/// A vein as a tapering polyline.
#[derive(Clone, Debug)]
pub(crate) struct Vein {
    /// Points from where it starts outward.
    pub(crate) points: Vec<Vec2>,
    /// Radius at each point.
    pub(crate) radii: Vec<f32>,
    /// Rank.
    pub(crate) order: Order,
}

impl Vein {
    /// Vein whose radius goes evenly from one value to another.
    fn tapering(points: Vec<Vec2>, from: f32, to: f32, order: Order) -> Self {
        let last = points.len().saturating_sub(1).max(1) as f32;
        let radii = (0..points.len()).map(|i| lerp(from, to, i as f32 / last)).collect();
        Self { points, radii, order }
    }
}

/// How a shape's veins run.
struct Plan {
    /// Angle between a lateral and its rib in degrees.
    divergence_deg: f32,
    /// How far laterals bow towards the tip: 0 straight, 1 strongly.
    bow: f32,
    /// Spacing of additional laterals on a rib; zero for none.
    fill_spacing: f32,
    /// Spacing of the fine rungs between laterals.
    rung_spacing: f32,
    /// Radius of a lateral one unit long.
    lateral_radius: f32,
}

/// Plan of a shape.
fn plan(shape: Shape) -> Plan {
    let (divergence_deg, bow, fill_spacing, rung_spacing, lateral_radius) = match shape {
        Shape::Maple => (42.0, 0.35, 0.2, 0.11, 0.0085),
        Shape::JapaneseMaple => (42.0, 0.4, 0.0, 0.09, 0.0065),
        Shape::Oak => (42.0, 0.3, 0.24, 0.1, 0.009),
        Shape::Birch => (43.0, 0.3, 0.0, 0.08, 0.0075),
        Shape::Beech => (44.0, 0.16, 0.0, 0.07, 0.0075),
        Shape::Hornbeam => (42.0, 0.08, 0.0, 0.055, 0.0065),
        Shape::Linden | Shape::Ginkgo => (44.0, 0.4, 0.0, 0.08, 0.0078),
    };
    Plan { divergence_deg, bow, fill_spacing, rung_spacing, lateral_radius }
}

/// Grows the veins of a leaf.
pub(crate) fn grow(shape: Shape, outline: &Outline, rng: &Rng) -> Vec<Vein> {
    if shape == Shape::Ginkgo {
        return dichotomous::grow(outline, &mut rng.fork(1));
    }
    let plan = plan(shape);
    let mut veins = Vec::new();
    for (index, rib) in outline.ribs.iter().enumerate() {
        let mut rib_rng = rng.fork(10 + index as u64);
        let branches = pinnate::branch(rib, &plan, index == 0, &mut rib_rng);
        for side in [&branches.right, &branches.left] {
            veins.extend(ladder::rungs(side, plan.rung_spacing, &mut rib_rng));
            veins.extend(side.iter().cloned());
        }
        veins.push(branches.rib);
    }
    if plan.fill_spacing > 0.0 {
        territory::fill(outline, &plan, &mut veins, &mut rng.fork(2));
    }
    veins
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Rng;
    use proptest::prelude::{ProptestConfig, any, prop_assert, prop_assert_eq, proptest};

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]
        #[test]
        fn veins_taper_and_stay_near_the_leaf(seed in any::<u64>(), which in 0..Shape::ALL.len()) {
            let rng = Rng::new(seed);
            let veins = grow(Shape::ALL[which], &Outline::draw(Shape::ALL[which], &rng), &rng);
            prop_assert!(veins.len() > 20, "only {} veins", veins.len());
            for vein in &veins {
                prop_assert_eq!(vein.points.len(), vein.radii.len(), "one radius a point");
                prop_assert!(vein.points.iter().all(|p| p.is_finite() && p.length() < 3.0), "vein runs away");
                prop_assert!(vein.radii.windows(2).all(|r| r[1] <= r[0] + 1e-6), "vein widens outward");
            }
        }
    }
}
