// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves of a fall: the simulator, its columns, and its leaves decoded.

use bevy::prelude::*;
use windfall_core::blocks::StepBlock;
use windfall_core::device::wind::sample::wind_at;
use windfall_core::leaf::{Attitude, LeafState, Place};
use windfall_core::{Context, Scene, SimError, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};

use crate::fall::FallError;

/// Leaves of a [`Fall`](crate::Fall), as they are in this frame. Places are in the frame of the entity.
#[derive(Component, Debug)]
pub struct Leaves {
    simulator: CpuSimulator,
    /// The block of the present step: the wind is read from it.
    step: Box<StepBlock>,
    /// Seconds that have passed and not been stepped yet.
    pub(crate) owed_s: f64,
    /// Of each slot, true if its leaf was in the air when landings were last looked for.
    was_falling: Vec<bool>,
}

/// A leaf, decoded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leaf {
    /// Index into the columns.
    pub slot: usize,
    /// Number of the leaf: a slot whose leaf has lain long enough gets a new one.
    pub id: u32,
    /// State. Of a dormant leaf nothing else means anything.
    pub state: LeafState,
    /// Index of the species in the scene.
    pub species: usize,
    /// Position in metres, in the frame of the fall.
    pub position: Vec3,
    /// Turns the leaf frame into place: blade in the x-z plane, normal +y, tip towards +z.
    pub rotation: Quat,
    /// Velocity in m/s.
    pub velocity: Vec3,
    /// Diameter in metres of the disc with the area of its blade.
    pub size_m: f32,
}

impl Leaves {
    /// Builds the world of a scene, and its simulator.
    pub(crate) fn build(scene: &Scene, threads: Option<usize>) -> Result<Self, FallError> {
        let world = World::build(scene)?;
        let simulator = CpuSimulator::new(&world, CpuOptions { threads, simd: None })?;
        let step = Box::new(world.step_block());
        let was_falling = world.leaves.place.iter().map(is_falling).collect();
        Ok(Self { simulator, step, owed_s: 0.0, was_falling })
    }

    /// The world: scene, clock and every store.
    pub fn world(&self) -> &World {
        self.simulator.world()
    }

    /// Number of leaf slots.
    pub fn len(&self) -> usize {
        self.world().leaves.len()
    }

    /// Returns true if there is no slot.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Position and state of every leaf.
    pub fn place(&self) -> &[Place] {
        &self.world().leaves.place
    }

    /// Orientation of every leaf; zero of one that nothing has turned yet.
    pub fn attitude(&self) -> &[Attitude] {
        &self.world().leaves.attitude
    }

    /// The leaf in a slot.
    ///
    /// # Panics
    /// If there is no such slot.
    pub fn leaf(&self, slot: usize) -> Leaf {
        self.decoded(&self.context(), slot)
    }

    /// All leaves but dormant ones.
    pub fn iter(&self) -> impl Iterator<Item = Leaf> {
        let context = self.context();
        let slots = (0..self.len()).filter(|slot| self.place()[*slot].state() != LeafState::Dormant);
        slots.map(move |slot| self.decoded(&context, slot))
    }

    /// Steps since the start.
    pub fn steps(&self) -> u32 {
        self.world().clock.step()
    }

    /// Length of a step in seconds.
    pub fn step_s(&self) -> f32 {
        self.world().clock.dt_s()
    }

    /// Hash of every bit of state, which `windfall simulate` prints after as many steps of the same scene.
    pub fn state_hash(&self) -> u64 {
        self.world().state_hash()
    }

    /// Velocity of the air in m/s that a leaf would feel at a point, in metres, of the frame of the fall.
    pub fn wind_at(&self, point: Vec3) -> Vec3 {
        let air = wind_at(&self.context(), point.to_array().into());
        Vec3::new(air.x, air.y, air.z)
    }

    /// The view of device functions at the present step.
    pub fn context(&self) -> Context<'_> {
        self.world().context(&self.step)
    }

    /// Goes on by some steps.
    pub(crate) fn advance(&mut self, steps: u32) -> Result<(), SimError> {
        self.simulator.step(steps)?;
        *self.step = self.simulator.world().step_block();
        Ok(())
    }

    /// Slots whose leaves have come to rest since this was last asked, in order.
    pub(crate) fn landed(&mut self) -> Vec<usize> {
        let Self { simulator, was_falling, .. } = self;
        let places = &simulator.world().leaves.place;
        let mut landed = Vec::new();
        for (slot, (place, was_falling)) in places.iter().zip(was_falling).enumerate() {
            let had_fallen = std::mem::replace(was_falling, is_falling(place));
            if had_fallen && place.state() == LeafState::Resting {
                landed.push(slot);
            }
        }
        landed
    }

    fn decoded(&self, context: &Context<'_>, slot: usize) -> Leaf {
        let world = self.world();
        let view = world.leaves.view(context, slot);
        let diameter_m = world.compiled.scene().species[view.species].size_m;
        let rotation = Quat::from_xyzw(view.attitude.x, view.attitude.y, view.attitude.z, view.attitude.w);
        Leaf {
            slot,
            id: view.id,
            state: view.state,
            species: view.species,
            position: Vec3::new(view.position.x, view.position.y, view.position.z),
            rotation: if rotation.length_squared() > 0.25 { rotation } else { Quat::IDENTITY },
            velocity: Vec3::new(view.velocity.x, view.velocity.y, view.velocity.z),
            size_m: diameter_m * view.drawn_size,
        }
    }
}

fn is_falling(place: &Place) -> bool {
    place.state() == LeafState::Falling
}
