// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/solid/near.rs
// The few of many solid parts that a leaf may meet in a step.
#import bindings
#import arith/math
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

fn may_meet_solids(place: vec3<f32>) -> bool {
    return may_meet_movers(place) || (solids_cell(place) & LIST_LENGTH_MASK) != 0u;
}

fn may_meet_solids_within(place: vec3<f32>, way_squared: f32) -> bool {
    if (may_meet_movers(place)) {
        return true;
    }
    let cell = solids_cell(place);
    let squared = max(way_squared, TINY_SQUARED);
    let reach = squared * inverse_sqrt(squared) + CLEAR_OF_SOLIDS_M;
    for (var entry = 0u; entry < (cell & LIST_LENGTH_MASK); entry += 1u) {
        let number = word_from(scene.solids.first_list_row, (cell >> LIST_LENGTH_BITS) + entry);
        let row = scene.solids.first_row + number * SOLID_ROWS;
        let bound = bitcast<f32>(tables[row + 1u].y) + reach;
        let apart = place - bitcast<vec3<f32>>(tables[row + 2u].xyz);
        if (vec3_dot(apart, apart) < bound * bound) {
            return true;
        }
    }
    return false;
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
