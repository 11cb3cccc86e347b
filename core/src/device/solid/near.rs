// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/solid/near.wgsl
//!
//! The few of many solid parts that a leaf may meet in a step: those that move, and those listed in its cell of a grid.

use super::shape::SOLID_ROWS;
use crate::arith::lane::{Mask, Real, Word};
use crate::arith::math::inverse_sqrt;
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

/// Returns true for leaves that may meet a solid part in this step. Only where there are any.
#[inline(always)]
pub fn may_meet_solids<R: Real>(cx: &Context<'_>, place: Vec3<R>) -> R::Mask {
    may_meet_movers(cx, place) | !(solids_cell(cx, place) & LIST_LENGTH_MASK).equals(0)
}

/// Returns true for places from which a way of a squared length may lead into a part that moves, or into the sphere around one in the list of the
/// cell. Only where there are any; for what has no extent.
#[inline(always)]
pub fn may_meet_solids_within<R: Real>(cx: &Context<'_>, place: Vec3<R>, way_squared: R) -> R::Mask {
    let mut meets = may_meet_movers(cx, place);
    let cell = solids_cell(cx, place);
    let count = cell & LIST_LENGTH_MASK;
    let first = cell >> LIST_LENGTH_BITS;
    let squared = way_squared.max(place.x.all(TINY_SQUARED));
    let reach = squared * inverse_sqrt(squared) + CLEAR_OF_SOLIDS_M;
    let none = count.all(0);
    for entry in 0.. {
        let is_listed = none.all(entry).less_than(count);
        if !(is_listed & !meets).any() {
            break;
        }
        let listed = is_listed.select(first.plus(none.all(entry)), none);
        let number = word_from(cx, cx.scene.solids.first_list_row, listed);
        let part = number.times(none.all(4 * SOLID_ROWS));
        let of_part =
            |at: u32| R::from_bits(word_from(cx, cx.scene.solids.first_row, part.plus(none.all(at))));
        let bound = of_part(5) + reach;
        let apart = place - Vec3::new(of_part(8), of_part(9), of_part(10));
        meets = meets | (is_listed & vec3_dot(apart, apart).less_than(bound * bound));
    }
    meets
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
