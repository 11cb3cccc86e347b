// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/release.wgsl
//!
//! The release of a leaf: place, size, speed and first motion, in integers but for the last conversion.

use super::launch::{leaf_hold, leaf_launch};
use super::own::{first_phase, motion_params, own_velocity};
use super::record::{
    AERODYNAMIC, CONE_SPIRAL, Drift, Place, SIZE_ONE, STATE_DORMANT, STATE_FALLING, Schedule,
    blend_steps_left, heading_word, leaf_appearance, leaf_source, leaf_species, own_size, place_bits,
    twig_sizes, with_blend, with_stage,
};
use crate::arith::rng::{mul_high, mul_q16, random, triangular};
use crate::arith::vector::Vec3;
use crate::blocks::{
    LENGTH_UNIT, NEVER, SHARE_VECTORS, SOURCE_BOX, SOURCE_DISC, SOURCE_TREES, SourceBlock, SpeciesBlock,
};
use crate::context::Context;
use crate::device::motion::feature::{STAGE_COUNT, STREAM_PLACE, STREAM_TRAITS, stage_end, stage_words};
use crate::device::terrain::ground::ground_surface;
use crate::leaf::LeafMut;

crate::shared_constants! {
    /// Tries to draw a point inside a disc or ball before a point of the inscribed box is taken.
    pub const PLACE_TRIES: u32 = 16;
}

/// Offset within a box: uniform over -extent..=extent.
#[inline(always)]
fn offset_in_box(word: u32, extent: u32) -> i32 {
    mul_high(word, 2 * extent + 1) as i32 - extent as i32
}

/// Offset of a unit coordinate in -32767..=32767, scaled to the extent.
#[inline(always)]
fn offset_scaled(unit: i32, extent: u32) -> i32 {
    let magnitude = mul_high(unit.unsigned_abs() << 17, extent) as i32;
    if unit < 0 { -magnitude } else { magnitude }
}

/// Unit coordinate from a random word.
#[inline(always)]
fn unit_coordinate(word: u32) -> i32 {
    mul_high(word, 65535) as i32 - 32767
}

/// Place of leaf `id` in its source, x, y and z in units of 2^-10 m.
#[inline(always)]
pub fn release_place(source: &SourceBlock, seed: [u32; 2], id: u32) -> [i32; 3] {
    let center = source.center_units;
    let extent = source.extent_units;
    let mut words = random(seed, id, STREAM_PLACE);
    if source.kind == SOURCE_BOX {
        return [
            center[0] + offset_in_box(words[0], extent[0]),
            center[1] + offset_in_box(words[1], extent[1]),
            center[2] + offset_in_box(words[2], extent[2]),
        ];
    }
    let mut unit = [0, 0, 0];
    let mut inside = false;
    for attempt in 0..PLACE_TRIES {
        if !inside {
            words = random(seed, id, STREAM_PLACE + attempt);
            unit = [unit_coordinate(words[0]), unit_coordinate(words[1]), unit_coordinate(words[2])];
            if source.kind == SOURCE_DISC {
                unit[1] = 0;
            }
            let squared =
                (unit[0] * unit[0]) as u32 + (unit[1] * unit[1]) as u32 + (unit[2] * unit[2]) as u32;
            inside = squared <= 32767 * 32767;
        }
    }
    if !inside {
        unit = [unit[0] / 2, unit[1] / 2, unit[2] / 2];
    }
    [
        center[0] + offset_scaled(unit[0], extent[0]),
        center[1] + offset_scaled(unit[1], extent[1]),
        center[2] + offset_scaled(unit[2], extent[2]),
    ]
}

/// Upper end of a species' share of random words in a source.
#[inline(always)]
pub fn source_share(source: &SourceBlock, species: u32) -> u32 {
    source.shares[(species >> 2) as usize].0[(species & 3) as usize]
}

/// Species of a leaf, from the shares of its source and a random word.
#[inline(always)]
pub fn release_species(source: &SourceBlock, word: u32) -> u32 {
    let mut species = 0;
    for candidate in 0..4 * SHARE_VECTORS {
        species += if word >= source_share(source, candidate) { 1 } else { 0 };
    }
    species
}

