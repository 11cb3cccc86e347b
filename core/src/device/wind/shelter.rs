// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/wind/shelter.wgsl
//!
//! Shelter behind trees, hills and still objects: the share of the mean wind that is left there, from the tables of
//! [`ShelterGrids`](crate::wind::ShelterGrids). Below zero the mean wind turns back.

use crate::arith::lane::{Mask, Real, Word};
use crate::blocks::ShelterBlock;
use crate::context::Context;

crate::shared_constants! {
    /// Layers of the table between the ground and its top, as a number of them.
    pub const SHELTER_LAYERS: f32 = 8.0;
}

/// Lack of wind in units between the two heights of a corner's word: the lower half of the word at the lower height, the upper half at
/// the upper one.
#[inline(always)]
fn shelter_between<W: Word>(word: W, share: W::Real) -> W::Real {
    let low = (word & 0xffff).to_real();
    low + share * ((word >> 16).to_real() - low)
}

/// A place in the tables.
#[derive(Clone, Copy, Debug)]
pub struct ShelterPlace<R: Real = f32> {
    /// Its row among those of the tables.
    pub row: R::Word,
    /// Share of the way along x within its cell.
    pub x: R,
    /// Share of the way up within its layer.
    pub up: R,
    /// Share of the way along z within its cell.
    pub z: R,
}

/// Place in a table so many metres above the ground.
#[inline(always)]
fn shelter_place_in<R: Real>(shelter: &ShelterBlock, x: R, above: R, z: R) -> ShelterPlace<R> {
    let none = x.all(0.0);
    let u = ((x - shelter.west_m) * shelter.cells_per_m).max(none).min(x.all(shelter.cells_x));
    let v = ((z - shelter.north_m) * shelter.cells_per_m).max(none).min(x.all(shelter.cells_z));
    let w = (above * shelter.layers_per_m).max(none).min(x.all(SHELTER_LAYERS));
    let ku = u.floor().min(x.all(shelter.cells_x - 1.0));
    let kv = v.floor().min(x.all(shelter.cells_z - 1.0));
    let kw = w.floor().min(x.all(SHELTER_LAYERS - 1.0));
    let index = (kw * shelter.cells_z + kv) * shelter.cells_x + ku;
    ShelterPlace { row: index.to_whole(), x: u - ku, up: w - kw, z: v - kv }
}

/// Place in the tables so many metres above the ground: in the finer one where that is.
#[inline(always)]
pub fn shelter_place<R: Real>(cx: &Context<'_>, x: R, above: R, z: R) -> ShelterPlace<R> {
    let whole = shelter_place_in(&cx.scene.shelter, x, above, z);
    let fine = &cx.scene.near_shelter;
    if fine.cells_x == 0.0 {
        return whole;
    }
    let near = shelter_place_in(fine, x, above, z);
    let u = (x - fine.west_m) * fine.cells_per_m;
    let v = (z - fine.north_m) * fine.cells_per_m;
    let none = x.all(0.0);
    let is_along = none.less_than(u) & u.less_than(x.all(fine.cells_x));
    let is_across = none.less_than(v) & v.less_than(x.all(fine.cells_z));
    let is_near = is_along & is_across & (above * fine.layers_per_m).less_than(x.all(SHELTER_LAYERS));
    let behind = near.row.plus(near.row.all(fine.first_row - cx.scene.shelter.first_row));
    ShelterPlace {
        row: is_near.select(behind, whole.row),
        x: is_near.select_real(near.x, whole.x),
        up: is_near.select_real(near.up, whole.up),
        z: is_near.select_real(near.z, whole.z),
    }
}

/// Share of the mean wind that is left at a place, by the words of its row.
#[inline(always)]
pub fn shelter_left<R: Real>(cx: &Context<'_>, place: &ShelterPlace<R>, words: [R::Word; 4]) -> R {
    let [a, b, c, d] = words;
    let a = shelter_between(a, place.up);
    let b = shelter_between(b, place.up);
    let c = shelter_between(c, place.up);
    let d = shelter_between(d, place.up);
    let near = a + place.x * (b - a);
    let far = c + place.x * (d - c);
    let lack = near + place.z * (far - near);
    place.x.all(1.0) - lack * cx.scene.shelter.lack_unit
}

/// Share of the mean wind that trees, hills and still objects leave at a place so many metres above the ground. Only where the scene has shelter.
#[inline(always)]
pub fn wind_shelter<R: Real>(cx: &Context<'_>, x: R, above: R, z: R) -> R {
    let place = shelter_place(cx, x, above, z);
    let rows = &cx.tables[cx.scene.shelter.first_row as usize..];
    shelter_left(cx, &place, place.row.look_up_words(bytemuck::cast_slice(rows)))
}
