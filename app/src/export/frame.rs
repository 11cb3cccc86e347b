// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The leaves of one frame as every format tells them.

use windfall_core::{Context, World};
use windfall_render::trees::Stand;

use windfall_core::leaf::LeafState;
use windfall_core::leaf::fly::flies;
use windfall_core::leaf::own::own_velocity;
use windfall_core::leaf::record::{
    HALF_MASK, PRIMITIVE_MASK, PRIMITIVE_SHIFT, SIZE_UNIT, SPECIES_MASK, SPECIES_SHIFT,
};
use windfall_core::motion::Primitive;

/// A leaf at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FrameLeaf {
    /// Its slot, from 0: the same in all frames.
    pub slot: u32,
    /// Its number: a slot whose leaf has lain long enough gets a new one with the next leaf.
    pub id: u32,
    /// What it is doing. A dormant leaf is nowhere: nothing else of it means anything.
    pub state: LeafState,
    /// Code of its primitive motion, empty if it has none.
    pub motion: &'static str,
    /// Number of its species in the scene.
    pub species: usize,
    /// Place in metres.
    pub position_m: [f32; 3],
    /// Unit quaternion x, y, z, w from the leaf's frame: blade in the x-z plane, normal +y, tip towards +z.
    pub quaternion: [f32; 4],
    /// Velocity in m/s; of a leaf on its twig that of the blade.
    pub velocity_m_s: [f32; 3],
    /// Size relative to its species'.
    pub size: f32,
    /// Tint (low half) and image variant, as [`Identity::look`](windfall_core::leaf::Identity) has them.
    pub look: u32,
}

/// One frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame<'a> {
    /// Number of the frame.
    pub number: u32,
    /// The state shown.
    pub world: &'a World,
    /// Its leaves in the order of their slots.
    pub leaves: &'a [FrameLeaf],
}

/// Looks at worlds, with room for their leaves that is used again.
#[derive(Debug)]
pub(crate) struct Observer {
    /// For every tree with leaves: the slot after its last, and the share of a stated size that is one leaf's.
    trees: Vec<(usize, f32)>,
    leaves: Vec<FrameLeaf>,
}

impl Observer {
    /// For the worlds of a scene that has this stand.
    pub(crate) fn new(stand: &Stand) -> Self {
        let mut next = 0;
        let trees = stand.trees.iter().map(|tree| {
            next += tree.leaves as usize;
            (next, (tree.cluster as f32).sqrt().recip())
        });
        Self { trees: trees.collect(), leaves: Vec::new() }
    }

    /// The leaves of a world as frame `number`.
    pub(crate) fn look<'a>(&'a mut self, world: &'a World, number: u32) -> Frame<'a> {
        let step = world.environment.step_block(&world.clock);
        let cx = world.environment.context(&step);
        self.leaves.clear();
        let mut trees = self.trees.iter().copied().peekable();
        for slot in 0..world.leaves.len() {
            while trees.next_if(|&(end, _)| end <= slot).is_some() {}
            let share = trees.peek().map_or(1.0, |&(_, share)| share);
            self.leaves.push(leaf(world, &cx, slot, share));
        }
        Frame { number, world, leaves: &self.leaves }
    }
}

/// What is told of the leaf in a slot; `share` is that of one leaf in the diameter of those it stands for on a twig.
fn leaf(world: &World, cx: &Context<'_>, slot: usize, share: f32) -> FrameLeaf {
    let leaves = &world.leaves;
    let (place, drift, course) = (&leaves.place[slot], &leaves.drift[slot], leaves.course[slot]);
    let state = place.state();
    let own = match state {
        LeafState::Falling if !flies(place.bits) => {
            let own = own_velocity(cx, place.bits, drift.phase, course.into());
            [own.x, own.y, own.z]
        }
        _ => [0.0; 3],
    };
    let motion = (place.bits >> PRIMITIVE_SHIFT) & PRIMITIVE_MASK;
    let motion = Primitive::ALL.get(motion as usize).filter(|_| state == LeafState::Falling);
    // A leaf that nothing has turned yet has no attitude.
    let quaternion = leaves.attitude[slot].quaternion;
    let is_turned = quaternion.iter().map(|part| part * part).sum::<f32>() > 0.25;
    let whole = (course.size & HALF_MASK) as f32 * SIZE_UNIT;
    let stated = (course.size >> 16) as f32 * SIZE_UNIT;
    let size = match state {
        LeafState::Attached if stated > 0.0 => stated,
        LeafState::Attached => whole * share,
        _ => whole,
    };
    FrameLeaf {
        // Scenes have far fewer leaves.
        slot: u32::try_from(slot).unwrap_or(u32::MAX),
        id: leaves.identity[slot].id,
        state,
        motion: motion.map_or("", |motion| motion.code()),
        species: ((place.bits >> SPECIES_SHIFT) & SPECIES_MASK) as usize,
        position_m: place.position,
        quaternion: if is_turned { quaternion } else { [0.0, 0.0, 0.0, 1.0] },
        velocity_m_s: std::array::from_fn(|axis| drift.velocity[axis] + own[axis]),
        size,
        look: leaves.identity[slot].look,
    }
}

/// Name of a state in tables.
pub(super) fn state_name(state: LeafState) -> &'static str {
    match state {
        LeafState::Dormant => "dormant",
        LeafState::Attached => "attached",
        LeafState::Falling => "falling",
        LeafState::Resting => "resting",
    }
}
