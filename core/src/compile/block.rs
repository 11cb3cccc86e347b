// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compiles the numbers of a scene that every kernel reads.

use super::body::body_block;
use super::burn::set_burning;
use super::source::{source_block, trees_block};
use super::species::{cones_block, response_block, species_block};
use super::water::set_floating;
use super::wind::{MOST_INTERVAL_STEPS, deviation_m_s, wind_block};
use crate::arith::rng::seed_words;
use crate::blocks::{CollisionBlock, LitterBlock, SOURCE_TREES, SceneBlock, SwayBlock, WindBlock};
use crate::convert::{len32, low_word, q16, single, steps, word};
use crate::device::leaf::burn::BURN_STAGES;
use crate::device::leaf::collide::COLLISION_WEIGHT_MOST;
use crate::device::leaf::wake::{CALM_INTERVAL, COVER_INTERVAL, WAKE_INTERVAL};
use crate::device::terrain::litter::{LITTER_CELLS_PER_M, LITTER_HIGHEST_M};
use crate::device::terrain::snow::SNOW_HIGHEST_M;
use crate::device::tree::sway::{IMPLICITNESS, SCHEME_ARTICULATED, SCHEME_OLIAPURAM_KUMAR, SCHEME_QUIGLEY};
use crate::flight::coefficients::TICKS_PER_S;
use crate::motion::{AIR_DENSITY, MotionTables};
use crate::scene::{DEEPEST_BED_M, FlightModel, Litter, MAX_SOURCES, ObjectMotion, Scene, SwayScheme};
use crate::solid::Solid;

const _: () = assert!(DEEPEST_BED_M <= LITTER_HIGHEST_M, "leaves of a bed have a place in the litter");

/// Height of resting leaves above the ground in metres: half the thickness of a curled dry leaf.
pub const REST_OFFSET_M: f32 = 0.004;
/// Time in seconds over which orientation blends after a join.
const BLEND_S: f32 = 0.15;
/// Time in seconds after which a landed leaf lies flat.
const SETTLE_S: f32 = 0.3;
/// Time constant in seconds of lying down: flat within a tenth of a second to the eye.
const SETTLE_TAU_S: f32 = 0.04;
/// Frequency at which the slowest leaf flutters on its twig in Hz; the fastest flutter half as fast again.
pub(super) const FLUTTER_HZ: f32 = 3.2;
/// Restitution of leaves that strike each other, assumed.
const COLLISION_RESTITUTION: f32 = 0.1;
/// Time in s from one at which leaves collide with each other to the next: one runs through a few cells of the air at most.
const COLLISION_S: f32 = 1.0 / 15.0;

/// Height of water that is not there, in metres.
pub const NO_WATER_M: f32 = -1.0e6;

/// Uniform block of a scene, but for the places of its tables behind those of the wind.
pub(super) fn compile_block(scene: &Scene, tables: &[MotionTables], solids: &[Solid]) -> SceneBlock {
    let [low, high] = seed_words(scene.seed);
    let mut block: SceneBlock = bytemuck::Zeroable::zeroed();
    block.seed = [low, high];
    block.ids_per_life = scene.leaf_count();
    block.species_count = len32(scene.species.len());
    block.table_species = block.species_count * if scene.leaves_burn() { 1 + BURN_STAGES } else { 1 };
    block.settle_steps = steps(SETTLE_S, scene.dt_s);
    block.blend_steps = steps(BLEND_S, scene.dt_s).min(63);
    let dt = f64::from(scene.dt_s);
    let litter = scene.ground.litter.as_ref();
    block.ticks_per_step_q16 = word(TICKS_PER_S * dt * 65536.0);
    block.has_bodies = u32::from(
        litter.is_some() || scene.species.iter().any(|species| species.flight != FlightModel::Synthesis),
    );
    if let Some(litter) = litter {
        set_litter_grid(litter, &mut block.litter);
    }
    block.dt_s = scene.dt_s;
    block.inv_dt_s = single(1.0 / dt);
    block.tilt_kept = single(libm::exp(-dt / f64::from(SETTLE_TAU_S)));
    if let Some(terrain) = scene.ground.terrain {
        block.has_terrain = 1;
        block.hill_shift = terrain.levels;
    }
    block.tree_leaf_count = scene.tree_leaf_count();
    block.flutter_per_step = word(4_294_967_296.0 * f64::from(FLUTTER_HZ) * dt);
    retune_block(scene, solids, &mut block);
    for (index, (species, tables)) in scene.species.iter().zip(tables).enumerate() {
        block.species[index] = species_block(scene, species, tables);
        block.bodies[index] = body_block(species, scene);
    }
    set_burning(scene, &mut block);
    block.cones = cones_block(scene);
    block.collisions = collision_block(scene, &block);
    for (index, source) in scene.sources.iter().take(MAX_SOURCES).enumerate() {
        block.sources[index] = source_block(scene, source);
    }
    block.sources[SOURCE_TREES as usize] = trees_block(scene);
    block
}

/// Sets what may change while a simulation runs: wind, ground, fall and rotation speed, the scheme of trees.
pub(super) fn retune_block(scene: &Scene, solids: &[Solid], block: &mut SceneBlock) {
    block.rotation_speed_q16 = q16(scene.rotation_speed);
    block.displacement_gain =
        single(f64::from(scene.fall_speed) * 65536.0 / f64::from(block.rotation_speed_q16));
    block.sway_scheme = scheme(scene);
    block.wind = wind_block(scene, solids);
    block.sway = sway_block(scene, &block.wind);
    set_ground(scene, block);
    block.responses = response_block(scene);
}

