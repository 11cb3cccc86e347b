// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Drops pieces in still air, and shows every falling one at every step.

use windfall_core::leaf::LeafState;
use windfall_core::scene::{Gusts, MeanSpeed, Source, SourceShape, Turbulence, WindParameters};
use windfall_core::scene::{Release as Schedule, Species};
use windfall_core::{Scene, Simulator, World};

use super::sample::Sample;
use crate::run::backend::Device;
use crate::run::cancel::Cancel;

/// Length of a step in s; the kernel cuts it finer where a body asks for that.
const STEP_S: f32 = 1.0 / 240.0;
/// Slowest descent in m/s that is waited for.
const SLOWEST_M_S: f64 = 0.05;
/// Time in s that is waited in any case.
const LEAST_S: f64 = 10.0;

/// A number of drops of one piece.
#[derive(Clone, Copy, Debug)]
pub(super) struct Drops<'a> {
    /// What is dropped.
    pub(super) species: &'a Species,
    /// How many, each with irregularities of its own.
    pub(super) count: u32,
    /// From how high, in m.
    pub(super) height_m: f32,
    /// Seed of everything random.
    pub(super) seed: u64,
}

impl Drops<'_> {
    /// The drops as a scene.
    fn scene(&self) -> Scene {
        let wind = WindParameters {
            speed: MeanSpeed::MetresPerSecond(0.0),
            gusts: Gusts { strength: 0.0, ..Gusts::default() },
            turbulence: Turbulence { intensity: 0.0, calm_m_s: 0.0, ..Turbulence::default() },
            ..WindParameters::default()
        };
        let source = Source {
            shape: SourceShape::Box {
                center_m: glam::Vec3::new(0.0, self.height_m, 0.0),
                half_extent_m: glam::Vec3::ZERO,
            },
            count: self.count,
            release: Schedule::Burst { at_s: 0.0 },
            recycle_after_s: None,
            species: Vec::new(),
        };
        Scene {
            name: "wind tunnel".into(),
            seed: self.seed,
            dt_s: STEP_S,
            species: vec![self.species.clone()],
            sources: vec![source],
            wind,
            ..Scene::default()
        }
    }

    /// Drops them all, and shows every step of every falling one, until all lie on the ground. Returns how many were still
    /// in the air when it was no use to wait any longer.
    ///
    /// # Errors
    /// Numbers that are not allowed in a scene, a lost device, an interruption, or what `look` says.
    pub(super) fn run(
        &self,
        device: &Device,
        cancel: &Cancel,
        look: &mut dyn FnMut(usize, &Sample) -> anyhow::Result<()>,
    ) -> anyhow::Result<u32> {
        let mut world = World::build(&self.scene())?;
        let mut simulator = device.simulator(&world)?;
        let longest_s = (f64::from(self.height_m) / SLOWEST_M_S).max(LEAST_S);
        loop {
            let mut aloft = 0;
            for slot in 0..world.leaves.len() {
                if world.leaves.place[slot].state() == LeafState::Falling {
                    look(slot, &Sample::of(&world, slot))?;
                    aloft += 1;
                }
            }
            if aloft == 0 || world.clock.seconds() >= longest_s {
                return Ok(aloft);
            }
            cancel.check()?;
            simulator.step(1)?;
            simulator.read_state(&mut world)?;
        }
    }
}