/// Size and speed of a leaf relative to its species, in 2^-14.
#[derive(Clone, Copy, Debug)]
pub struct SizeSpeed {
    /// Size.
    pub size: u32,
    /// Speed.
    pub speed: u32,
}

/// Size and speed of a leaf, from the random words of its traits.
#[inline(always)]
pub fn release_size_speed(species: &SpeciesBlock, words: [u32; 4]) -> SizeSpeed {
    let size = SIZE_ONE as i32 + ((species.size_spread_q14 as i32 * triangular(words[1])) >> 16);
    let speed = SIZE_ONE as i32 + ((species.speed_spread_q14 as i32 * triangular(words[2])) >> 16);
    SizeSpeed { size: size as u32, speed: speed as u32 }
}

/// Rate of a primitive motion relative to its species' in 2^-16: small and fast leaves swing faster.
#[inline(always)]
pub fn release_ratio(size_speed: SizeSpeed) -> u32 {
    (size_speed.speed << 16) / size_speed.size
}

/// Phase per step of a species' primitive motion for a leaf of nominal size and speed.
#[inline(always)]
pub fn species_rate(species: &SpeciesBlock, primitive: u32) -> u32 {
    species.rates[(primitive >> 2) as usize].0[(primitive & 3) as usize]
}

/// Phase per step of a primitive motion for a leaf of that ratio.
#[inline(always)]
pub fn release_rate(species: &SpeciesBlock, primitive: u32, ratio_q16: u32) -> u32 {
    mul_q16(species_rate(species, primitive), ratio_q16)
}

/// Time in 2^-16 steps of a fall through still air from `height` (2^-10 m) at that speed.
#[inline(always)]
pub fn release_fall_time(species: &SpeciesBlock, height: i32, speed: u32) -> u32 {
    let positive = height.max(0) as u32;
    let per_metre = species.fall_steps_q16_per_m;
    let nominal = (mul_high(positive, per_metre) << 22) | (positive.wrapping_mul(per_metre) >> 10);
    mul_q16(nominal, (1 << 30) / speed)
}

/// The step of the next event of a leaf in `stage`: the stage's end or the slot's next release.
#[inline(always)]
pub fn next_event(cx: &Context<'_>, id: u32, release: u32, fall_time: u32, stage: u32, source: u32) -> u32 {
    let lifetime = cx.scene.sources[source as usize].lifetime_steps;
    // A tree takes its leaves back only from the ground.
    let is_final = lifetime == 0 || source == SOURCE_TREES;
    let recycle = if is_final { NEVER } else { release.wrapping_add(lifetime) };
    if stage + 1 >= STAGE_COUNT {
        return recycle;
    }
    let seed = cx.scene.seed;
    recycle.min(release.wrapping_add(stage_end(seed, id, fall_time, stage) >> 16))
}

/// Lets leaf `id` go from `source` at step `release`: at rest, in the first primitive motion of its species.
#[inline(always)]
pub fn leaf_release(cx: &Context<'_>, leaf: &mut LeafMut<'_>, id: u32, source: u32, release: u32) {
    let seed = cx.scene.seed;
    let from = &cx.scene.sources[source as usize];
    let place = release_place(from, seed, id);
    let traits = random(seed, id, STREAM_TRAITS);
    leaf_drop(cx, leaf, id, traits, source, release_species(from, traits[0]), place, release);
}

