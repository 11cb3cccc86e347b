// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Branchlet of leaves that one simulated leaf represents on its twig: shoots in a fan, with leaves to either side. Pictures
//! set each branchlet on the device (`branchlet.wgsl`); other programs are given a few to choose from.

use glam::{Quat, Vec3, Vec4};
use windfall_core::arith::rng::random;
use windfall_core::shared_constants;

shared_constants! {
    /// Most leaves that one simulated leaf stands for on a tree.
    pub(crate) const MAX_CLUSTER: u32 = 30;
    /// Leaves of one shoot; a branchlet has as many shoots as it needs.
    const SHOOT_LEAVES: f32 = 7.0;
    /// Length of a shoot in diameters of a leaf times the root of the branchlet's number of leaves.
    const SHOOT_LENGTH: f32 = 2.6;
    /// Share of that length by which shoots begin behind the first leaf.
    const SHOOT_BACK: f32 = 0.35;
    /// Angle in radians between the outermost shoots and the middle of the fan.
    const SHOOT_FAN_RAD: f32 = 0.8;
    /// Mean rise of a shoot's end above where it sets out for, per length.
    const SHOOT_RISE: f32 = 0.25;
    /// Largest angle in radians by which a shoot is off its place in the fan.
    const SHOOT_YAW_RAD: f32 = 0.35;
    /// Largest angle in radians between a shoot and the fan's plane.
    const SHOOT_PITCH_RAD: f32 = 0.6;
    /// Distance of leaves from their shoot in diameters.
    const SHOOT_WIDTH: f32 = 0.45;
    /// Largest distance in diameters, along each axis, of a leaf from that place.
    const LEAF_ASTRAY: f32 = 0.4;
    /// Angle in radians between leaf and shoot.
    const SHOOT_LEAF_RAD: f32 = 0.8;
    /// Vector part of the quaternion, beside a real part of 1, that turns leaves on from there at most.
    const CLUSTER_TURN: [f32; 3] = [0.35, 0.4, 0.35];
}

/// Places of `count` leaves in diameters of one and how each is turned, in the frame of the first, which lies at the origin.
pub fn cluster(count: u32, number: u32) -> impl Iterator<Item = (Vec3, Quat)> {
    let signed = |word: u32| 2.0 * (word as f32 / u32::MAX as f32) - 1.0;
    let vector = move |stream, item| Vec4::from(random([number, count], item, stream).map(signed));
    (0..count).map(move |copy| match copy {
        0 => (Vec3::ZERO, Quat::IDENTITY),
        _ => on_shoot(count, copy, vector(2, copy % shoot_count(count)), vector(0, copy), vector(1, copy)),
    })
}

/// Shoots of a branchlet of `count` leaves. Twin: `shoot_count` of `branchlet.wgsl`.
pub(super) fn shoot_count(count: u32) -> u32 {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most count")]
    let shoots = (count as f32 / SHOOT_LEAVES).ceil() as u32;
    shoots.max(1)
}

/// Place and turn of a leaf of a branchlet: random vectors within -1 to 1 of its shoot, and of its own place and turn.
/// Twin: `on_shoot` of `branchlet.wgsl`.
fn on_shoot(count: u32, copy: u32, shoot: Vec4, place: Vec4, turn: Vec4) -> (Vec3, Quat) {
    let shoots = shoot_count(count);
    let rank = copy / shoots;
    let along = ((rank as f32 + 0.5 + 0.5 * place.w) * shoots as f32 / count as f32).min(1.0) - SHOOT_BACK;
    let in_fan = ((copy % shoots) as f32 + 0.5) / shoots as f32 * 2.0 - 1.0;
    let (yaw, pitch) = (SHOOT_FAN_RAD * in_fan + SHOOT_YAW_RAD * shoot.x, SHOOT_PITCH_RAD * shoot.y);
    let toward = Vec3::new(yaw.sin() * pitch.cos(), pitch.sin(), yaw.cos() * pitch.cos());
    let side = if rank.is_multiple_of(2) { 1.0 } else { -1.0 };
    let aside = Vec3::new(yaw.cos(), 0.0, -yaw.sin()) * (side * SHOOT_WIDTH);
    let length = SHOOT_LENGTH * (count as f32).sqrt() * (0.85 + 0.15 * shoot.z);
    let rise = Vec3::Y * (SHOOT_RISE * (1.0 + shoot.w) * along * along.abs());
    let at = (toward * along + rise) * length + aside + place.truncate() * LEAF_ASTRAY;
    let own = turn.truncate() * Vec3::from(CLUSTER_TURN);
    let turned = Quat::from_rotation_y(yaw + side * SHOOT_LEAF_RAD);
    (at, (turned * Quat::from_xyzw(own.x, own.y, own.z, 1.0)).normalize())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn branchlets_are_as_long_as_their_leaves_ask_for_and_differ() {
        for count in [1, 4, 12, MAX_CLUSTER] {
            let leaves: Vec<_> = cluster(count, 0).collect();
            assert_eq!(leaves.len(), count as usize, "that many leaves");
            assert_eq!(leaves[0], (Vec3::ZERO, Quat::IDENTITY), "the first is the simulated one");
            let far = leaves.iter().map(|(place, _)| place.length()).fold(0.0, f32::max);
            let limit = (1.0 - SHOOT_BACK) * (1.0 + 2.0 * SHOOT_RISE) * SHOOT_LENGTH * (count as f32).sqrt();
            assert!(far < limit + SHOOT_WIDTH + 2.0 * LEAF_ASTRAY, "{far} of {limit}");
            assert!(count < 4 || far > 0.4 * limit, "{far} of {limit}");
        }
        let other: Vec<_> = cluster(4, 1).collect();
        assert!(cluster(4, 0).zip(&other).skip(1).all(|(a, b)| a != *b), "another number, other places");
    }
}
