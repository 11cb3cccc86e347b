// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/solid/near.wgsl
//!
//! The few of many solid parts that a leaf may meet in a step: those that move, and those listed in its cell of a grid.

use super::shape::{SOLID_GRID, SOLID_HULL, SOLID_ROUND, SOLID_ROWS};
use crate::arith::lane::{Mask, Real, Word};
use crate::arith::math::inverse_sqrt;
use crate::arith::quaternion::{Quat, quat_rotate_back};
use crate::arith::vector::{TINY_SQUARED, Vec3, vec3_dot};
use crate::context::Context;
use crate::layout::Uint4;

crate::shared_constants! {
    /// Bits of the length of a cell's list; those above are the place of its first entry.
    pub const LIST_LENGTH_BITS: u32 = 13;
    /// Mask of the length.
    pub const LIST_LENGTH_MASK: u32 = 8191;
    /// Distance in m from a part from which on nothing without extent touches it, whatever the rounding of places.
    pub const CLEAR_OF_SOLIDS_M: f32 = 0.002;
    /// Distance in m from parts that stand still within which cells of the occupancy grid are occupied.
    pub const OCCUPIED_WITHIN_M: f32 = 0.25;
}

/// Words of a list that begins with a row.
#[inline(always)]
fn word_from<W: Word>(cx: &Context<'_>, first_row: u32, place: W) -> W {
    place.look_up_word(bytemuck::cast_slice::<Uint4, u32>(&cx.tables[first_row as usize..]))
}

/// Word of the cell that a place lies in: the list of parts that stand still near it; 0 where there are none.
#[inline(always)]
pub fn solids_cell<R: Real>(cx: &Context<'_>, place: Vec3<R>) -> R::Word {
    let solids = &cx.scene.solids;
    let u = (place.x - solids.west_m) * solids.cells_per_m;
    let v = (place.z - solids.north_m) * solids.cells_per_m;
    let column = u.floor().to_whole();
    let line = v.floor().to_whole();
    let is_inside = column.less_than(column.all(solids.columns))
        & line.less_than(line.all(solids.lines))
        & place.y.less_than(place.y.all(solids.highest_m));
    let none = column.all(0);
    let cell = is_inside.select(line.times(line.all(solids.columns)).plus(column), none);
    is_inside.select(word_from(cx, solids.first_cell_row, cell), none)
}

/// Returns true for places in occupied cells of the occupancy grid: those within [`OCCUPIED_WITHIN_M`] of a part that stands still, and
/// some beside them.
#[inline(always)]
pub fn is_occupied<R: Real>(cx: &Context<'_>, place: Vec3<R>) -> R::Mask {
    let solids = &cx.scene.solids;
    let at = place - Vec3::from(solids.occupancy_low_m).spread(place.x);
    let column = (at.x * solids.occupancy_cells_per_m).floor().to_whole();
    // A plane has no end below.
    let layer = (at.y.max(at.y.all(0.0)) * solids.occupancy_cells_per_m).floor().to_whole();
    let line = (at.z * solids.occupancy_cells_per_m).floor().to_whole();
    let is_inside = column.less_than(column.all(solids.occupancy_columns))
        & layer.less_than(layer.all(solids.occupancy_layers))
        & line.less_than(line.all(solids.occupancy_lines));
    let none = column.all(0);
    let stack = line.times(none.all(solids.occupancy_columns)).plus(column);
    let cell = is_inside.select(stack.times(none.all(solids.occupancy_layers)).plus(layer), none);
    let bits = word_from(cx, solids.first_occupancy_row, cell >> 5);
    is_inside & !(bits.shift_by(cell & 31) & 1).equals(0)
}

/// Returns true for leaves that may meet a solid part in this step, on a way that is at most so long. Only where there are any.
#[inline(always)]
pub fn may_meet_solids<R: Real>(cx: &Context<'_>, place: Vec3<R>, way_squared: R) -> R::Mask {
    let meets = may_meet_movers(cx, place);
    let clear_way_m = cx.scene.solids.clear_way_m;
    let is_short = way_squared.less_than(place.x.all(clear_way_m * clear_way_m));
    let asks = !(is_short & !is_occupied(cx, place)) & !meets;
    if !asks.any() {
        return meets;
    }
    meets | (asks & !(solids_cell(cx, place) & LIST_LENGTH_MASK).equals(0))
}

