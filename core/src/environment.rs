// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compiles a scene into the blocks and tables that kernels read.

use std::sync::Arc;

use glam::DVec3;

use crate::blocks::{
    EnvironmentBlock, NEVER, SOURCE_BOX, SOURCE_DISC, SOURCE_SPHERE, SourceBlock, SpeciesBlock, StepBlock,
    VortexBlock, WindBlock,
};
use crate::clock::Clock;
use crate::context::Context;
use crate::error::SceneError;
use crate::layout::{Float4, Uint4};
use crate::leaf::record::SIZE_ONE;
use crate::motion::lookup::MotionRows;
use crate::motion::table::TABLE_ROWS;
use crate::motion::{GRAVITY, MotionConstants, MotionTables, Primitive};
use crate::scene::limits::MAX_PERIODS_PER_STEP;
use crate::scene::{MAX_SOURCES, MAX_SPECIES, Release, Scene, Source, SourceShape, Species, WindParameters};
use crate::wind::gust::{GUST_ROWS, GUST_SPACING, gust_rows};
use crate::wind::profile::{PROFILE_PER_METRE, PROFILE_ROWS, profile_rows};
use crate::wind::turbulence::TURBULENCE_X;
use crate::wind::turbulence_box;

/// Height of resting leaves above the ground in metres: half the thickness of a curled dry leaf.
const REST_OFFSET_M: f32 = 0.004;
/// Time in seconds over which orientation blends after a join.
const BLEND_S: f32 = 0.15;
/// Time in seconds after which a landed leaf lies flat.
const SETTLE_S: f32 = 0.3;
/// Time constant in seconds of lying down: flat within a tenth of a second to the eye.
const SETTLE_TAU_S: f32 = 0.04;
/// Turbulence up and across the wind relative to along it (IEC 61400-1).
const DEVIATION_RATIOS: [f32; 3] = [1.0, 0.5, 0.8];
/// Cells of the turbulence box that an eddy of typical size spans.
const EDDY_CELLS: f32 = 8.0;
/// Slots of motion tables per species: a power of two above the six primitive motions.
const TABLES_PER_SPECIES: usize = 8;

/// A compiled scene: uniform block and tables, ready for any backend.
#[derive(Clone, Debug)]
pub struct Environment {
    scene: Scene,
    block: EnvironmentBlock,
    motion: Arc<[Float4]>,
    wind: Arc<[Float4]>,
}

impl Environment {
    /// Compiles a validated scene. Motion tables that a species names as a file are read now.
    ///
    /// # Errors
    /// A motion table file that cannot be read or used.
    pub fn compile(scene: &Scene) -> Result<Self, SceneError> {
        let seed = seed_words(scene.seed);
        let tables = scene
            .species
            .iter()
            .map(|species| tables_of(scene, species, seed))
            .collect::<Result<Vec<_>, _>>()?;
        let motion = pack_motion(&tables);
        let mut wind = Vec::with_capacity((PROFILE_ROWS + GUST_ROWS) as usize + 65536);
        wind.extend(profile_rows(scene.wind.profile, scene.wind.reference_height_m));
        wind.extend(gust_rows(seed));
        wind.extend(turbulence_box(seed));
        let block = compile_block(scene, &tables);
        Ok(Self { scene: scene.clone(), block, motion: motion.into(), wind: wind.into() })
    }

