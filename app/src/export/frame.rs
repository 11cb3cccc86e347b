// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The leaves and particles of one frame as every format describes them.

use windfall_core::leaf::LeafState;
use windfall_core::{Context, World};

use crate::run::live_particle::LiveParticle;

/// A leaf at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FrameLeaf {
    /// Its slot, from 0: the same in all frames.
    pub slot: u32,
    /// Its number: a slot whose leaf has lain long enough gets a new one with the next leaf.
    pub id: u32,
    /// Its state. A dormant leaf is nowhere: nothing else of it means anything.
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
    /// Tint and image variant, packed as [`leaf_tint`](windfall_core::device::leaf::record::leaf_tint) and its like read them.
    pub appearance: u32,
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
    /// Its living particles, population after population, in the order of their slots.
    pub particles: &'a [LiveParticle],
}

impl<'a> Frame<'a> {
    /// The living particles of a population, by its number in the scene.
    pub(crate) fn particles_of(&self, population: usize) -> &'a [LiveParticle] {
        let first = self.particles.partition_point(|particle| particle.population < population);
        let rest = &self.particles[first..];
        &rest[..rest.partition_point(|particle| particle.population == population)]
    }
}

/// Decodes the leaves and particles of worlds, with room for them that is used again.
#[derive(Debug, Default)]
pub(crate) struct Observer {
    leaves: Vec<FrameLeaf>,
    particles: Vec<LiveParticle>,
}

impl Observer {
    /// The leaves and particles of a world as frame `number`.
    pub(crate) fn look<'a>(&'a mut self, world: &'a World, number: u32) -> Frame<'a> {
        let step = world.step_block();
        let cx = world.context(&step);
        self.leaves.clear();
        let rows = world.compiled.shard_rows().leaves();
        self.leaves.extend(rows.map(|(row, slot)| leaf(world, &cx, row, slot)));
        self.particles.clear();
        self.particles.extend(LiveParticle::all(world));
        Frame { number, world, leaves: &self.leaves, particles: &self.particles }
    }
}

/// The leaf in a row, which is that of a slot.
fn leaf(world: &World, cx: &Context<'_>, row: usize, slot: u32) -> FrameLeaf {
    let leaf = world.leaves.view(cx, row);
    // A leaf that nothing has turned yet has no attitude.
    let quaternion = leaf.attitude.to_array();
    let is_turned = quaternion.iter().map(|part| part * part).sum::<f32>() > 0.25;
    FrameLeaf {
        slot,
        id: leaf.id,
        state: leaf.state,
        motion: leaf.motion_code(),
        species: leaf.species,
        position_m: leaf.position.to_array(),
        quaternion: if is_turned { quaternion } else { [0.0, 0.0, 0.0, 1.0] },
        velocity_m_s: leaf.velocity.to_array(),
        size: leaf.size,
        appearance: world.leaves.identity[row].appearance,
    }
}