/// Returns true for ways from places that may lead into a part that moves, or into one in the list of the cell. Only where there are any; for
/// what has no extent.
#[inline(always)]
pub fn may_meet_solids_on_way<R: Real>(cx: &Context<'_>, place: Vec3<R>, way: Vec3<R>) -> R::Mask {
    let mut meets = may_meet_movers(cx, place);
    let squared = vec3_dot(way, way).max(place.x.all(TINY_SQUARED));
    let reach = squared * inverse_sqrt(squared) + CLEAR_OF_SOLIDS_M;
    let is_far = place.x.all(OCCUPIED_WITHIN_M).less_than(reach);
    let asks = (is_far | is_occupied(cx, place)) & !meets;
    if !asks.any() {
        return meets;
    }
    let cell = solids_cell(cx, place);
    let none = cell.all(0);
    let count = asks.select(cell & LIST_LENGTH_MASK, none);
    let first = cell >> LIST_LENGTH_BITS;
    for entry in 0.. {
        let is_listed = none.all(entry).less_than(count);
        if !(is_listed & !meets).any() {
            break;
        }
        let listed = is_listed.select(first.plus(none.all(entry)), none);
        let number = word_from(cx, cx.scene.solids.first_list_row, listed);
        let row = number.times(none.all(SOLID_ROWS));
        let [rounding, bound, _, _] = part_row(cx, row.plus(none.all(1)));
        let [x, y, z, _] = part_row(cx, row.plus(none.all(2)));
        let apart = place - Vec3::new(R::from_bits(x), R::from_bits(y), R::from_bits(z));
        let near = R::from_bits(bound) + reach;
        let is_near = is_listed & vec3_dot(apart, apart).less_than(near * near);
        if !is_near.any() {
            continue;
        }
        let [flags, half_x, half_y, half_z] = part_row(cx, row);
        let [i, j, k, w] = part_row(cx, row.plus(none.all(3)));
        let turn = Quat { x: R::from_bits(i), y: R::from_bits(j), z: R::from_bits(k), w: R::from_bits(w) };
        let shape = Core {
            is_round: !(flags & SOLID_ROUND).equals(0),
            half_m: Vec3::new(R::from_bits(half_x), R::from_bits(half_y), R::from_bits(half_z)),
            rounding_m: R::from_bits(rounding),
        };
        let may_be_met = core_may_be_met(shape, quat_rotate_back(turn, apart), quat_rotate_back(turn, way));
        let has_faces = !(flags & (SOLID_HULL | SOLID_GRID)).equals(0);
        meets = meets | (is_near & (has_faces | may_be_met));
    }
    meets
}

/// Row of a part, from the first of all on.
#[inline(always)]
fn part_row<W: Word>(cx: &Context<'_>, row: W) -> [W; 4] {
    row.look_up_words(bytemuck::cast_slice(&cx.tables[cx.scene.solids.first_row as usize..]))
}

/// Parts without faces, or one.
#[derive(Clone, Copy)]
pub struct Core<R: Real = f32> {
    /// True for cylinders.
    pub is_round: R::Mask,
    /// Half edges in m; of a cylinder, radius, half of the height, and nothing.
    pub half_m: Vec3<R>,
    /// Radius in m by which it is rounded.
    pub rounding_m: R,
}

/// Returns true for ways in the frame of a part without faces that may lead into it: such parts are convex, so they lie behind the plane through
/// their point that is nearest to where the way begins.
#[inline(always)]
pub fn core_may_be_met<R: Real>(shape: Core<R>, inner: Vec3<R>, way: Vec3<R>) -> R::Mask {
    let none = inner.x.all(0.0);
    let one = none.all(1.0);
    let half = shape.half_m;
    let sign = Vec3::new(
        inner.x.less_than(none).select_real(-one, one),
        inner.y.less_than(none).select_real(-one, one),
        inner.z.less_than(none).select_real(-one, one),
    );
    let radial_squared = (inner.x * inner.x + inner.z * inner.z).max(none.all(TINY_SQUARED));
    let inv_radial = inverse_sqrt(radial_squared);
    let outward = (way.x * inner.x + way.z * inner.z) * inv_radial;
    let beyond_x = shape.is_round.select_real(radial_squared * inv_radial, inner.x * sign.x) - half.x;
    let beyond_y = inner.y * sign.y - half.y;
    let beyond_z = shape.is_round.select_real(-one, inner.z * sign.z - half.z);
    let outside = Vec3::new(beyond_x.max(none), beyond_y.max(none), beyond_z.max(none));
    let along =
        Vec3::new(shape.is_round.select_real(outward, way.x * sign.x), way.y * sign.y, way.z * sign.z);
    let squared = vec3_dot(outside, outside).max(none.all(TINY_SQUARED));
    let inverse = inverse_sqrt(squared);
    let distance = squared * inverse - shape.rounding_m;
    let nearer = (vec3_dot(outside, along) * inverse).min(none);
    (distance + nearer).less_than(none.all(CLEAR_OF_SOLIDS_M))
}

/// Returns true for leaves that may meet a solid part that moves in this step.
#[inline(always)]
pub fn may_meet_movers<R: Real>(cx: &Context<'_>, place: Vec3<R>) -> R::Mask {
    let mut meets = place.x.less_than(place.x);
    for number in 0..cx.scene.solids.mover_count {
        let mover = &cx.step.movers[number as usize];
        let apart = place - Vec3::from(mover.center_m).spread(place.x);
        meets = meets | vec3_dot(apart, apart).less_than(place.x.all(mover.bound_m * mover.bound_m));
    }
    meets
}

/// Number of the parts near a place: all that move, and those in the list of its cell.
#[inline(always)]
pub fn near_count(cx: &Context<'_>, cell: u32) -> u32 {
    cx.scene.solids.mover_count + (cell & LIST_LENGTH_MASK)
}

/// One of these parts.
#[inline(always)]
pub fn near_solid(cx: &Context<'_>, cell: u32, place: u32) -> u32 {
    let movers = cx.scene.solids.mover_count;
    if place < movers {
        return place;
    }
    word_from(cx, cx.scene.solids.first_list_row, (cell >> LIST_LENGTH_BITS) + (place - movers))
}
