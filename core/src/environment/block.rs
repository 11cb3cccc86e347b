// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The numbers of a scene that every kernel reads.

use super::body::body_block;
use super::convert::{len32, q16, single, steps, word};
use super::source::{source_block, trees_block};
use super::species::{response, species_block};
use super::tables::TABLES_PER_SPECIES;
use super::wind::wind_block;
use crate::blocks::{EnvironmentBlock, SOURCE_TREES};
use crate::flight::coefficients::TICKS_PER_S;
use crate::kernel::rng::seed_words;
use crate::layout::{Float4, Uint4};
use crate::motion::table::TABLE_ROWS;
use crate::motion::{GRAVITY, MotionTables};
use crate::scene::{FlightModel, MAX_SOURCES, Scene, SwayScheme};
use crate::tree::sway::{SCHEME_ARTICULATED, SCHEME_OLIAPURAM_KUMAR, SCHEME_QUIGLEY};
use crate::wind::gust::GUST_ROWS;
use crate::wind::profile::PROFILE_ROWS;
use crate::wind::turbulence::TURBULENCE_NODES;

/// Height of resting leaves above the ground in metres: half the thickness of a curled dry leaf.
const REST_OFFSET_M: f32 = 0.004;
/// Time in seconds over which orientation blends after a join.
const BLEND_S: f32 = 0.15;
/// Time in seconds after which a landed leaf lies flat.
const SETTLE_S: f32 = 0.3;
/// Time constant in seconds of lying down: flat within a tenth of a second to the eye.
const SETTLE_TAU_S: f32 = 0.04;
/// Rate at which the slowest leaf flutters on its twig in Hz; the fastest flutter half as fast again.
pub(super) const FLUTTER_HZ: f32 = 3.2;
/// Where water lies that is not there, in metres.
const NO_WATER_M: f32 = -1.0e6;

/// The uniform block of a scene whose petioles begin at that row of theirs.
pub(super) fn compile_block(scene: &Scene, tables: &[MotionTables], first_petiole: u32) -> EnvironmentBlock {
    let [low, high] = seed_words(scene.seed);
    let mut block: EnvironmentBlock = bytemuck::Zeroable::zeroed();
    block.seed = Uint4([low, high, scene.leaf_count(), len32(scene.species.len())]);
    block.counts = Uint4([
        len32(scene.sources.len()),
        steps(SETTLE_S, scene.dt_s),
        steps(BLEND_S, scene.dt_s).min(63),
        q16(scene.rotation_speed),
    ]);
    let dt = f64::from(scene.dt_s);
    let has_bodies = u32::from(scene.species.iter().any(|species| species.flight != FlightModel::Synthesis));
    block.motion = Uint4([
        len32(tables.len() * TABLES_PER_SPECIES * 2) * TABLE_ROWS,
        0,
        has_bodies,
        word(TICKS_PER_S * dt * 65536.0),
    ]);
    block.time =
        Float4([scene.dt_s, single(1.0 / dt), single(1.0 / dt / 4_294_967_296.0), displacement_gain(scene)]);
    block.ground = ground_numbers(scene);
    block.terrain = terrain_words(scene);
    block.relief = relief_numbers(scene);
    block.settle = Float4([single(libm::exp(-dt / f64::from(SETTLE_TAU_S))), 0.0, 0.0, 0.0]);
    block.wind = wind_block(scene);
    for (index, (species, tables)) in scene.species.iter().zip(tables).enumerate() {
        block.species[index] = species_block(scene, species, tables);
        block.responses[index] = response(scene, species);
        block.bodies[index] = body_block(species, scene.dt_s);
    }
    for (index, source) in scene.sources.iter().take(MAX_SOURCES).enumerate() {
        let earlier: u32 = scene.sources[..index].iter().map(|earlier| earlier.count).sum();
        let first = scene.tree_leaf_count() + earlier;
        block.sources[index] = source_block(scene, source, first);
    }
    block.sources[SOURCE_TREES as usize] = trees_block(scene);
    block.crowns = Uint4([
        scene.tree_leaf_count(),
        first_petiole,
        word(4_294_967_296.0 * f64::from(FLUTTER_HZ) * dt),
        scheme(scene),
    ]);
    block
}

/// Number of the scheme that trees sway by.
pub(super) fn scheme(scene: &Scene) -> u32 {
    match scene.sway {
        SwayScheme::Articulated => SCHEME_ARTICULATED,
        SwayScheme::Quigley => SCHEME_QUIGLEY,
        SwayScheme::OliapuramKumar => SCHEME_OLIAPURAM_KUMAR,
    }
}

/// What a table's displacement grows by, as its phase goes at the scene's rotation speed.
pub(super) fn displacement_gain(scene: &Scene) -> f32 {
    single(f64::from(scene.fall_speed) * 65536.0 / f64::from(q16(scene.rotation_speed)))
}

/// Height of the ground or of the water on it, height of resting leaves, loss of speed by friction, half its inverse.
pub(super) fn ground_numbers(scene: &Scene) -> Float4 {
    let loss = f64::from(scene.ground.friction) * GRAVITY;
    let height = match (scene.ground.terrain, scene.ground.water) {
        (None, Some(water)) => scene.ground.height_m.max(water.height_m),
        _ => scene.ground.height_m,
    };
    Float4([height, height + REST_OFFSET_M, single(loss), single(0.5 / loss)])
}

/// First row of the hills, mask and logarithm of the cells along an edge, and that there are hills.
fn terrain_words(scene: &Scene) -> Uint4 {
    let first = PROFILE_ROWS + GUST_ROWS + 2 * TURBULENCE_NODES;
    scene
        .ground
        .terrain
        .map_or(Uint4::default(), |terrain| Uint4([first, (1 << terrain.levels) - 1, terrain.levels, 1]))
}

/// Cells of the hills per metre, highest place where a leaf can rest, water above the ground's height, gravity.
pub(super) fn relief_numbers(scene: &Scene) -> Float4 {
    let ground = &scene.ground;
    let rest = ground_numbers(scene).0[1];
    let Some(terrain) = ground.terrain else {
        return Float4([0.0, rest, 0.0, single(GRAVITY)]);
    };
    let water = ground.water.map_or(NO_WATER_M, |water| water.height_m - ground.height_m);
    let per_metre = f64::from(1u32 << terrain.levels) / f64::from(terrain.edge_m);
    Float4([single(per_metre), rest + terrain.relief_m.max(water) + 0.001, water, single(GRAVITY)])
}
