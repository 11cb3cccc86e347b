// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/terrain/ground.rs
// The ground: level, or the hills' table interpolated linearly; water and litter on it.
#import bindings
#import arith/math
#import arith/quaternion
#import terrain/litter
#import terrain/snow

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

fn ground_bare(x: f32, z: f32) -> f32 {
    if (scene.has_terrain == 0u) {
        return 0.0;
    }
    return max(ground_relief(x, z), scene.water_relief_m);
}

fn ground_is_water(x: f32, z: f32) -> bool {
    if (scene.has_terrain != 0u) {
        return ground_relief(x, z) < scene.water_relief_m;
    }
    return scene.ground_height_m < scene.surface_height_m;
}

fn ground_bottom(x: f32, z: f32) -> f32 {
    var relief = 0.0;
    if (scene.has_terrain != 0u) {
        relief = ground_relief(x, z);
    }
    return relief + scene.litter.bottom_m;
}

fn ground_surface(x: f32, z: f32) -> f32 {
    let bare = ground_bare(x, z);
    if (scene.litter.columns != 0u) {
        return bare + ground_cover(x, z);
    }
    return bare;
}

fn ground_rest(x: f32, z: f32) -> f32 {
    return ground_surface(x, z) + scene.rest_height_m;
}

fn lying_over(x: f32, z: f32, reach: f32, rest: f32) -> f32 {
    let bare = ground_bare(x, z) + scene.rest_height_m;
    return max(bare + reach, rest);
}

fn lying_height(x: f32, z: f32, reach: f32) -> f32 {
    return lying_over(x, z, reach, ground_rest(x, z));
}

fn ground_met(place: vec3<f32>) -> bool {
    let low = place.y < scene.highest_rest_m;
    if ((scene.has_terrain == 0u && scene.litter.columns == 0u) || !low) {
        return low;
    }
    return place.y < ground_rest(place.x, place.z);
}

fn ground_rise(x: f32, z: f32) -> vec2<f32> {
    if (scene.has_terrain == 0u) {
        return vec2<f32>(0.0, 0.0);
    }
    let cell = ground_cell(x, z);
    let corners = cell.corners;
    let near = corners.y - corners.x;
    let west = corners.z - corners.x;
    return vec2<f32>(
        (near + cell.z * ((corners.w - corners.z) - near)) * scene.hill_cells_per_m,
        (west + cell.x * ((corners.w - corners.y) - west)) * scene.hill_cells_per_m,
    );
}

fn ground_slope(x: f32, z: f32) -> Slope {
    if (scene.litter.columns != 0u) {
        return steepest_slope(x, z);
    }
    if (scene.has_terrain == 0u || ground_relief(x, z) < scene.water_relief_m) {
        return Slope(0.0, 0.0, 1.0, 1.0);
    }
    let rise = ground_rise(x, z);
    let gain = 1.0 + (rise.x * rise.x + rise.y * rise.y);
    return Slope(rise.x, rise.y, gain, reciprocal(gain));
}

fn steepest_slope(x: f32, z: f32) -> Slope {
    let here = ground_surface(x, z);
    var steepest = Slope(0.0, 0.0, 1.0, 1.0);
    var least = 0.0;
    for (var number = 0u; number < DROP_DIRECTIONS; number++) {
        let direction = drop_direction(number);
        let reach = 1.0 / LITTER_CELLS_PER_M;
        let there = ground_surface(x + direction.x * reach, z + direction.y * reach);
        let rise = (there - here) * LITTER_CELLS_PER_M;
        if (rise < least) {
            let gain = 1.0 + rise * rise;
            least = rise;
            steepest = Slope(direction.x * rise, direction.y * rise, gain, reciprocal(gain));
        }
    }
    return steepest;
}

fn drop_direction(number: u32) -> vec2<f32> {
    let along = select(-1.0, 1.0, (number & 2u) == 0u);
    if (number < 4u) {
        return select(vec2<f32>(0.0, along), vec2<f32>(along, 0.0), (number & 1u) == 0u);
    }
    let across = select(-ROOT_HALF, ROOT_HALF, (number & 1u) == 0u);
    return vec2<f32>(along * ROOT_HALF, across);
}

fn ground_gradient(x: f32, z: f32) -> vec2<f32> {
    var rise_x = 0.0;
    var rise_z = 0.0;
    if (scene.has_terrain != 0u) {
        let cell = ground_cell(x, z);
        let corners = cell.corners;
        let near = corners.y - corners.x;
        let west = corners.z - corners.x;
        let is_dry = scene.water_relief_m < ground_relief(x, z);
        let cells_per_m = select(0.0, scene.hill_cells_per_m, is_dry);
        rise_x = (near + cell.z * ((corners.w - corners.z) - near)) * cells_per_m;
        rise_z = (west + cell.x * ((corners.w - corners.y) - west)) * cells_per_m;
    }
    if (scene.litter.columns != 0u) {
        let cell = litter_cell(x, z);
        let corners = litter_corners(cell);
        let near = corners.y - corners.x;
        let west = corners.z - corners.x;
        rise_x = rise_x + (near + cell.z * ((corners.w - corners.z) - near)) * (LITTER_UNIT_M * LITTER_CELLS_PER_M);
        rise_z = rise_z + (west + cell.x * ((corners.w - corners.y) - west)) * (LITTER_UNIT_M * LITTER_CELLS_PER_M);
    }
    if (scene.litter.columns != 0u && scene.snow.columns != 0u) {
        let snow = snow_between(x, z);
        let near = snow.depths_m.y - snow.depths_m.x;
        let west = snow.depths_m.z - snow.depths_m.x;
        rise_x = rise_x + (near + snow.z * ((snow.depths_m.w - snow.depths_m.z) - near)) * SNOW_CELLS_PER_M;
        rise_z = rise_z + (west + snow.x * ((snow.depths_m.w - snow.depths_m.y) - west)) * SNOW_CELLS_PER_M;
    }
    return vec2<f32>(rise_x, rise_z);
}

fn ground_lean(slope: Slope) -> vec4<f32> {
    let up = inverse_sqrt(slope.gain);
    return quat_normalize(vec4<f32>((-slope.z) * up, 0.0, slope.x * up, 1.0 + up));
}
