// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Drops of a piece in still air.

use windfall_core::Scene;
use windfall_core::leaf::LeafState;
use windfall_core::scene::{Gusts, MeanSpeed, Source, SourceShape, Turbulence, WindParameters};
use windfall_core::scene::{Release as Schedule, Species};

use super::descent::{DescentSummary, Watch};
use super::experiment::follow;
use super::sample::Sample;
use crate::run::backend::Device;
use crate::run::cancel::Cancel;

/// Length of a step in s; the kernel takes substeps where a body needs them.
const STEP_S: f32 = 1.0 / 240.0;
/// Slowest descent in m/s that is waited for.
const SLOWEST_M_S: f64 = 0.05;
/// Time in s that is waited in any case.
const LEAST_S: f64 = 10.0;

/// A number of drops of one piece.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Drops<'a> {
    /// Species that is dropped.
    pub(crate) species: &'a Species,
    /// Number of drops, each with irregularities of its own.
    pub(crate) count: u32,
    /// From how high, in m.
    pub(crate) height_m: f32,
    /// Seed of everything random.
    pub(crate) seed: u64,
}

impl Drops<'_> {
    /// Drops them all, and summarises what each does from `settle_m` below its release on; `None` if none falls farther.
    ///
    /// # Errors
    /// Errors of [`Drops::run`].
    pub(crate) fn summary(
        &self,
        settle_m: f64,
        device: &Device,
        cancel: &Cancel,
    ) -> anyhow::Result<Option<DescentSummary>> {
        let mut watches = vec![Watch::new(settle_m); self.count as usize];
        self.run(device, cancel, &mut |drop, sample| {
            watches[drop].add(sample);
            Ok(())
        })?;
        let numbers: Vec<_> = watches.iter().filter_map(Watch::finish).collect();
        Ok(DescentSummary::of(&numbers))
    }

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

    /// Drops them all and passes every step of every falling one to `observe`, until all lie on the ground. Returns the number
    /// of those that were still in the air when the time was over.
    ///
    /// # Errors
    /// Numbers that are not allowed in a scene, a lost device, a request to end, or what `observe` returns.
    pub(crate) fn run(
        &self,
        device: &Device,
        cancel: &Cancel,
        observe: &mut dyn FnMut(usize, &Sample) -> anyhow::Result<()>,
    ) -> anyhow::Result<u32> {
        let limit_s = (f64::from(self.height_m) / SLOWEST_M_S).max(LEAST_S);
        follow(&self.scene(), device, limit_s, cancel, &mut |world| {
            let places = world.leaves.place.iter().enumerate();
            let mut falling = places.filter(|(_, place)| place.state() == LeafState::Falling);
            falling.try_for_each(|(slot, _)| observe(slot, &Sample::of(world, slot)))
        })
    }
}
