// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/burn.wgsl
//!
//! Burning leaves. Hot air and burning neighbours heat a leaf: its water boils away first, then it warms until it catches. A front runs over
//! it from one end to the other. What it has passed has burnt, all but the ash; the leaf goes through stages of falling mass, each compiled
//! like a species of its own, and is gone in the end. What lies clings to its neighbours as before: the wind that wakes it is that of a whole
//! leaf.
//!
//! Burning leaves add their heat release to cells of the air, as integers, so that the order of leaves does not matter. A leaf is heated by
//! its own cell: the grid lies elsewhere each time, by the same random shift as that of collisions, so that its faces leave no trace. Flames
//! lean with the wind, so the heat goes where it blows.

use super::air_cell::{cell_floor, cell_key};
use super::record::{
    CHANGE_REMOVED, STATE_DORMANT, STATE_RESTING, flies, is_afloat, is_covered, is_sunk, leaf_species,
    leaf_state, lies, lies_still, place_bits, size_ratio, with_litter_change, with_species,
};
use crate::arith::lane::{Real, Word};
use crate::arith::math::{inverse_fifth_root, reciprocal};
use crate::arith::rng::{random, unit_float};
use crate::arith::vector::{Vec3, vec3_dot};
use crate::blocks::{BurnBlock, NEVER, PlumeBlock};
use crate::context::Context;
use crate::device::wind::plume::plume_warmth;
use crate::device::wind::sample::wind_at;
use crate::leaf::LeafMut;

crate::shared_constants! {
    /// In place of the step at which a leaf caught: it has not.
    pub const UNLIT: u32 = 0;
    /// Stages of a burning leaf. Behind the species of a scene come those of its first stage, of its second, of its third.
    pub const BURN_STAGES: u32 = 3;
    /// Steps from one time at which leaves are heated to the next.
    pub const BURN_INTERVAL: u32 = 8;
    /// Binary logarithm of the number of cells in a simulator's table: cells of the air share them, by a hash.
    pub const BURN_CELL_BITS: u32 = 14;
    /// Words of [`BurnSums`].
    pub const BURN_WORDS: u32 = 4;
    /// Cells of the air per metre.
    pub const BURN_CELLS_PER_M: f32 = 12.0;
    /// Temperature rise in K of a flame, as of the steady flame of [`plume_warmth`].
    pub const FLAME_RISE_K: f32 = 800.0;
    /// Heat release in W per m³ of flame: of the order of half a megawatt (Cox 1995, Combustion Fundamentals of Fire).
    pub const FLAME_W_PER_M3: f32 = 500_000.0;
    /// Heat release that counts as one, in 1/W.
    pub const BURN_POWER_ONE: f32 = 10.0;
    /// Largest heat release of a leaf in those units.
    pub const BURN_POWER_MOST: f32 = 65_536.0;
    /// Temperature rise in K at which water boils.
    pub const BOILING_RISE_K: f32 = 80.0;
    /// Time in s for which the wind carries the heat of a burning leaf before it comes to its neighbours.
    pub const FLAME_LEAN_S: f32 = 0.1;
    /// Words of a fire that leaves feed, behind the heights of litter: its heat release in the units above, and as floats the speed in m/s and the inverse height in 1/m that
    /// it gives its plume; one is unused.
    pub const FIRE_WORDS: u32 = 4;
    /// Binary logarithm of the intervals in which the heat release of a fire follows its leaves.
    pub const FIRE_FOLLOWS: u32 = 2;
    /// Kilowatts of a unit of heat release.
    pub const FIRE_KW: f32 = 1e-4;
    /// Heat release in kW below which there is no plume.
    pub const FIRE_LEAST_KW: f32 = 0.01;
    /// Largest heat release in kW that a plume follows.
    pub const FIRE_MOST_KW: f32 = crate::scene::MOST_FED_KW;
    /// Random words of a leaf's ignition.
    pub const STREAM_IGNITION: u32 = 39;
}

crate::shared_record! {
    /// Burning of a leaf. Only scenes in which leaves burn have any; zeros are cold.
    pub struct Burn {
        /// Heat taken up in J/m².
        pub heat: f32,
        /// Share of the way that its front had run when water put it out; 0 of others.
        pub out_way: f32,
        /// Step after the one in which it caught, or [`UNLIT`].
        pub lit: u32,
        /// Steps in which its front runs over it; 0 unless it has caught.
        pub steps: f32,
    }
}

crate::shared_struct! {
    /// Sums over the burning leaves of a cell, or what one of them adds: integers modulo 2^32.
    pub struct BurnSums {
        /// Leaves.
        pub count: u32,
        /// Keys of the cells of the air that their heat goes to.
        pub key: u32,
        /// Heat releases.
        pub power: u32,
        /// Zero.
        pub unused: u32,
    }
}

