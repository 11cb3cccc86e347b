// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/leaf/collide.wgsl
//!
//! Collisions in the air of leaves that fly as bodies. The air is divided into cells, as in the simulation of rarefied gases. Integers
//! summed over the leaves of a cell give their mean velocity, how fast they run through each other, and whether they draw nearer to each
//! other. If they do, each loses a share of what its velocity is beyond the mean: as much as the kinetic theory of gases has thin discs
//! lose to one another in that time. Momentum is kept to rounding, and energy only falls.
//!
//! Sums of integers do not depend on the order of leaves. The grid lies elsewhere each time, by a random shift, so that its faces
//! leave no trace (Ihle and Kroll 2001, Phys. Rev. E 63, 020201).

use super::air_cell::{cell_floor, cell_key};
use super::record::{body_spin, body_spin_words, leaf_species, size_ratio};
use crate::arith::lane::{Real, Word};
use crate::arith::math::{inverse_sqrt, reciprocal};
use crate::arith::vector::{TINY_SQUARED, Vec3, vec3_dot};
use crate::context::Context;
use crate::leaf::LeafMut;

crate::shared_constants! {
    /// Binary logarithm of the number of cells in a simulator's table: cells of the air share them, by a hash.
    pub const COLLISION_CELL_BITS: u32 = 18;
    /// Words of [`CollisionSums`].
    pub const COLLISION_WORDS: u32 = 12;
    /// Cells of the air per metre.
    pub const COLLISION_CELLS_PER_M: f32 = 8.0;
    /// Most leaves of a cell that collide: more do not fit in the sums.
    pub const MOST_COLLIDING: u32 = 1023;
    /// Weight of the heaviest leaf of a scene.
    pub const COLLISION_WEIGHT_MOST: f32 = 64.0;
    /// Speed in m/s along an axis from which on a leaf counts as no faster.
    pub const COLLISION_SPEED_MOST: f32 = 63.0;
    /// Distance of a leaf from a cell's corner, in cells of so many units.
    pub const COLLISION_PLACE_ONE: f32 = 32_768.0;
    /// Momentum of a weight of one at 1 m/s.
    pub const COLLISION_MOMENTUM_ONE: f32 = 512.0;
    /// Energy, times two, of a weight of one at 1 m/s.
    pub const COLLISION_ENERGY_ONE: f32 = 2.0;
    /// Unit of the sum of place times momentum, for a weight of one at 1 m/s a cell away from the corner.
    pub const COLLISION_VIRIAL_ONE: f32 = 128.0;
    /// Units per m² of the squares of half axes.
    pub const COLLISION_AREA_ONE: f32 = 1_048_576.0;
    /// Largest square of half axes in units.
    pub const COLLISION_AREA_MOST: f32 = 262_144.0;
    /// Cross-section in which two thin discs of radius one strike each other, in the mean over all their poses: pi + pi³/8, a quarter of
    /// the mean surface of their Minkowski sum (Santaló 1976, Integral Geometry and Geometric Probability).
    pub const DISC_CROSS_SECTION: f32 = 7.017_377;
}

crate::shared_struct! {
    /// Sums over the leaves of a cell, or what one of them adds: integers modulo 2^32, two's complement.
    pub struct CollisionSums {
        /// Leaves.
        pub count: u32,
        /// Keys of the cells of the air that they are in.
        pub key: u32,
        /// Weights: masses, of 64 for the heaviest of the scene.
        pub weight: u32,
        /// Squares of half axes.
        pub area: u32,
        /// Momenta.
        pub momentum: [u32; 3],
        /// Weights times squared speeds.
        pub energy: u32,
        /// Weights times places.
        pub place: [u32; 3],
        /// Products of place and momentum.
        pub virial: u32,
    }
}

const _: () = assert!(
    (MOST_COLLIDING as f32)
        * COLLISION_WEIGHT_MOST
        * COLLISION_SPEED_MOST
        * (COLLISION_SPEED_MOST * 3.0 * COLLISION_ENERGY_ONE)
        < 2_147_483_648.0
        && (MOST_COLLIDING as f32) * COLLISION_WEIGHT_MOST * COLLISION_SPEED_MOST * COLLISION_MOMENTUM_ONE
            < 2_147_483_648.0
        && (MOST_COLLIDING as f32)
            * COLLISION_WEIGHT_MOST
            * (3.0 * COLLISION_SPEED_MOST)
            * COLLISION_VIRIAL_ONE
            < 2_147_483_648.0
        && (MOST_COLLIDING as f32) * COLLISION_WEIGHT_MOST * COLLISION_PLACE_ONE < 2_147_483_648.0
        && (MOST_COLLIDING as f32) * COLLISION_AREA_MOST < 2_147_483_648.0,
    "sums stay within 31 bits"
);
const _: () = assert!(size_of::<CollisionSums>() == COLLISION_WORDS as usize * 4, "as many words");

/// A cell of the air.
#[derive(Clone, Copy, Debug)]
pub struct CollisionCell {
    /// Its number in the table of cells.
    pub index: u32,
    /// A key that others of the same number have not.
    pub key: u32,
    /// Place in it, in cells from its corner.
    pub within: Vec3,
}

/// Motion that the leaves of a cell leave their collisions with.
#[derive(Clone, Copy, Debug)]
pub struct Collisions {
    /// Their mean velocity in m/s.
    pub velocity: Vec3,
    /// Share of its velocity beyond the mean that each leaf loses; 0 where none collide.
    pub share: f32,
}

/// A component of a velocity as sums count it.
#[inline(always)]
fn bounded_speed<R: Real>(along: R) -> R {
    along.max(along.all(-COLLISION_SPEED_MOST)).min(along.all(COLLISION_SPEED_MOST))
}