    /// The same environment with another wind, ground, fall and rotation speed; species, sources, seed and step
    /// length stay. Much cheaper than compiling anew.
    pub fn retune(&mut self, scene: &Scene) {
        let keep = (self.scene.species.clone(), self.scene.sources.clone(), self.scene.seed, self.scene.dt_s);
        if self.scene.wind.profile != scene.wind.profile
            || self.scene.wind.reference_height_m != scene.wind.reference_height_m
        {
            let mut wind = profile_rows(scene.wind.profile, scene.wind.reference_height_m);
            wind.extend_from_slice(&self.wind[PROFILE_ROWS as usize..]);
            self.wind = wind.into();
        }
        self.scene = scene.clone();
        (self.scene.species, self.scene.sources, self.scene.seed, self.scene.dt_s) = keep;
        let old = self.block;
        self.block = EnvironmentBlock {
            counts: Uint4([
                old.counts.0[0],
                old.counts.0[1],
                old.counts.0[2],
                q16(self.scene.rotation_speed),
            ]),
            time: Float4([old.time.0[0], old.time.0[1], old.time.0[2], displacement_gain(&self.scene)]),
            ground: ground_numbers(&self.scene),
            wind: wind_block(&self.scene),
            ..old
        };
        for (species, block) in self.scene.species.iter().zip(&mut self.block.species) {
            block.scales.0[3] = spin_unit(&self.scene, species);
        }
    }

    /// The scene this was compiled from.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The uniform block.
    pub fn block(&self) -> &EnvironmentBlock {
        &self.block
    }

    /// The packed motion tables (see [`MotionRows`]).
    pub fn motion(&self) -> &Arc<[Float4]> {
        &self.motion
    }

    /// The wind tables: profile, gusts, turbulence.
    pub fn wind(&self) -> &Arc<[Float4]> {
        &self.wind
    }

    /// The block of one step.
    pub fn step_block(&self, clock: &Clock) -> StepBlock {
        let wind = &self.block.wind;
        let carried = |per_metre: f32, period: u32| {
            let places = clock.wind_travel_m() * f64::from(per_metre);
            let period = f64::from(period);
            #[expect(
                clippy::cast_possible_truncation,
                reason = "within one period; kernels work in single precision"
            )]
            let within = (places - libm::floor(places / period) * period) as f32;
            within
        };
        let mut vortices = [<VortexBlock as bytemuck::Zeroable>::zeroed(); crate::scene::MAX_VORTICES];
        for (vortex, block) in self.scene.wind.vortices.iter().zip(&mut vortices) {
            let center = vortex.center_m.as_dvec3() + vortex.drift_m_s.as_dvec3() * clock.seconds();
            let axis = vortex.axis.as_dvec3().normalize();
            let core_squared = f64::from(vortex.core_m) * f64::from(vortex.core_m);
            *block = VortexBlock {
                center: float4(center, core_squared),
                axis: float4(axis, f64::from(vortex.circulation_m2_s) / std::f64::consts::TAU),
                axial: float4(DVec3::X * (f64::from(vortex.axial_m_s) * core_squared), 0.0),
            };
        }
        StepBlock {
            index: Uint4([clock.step(), 0, 0, 0]),
            offsets: Float4([
                carried(wind.gust.0[1], GUST_ROWS),
                carried(wind.cells.0[0], TURBULENCE_X),
                0.0,
                0.0,
            ]),
            vortices,
        }
    }

    /// What a kernel sees in one step.
    pub fn context<'a>(&'a self, step: &'a StepBlock) -> Context<'a> {
        Context {
            environment: &self.block,
            step,
            motion: MotionRows { rows: &self.motion, velocity_first: self.block.motion.0[0] },
            wind: &self.wind,
        }
    }

    /// Distance in metres that the mean wind travels in one step.
    pub fn wind_travel_per_step_m(&self) -> f64 {
        f64::from(self.block.wind.mean.0[2]) * f64::from(self.scene.dt_s)
    }
}

/// The seed as the two words of the generator's key.
pub(crate) fn seed_words(seed: u64) -> [u32; 2] {
    #[expect(clippy::cast_possible_truncation, reason = "low and high word")]
    let words = [seed as u32, (seed >> 32) as u32];
    words
}

