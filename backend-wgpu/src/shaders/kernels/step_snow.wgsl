// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/step_snow.rs
// Lets snow slide and drift from cell to cell, or settle and melt, in the steps in which it does.
#import terrain/snow
#import tree/branch_snow
#import wind/shelter

// The tables, behind which the snow is: nothing else of them is written.
@group(0) @binding(2) var<storage, read_write> snow_words: array<u32>;

fn snow_word(plane: u32, cell: u32) -> u32 {
    let cells = scene.snow.columns * scene.snow.lines;
    return scene.litter.first_row * 4u + scene.snow.first_word + plane * cells + cell;
}

fn read_snow(cell: u32) -> SnowCell {
    return SnowCell(snow_words[snow_word(SNOW_WATER, cell)], snow_words[snow_word(SNOW_DEPTH, cell)]);
}

fn write_snow(cell: u32, snow: SnowCell) {
    snow_words[snow_word(SNOW_WATER, cell)] = snow.water;
    snow_words[snow_word(SNOW_DEPTH, cell)] = snow.depth;
}

fn lies_on(cell: u32) -> SnowFloor {
    let first = scene.snow.first_row * 4u + 2u * cell;
    return snow_floor(snow_words[first], snow_words[first + 1u]);
}

fn moved(cell: SnowCell, gives: SnowCell, gets: SnowCell) -> SnowCell {
    return SnowCell(cell.water - gives.water + gets.water, cell.depth - gives.depth + gets.depth);
}

fn wind_left(cell: u32, snow: SnowCell, lee_m: f32) -> f32 {
    if (scene.shelter.lack_unit == 0.0) {
        return 1.0;
    }
    let center = snow_center(cell);
    let depth_m = f32(snow.depth) * SNOW_DEPTH_M;
    let place = shelter_place(center.x, depth_m, center.y);
    let first = (scene.shelter.first_row + place.row) * 4u;
    let words = vec4<u32>(snow_words[first], snow_words[first + 1u], snow_words[first + 2u], snow_words[first + 3u]);
    return left_over_snow(shelter_left(place, words), depth_m, lee_m);
}

fn clear_crown(cell: u32) {
    let column = cell % scene.snow.columns;
    let line = cell / scene.snow.columns;
    if (scene.snow.branches == 0u || column % CROWN_CELLS != 0u || line % CROWN_CELLS != 0u) {
        return;
    }
    let square = crown_square(cell);
    let pool = CROWN_POOL - crown_pool(step_block.index);
    let bed = scene.litter.first_row * 4u;
    for (var word = 0u; word < CROWN_POOL; word++) {
        snow_words[bed + crown_word(square, pool + word)] = 0u;
    }
}

fn fall_through_crown(cell: u32, open: f32) {
    let shifted = crown_cell(cell);
    let left = crown_word(crown_square(shifted), crown_pool(step_block.index) + 1u);
    let part = crown_part(shifted, snow_words[scene.litter.first_row * 4u + left]);
    snow_words[snow_word(SNOW_LANDED, cell)] += part;
    if (open < 0.0) {
        snow_words[snow_word(SNOW_MELTED, cell)] += part;
    } else {
        snow_words[snow_word(SNOW_WATER, cell)] += part;
        snow_words[snow_word(SNOW_DEPTH, cell)] += fresh_depth(part);
    }
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn step_snow(@builtin(global_invocation_id) id: vec3<u32>) {
    let cell = id.x;
    if (cell >= scene.snow.columns * scene.snow.lines) {
        return;
    }
    let turn = snow_turn(step_block.index);
    let on = lies_on(cell);
    if (turn == 0u) {
        clear_crown(cell);
    }
    if (turn == SNOW_AGES && scene.snow.branches != 0u) {
        fall_through_crown(cell, on.open);
    }
    let one = read_snow(cell);
    if (turn == SNOW_AGES) {
        if (one.water != 0u) {
            let after = snow_age(cell, one, on.open);
            write_snow(cell, after);
            snow_words[snow_word(SNOW_MELTED, cell)] += one.water - after.water;
        }
        return;
    }
    let pair = snow_pair(cell, turn);
    let drifts = snow_drifts();
    if (pair.other == NEVER || (pair.is_around && !drifts)) {
        return;
    }
    let two = read_snow(pair.other);
    let other_on = lies_on(pair.other);
    if ((one.depth == 0u && two.depth == 0u) || on.open < 0.0 || other_on.open < 0.0) {
        return;
    }
    let way_m = select(1.0, ROOT_TWO, pair.is_diagonal) * (1.0 / SNOW_CELLS_PER_M);
    var to = SnowCell(0u, 0u);
    var fro = SnowCell(0u, 0u);
    if (!pair.is_around) {
        to = snow_slide(one, two, on.height_m - other_on.height_m, way_m);
        fro = snow_slide(two, one, other_on.height_m - on.height_m, way_m);
    }
    var here = moved(one, to, fro);
    var there = moved(two, fro, to);
    if (drifts && !pair.is_diagonal) {
        let rise_m = (other_on.height_m + f32(there.depth) * SNOW_DEPTH_M) - (on.height_m + f32(here.depth) * SNOW_DEPTH_M);
        let toward = select(scene.wind.direction_z, scene.wind.direction_x, (turn & 3u) == 0u);
        to = snow_drift(here, rise_m, wind_left(cell, here, on.lee_m), toward);
        fro = snow_drift(there, -rise_m, wind_left(pair.other, there, other_on.lee_m), -toward);
        here = moved(here, to, SnowCell(fro.water, drifted_depth(fro)));
        there = moved(there, fro, SnowCell(to.water, drifted_depth(to)));
    }
    write_snow(cell, here);
    write_snow(pair.other, there);
}
