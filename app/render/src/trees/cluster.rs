// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Arrangement of the leaves that one simulated leaf represents on its twig. Pictures set each cluster on the device
//! (`leaves/cull.wgsl`); other programs are given a few clusters to choose from.

use glam::{Quat, Vec3};
use windfall_core::arith::rng::random;
use windfall_core::shared_constants;

shared_constants! {
    /// Most leaves that one simulated leaf stands for on a tree.
    pub(crate) const MAX_CLUSTER: u32 = 16;
    /// Size of leaves on twigs relative to what they have when they fall, so that crowns close: set by eye.
    pub const TWIG_SIZE: f32 = 1.42;
    /// Largest distance of a leaf from the first, across and along the blade, in diameters of one times the root of their
    /// number.
    const CLUSTER_REACH: [f32; 3] = [0.9, 0.54, 0.9];
    /// Vector part of the quaternion, beside a real part of 1, that turns leaves against the first at most.
    const CLUSTER_TURN: [f32; 3] = [0.35, 0.9, 0.35];
}

/// Places of `count` leaves in diameters of one and how each is turned, in the frame of the first, which lies at the origin.
pub fn cluster(count: u32, number: u32) -> impl Iterator<Item = (Vec3, Quat)> {
    let signed = |word: u32| 2.0 * (word as f32 / u32::MAX as f32) - 1.0;
    let vector = move |stream, copy| {
        let [x, y, z, _] = random([number, count], copy, stream).map(signed);
        Vec3::new(x, y, z)
    };
    (0..count).map(move |copy| {
        if copy == 0 {
            return (Vec3::ZERO, Quat::IDENTITY);
        }
        let turn = vector(1, copy) * Vec3::from(CLUSTER_TURN);
        let place = vector(0, copy) * Vec3::from(CLUSTER_REACH) * (count as f32).sqrt();
        (place, Quat::from_xyzw(turn.x, turn.y, turn.z, 1.0).normalize())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clusters_are_as_wide_as_their_leaves_ask_for_and_differ() {
        for count in [1, 4, MAX_CLUSTER] {
            let leaves: Vec<_> = cluster(count, 0).collect();
            assert_eq!(leaves.len(), count as usize, "that many leaves");
            assert_eq!(leaves[0], (Vec3::ZERO, Quat::IDENTITY), "the first is the simulated one");
            let far = leaves.iter().fold(Vec3::ZERO, |far, (place, _)| far.max(place.abs()));
            let limit = Vec3::from(CLUSTER_REACH) * (count as f32).sqrt();
            assert!(far.cmple(limit).all(), "{far} lies within {limit}");
            assert!(count < 4 || far.length() > 0.5 * limit.length(), "{far} of {limit}");
        }
        let other: Vec<_> = cluster(4, 1).collect();
        assert!(cluster(4, 0).zip(&other).skip(1).all(|(a, b)| a != *b), "another number, other places");
    }
}