crate::shared_struct! {
    /// Window of the leaves that kernels see.
    pub struct BurnPage {
        /// Slot of its first leaf.
        pub first_slot: u32,
        /// Zeros.
        pub unused: [u32; 3],
    }
}

const _: () = assert!(size_of::<BurnSums>() == BURN_WORDS as usize * 4, "as many words");

/// A cell of the air that heat goes to.
#[derive(Clone, Copy, Debug)]
pub struct BurnCell {
    /// Its number in the table of cells.
    pub index: u32,
    /// A key that others of the same number have not.
    pub key: u32,
}

/// Species of a scene that leaves with these bits are of, at whatever stage.
#[inline(always)]
pub fn scene_species(cx: &Context<'_>, bits: u32) -> u32 {
    leaf_species(bits) % cx.scene.species_count
}

/// Share of a leaf that has burnt when its front has run a share of the way: the front is short where it begins and ends, and long between.
#[inline(always)]
pub fn burnt_share(way: f32) -> f32 {
    (way * way) * (3.0 - 2.0 * way)
}

/// Share of the way that the front of a leaf has run at the start of a step, 0 to 1. One that is not lit has none, but for one that water has put out.
#[inline(always)]
pub fn burn_way(step: u32, burn: &Burn) -> f32 {
    if burn.lit == UNLIT {
        return burn.out_way;
    }
    let steps = step.wrapping_sub(burn.lit).wrapping_add(1);
    (steps.to_real() * reciprocal(burn.steps)).min(1.0)
}

/// Heat release in W of a leaf of a relative size whose front has run a share of the way.
#[inline(always)]
pub fn burn_power(block: &BurnBlock, ratio: f32, way: f32) -> f32 {
    (block.mean_w * ratio) * ((way * (1.0 - way)) * 6.0)
}

/// Temperature rise in K of a leaf that has taken up so much heat per area.
#[inline(always)]
pub fn leaf_rise(block: &BurnBlock, heat: f32) -> f32 {
    let wet = (heat * block.wet_m2_k_j).min(BOILING_RISE_K);
    wet + (heat - block.dry_j_m2).max(0.0) * block.dry_m2_k_j
}

/// Temperature rise in K at which the leaf in a slot catches.
#[inline(always)]
pub fn ignition_rise(cx: &Context<'_>, block: &BurnBlock, slot: u32) -> f32 {
    let [word, _, _, _] = random(cx.scene.seed, slot, STREAM_IGNITION);
    block.ignition_k + block.ignition_span_k * unit_float(word)
}

/// The cell of a place.
#[inline(always)]
pub fn burn_cell(cx: &Context<'_>, place: Vec3) -> BurnCell {
    let shifted = (place + Vec3::from(cx.step.collision_shift_m)) * BURN_CELLS_PER_M;
    let [column, layer, line] = shifted.to_array().map(|cells| cell_floor(cells).to_whole());
    let key = cell_key(column, layer, line);
    BurnCell { index: key >> (32 - BURN_CELL_BITS), key }
}

/// The cell that the heat of a leaf at a place goes to.
#[inline(always)]
pub fn heated_cell(cx: &Context<'_>, place: Vec3) -> BurnCell {
    let wind = wind_at(cx, place);
    burn_cell(cx, Vec3::new(place.x + wind.x * FLAME_LEAN_S, place.y, place.z + wind.z * FLAME_LEAN_S))
}

/// Sums of a cell that a leaf of a heat release in W is the only one to add to.
#[inline(always)]
pub fn burn_sums(cell: &BurnCell, power_w: f32) -> BurnSums {
    let power = (power_w * BURN_POWER_ONE).min(BURN_POWER_MOST).floor().to_whole();
    BurnSums { count: 1, key: cell.key, power, unused: 0 }
}

/// Heat that a leaf releases.
#[derive(Clone, Copy, Debug)]
pub struct LeafHeat {
    /// Number of the cell that it goes to.
    pub index: u32,
    /// Sums that the leaf adds there; of no leaf unless it burns.
    pub sums: BurnSums,
}

/// Heat of a leaf at a place.
#[inline(always)]
pub fn leaf_heat_release(cx: &Context<'_>, place: Vec3, bits: u32, size: u32, burn: &Burn) -> LeafHeat {
    let none = LeafHeat { index: 0, sums: BurnSums { count: 0, key: 0, power: 0, unused: 0 } };
    if burn.lit == UNLIT || leaf_state(bits) == STATE_DORMANT {
        return none;
    }
    let block = &cx.scene.burns[scene_species(cx, bits) as usize];
    let way = burn_way(cx.step.index, burn);
    if way >= 1.0 {
        return none;
    }
    let cell = heated_cell(cx, place);
    LeafHeat { index: cell.index, sums: burn_sums(&cell, burn_power(block, size_ratio(size), way)) }
}

/// Returns true if a leaf at a place feeds the fire of a plume.
#[inline(always)]
pub fn feeds_plume(plume: &PlumeBlock, place: Vec3) -> bool {
    let from_base = place - Vec3::from(plume.base_m);
    vec3_dot(from_base, from_base) < plume.feeding_m2
}

