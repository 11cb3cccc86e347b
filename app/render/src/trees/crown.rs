// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Extent of a tree's leaves as an ellipsoid: enough to know how deep in the crown a leaf sits.

use glam::Vec3;
use windfall_core::tree::Skeleton;

/// Share of the leaves that lie beyond the ellipsoid on either side of each axis: stray twigs make no crown.
const STRAY: f32 = 0.02;
/// Smallest half axis in metres.
const LEAST_M: f32 = 0.1;

/// An ellipsoid with upright axes around the leaves of a tree, or around its wood if it bears none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Crown {
    /// Centre in metres.
    pub(crate) center_m: Vec3,
    /// Half axes in metres.
    pub(crate) radii_m: Vec3,
}

impl Crown {
    /// The crown of a tree that stands at `foot_m`.
    pub(crate) fn of(skeleton: &Skeleton, foot_m: Vec3) -> Self {
        let mut places: Vec<Vec3> = skeleton.attachments.iter().map(|at| at.at_m).collect();
        if places.is_empty() {
            places = skeleton.segments.iter().map(|segment| segment.end_m).collect();
        }
        places.iter_mut().for_each(|at| *at += foot_m);
        let range = |axis: usize| {
            let mut along: Vec<f32> = places.iter().map(|at| at[axis]).collect();
            along.sort_by(f32::total_cmp);
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a share of a length"
            )]
            let stray = (along.len() as f32 * STRAY) as usize;
            match along.len() {
                0 => (foot_m[axis], foot_m[axis]),
                count => (along[stray], along[count - 1 - stray]),
            }
        };
        let (low, high): (Vec<f32>, Vec<f32>) = (0..3).map(range).unzip();
        let (low, high) = (Vec3::new(low[0], low[1], low[2]), Vec3::new(high[0], high[1], high[2]));
        // The box touches the ellipsoid only at six points; leaves fill its corners a little.
        Self { center_m: 0.5 * (low + high), radii_m: (0.53 * (high - low)).max(Vec3::splat(LEAST_M)) }
    }
}

#[cfg(test)]
mod tests {
    use windfall_core::tree::{Attachment, AttachmentKind};

    use super::*;

    #[test]
    fn crown_surrounds_the_leaves_where_the_tree_stands() {
        let leaf = |at_m| Attachment {
            segment: 0,
            kind: AttachmentKind::Leaf,
            at_m,
            direction: Vec3::X,
            normal: Vec3::Y,
        };
        let attachments = vec![leaf(Vec3::new(2.0, 3.0, 0.0)), leaf(Vec3::new(-2.0, 7.0, 0.0))];
        let skeleton = Skeleton { segments: Vec::new(), attachments };
        let crown = Crown::of(&skeleton, Vec3::new(10.0, 1.0, 0.0));
        assert!(crown.center_m.distance(Vec3::new(10.0, 6.0, 0.0)) < 1e-4, "{}", crown.center_m);
        assert!(crown.radii_m.x > 2.0 && crown.radii_m.z < 0.2, "as wide as it is: {}", crown.radii_m);
    }
}
