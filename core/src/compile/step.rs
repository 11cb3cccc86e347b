// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compiles what changes from step to step: the wind's patterns, what moves, births.

use super::jet::jet_block;
use super::plume::{plume_block, puffs_per_s};
use super::snow::{blow_over, snow_friction, snow_step};
use super::vortex::vortex_block;
use super::{CompiledScene, Cycle};
use crate::arith::rng::{random, unit_float};
use crate::blocks::{JetBlock, MomentBlock, MoverBlock, PlumeBlock, StepBlock, VortexBlock};
use crate::clock::Clock;
use crate::convert::{len32, single};
use crate::device::leaf::burn::FIRE_WORDS;
use crate::device::leaf::collide::COLLISION_CELLS_PER_M;
use crate::device::wind::gust::{GUST_ROWS, wind_gust};
use crate::device::wind::turbulence::TURBULENCE_X;
use crate::scene::{MAX_MOVERS, Profile};

/// Random words of the grid in which leaves collide, by step.
const STREAM_COLLISION: u32 = 38;

impl CompiledScene {
    /// The block of one step.
    pub fn step_block(&self, clock: &Clock) -> StepBlock {
        let middle = 0.5 * f64::from(self.block.wind.interval_steps);
        let mut step = StepBlock {
            moments: [0.0, middle].map(|steps| self.moment_block(clock, steps)),
            movers: self.movers_at(clock.seconds()),
            births: self.births.blocks(clock.step(), clock.born()),
            snow: snow_step(self.scene.weather.as_ref(), clock.dt_s().into(), clock.seconds()),
            collision_shift_m: self.collision_shift_m(clock.step()),
            index: clock.step(),
            vortex_count: len32(self.scene.wind.vortices.len()),
            jet_count: len32(self.scene.wind.jets.len()),
            slipstream_count: self.solids.slipstream_count(),
            plume_count: len32(self.scene.wind.plumes.len()),
        };
        if let Some(weather) = &self.scene.weather {
            let wind = &self.block.wind;
            let along = weather.center_m.x * wind.direction_x + weather.center_m.y * wind.direction_z;
            let gust = wind_gust(&self.context(&step), &step.moments[0], along);
            let friction_m_s = snow_friction(&self.scene, &self.block, gust);
            blow_over(&mut step.snow, clock.dt_s().into(), friction_m_s);
        }
        step
    }

    /// Shift of the grids in which leaves collide and heat each other in a step, less than a cell of the coarser one along each axis.
    fn collision_shift_m(&self, step: u32) -> [f32; 3] {
        if !self.block.collides(step) && !self.block.heats(step) {
            return [0.0; 3];
        }
        let [x, y, z, _] = random(self.block.seed, step, STREAM_COLLISION);
        [x, y, z].map(|word| unit_float(word) * (1.0 / COLLISION_CELLS_PER_M))
    }

    /// Solid parts that move, in the step that begins at a time.
    fn movers_at(&self, time_s: f64) -> [MoverBlock; MAX_MOVERS] {
        if self.solids.are_still() {
            return bytemuck::Zeroable::zeroed();
        }
        self.solids.movers_at(time_s, f64::from(self.block.dt_s), self.block.solids.reach_m, |x_m, z_m| {
            self.ground_height(single(x_m), single(z_m)).into()
        })
    }

    /// The wind so many steps after a step's start.
    fn moment_block(&self, clock: &Clock, steps: f64) -> MomentBlock {
        let wind = &self.block.wind;
        let carried = |per_metre: f32, period: u32, of_cycle: fn(&Cycle) -> u32| {
            let places = match &self.cycle {
                None => {
                    let travel_m = clock.wind_travel_m() + steps * self.wind_travel_per_step_m();
                    travel_m * f64::from(per_metre)
                }
                Some(cycle) => cycle.share(clock.step(), steps) * f64::from(of_cycle(cycle)),
            };
            let period = f64::from(period);
            #[expect(
                clippy::cast_possible_truncation,
                reason = "within one period; kernels work in single precision"
            )]
            let within = (places - libm::floor(places / period) * period) as f32;
            within
        };
        let seconds = clock.seconds() + steps * f64::from(clock.dt_s());
        let mut vortices = [<VortexBlock as bytemuck::Zeroable>::zeroed(); crate::scene::MAX_VORTICES];
        for (vortex, block) in self.scene.wind.vortices.iter().zip(&mut vortices) {
            *block = vortex_block(vortex, seconds);
        }
        let mut jets = [<JetBlock as bytemuck::Zeroable>::zeroed(); crate::scene::MAX_JETS];
        // A uniform wind has no ground.
        let has_ground = self.scene.wind.profile != Profile::Uniform;
        let ground = |at: glam::DVec3| {
            has_ground.then(|| {
                self.ground_height(single(at.x), single(at.z)).max(self.block.surface_height_m).into()
            })
        };
        for (jet, block) in self.scene.wind.jets.iter().zip(&mut jets) {
            *block = jet_block(jet, seconds, ground);
        }
        let mut plumes = [<PlumeBlock as bytemuck::Zeroable>::zeroed(); crate::scene::MAX_PLUMES];
        for (plume, block) in self.scene.wind.plumes.iter().zip(&mut plumes) {
            let ground_m = ground(plume.at_m.as_dvec3()).unwrap_or(0.0);
            let per_s = puffs_per_s(plume);
            let puffs = match &self.cycle {
                None => (per_s, per_s * seconds),
                Some(cycle) => cycle.repeated(per_s, clock, steps),
            };
            *block = plume_block(&self.scene, plume, seconds, puffs, ground_m);
        }
        for (fire, block) in (0..).zip(&mut plumes).filter(|(_, block)| block.feeding_m2 != 0.0) {
            block.fire = self.block.first_fire + fire * FIRE_WORDS;
        }
        let slipstreams = if self.solids.are_still() {
            bytemuck::Zeroable::zeroed()
        } else {
            let ground = |x_m, z_m| self.ground_height(single(x_m), single(z_m)).into();
            self.solids.slipstreams_at(seconds, f64::from(self.block.dt_s), ground)
        };
        MomentBlock {
            vortices,
            jets,
            plumes,
            slipstreams,
            gust_offset: carried(wind.gust_rows_per_m, GUST_ROWS, |cycle| cycle.gust_rows),
            turbulence_offset: carried(wind.cells_per_m[0], TURBULENCE_X, |cycle| cycle.cells),
            padding: Default::default(),
        }
    }
}