/// Number of the scheme that trees sway by.
fn scheme(scene: &Scene) -> u32 {
    match scene.sway {
        SwayScheme::Articulated => SCHEME_ARTICULATED,
        SwayScheme::Quigley => SCHEME_QUIGLEY,
        SwayScheme::OliapuramKumar => SCHEME_OLIAPURAM_KUMAR,
    }
}

/// Times at which joints are solved. In the step between, segments go on as they move, which is right where the wind is so
/// weak that falling leaves, too, sample it for the longest interval.
fn sway_block(scene: &Scene, wind: &WindBlock) -> SwayBlock {
    let interval_steps = if wind.interval_steps == MOST_INTERVAL_STEPS { scene.sway_every } else { 1 };
    let dt = f64::from(interval_steps) * f64::from(scene.dt_s);
    SwayBlock {
        interval_steps,
        dt_s: single(dt),
        inv_dt_s: single(1.0 / dt),
        ahead_s: single(f64::from(IMPLICITNESS) * dt),
    }
}

/// Sets the numbers of the ground, of the water on it and of leaves that slide there.
fn set_ground(scene: &Scene, block: &mut SceneBlock) {
    let ground = &scene.ground;
    let loss = f64::from(ground.friction) * f64::from(scene.gravity_m_s2);
    block.gravity_m_s2 = scene.gravity_m_s2;
    block.friction_m_s2 = single(loss);
    block.stop_s2_m = single(0.5 / loss);
    block.ground_height_m = ground.height_m;
    block.surface_height_m = match (ground.terrain, ground.water) {
        (None, Some(water)) => ground.height_m.max(water.height_m),
        _ => ground.height_m,
    };
    block.rest_height_m = block.surface_height_m + REST_OFFSET_M;
    block.highest_rest_m = block.rest_height_m;
    (block.water_relief_m, block.hill_cells_per_m) = (0.0, 0.0);
    if let Some(terrain) = ground.terrain {
        block.water_relief_m = ground.water.map_or(NO_WATER_M, |water| water.height_m - ground.height_m);
        block.highest_rest_m = block.rest_height_m + terrain.relief_m.max(block.water_relief_m) + 0.001;
        block.hill_cells_per_m = single(f64::from(1u32 << terrain.levels) / f64::from(terrain.edge_m));
    }
    if let Some(litter) = &ground.litter {
        block.highest_rest_m += LITTER_HIGHEST_M;
        if scene.weather.is_some() {
            block.highest_rest_m += SNOW_HIGHEST_M;
        }
        set_litter(scene, litter, &mut block.litter);
    }
}

/// Sets the grid of litter: the cells that the rectangle covers, and one more all around.
fn set_litter_grid(litter: &Litter, block: &mut LitterBlock) {
    let cells = f64::from(LITTER_CELLS_PER_M);
    let span = |center_m: f32, size_m: f32| {
        let first = libm::floor((f64::from(center_m) - 0.5 * f64::from(size_m)) * cells);
        #[expect(clippy::cast_possible_truncation, reason = "validated to stay within 4096 m and a few")]
        let first = first as i64 - 1;
        (low_word(first), word(f64::from(size_m) * cells) + 2)
    };
    (block.first_column, block.columns) = span(litter.center_m.x, litter.size_m.x);
    (block.first_line, block.lines) = span(litter.center_m.y, litter.size_m.y);
    block.is_living = u32::from(!litter.still);
}

/// Sets what of litter may change while a simulation runs.
fn set_litter(scene: &Scene, litter: &Litter, block: &mut LitterBlock) {
    let turns = |degrees: f32| word(f64::from(degrees) / 360.0 * 65536.0);
    let (least, most) = litter.raised_deg;
    block.friction = litter.friction;
    block.ground_friction = scene.ground.friction;
    block.restitution = litter.restitution;
    block.adhesion_m2_s2 = single(f64::from(litter.adhesion_n_m2) / AIR_DENSITY);
    block.least_raise = turns(least);
    block.raise_spread = turns(most) - turns(least);
    let is_calm = scene.wind.speed.metres_per_second() == 0.0
        && deviation_m_s(&scene.wind) == 0.0
        && scene.wind.vortices.is_empty()
        && scene.wind.jets.is_empty()
        && scene.wind.plumes.is_empty()
        && scene.walkers.is_empty()
        && scene.objects.iter().all(|object| object.motion == ObjectMotion::Still);
    block.is_calm = u32::from(is_calm);
    (block.wake_steps, block.cover_steps) =
        if is_calm { (CALM_INTERVAL, CALM_INTERVAL) } else { (WAKE_INTERVAL, COVER_INTERVAL) };
    block.rest_m2_s2 = scene.gravity_m_s2 * REST_OFFSET_M;
    set_floating(scene, litter, block);
}

/// Collisions of leaves with each other. Their weights are their masses, since the density of litter is the same for all.
fn collision_block(scene: &Scene, block: &SceneBlock) -> CollisionBlock {
    let interval_steps = steps(COLLISION_S, scene.dt_s);
    let heaviest = scene.species.iter().zip(&block.bodies).map(|(species, body)| {
        let ratio = 1.0 + f64::from(species.size_variation);
        f64::from(body.litter_units) * ratio * ratio
    });
    let heaviest = heaviest.fold(0.0, f64::max).max(1.0);
    CollisionBlock {
        interval_steps,
        interval_s: single(f64::from(interval_steps) * f64::from(scene.dt_s)),
        restitution: COLLISION_RESTITUTION,
        weight_per_unit: single((f64::from(COLLISION_WEIGHT_MOST) - 1.0) / heaviest),
    }
}