/// Tables from a file or from the equations. The rates that the equations give have been validated with the scene;
/// those of a file are known only now.
fn tables_of(scene: &Scene, species: &Species, seed: [u32; 2]) -> Result<MotionTables, SceneError> {
    let Some(path) = &species.tables else {
        return Ok(MotionTables::generate(species, seed));
    };
    let text =
        std::fs::read_to_string(path).map_err(|source| SceneError::Read { path: path.into(), source })?;
    let tables = MotionTables::from_text(&text, path)?;
    let leaf = (1.0 + f64::from(species.speed_variation)) / (1.0 - f64::from(species.size_variation));
    let speedup = leaf * f64::from(scene.rotation_speed.max(1.0));
    let shortest = f64::from(scene.dt_s) * speedup / MAX_PERIODS_PER_STEP;
    for (primitive, table) in Primitive::ALL.iter().zip(&tables.0) {
        if table.period_s < shortest {
            return Err(SceneError::Field {
                file: path.clone(),
                field: format!("period_s of {}", primitive.code()),
                value: table.period_s.to_string(),
                allowed: format!("{shortest:.4} or more at dt_s {}, or a smaller dt_s", scene.dt_s),
            });
        }
    }
    Ok(tables)
}

/// Displacement and orientation rows of all tables, interleaved; behind them the velocity rows. Of the two quaternions
/// of a rotation each row takes the one nearer to the row before: a file may hold either, and rows are interpolated.
fn pack_motion(tables: &[MotionTables]) -> Vec<Float4> {
    let rows = TABLE_ROWS as usize;
    let count = tables.len() * TABLES_PER_SPECIES;
    let mut packed = vec![Float4::default(); count * rows * 3];
    for (species, tables) in tables.iter().enumerate() {
        for (primitive, table) in tables.0.iter().enumerate() {
            let first = (species * TABLES_PER_SPECIES + primitive) * rows;
            let mut orientation = table.orientation[0];
            for row in 0..rows {
                let [x, y, z] = table.displacement_m[row];
                packed[2 * (first + row)] = Float4([x, y, z, 0.0]);
                let next = table.orientation[row];
                let cosine: f32 = orientation.iter().zip(next).map(|(a, b)| a * b).sum();
                orientation = if cosine < 0.0 { next.map(|part| -part) } else { next };
                packed[2 * (first + row) + 1] = Float4(orientation);
                let [x, y, z] = table.velocity_m[row];
                packed[2 * count * rows + first + row] = Float4([x, y, z, 0.0]);
            }
        }
    }
    packed
}

fn compile_block(scene: &Scene, tables: &[MotionTables]) -> EnvironmentBlock {
    let [low, high] = seed_words(scene.seed);
    let mut block: EnvironmentBlock = bytemuck::Zeroable::zeroed();
    block.seed = Uint4([low, high, scene.leaf_count(), len32(scene.species.len())]);
    block.counts = Uint4([
        len32(scene.sources.len()),
        steps(SETTLE_S, scene.dt_s),
        steps(BLEND_S, scene.dt_s).min(63),
        q16(scene.rotation_speed),
    ]);
    block.motion = Uint4([len32(tables.len() * TABLES_PER_SPECIES * 2) * TABLE_ROWS, 0, 0, 0]);
    let dt = f64::from(scene.dt_s);
    block.time =
        Float4([scene.dt_s, single(1.0 / dt), single(1.0 / dt / 4_294_967_296.0), displacement_gain(scene)]);
    block.ground = ground_numbers(scene);
    block.settle = Float4([single(libm::exp(-dt / f64::from(SETTLE_TAU_S))), 0.0, 0.0, 0.0]);
    block.wind = wind_block(scene);
    for (index, (species, tables)) in scene.species.iter().zip(tables).enumerate() {
        block.species[index] = species_block(scene, species, tables);
    }
    for (index, source) in scene.sources.iter().take(MAX_SOURCES).enumerate() {
        let first: u32 = scene.sources[..index].iter().map(|earlier| earlier.count).sum();
        block.sources[index] = source_block(scene, source, first);
    }
    block
}

