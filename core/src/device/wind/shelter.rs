// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/wind/shelter.wgsl
//!
//! Shelter behind trees, hills and still objects: the share of the mean wind that is left there, from the table of
//! [`ShelterGrid`](crate::wind::ShelterGrid). Below zero the mean wind turns back.

use crate::arith::lane::{Real, Word};
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

/// A place in the table.
#[derive(Clone, Copy, Debug)]
pub struct ShelterPlace<R: Real = f32> {
    /// Its row among those of the table.
    pub row: R::Word,
    /// Share of the way along x within its cell.
    pub x: R,
    /// Share of the way up within its layer.
    pub up: R,
    /// Share of the way along z within its cell.
    pub z: R,
}

/// Place in the table so many metres above the ground.
#[inline(always)]
pub fn shelter_place<R: Real>(cx: &Context<'_>, x: R, above: R, z: R) -> ShelterPlace<R> {
    let shelter = &cx.scene.shelter;
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
