// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Shoots of the branchlets that leaves stand for: the finest twigs, which no segment of the wood is.

use std::f32::consts::TAU;
use std::ops::Range;

use glam::{Mat3, Quat, Vec3};
use windfall_core::shared_constants;
use windfall_core::tree::{Attachment, AttachmentKind, Skeleton};

use super::StandingTree;
use super::branchlet::shoot_count;
use crate::gpu::vertex::vertex_struct;

shared_constants! {
    /// Width in metres of a shoot that is drawn by itself where a pixel is no wider.
    const SHOOT_SEEN_M: f32 = 0.006;
    /// Least share of a tree's shoots that are drawn.
    const LEAST_SHOOTS: f32 = 0.02;
    /// Parts of a shoot between corners.
    const SHOOT_PARTS: u32 = 3;
}

/// Radius in metres of the thickest wood that bears shoots.
const BEARING_M: f32 = 0.012;
/// Distance between branchlets on it in metres.
const SPACING_M: f32 = 0.12;
/// Leaves of such a branchlet in summer: they set how many shoots it has and how long.
const SITE_LEAVES: u32 = 12;
/// Angle between a branchlet and its twig in radians.
const SITE_ANGLE_RAD: f32 = 0.9;
/// Golden angle in radians.
const GOLDEN_RAD: f32 = 2.399_963;

/// Corners of a shoot's ribbon.
pub(crate) const CORNERS: u32 = 2 * SHOOT_PARTS + 2;

vertex_struct! {
    /// A shoot at rest, in the world.
    pub(crate) struct ShootInstance from 0 {
        /// Base of the leaf's petiole.
        base_m: [f32; 3] = Float32x3,
        /// Row of the branch columns that moves it.
        row: u32 = Uint32,
        /// Attitude of the leaf.
        attitude: [i16; 4] = Snorm16x4,
        /// Slot of the leaf that stands for its branchlet.
        slot: u32 = Uint32,
        /// Number among the shoots of the branchlet.
        number: u32 = Uint32,
        /// Leaves of the branchlet.
        leaves: u32 = Uint32,
        /// Record of the tree.
        record: u32 = Uint32,
    }
}

/// Place of a branchlet on its tree.
struct Site {
    /// Base, in the tree's frame, and attitude of the leaf that stands for it.
    at_m: Vec3,
    attitude: Quat,
    segment: u32,
    /// Number that no other branchlet of the scene has.
    slot: u32,
    /// Leaves that it bears in summer.
    leaves: u32,
}

/// The shoots of a tree whose leaves have the slots from `first_slot` on, in an order of which every beginning is spread over the crown.
pub(crate) fn shoots_of(tree: &StandingTree, record: u32, first_slot: u32) -> Vec<ShootInstance> {
    let on_leaf = |(slot, leaf): (u32, &Attachment)| Site {
        at_m: leaf.at_m,
        attitude: facing(leaf.direction, leaf.normal),
        segment: leaf.segment,
        slot,
        leaves: tree.cluster,
    };
    let leaves = tree.skeleton.attachments.iter().filter(|at| at.kind == AttachmentKind::Leaf);
    let mut sites: Vec<Site> = (first_slot..first_slot + tree.leaves).zip(leaves).map(on_leaf).collect();
    let bare = bare_sites(&tree.skeleton);
    if sites.len() < bare.len() {
        sites.extend(bare);
    }
    let shoots_of = |site: &Site| {
        let instance = |number| ShootInstance {
            base_m: tree.place(site.at_m).to_array(),
            row: tree.rows[site.segment as usize],
            attitude: snorm(site.attitude),
            slot: site.slot,
            number,
            leaves: site.leaves,
            record,
        };
        (0..shoot_count(site.leaves)).map(instance).collect::<Vec<_>>()
    };
    let mut shoots: Vec<_> = sites.iter().flat_map(shoots_of).collect();
    // Multiples of an odd number are a permutation of the words.
    shoots
        .sort_by_key(|shoot| shoot.slot.wrapping_mul(8).wrapping_add(shoot.number).wrapping_mul(0x9E37_79B1));
    shoots
}

