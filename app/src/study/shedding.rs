// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves that a crown loses: by the model of its petioles, and by simulating it.

use windfall_core::device::leaf::carry::shed_chance;
use windfall_core::device::leaf::petiole::SHED_INTERVAL;
use windfall_core::device::leaf::petiole::petiole_of;
use windfall_core::leaf::LeafState;
use windfall_core::scene::{Gusts, MeanSpeed, Profile, Tree, TreePreset, Turbulence};
use windfall_core::{Scene, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};

use crate::run::cancel::Cancel;

/// Length of a step in s: chances are per second, and trees in a steady wind hardly move.
const STEP_S: f32 = 0.05;
/// Fastest wind in m/s.
pub(crate) const FASTEST_M_S: u32 = 30;
/// Wind speeds that are simulated, in m/s: in the middle of the steps of the model's table.
const SIMULATED_M_S: [f32; 6] = [4.5, 8.5, 12.5, 16.5, 20.5, 24.5];
/// Steps between checks for a request to end.
const BATCH: u32 = 600;

/// A tree by itself at a time of the year.
#[derive(Debug)]
pub(crate) struct Crown {
    scene: Scene,
}

/// A simulated crown.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mark {
    /// Mean wind in m/s.
    pub(crate) speed_m_s: f64,
    /// Leaves per hour.
    pub(crate) leaves_per_h: f64,
    /// Standard error of counting, in leaves per hour.
    pub(crate) error_per_h: f64,
    /// True if it blew in gusts.
    pub(crate) is_gusty: bool,
}

/// Leaves that a crown loses at a time of the year.
#[derive(Debug)]
pub(crate) struct Season {
    /// The time of the year.
    pub(crate) autumn: f32,
    /// Share of its leaves that the crown still has.
    pub(crate) hanging: f64,
    /// Leaves per hour by wind speed, from none in steps of 1 m/s.
    pub(crate) curve: Vec<f64>,
    /// Simulations in which leaves came off.
    pub(crate) marks: Vec<Mark>,
}

impl Crown {
    /// A tree of a kind of the wood, in still air.
    ///
    /// # Errors
    /// Never for presets.
    pub(crate) fn new(
        wood: &Scene,
        preset: TreePreset,
        leaves: u32,
        seed: u64,
        autumn: f32,
    ) -> anyhow::Result<Self> {
        let mut scene =
            Scene { seed, dt_s: STEP_S, autumn, species: wood.species.clone(), ..Scene::default() };
        scene.sources.clear();
        scene.trees = vec![Tree { kind: preset.name().into(), leaves, ..Tree::default() }];
        scene.wind.profile = Profile::Uniform;
        let crown = Self { scene };
        crown.world(0.0, false)?;
        Ok(crown)
    }

    fn world(&self, speed_m_s: f32, is_gusty: bool) -> anyhow::Result<World> {
        let mut scene = self.scene.clone();
        scene.wind.speed = MeanSpeed::MetresPerSecond(speed_m_s);
        if !is_gusty {
            scene.wind.gusts = Gusts { strength: 0.0, ..Gusts::default() };
            scene.wind.turbulence = Turbulence { intensity: 0.0, ..Turbulence::default() };
        }
        Ok(World::build(&scene)?)
    }

    /// Rates per second at which the petioles break that still hang, in air of a speed.
    fn rates(&self, world: &World, speed_m_s: f32) -> Vec<f64> {
        let block = world.compiled.step_block(&world.clock);
        let cx = world.compiled.context(&block);
        let interval_s = f64::from(SHED_INTERVAL) * f64::from(STEP_S);
        let hanging = (0u32..).zip(&world.leaves.place);
        let hanging = hanging.filter(|(_, place)| place.state() == LeafState::Attached);
        hanging
            .map(|(slot, _)| shed_chance(&cx, petiole_of(&cx, slot).bits, speed_m_s))
            .map(|chance| -(1.0 - f64::from(chance) / 4_294_967_296.0).ln() / interval_s)
            .collect()
    }
}

fn attached(world: &World) -> u32 {
    world.stats().leaves.attached
}

impl Season {
    /// Of a crown, averaged over the first `minutes`.
    ///
    /// # Errors
    /// A request to end, or threads that do not start.
    pub(crate) fn of(crown: &Crown, minutes: u32, cancel: &Cancel) -> anyhow::Result<Self> {
        let seconds = 60.0 * f64::from(minutes);
        let still = crown.world(0.0, false)?;
        let facts = still.compiled.forest().trees()[0].facts;
        let per_hour = facts.leaves_each * 3600.0 / seconds;
        let lost = |speed| -> f64 {
            let rates = crown.rates(&still, speed);
            rates.iter().map(|rate| 1.0 - (-rate * seconds).exp()).sum()
        };
        #[expect(clippy::cast_precision_loss, reason = "a few dozen")]
        let curve = (0..FASTEST_M_S).map(|speed| per_hour * lost(speed as f32)).collect();
        let mut marks = Vec::new();
        for speed in SIMULATED_M_S {
            for is_gusty in [false, true] {
                let before = crown.world(speed, is_gusty)?;
                let mut simulator = CpuSimulator::new(&before, CpuOptions::default())?;
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "an hour at most"
                )]
                let mut left = (seconds / f64::from(STEP_S)).round() as u32;
                while left > 0 {
                    cancel.check()?;
                    let batch = left.min(BATCH);
                    simulator.step(batch)?;
                    left -= batch;
                }
                let shed = f64::from(attached(&before) - simulator.stats()?.leaves.attached);
                if shed > 0.0 {
                    marks.push(Mark {
                        speed_m_s: f64::from(speed),
                        leaves_per_h: per_hour * shed,
                        error_per_h: per_hour * (shed * (1.0 - shed / f64::from(attached(&before)))).sqrt(),
                        is_gusty,
                    });
                }
            }
        }
        let fallen = still.stats().leaves.resting;
        let hanging = f64::from(attached(&still)) / f64::from(attached(&still) + fallen).max(1.0);
        Ok(Self { autumn: crown.scene.autumn, hanging, curve, marks })
    }
}
