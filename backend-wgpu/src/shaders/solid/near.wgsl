// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/solid/near.rs
// The few of many solid parts that a leaf may meet in a step.
#import bindings
#import arith/math
#import arith/quaternion
#import arith/vector

fn word_from(first_row: u32, place: u32) -> u32 {
    return tables[first_row + (place >> 2u)][place & 3u];
}

fn solids_cell(place: vec3<f32>) -> u32 {
    let u = (place.x - scene.solids.west_m) * scene.solids.cells_per_m;
    let v = (place.z - scene.solids.north_m) * scene.solids.cells_per_m;
    let column = bitcast<u32>(i32(floor(u)));
    let line = bitcast<u32>(i32(floor(v)));
    let is_inside = column < scene.solids.columns && line < scene.solids.lines && place.y < scene.solids.highest_m;
    if (!is_inside) {
        return 0u;
    }
    return word_from(scene.solids.first_cell_row, line * scene.solids.columns + column);
}

fn is_occupied(place: vec3<f32>) -> bool {
    let at = place - scene.solids.occupancy_low_m;
    let column = bitcast<u32>(i32(floor(at.x * scene.solids.occupancy_cells_per_m)));
    // A plane has no end below.
    let layer = bitcast<u32>(i32(floor(max(at.y, 0.0) * scene.solids.occupancy_cells_per_m)));
    let line = bitcast<u32>(i32(floor(at.z * scene.solids.occupancy_cells_per_m)));
    let is_inside = column < scene.solids.occupancy_columns && layer < scene.solids.occupancy_layers &&
        line < scene.solids.occupancy_lines;
    if (!is_inside) {
        return false;
    }
    let cell = (line * scene.solids.occupancy_columns + column) * scene.solids.occupancy_layers + layer;
    let bits = word_from(scene.solids.first_occupancy_row, cell >> 5u);
    return ((bits >> (cell & 31u)) & 1u) != 0u;
}

fn may_meet_solids(place: vec3<f32>, way_squared: f32) -> bool {
    if (may_meet_movers(place)) {
        return true;
    }
    let is_short = way_squared < scene.solids.clear_way_m * scene.solids.clear_way_m;
    if (is_short && !is_occupied(place)) {
        return false;
    }
    return (solids_cell(place) & LIST_LENGTH_MASK) != 0u;
}

fn may_meet_solids_on_way(place: vec3<f32>, way: vec3<f32>) -> bool {
    if (may_meet_movers(place)) {
        return true;
    }
    let squared = max(vec3_dot(way, way), TINY_SQUARED);
    let reach = squared * inverse_sqrt(squared) + CLEAR_OF_SOLIDS_M;
    if (!(OCCUPIED_WITHIN_M < reach || is_occupied(place))) {
        return false;
    }
    let cell = solids_cell(place);
    for (var entry = 0u; entry < (cell & LIST_LENGTH_MASK); entry += 1u) {
        let number = word_from(scene.solids.first_list_row, (cell >> LIST_LENGTH_BITS) + entry);
        let row = number * SOLID_ROWS;
        let surface = part_row(row + 1u);
        let apart = place - bitcast<vec3<f32>>(part_row(row + 2u).xyz);
        let near = bitcast<f32>(surface.y) + reach;
        if (!(vec3_dot(apart, apart) < near * near)) {
            continue;
        }
        let sizes = part_row(row);
        let turn = bitcast<vec4<f32>>(part_row(row + 3u));
        let shape = Core((sizes.x & SOLID_ROUND) != 0u, bitcast<vec3<f32>>(sizes.yzw), bitcast<f32>(surface.x));
        let has_faces = (sizes.x & (SOLID_HULL | SOLID_GRID)) != 0u;
        if (has_faces || core_may_be_met(shape, quat_rotate_back(turn, apart), quat_rotate_back(turn, way))) {
            return true;
        }
    }
    return false;
}

fn part_row(row: u32) -> vec4<u32> {
    return tables[scene.solids.first_row + row];
}

struct Core {
    is_round: bool,
    half_m: vec3<f32>,
    rounding_m: f32,
}

fn core_may_be_met(shape: Core, inner: vec3<f32>, way: vec3<f32>) -> bool {
    let half = shape.half_m;
    let sign = select(vec3<f32>(1.0, 1.0, 1.0), vec3<f32>(-1.0, -1.0, -1.0), inner < vec3<f32>(0.0, 0.0, 0.0));
    let radial_squared = max(inner.x * inner.x + inner.z * inner.z, TINY_SQUARED);
    let inv_radial = inverse_sqrt(radial_squared);
    let outward = (way.x * inner.x + way.z * inner.z) * inv_radial;
    let beyond_x = select(inner.x * sign.x, radial_squared * inv_radial, shape.is_round) - half.x;
    let beyond_y = inner.y * sign.y - half.y;
    let beyond_z = select(inner.z * sign.z - half.z, -1.0, shape.is_round);
    let outside = vec3<f32>(max(beyond_x, 0.0), max(beyond_y, 0.0), max(beyond_z, 0.0));
    let along = vec3<f32>(select(way.x * sign.x, outward, shape.is_round), way.y * sign.y, way.z * sign.z);
    let squared = max(vec3_dot(outside, outside), TINY_SQUARED);
    let inverse = inverse_sqrt(squared);
    let distance = squared * inverse - shape.rounding_m;
    let nearer = min(vec3_dot(outside, along) * inverse, 0.0);
    return distance + nearer < CLEAR_OF_SOLIDS_M;
}

fn may_meet_movers(place: vec3<f32>) -> bool {
    for (var number = 0u; number < scene.solids.mover_count; number += 1u) {
        let apart = place - step_block.movers[number].center_m;
        let bound = step_block.movers[number].bound_m;
        if (vec3_dot(apart, apart) < bound * bound) {
            return true;
        }
    }
    return false;
}

fn near_count(cell: u32) -> u32 {
    return scene.solids.mover_count + (cell & LIST_LENGTH_MASK);
}

fn near_solid(cell: u32, place: u32) -> u32 {
    let movers = scene.solids.mover_count;
    if (place < movers) {
        return place;
    }
    return word_from(scene.solids.first_list_row, (cell >> LIST_LENGTH_BITS) + (place - movers));
}
