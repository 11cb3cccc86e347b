// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Trunks and thick limbs of trees, as they stand in still air: they sway by less than leaves are wide.

use glam::{DQuat, DVec3};

use super::part::{Solid, SolidPose};
use crate::scene::{ObjectFriction, ObjectShape};
use crate::tree::{Forest, Segment};

/// Least radius in m of wood that leaves strike: thinner wood gives way.
const LEAST_RADIUS_M: f32 = 0.03;
/// Branchings up to which limbs are solid.
const DEEPEST_ORDER: u32 = 1;
/// Most parts, the thickest of all.
const MOST_TRUNKS: usize = 2048;
/// Friction of leaves on bark, assumed.
const BARK_FRICTION: ObjectFriction = ObjectFriction::Coulomb(0.6);
/// Restitution of leaves that strike it, assumed.
const BARK_RESTITUTION: f32 = 0.1;

/// Solid parts of all trees.
pub(crate) fn trunks_of(forest: &Forest) -> Vec<Solid> {
    let mut wood: Vec<(f32, Solid)> = Vec::new();
    for tree in forest.trees() {
        let segments = tree.skeleton.segments.iter();
        let thick = segments
            .filter(|segment| segment.order <= DEEPEST_ORDER && mean_radius_m(segment) >= LEAST_RADIUS_M);
        wood.extend(thick.map(|segment| (mean_radius_m(segment), trunk(segment, tree.foot_m.as_dvec3()))));
    }
    wood.sort_by(|a, b| b.0.total_cmp(&a.0));
    wood.truncate(MOST_TRUNKS);
    wood.into_iter().map(|(_, trunk)| trunk).collect()
}

fn mean_radius_m(segment: &Segment) -> f32 {
    0.5 * (segment.start_radius_m + segment.end_radius_m)
}

/// The capsule of a segment of a tree that stands at a place.
fn trunk(segment: &Segment, foot_m: DVec3) -> Solid {
    let center_m = foot_m + (segment.start_m + segment.end_m).as_dvec3() * 0.5;
    let turn = DQuat::from_rotation_arc(DVec3::Y, segment.direction().as_dvec3());
    Solid::still(
        ObjectShape::Capsule { radius_m: mean_radius_m(segment), length_m: segment.length_m() },
        BARK_FRICTION,
        BARK_RESTITUTION,
        SolidPose { center_m, turn },
    )
}
