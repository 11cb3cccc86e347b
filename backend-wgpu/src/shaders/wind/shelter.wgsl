// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/wind/shelter.rs
// Share of the mean wind that trees, hills and still objects leave, from a table.
#import bindings

fn shelter_between(word: u32, share: f32) -> f32 {
    let low = f32(word & 0xffffu);
    return low + share * (f32(word >> 16u) - low);
}

fn wind_shelter(x: f32, above: f32, z: f32) -> f32 {
    let shelter = scene.shelter;
    let u = min(max((x - shelter.west_m) * shelter.cells_per_m, 0.0), shelter.cells_x);
    let v = min(max((z - shelter.north_m) * shelter.cells_per_m, 0.0), shelter.cells_z);
    let w = min(max(above * shelter.layers_per_m, 0.0), SHELTER_LAYERS);
    let ku = min(floor(u), shelter.cells_x - 1.0);
    let kv = min(floor(v), shelter.cells_z - 1.0);
    let kw = min(floor(w), SHELTER_LAYERS - 1.0);
    let index = (kw * shelter.cells_z + kv) * shelter.cells_x + ku;
    let row = tables[shelter.first_row + bitcast<u32>(i32(index))];
    let share = w - kw;
    let a = shelter_between(row.x, share);
    let b = shelter_between(row.y, share);
    let c = shelter_between(row.z, share);
    let d = shelter_between(row.w, share);
    let near = a + (u - ku) * (b - a);
    let far = c + (u - ku) * (d - c);
    let lack = near + (v - kv) * (far - near);
    return 1.0 - lack * shelter.lack_unit;
}