fn species_block(scene: &Scene, species: &Species, tables: &MotionTables) -> SpeciesBlock {
    let constants = MotionConstants::of(species);
    let dt = f64::from(scene.dt_s);
    let tau = constants.response_s();
    let decay = libm::exp(-dt / tau);
    let mut rates = [0; 8];
    for (rate, table) in rates.iter_mut().zip(&tables.0) {
        *rate = word(4_294_967_296.0 * dt / table.period_s);
    }
    let mut transitions = [0; 36];
    for (count, entry) in transitions.iter_mut().zip(species.transitions.0.iter().flatten()) {
        *count = *entry;
    }
    SpeciesBlock {
        response: Float4([single(decay), 0.0, single(tau), single(1.0 / tau)]),
        scales: Uint4([
            word(65536.0 / (constants.descent_m_s * dt)),
            spread(species.size_variation),
            spread(species.speed_variation),
            spin_unit(scene, species),
        ]),
        start: Uint4([species.start as u32, 0, 0, 0]),
        rates: bytemuck::cast(rates),
        transitions: bytemuck::cast(transitions),
    }
}

/// Fastest spin per step in 2^-18 turns. Wind makes leaves spin faster by what they lag behind its turbulence, in
/// units of their own descent: an average over the scene, so that the angle stays an integer everywhere.
fn spin_unit(scene: &Scene, species: &Species) -> u32 {
    let constants = MotionConstants::of(species);
    let mean = scene.wind.speed.metres_per_second();
    let deviation = f64::from(deviation_m_s(&scene.wind));
    let eddy_s = f64::from(EDDY_CELLS * scene.wind.turbulence.cell_m) / mean.max(0.1);
    let tau = constants.response_s();
    let lag = deviation * libm::sqrt(tau / (tau + eddy_s));
    let per_step = f64::from(species.spin_rad_s) * f64::from(scene.dt_s) * f64::from(scene.rotation_speed)
        / std::f64::consts::TAU;
    word((per_step * (1.0 + lag / constants.descent_m_s) * 262_144.0).min(65535.0))
}

fn source_block(scene: &Scene, source: &Source, first: u32) -> SourceBlock {
    let (center, extent, kind) = match source.shape {
        SourceShape::Box { center_m, half_extent_m } => (center_m, half_extent_m, SOURCE_BOX),
        SourceShape::Disc { center_m, radius_m } => {
            (center_m, glam::Vec3::new(radius_m, 0.0, radius_m), SOURCE_DISC)
        }
        SourceShape::Sphere { center_m, radius_m } => (center_m, glam::Vec3::splat(radius_m), SOURCE_SPHERE),
    };
    let center = center.to_array().map(length_units).map(|units| units as u32);
    let extent = extent.to_array().map(length_units).map(|units| units as u32);
    let start = release_step(scene, source, 0);
    SourceBlock {
        center: Uint4([center[0], center[1], center[2], kind]),
        extent: Uint4([extent[0], extent[1], extent[2], 0]),
        timing: Uint4([first, source.count, low_word(start), lifetime_steps(scene, source)]),
        shares: bytemuck::cast(share_ends(scene, source)),
    }
}

/// Steps from a release of a slot to the next; 0 for never.
pub(crate) fn lifetime_steps(scene: &Scene, source: &Source) -> u32 {
    source.recycle_after_s.map_or(0, |seconds| steps(seconds, scene.dt_s))
}

/// Step of the first release of the source's slot number `index`, possibly negative.
pub(crate) fn release_step(scene: &Scene, source: &Source, index: u32) -> i64 {
    let dt = f64::from(scene.dt_s);
    #[expect(clippy::cast_possible_truncation, reason = "validated to fit")]
    let whole = |seconds: f64| libm::floor(seconds / dt + 0.5) as i64;
    match source.release {
        Release::Burst { at_s } => whole(f64::from(at_s)),
        Release::Rate { per_s, from_s } => whole(f64::from(from_s) + f64::from(index) / f64::from(per_s)),
    }
}

