// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/step_snow.rs
// Lets snow slide from cell to cell, or settle and melt, in the steps in which it does.
#import terrain/snow

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

fn lies_on(cell: u32) -> vec2<f32> {
    let first = scene.snow.first_row * 4u + 2u * cell;
    return vec2<f32>(bitcast<f32>(snow_words[first]), bitcast<f32>(snow_words[first + 1u]));
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn step_snow(@builtin(global_invocation_id) id: vec3<u32>) {
    let cell = id.x;
    if (cell >= scene.snow.columns * scene.snow.lines) {
        return;
    }
    let turn = snow_turn(step_block.index);
    let one = read_snow(cell);
    let on = lies_on(cell);
    if (turn == SNOW_AGES) {
        if (one.water != 0u) {
            let after = snow_age(cell, one, on.y);
            write_snow(cell, after);
            snow_words[snow_word(SNOW_MELTED, cell)] += one.water - after.water;
        }
        return;
    }
    let pair = snow_pair(cell, turn);
    if (pair.other == NEVER) {
        return;
    }
    let two = read_snow(pair.other);
    let other_on = lies_on(pair.other);
    if ((one.depth == 0u && two.depth == 0u) || on.y < 0.0 || other_on.y < 0.0) {
        return;
    }
    let way_m = select(1.0, ROOT_TWO, pair.is_diagonal) * (1.0 / SNOW_CELLS_PER_M);
    let there = snow_slide(one, two, on.x - other_on.x, way_m);
    let back = snow_slide(two, one, other_on.x - on.x, way_m);
    write_snow(cell, SnowCell(one.water - there.water + back.water, one.depth - there.depth + back.depth));
    write_snow(pair.other, SnowCell(two.water - back.water + there.water, two.depth - back.depth + there.depth));
}