/// The nearest whole number, two's complement.
#[inline(always)]
fn nearest_whole(number: f32) -> u32 {
    (number + 0.5).floor().to_whole()
}

/// The cell of a place.
#[inline(always)]
pub fn collision_cell(cx: &Context<'_>, place: Vec3) -> CollisionCell {
    let shifted = (place + Vec3::from(cx.step.collision_shift_m)) * COLLISION_CELLS_PER_M;
    let corner = Vec3::new(cell_floor(shifted.x), cell_floor(shifted.y), cell_floor(shifted.z));
    let within = shifted - corner;
    let [column, layer, line] = corner.to_array().map(Real::to_whole);
    let key = cell_key(column, layer, line);
    CollisionCell { index: key >> (32 - COLLISION_CELL_BITS), key, within }
}

/// Sums to which a leaf with these bits and this size word is the only one that adds.
#[inline(always)]
pub fn own_sums(
    cx: &Context<'_>,
    cell: &CollisionCell,
    bits: u32,
    size: u32,
    velocity: Vec3,
) -> CollisionSums {
    let body = &cx.scene.bodies[leaf_species(bits) as usize];
    let ratio = size_ratio(size);
    let units = (body.litter_units * ratio) * ratio;
    let weight = (units * cx.scene.collisions.weight_per_unit + 1.0).min(COLLISION_WEIGHT_MOST).floor();
    let velocity = Vec3::new(bounded_speed(velocity.x), bounded_speed(velocity.y), bounded_speed(velocity.z));
    let momentum = velocity * (weight * COLLISION_MOMENTUM_ONE);
    let place = cell.within * (weight * COLLISION_PLACE_ONE);
    let radius = body.half_mean_m * ratio;
    let area = ((radius * radius) * COLLISION_AREA_ONE).min(COLLISION_AREA_MOST);
    let energy = vec3_dot(velocity, velocity) * (weight * COLLISION_ENERGY_ONE);
    let virial = vec3_dot(velocity, cell.within) * (weight * COLLISION_VIRIAL_ONE);
    CollisionSums {
        count: 1,
        key: cell.key,
        weight: weight.to_whole(),
        area: nearest_whole(area),
        momentum: [nearest_whole(momentum.x), nearest_whole(momentum.y), nearest_whole(momentum.z)],
        energy: nearest_whole(energy),
        place: [nearest_whole(place.x), nearest_whole(place.y), nearest_whole(place.z)],
        virial: nearest_whole(virial),
    }
}

/// A sum as a number: in two parts, because devices round large integers either way.
#[inline(always)]
fn sum_to_real(sum: u32) -> f32 {
    sum.shift_signed(12).to_real() * 4096.0 + (sum & 4095).to_real()
}

/// Collisions in a cell with these sums.
#[inline(always)]
pub fn collisions_of(cx: &Context<'_>, cell: &CollisionCell, sums: &CollisionSums) -> Collisions {
    let none = Collisions { velocity: Vec3::ZERO, share: 0.0 };
    let count = sums.count;
    // Cells of the air that share a place in the table are left alone.
    if !(2..=MOST_COLLIDING).contains(&count) || sums.key != count.times(cell.key) {
        return none;
    }
    let per_weight = reciprocal(sum_to_real(sums.weight));
    let momentum = Vec3::from(sums.momentum.map(sum_to_real));
    let velocity = momentum * (per_weight * (1.0 / COLLISION_MOMENTUM_ONE));
    let middle = Vec3::from(sums.place.map(sum_to_real)) * (per_weight * (1.0 / COLLISION_PLACE_ONE));
    let virial = sum_to_real(sums.virial) * (per_weight * (1.0 / COLLISION_VIRIAL_ONE));
    if virial >= vec3_dot(velocity, middle) {
        return none;
    }
    let energy = sum_to_real(sums.energy) * (per_weight * (1.0 / COLLISION_ENERGY_ONE));
    let beyond = (energy - vec3_dot(velocity, velocity)).max(0.0);
    let leaves = count.to_real();
    let others = leaves - 1.0;
    // Mean square of the speed of two of them relative to each other.
    let squared = ((beyond + beyond) * (leaves * reciprocal(others))).max(TINY_SQUARED);
    let cells_per_m3 = (COLLISION_CELLS_PER_M * COLLISION_CELLS_PER_M) * COLLISION_CELLS_PER_M;
    let area = sum_to_real(sums.area) * (DISC_CROSS_SECTION / COLLISION_AREA_ONE);
    let rate = (area * cells_per_m3) * (others * reciprocal(leaves)) * (squared * inverse_sqrt(squared));
    // In the mean a collision takes half of one and the restitution; and it is only while they draw nearer, half of the time, that
    // leaves collide.
    let lost = rate * (cx.scene.collisions.interval_s * (1.0 + cx.scene.collisions.restitution));
    Collisions { velocity, share: lost * reciprocal(1.0 + lost) }
}

/// Lets a leaf that flies as a body collide with the others of its cell, whose sums these are.
#[inline(always)]
pub fn leaf_collide(cx: &Context<'_>, leaf: &mut LeafMut<'_>, cell: &CollisionCell, sums: &CollisionSums) {
    let Collisions { velocity, share } = collisions_of(cx, cell, sums);
    if share == 0.0 {
        return;
    }
    let own = Vec3::from(leaf.drift.velocity);
    leaf.drift.velocity = (own + (velocity - own) * share).to_array();
    let spin = body_spin(leaf.drift.phase, leaf.schedule.rate, leaf.schedule.heading) * (1.0 - share);
    [leaf.drift.phase, leaf.schedule.rate, leaf.schedule.heading] = body_spin_words(spin);
}