/// Upper ends of the species' shares of the random words; a share that reaches the top is closed there.
fn share_ends(scene: &Scene, source: &Source) -> [u32; MAX_SPECIES] {
    let weight = |species: &Species| match source.species.is_empty() {
        true => 1,
        false => source
            .species
            .iter()
            .filter(|share| share.species == species.name)
            .map(|share| share.weight)
            .sum(),
    };
    let weights: Vec<u64> = scene.species.iter().map(|species| u64::from(weight(species))).collect();
    let total: u64 = weights.iter().sum();
    let mut ends = [NEVER; MAX_SPECIES];
    let mut until = 0;
    let last = weights.iter().rposition(|&weight| weight > 0).unwrap_or(0);
    for (index, weight) in weights.iter().enumerate().take(last) {
        until += weight;
        ends[index] = low_word(((until << 32) / total).min(u64::from(NEVER)).cast_signed());
    }
    ends
}

fn displacement_gain(scene: &Scene) -> f32 {
    single(f64::from(scene.fall_speed) * 65536.0 / f64::from(q16(scene.rotation_speed)))
}

fn ground_numbers(scene: &Scene) -> Float4 {
    let loss = f64::from(scene.ground.friction) * GRAVITY;
    let height = scene.ground.height_m;
    Float4([height, height + REST_OFFSET_M, single(loss), single(0.5 / loss)])
}

/// Standard deviation of the along-wind turbulence in m/s.
fn deviation_m_s(wind: &WindParameters) -> f32 {
    single(f64::from(wind.turbulence.intensity) * wind.speed.metres_per_second()) + wind.turbulence.calm_m_s
}

fn wind_block(scene: &Scene) -> WindBlock {
    let wind = &scene.wind;
    let speed = wind.speed.metres_per_second();
    let (sin, cos) = libm::sincos(f64::from(wind.direction_deg).to_radians());
    let gust_length = speed * f64::from(wind.gusts.interval_s) / f64::from(GUST_SPACING);
    let deviation = deviation_m_s(wind);
    let cells = DEVIATION_RATIOS.map(|ratio| 1.0 / (ratio * wind.turbulence.cell_m));
    WindBlock {
        mean: Float4([single(cos), single(sin), single(speed), PROFILE_PER_METRE]),
        gust: Float4([
            wind.gusts.strength,
            if gust_length > 0.0 { single(1.0 / gust_length) } else { 0.0 },
            scene.ground.height_m,
            0.0,
        ]),
        deviation: Float4([
            deviation * DEVIATION_RATIOS[0],
            deviation * DEVIATION_RATIOS[1],
            deviation * DEVIATION_RATIOS[2],
            0.0,
        ]),
        cells: Float4([cells[0], cells[1], cells[2], 0.0]),
        tables: Uint4([0, PROFILE_ROWS, PROFILE_ROWS + GUST_ROWS, len32(wind.vortices.len())]),
    }
}

#[expect(clippy::cast_possible_truncation, reason = "kernels work in single precision")]
fn single(value: f64) -> f32 {
    value as f32
}

/// Nearest unsigned word of a positive number; saturating.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturating by the language")]
fn word(value: f64) -> u32 {
    libm::floor(value + 0.5) as u32
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "two's complement of a validated number"
)]
fn low_word(value: i64) -> u32 {
    value as u32
}

#[expect(clippy::cast_possible_truncation, reason = "lists of a scene are short")]
fn len32(length: usize) -> u32 {
    length as u32
}

/// Lengths in 2^-10 m.
#[expect(clippy::cast_possible_truncation, reason = "validated to stay within 4096 m")]
fn length_units(metres: f32) -> i32 {
    libm::floor(f64::from(metres) * 1024.0 + 0.5) as i32
}

/// At least one step.
fn steps(seconds: f32, dt_s: f32) -> u32 {
    word(f64::from(seconds) / f64::from(dt_s)).max(1)
}

fn q16(value: f32) -> u32 {
    word(f64::from(value) * 65536.0)
}

fn spread(variation: f32) -> u32 {
    word(f64::from(variation) * f64::from(SIZE_ONE))
}

fn float4(v: DVec3, w: f64) -> Float4 {
    Float4([single(v.x), single(v.y), single(v.z), single(w)])
}