/// Lets leaf `id` of a species go from `place`, in units of 2^-10 m, with the random words of its traits.
#[expect(
    clippy::cast_possible_truncation,
    clippy::too_many_arguments,
    reason = "a whole number in range; as in WGSL"
)]
#[inline(always)]
pub fn leaf_drop(
    cx: &Context<'_>,
    leaf: &mut LeafMut<'_>,
    id: u32,
    traits: [u32; 4],
    source: u32,
    species_index: u32,
    place: [i32; 3],
    release: u32,
) {
    let species = &cx.scene.species[species_index as usize];
    let size_speed = release_size_speed(species, traits);
    let position =
        [place[0] as f32 * LENGTH_UNIT, place[1] as f32 * LENGTH_UNIT, place[2] as f32 * LENGTH_UNIT];
    let ground = (ground_surface(cx, position[0], position[2]) + cx.scene.surface_height_m) * 1024.0;
    leaf.identity.fall_time = release_fall_time(species, place[1] - ground.floor() as i32, size_speed.speed);
    leaf.identity.appearance = leaf_appearance(traits[3], traits[0], source);
    leaf.schedule.size = size_speed.size;
    leaf.schedule.heading = heading_word(0, traits[3] >> 16);
    *leaf.place = Place { position, bits: place_bits(STATE_DORMANT, 0, 0, species_index, 0) };
    leaf.drift.velocity = [0.0, 0.0, 0.0];
    if species.first_motion == AERODYNAMIC {
        leaf_hold(cx, leaf, id);
    }
    leaf_set_off(cx, leaf, id, release, size_speed);
}

/// Begins the first stage of a leaf's fall, or its flight. It sets off with the velocity in its drift.
#[inline(always)]
pub fn leaf_set_off(cx: &Context<'_>, leaf: &mut LeafMut<'_>, id: u32, release: u32, size_speed: SizeSpeed) {
    let seed = cx.scene.seed;
    let before = leaf.place.bits;
    let source = leaf_source(leaf.identity.appearance);
    let species_index = leaf_species(before);
    let species = &cx.scene.species[species_index as usize];
    let stage = stage_words(seed, id, 0);
    let primitive = species.first_motion;
    leaf.identity.id = id;
    leaf.identity.release = release;
    leaf.identity.appearance = with_stage(leaf.identity.appearance, 0);
    if primitive == AERODYNAMIC {
        leaf.schedule.event = next_event(cx, id, release, 0, STAGE_COUNT, source);
        leaf.place.bits = place_bits(STATE_FALLING, 0, primitive, species_index, 0);
        leaf_launch(cx, leaf, id);
        return;
    }
    // A cone spiral lasts until the ground.
    let last = if primitive == CONE_SPIRAL { STAGE_COUNT } else { 0 };
    let schedule = Schedule {
        event: next_event(cx, id, release, leaf.identity.fall_time, last, source),
        rate: release_rate(species, primitive, release_ratio(size_speed)),
        size: leaf.schedule.size,
        heading: heading_word(stage[2] >> 16, leaf.schedule.heading),
    };
    *leaf.schedule = schedule;
    let bits = place_bits(STATE_FALLING, blend_steps_left(before), primitive, species_index, stage[3]);
    leaf.place.bits = bits;
    let phase = first_phase(cx, bits, stage[1]);
    let own = own_velocity(cx, bits, phase, motion_params(schedule));
    *leaf.drift = Drift { velocity: (Vec3::from(leaf.drift.velocity) - own).to_array(), phase };
}

/// Lets a leaf go whose petiole has broken, where it is and as fast as it is.
#[inline(always)]
pub fn leaf_detach(cx: &Context<'_>, leaf: &mut LeafMut<'_>, release: u32) {
    let seed = cx.scene.seed;
    let id = leaf.identity.id.wrapping_add(cx.scene.ids_per_life);
    let traits = random(seed, id, STREAM_TRAITS);
    let species = &cx.scene.species[leaf_species(leaf.place.bits) as usize];
    let size = own_size(leaf.schedule.size);
    leaf.schedule.size = twig_sizes(size, size);
    if species.first_motion != AERODYNAMIC {
        leaf.schedule.heading = heading_word(0, traits[3] >> 16);
    }
    leaf.place.bits = with_blend(leaf.place.bits, cx.scene.blend_steps);
    let size_speed = SizeSpeed { size, speed: release_size_speed(species, traits).speed };
    leaf_set_off(cx, leaf, id, release, size_speed);
}