/// Words of a fire that its leaves feed with so much heat release, which had another before.
#[inline(always)]
pub fn fire_words(before: u32, fed: u32) -> [u32; FIRE_WORDS as usize] {
    let power = before.plus(fed.minus(before).shift_signed(FIRE_FOLLOWS));
    let power_kw = (power.to_real() * FIRE_KW).min(FIRE_MOST_KW);
    if power_kw < FIRE_LEAST_KW {
        return [power, 0, 0, 0];
    }
    let inverse_root = inverse_fifth_root(power_kw);
    [power, reciprocal(inverse_root).to_bits(), (inverse_root * inverse_root).to_bits(), 0]
}

/// Heat release in W that goes to a cell with these sums; none if cells of the air share it.
#[inline(always)]
pub fn cell_power(cell: &BurnCell, sums: &BurnSums) -> f32 {
    if sums.count == 0 || sums.key != sums.count.times(cell.key) {
        return 0.0;
    }
    sums.power.to_real() * (1.0 / BURN_POWER_ONE)
}

/// Mean temperature rise in K of a cell that so much power goes to: flames fill it as far as they need its volume.
#[inline(always)]
pub fn flame_warmth(power_w: f32) -> f32 {
    let cells_per_m3 = (BURN_CELLS_PER_M * BURN_CELLS_PER_M) * BURN_CELLS_PER_M;
    (power_w * (cells_per_m3 * (FLAME_RISE_K / FLAME_W_PER_M3))).min(FLAME_RISE_K)
}

/// Heats the leaf in a slot, which is not lit, with so much power going to its cell, and lights it.
#[inline(always)]
pub fn leaf_heat(
    cx: &Context<'_>,
    leaf: &LeafMut<'_>,
    slot: u32,
    block: &BurnBlock,
    burn: &mut Burn,
    power_w: f32,
) {
    let bits = leaf.place.bits;
    let is_open = lies_still(bits) && !is_covered(bits) && !is_afloat(bits) && !is_sunk(bits);
    if !is_open && !flies(bits) {
        burn.heat = 0.0;
        return;
    }
    let warmth = plume_warmth(cx, leaf.place.position.into()).max(flame_warmth(power_w));
    burn.heat = (burn.heat + block.exchange_j_m2_k * (warmth - leaf_rise(block, burn.heat))).max(0.0);
    if leaf_rise(block, burn.heat) >= ignition_rise(cx, block, slot) {
        burn.lit = cx.step.index.wrapping_add(1);
        burn.steps = block.steps * size_ratio(leaf.schedule.size);
    }
}

/// Takes a leaf of a species through its stages, whose front has run a share of the way; in the end it is gone. Returns true if it waits for
/// the litter to lose its volume.
#[inline(always)]
pub fn leaf_waste(cx: &Context<'_>, leaf: &mut LeafMut<'_>, species: u32, burn: &mut Burn, way: f32) -> bool {
    let bits = leaf.place.bits;
    let state = leaf_state(bits);
    if state == STATE_DORMANT {
        return false;
    }
    if lies(bits) && (is_afloat(bits) || is_sunk(bits)) {
        *burn = Burn { out_way: way, ..Burn::default() };
        return false;
    }
    let is_lying = lies_still(bits);
    let is_flying = flies(bits);
    if way >= 1.0 {
        if is_lying {
            leaf.place.bits = with_litter_change(bits, CHANGE_REMOVED);
            return true;
        }
        if is_flying || (state == STATE_RESTING && !lies(bits)) {
            leaf.place.bits = place_bits(STATE_DORMANT, 0, 0, species, 0);
            leaf.drift.velocity = [0.0; 3];
            leaf.schedule.event = NEVER;
        }
        return false;
    }
    let stage = (way * BURN_STAGES as f32).floor().to_whole() + 1;
    let number = species + stage * cx.scene.species_count;
    if (is_lying || is_flying) && number != leaf_species(bits) {
        leaf.place.bits = with_species(bits, number);
    }
    false
}

/// Heats the leaf in a slot or lets it burn on, with so much power going to its cell. Returns true if it waits for the litter to lose its volume.
#[inline(always)]
pub fn leaf_burn(cx: &Context<'_>, leaf: &mut LeafMut<'_>, slot: u32, burn: &mut Burn, power_w: f32) -> bool {
    let species = scene_species(cx, leaf.place.bits);
    let block = &cx.scene.burns[species as usize];
    if block.steps == 0.0 {
        return false;
    }
    if burn.lit == UNLIT {
        if burn.out_way != 0.0 {
            return false;
        }
        leaf_heat(cx, leaf, slot, block, burn, power_w);
        return false;
    }
    let way = burn_way(cx.step.index, burn);
    leaf_waste(cx, leaf, species, burn, way)
}
