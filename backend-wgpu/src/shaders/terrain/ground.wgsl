// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/terrain/ground.rs
// The ground: level, or the hills' table interpolated linearly; water on it.
#import bindings
#import arith/math
#import arith/quaternion

struct Cell {
    corners: vec4<f32>,
    x: f32,
    z: f32,
}

struct Slope {
    x: f32,
    z: f32,
    gain: f32,
    inv_gain: f32,
}

fn ground_cell(x: f32, z: f32) -> Cell {
    let shift = scene.hill_shift;
    let mask = (1u << shift) - 1u;
    let u = x * scene.hill_cells_per_m;
    let v = z * scene.hill_cells_per_m;
    let ku = floor(u);
    let kv = floor(v);
    let index = ((bitcast<u32>(i32(kv)) & mask) << shift) | (bitcast<u32>(i32(ku)) & mask);
    return Cell(bitcast<vec4<f32>>(tables[scene.first_hill_row + index]), u - ku, v - kv);
}

fn ground_relief(x: f32, z: f32) -> f32 {
    let cell = ground_cell(x, z);
    let corners = cell.corners;
    let near = corners.x + cell.x * (corners.y - corners.x);
    let far = corners.z + cell.x * (corners.w - corners.z);
    return near + cell.z * (far - near);
}

fn ground_surface(x: f32, z: f32) -> f32 {
    if (scene.has_terrain == 0u) {
        return 0.0;
    }
    return max(ground_relief(x, z), scene.water_relief_m);
}

fn ground_rest(x: f32, z: f32) -> f32 {
    return ground_surface(x, z) + scene.rest_height_m;
}

fn ground_met(place: vec3<f32>) -> bool {
    let low = place.y < scene.highest_rest_m;
    if (scene.has_terrain == 0u || !low) {
        return low;
    }
    return place.y < ground_rest(place.x, place.z);
}

fn ground_slope(x: f32, z: f32) -> Slope {
    if (scene.has_terrain == 0u || ground_relief(x, z) < scene.water_relief_m) {
        return Slope(0.0, 0.0, 1.0, 1.0);
    }
    let cell = ground_cell(x, z);
    let corners = cell.corners;
    let near = corners.y - corners.x;
    let west = corners.z - corners.x;
    let rise_x = (near + cell.z * ((corners.w - corners.z) - near)) * scene.hill_cells_per_m;
    let rise_z = (west + cell.x * ((corners.w - corners.y) - west)) * scene.hill_cells_per_m;
    let gain = 1.0 + (rise_x * rise_x + rise_z * rise_z);
    return Slope(rise_x, rise_z, gain, reciprocal(gain));
}

fn ground_lean(slope: Slope) -> vec4<f32> {
    let up = inverse_sqrt(slope.gain);
    return quat_normalize(vec4<f32>((-slope.z) * up, 0.0, slope.x * up, 1.0 + up));
}