/// Sites along the thin wood of a tree, whose leaves are few or none.
fn bare_sites(skeleton: &Skeleton) -> Vec<Site> {
    let mut sites = Vec::new();
    for (segment, wood) in (0u32..).zip(&skeleton.segments) {
        if wood.end_radius_m > BEARING_M {
            continue;
        }
        let axis = wood.direction();
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a length of wood in decimetres"
        )]
        let count = (wood.length_m() / SPACING_M).round() as u32;
        for number in 0..count {
            let site = count32(sites.len());
            let slot = u32::MAX - site;
            let around =
                Quat::from_axis_angle(axis, GOLDEN_RAD * site as f32 % TAU) * axis.any_orthonormal_vector();
            let direction = axis * SITE_ANGLE_RAD.cos() + around * SITE_ANGLE_RAD.sin();
            let normal =
                direction.cross(Vec3::Y).cross(direction).normalize_or(direction.any_orthonormal_vector());
            let along = (number as f32 + 0.5) / count as f32;
            sites.push(Site {
                at_m: wood.start_m.lerp(wood.end_m, along),
                attitude: facing(direction, normal),
                segment,
                slot,
                leaves: SITE_LEAVES,
            });
        }
    }
    sites
}

/// Attitude of a leaf with the tip in that direction, and its upper side.
fn facing(direction: Vec3, normal: Vec3) -> Quat {
    let across = normal.cross(direction).normalize();
    Quat::from_mat3(&Mat3::from_cols(across, direction.cross(across), direction))
}

fn snorm(attitude: Quat) -> [i16; 4] {
    #[expect(clippy::cast_possible_truncation, reason = "unit quaternions")]
    attitude.to_array().map(|part| (part * 32_767.0).round() as i16)
}

fn count32(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}

/// Those of a tree's shoots that are drawn where a pixel covers `pixel_m` at its crown.
pub(crate) fn drawn(shoots: &Range<u32>, pixel_m: f32) -> Range<u32> {
    let share = shoot_share(pixel_m);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most their number")]
    let count = ((shoots.end - shoots.start) as f32 * share).ceil() as u32;
    shoots.start..(shoots.start + count).min(shoots.end)
}

/// Share of a tree's shoots that are drawn, and as many times as thick. Twin: `shoot_share` of `twig_pass.wgsl`.
fn shoot_share(pixel_m: f32) -> f32 {
    (SHOOT_SEEN_M / pixel_m).clamp(LEAST_SHOOTS, 1.0)
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use windfall_core::{Scene, World};

    use super::*;
    use crate::trees::SceneTrees;

    fn tree(leaves: u32) -> StandingTree {
        let text = format!("(trees: [(kind: \"birch\", leaves: {leaves})])");
        let scene = Scene::from_ron(&text, "a birch").expect("a scene");
        let world = World::build(&scene).expect("a world");
        SceneTrees::of(&scene, world.compiled.forest()).trees.remove(0)
    }

    #[test]
    fn every_branchlet_has_its_shoots_whether_it_bears_leaves_or_not() {
        let (leafy, bare) = (tree(5000), tree(0));
        let shoots = shoots_of(&leafy, 3, 40);
        assert_eq!(
            shoots.len(),
            5000 * shoot_count(leafy.cluster) as usize,
            "each leaf stands for a branchlet"
        );
        assert!(shoots.iter().all(|shoot| (40..5040).contains(&shoot.slot) && shoot.record == 3));
        let bare = shoots_of(&bare, 1, 0);
        assert!(bare.len() > 1000, "{} shoots of a bare tree", bare.len());
        let turns: HashSet<[i16; 4]> = bare.iter().map(|shoot| shoot.attitude).collect();
        assert!(2 * turns.len() > bare.len() / 2, "{} directions of {} shoots", turns.len(), bare.len());
    }

    #[test]
    fn the_first_shoots_are_spread_over_the_crown() {
        let shoots = shoots_of(&tree(5000), 1, 0);
        let mean_m = |shoots: &[ShootInstance]| {
            shoots.iter().map(|shoot| Vec3::from(shoot.base_m)).sum::<Vec3>() / shoots.len() as f32
        };
        let (few, all) = (mean_m(&shoots[..shoots.len() / 20]), mean_m(&shoots));
        assert!(few.distance(all) < 0.5, "a twentieth of them around {few}, all around {all}");
    }

    #[test]
    fn the_farther_the_fewer_are_drawn() {
        assert_eq!(drawn(&(10..110), 0.5 * SHOOT_SEEN_M), 10..110, "all near by");
        assert_eq!(drawn(&(10..110), 4.0 * SHOOT_SEEN_M), 10..35, "a quarter");
        assert_eq!(drawn(&(10..110), 1.0e3), 10..12, "never none");
    }
}
