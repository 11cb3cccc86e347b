// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves decoded for the host: for exports, reports and views. Kernels read the records.

use super::store::{LeafState, Leaves};
use crate::arith::{Quat, Vec3};
use crate::context::Context;
use crate::device::leaf::burn::scene_species;
use crate::device::leaf::own::{motion_params, own_velocity};
use crate::device::leaf::record::{
    Attitude, Drift, Identity, Place, SIZE_UNIT, Schedule, body_spin, flies, leaf_primitive, leaf_regime,
    leaf_source, leaf_stage, leaf_tint, leaf_variant, own_size, size_ratio,
};
use crate::motion::{PRIMITIVE_COUNT, Primitive};

/// The records of one leaf.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LeafRecords {
    /// Position and flags.
    pub place: Place,
    /// Residual velocity and phase.
    pub drift: Drift,
    /// Orientation.
    pub attitude: Attitude,
    /// Next event and motion parameters.
    pub schedule: Schedule,
    /// Identity and appearance.
    pub identity: Identity,
}

/// Motion of a leaf in the air.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LeafMotion {
    /// A primitive motion of synthesis.
    Primitive(Primitive),
    /// The regime in which a body falls, an index of [`REGIME_NAMES`](crate::device::flight::regime::REGIME_NAMES).
    Regime(usize),
}

/// A leaf at one step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeafView {
    /// Number of the leaf: a slot whose leaf has lain long enough gets a new one with the next leaf.
    pub id: u32,
    /// Step of its release, two's complement.
    pub release: u32,
    /// State. The other fields of a dormant leaf mean nothing but for the identity.
    pub state: LeafState,
    /// Index of the species in the scene.
    pub species: usize,
    /// Index of the source in the scene; [`SOURCE_TREES`](crate::blocks::SOURCE_TREES) for leaves of trees.
    pub source: u32,
    /// Motion in the air, else `None`.
    pub motion: Option<LeafMotion>,
    /// Stage of the fall of a synthesised leaf.
    pub stage: u32,
    /// Position in metres.
    pub position: Vec3,
    /// Orientation: turns the leaf frame (blade in the x-z plane, normal +y, tip towards +z) into place.
    pub attitude: Quat,
    /// Velocity in m/s; of a leaf on its twig that of the blade.
    pub velocity: Vec3,
    /// Spin about the leaf's own axes in rad/s, of a body in the air.
    pub spin: Option<Vec3>,
    /// Size relative to the species'.
    pub size: f32,
    /// The same as drawn: on its twig a leaf may stand for several.
    pub drawn_size: f32,
    /// Tint, 0 to 1.
    pub tint: f32,
    /// Variant among the species' leaf images.
    pub variant: u32,
}

impl LeafView {
    /// Number of the motion: 0 without one, then primitive motions in the order of [`Primitive::ALL`], then regimes of bodies.
    pub fn motion_number(&self) -> usize {
        match self.motion {
            None => 0,
            Some(LeafMotion::Primitive(primitive)) => 1 + primitive.index(),
            Some(LeafMotion::Regime(regime)) => 1 + PRIMITIVE_COUNT + regime,
        }
    }

    /// Code of the primitive motion in tables, such as `SD`; empty if it has none.
    pub fn motion_code(&self) -> &'static str {
        match self.motion {
            Some(LeafMotion::Primitive(primitive)) => primitive.code(),
            _ => "",
        }
    }
}

impl LeafView {
    /// Decodes the records of a leaf at the step of a context.
    pub fn new(cx: &Context<'_>, leaf: &LeafRecords) -> Self {
        let LeafRecords { place, drift, attitude, schedule, identity } = *leaf;
        let state = place.state();
        let is_body = flies(place.bits);
        let is_falling = state == LeafState::Falling;
        let primitive = Primitive::of_number(leaf_primitive(place.bits));
        let motion = match is_body {
            true => Some(LeafMotion::Regime(leaf_regime(place.bits) as usize)),
            false => primitive.filter(|_| is_falling).map(LeafMotion::Primitive),
        };
        let mut velocity = Vec3::from(drift.velocity);
        if is_falling && !is_body {
            velocity = velocity + own_velocity(cx, place.bits, drift.phase, motion_params(schedule));
        }
        let drawn_size = size_ratio(schedule.size);
        let on_twig = own_size(schedule.size) as f32 * SIZE_UNIT;
        let appearance = identity.appearance;
        Self {
            id: identity.id,
            release: identity.release,
            state,
            species: scene_species(cx, place.bits) as usize,
            source: leaf_source(appearance),
            motion,
            stage: leaf_stage(appearance),
            position: place.position.into(),
            attitude: attitude.quaternion.into(),
            velocity,
            spin: is_body.then(|| body_spin(drift.phase, schedule.rate, schedule.heading)),
            size: if state == LeafState::Attached { on_twig } else { drawn_size },
            drawn_size,
            tint: leaf_tint(appearance) as f32 / 65535.0,
            variant: leaf_variant(appearance),
        }
    }
}

impl Leaves {
    /// The records of the leaf in a slot.
    pub fn records(&self, slot: usize) -> LeafRecords {
        LeafRecords {
            place: self.place[slot],
            drift: self.drift[slot],
            attitude: self.attitude[slot],
            schedule: self.schedule[slot],
            identity: self.identity[slot],
        }
    }

    /// The leaf in a slot, decoded, at the step of a context.
    pub fn view(&self, cx: &Context<'_>, slot: usize) -> LeafView {
        LeafView::new(cx, &self.records(slot))
    }
}
