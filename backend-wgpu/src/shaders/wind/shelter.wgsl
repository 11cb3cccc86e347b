// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/wind/shelter.rs
// Share of the mean wind that trees, hills and still objects leave, from tables.
#import bindings

struct ShelterPlace {
    row: u32,
    x: f32,
    up: f32,
    z: f32,
}

fn shelter_between(word: u32, share: f32) -> f32 {
    let low = f32(word & 0xffffu);
    return low + share * (f32(word >> 16u) - low);
}

fn shelter_place_in(shelter: ShelterBlock, x: f32, above: f32, z: f32) -> ShelterPlace {
    let u = min(max((x - shelter.west_m) * shelter.cells_per_m, 0.0), shelter.cells_x);
    let v = min(max((z - shelter.north_m) * shelter.cells_per_m, 0.0), shelter.cells_z);
    let w = min(max(above * shelter.layers_per_m, 0.0), SHELTER_LAYERS);
    let ku = min(floor(u), shelter.cells_x - 1.0);
    let kv = min(floor(v), shelter.cells_z - 1.0);
    let kw = min(floor(w), SHELTER_LAYERS - 1.0);
    let index = (kw * shelter.cells_z + kv) * shelter.cells_x + ku;
    return ShelterPlace(bitcast<u32>(i32(index)), u - ku, w - kw, v - kv);
}

fn shelter_place(x: f32, above: f32, z: f32) -> ShelterPlace {
    let fine = scene.near_shelter;
    let u = (x - fine.west_m) * fine.cells_per_m;
    let v = (z - fine.north_m) * fine.cells_per_m;
    let is_along = 0.0 < u && u < fine.cells_x;
    let is_across = 0.0 < v && v < fine.cells_z;
    if fine.cells_x == 0.0 || !is_along || !is_across || above * fine.layers_per_m >= SHELTER_LAYERS {
        return shelter_place_in(scene.shelter, x, above, z);
    }
    var near = shelter_place_in(fine, x, above, z);
    near.row += fine.first_row - scene.shelter.first_row;
    return near;
}

fn shelter_left(place: ShelterPlace, words: vec4<u32>) -> f32 {
    let a = shelter_between(words.x, place.up);
    let b = shelter_between(words.y, place.up);
    let c = shelter_between(words.z, place.up);
    let d = shelter_between(words.w, place.up);
    let near = a + place.x * (b - a);
    let far = c + place.x * (d - c);
    let lack = near + place.z * (far - near);
    return 1.0 - lack * scene.shelter.lack_unit;
}

fn wind_shelter(x: f32, above: f32, z: f32) -> f32 {
    let place = shelter_place(x, above, z);
    return shelter_left(place, tables[scene.shelter.first_row + place.row]);
}
