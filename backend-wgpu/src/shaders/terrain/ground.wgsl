// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/terrain/ground.rs
#import bindings
#import kernel/math
#import kernel/quaternion

struct Cell {
    corners: vec4<f32>,
    x: f32,
    z: f32,
}

struct Slope {
    x: f32,
    z: f32,
    gain: f32,
    ease: f32,
}

fn ground_cell(x: f32, z: f32) -> Cell {
    let terrain = environment.terrain;
    let u = x * environment.relief.x;
    let v = z * environment.relief.x;
    let ku = floor(u);
    let kv = floor(v);
    let index = ((bitcast<u32>(i32(kv)) & terrain.y) << terrain.z) | (bitcast<u32>(i32(ku)) & terrain.y);
    return Cell(bitcast<vec4<f32>>(wind_rows[terrain.x + index]), u - ku, v - kv);
}

fn ground_relief(x: f32, z: f32) -> f32 {
    let cell = ground_cell(x, z);
    let corners = cell.corners;
    let near = corners.x + cell.x * (corners.y - corners.x);
    let far = corners.z + cell.x * (corners.w - corners.z);
    return near + cell.z * (far - near);
}

fn ground_surface(x: f32, z: f32) -> f32 {
    if (environment.terrain.w == 0u) {
        return 0.0;
    }
    return max(ground_relief(x, z), environment.relief.z);
}

fn ground_rest(x: f32, z: f32) -> f32 {
    return ground_surface(x, z) + environment.ground.y;
}

fn ground_met(place: vec3<f32>) -> bool {
    let low = place.y < environment.relief.y;
    if (environment.terrain.w == 0u || !low) {
        return low;
    }
    return place.y < ground_rest(place.x, place.z);
}

fn ground_slope(x: f32, z: f32) -> Slope {
    if (environment.terrain.w == 0u || ground_relief(x, z) < environment.relief.z) {
        return Slope(0.0, 0.0, 1.0, 1.0);
    }
    let cell = ground_cell(x, z);
    let corners = cell.corners;
    let near = corners.y - corners.x;
    let west = corners.z - corners.x;
    let rise_x = (near + cell.z * ((corners.w - corners.z) - near)) * environment.relief.x;
    let rise_z = (west + cell.x * ((corners.w - corners.y) - west)) * environment.relief.x;
    let gain = 1.0 + (rise_x * rise_x + rise_z * rise_z);
    return Slope(rise_x, rise_z, gain, reciprocal(gain));
}

fn ground_lean(slope: Slope) -> vec4<f32> {
    let up = inverse_sqrt(slope.gain);
    return quat_normalize(vec4<f32>((0.0 - slope.z) * up, 0.0, slope.x * up, 1.0 + up));
}
