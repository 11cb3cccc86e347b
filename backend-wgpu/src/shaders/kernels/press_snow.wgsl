// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/press_snow.rs
// Presses the snow beneath things that move, in the steps in which they do.
#import solid/shape
#import terrain/snow
#import terrain/snow_print

// The tables, behind which the snow is: nothing else of them is written.
@group(0) @binding(2) var<storage, read_write> snow_words: array<u32>;

fn row(number: u32) -> vec4<u32> {
    let first = number * 4u;
    return vec4<u32>(snow_words[first], snow_words[first + 1u], snow_words[first + 2u], snow_words[first + 3u]);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn press_snow(@builtin(global_invocation_id) id: vec3<u32>) {
    let cell = id.x;
    let cells = scene.snow.columns * scene.snow.lines;
    if (cell >= cells) {
        return;
    }
    let first = scene.litter.first_row * 4u + scene.snow.first_word + cell;
    let before = SnowCell(snow_words[first + SNOW_WATER * cells], snow_words[first + SNOW_DEPTH * cells]);
    if (before.depth == 0u) {
        return;
    }
    let center = snow_center(cell);
    let on = scene.snow.first_row * 4u + 2u * cell;
    let floor_m = snow_floor(snow_words[on], snow_words[on + 1u]).height_m;
    var after = before;
    for (var number = 0u; number < scene.solids.mover_count; number++) {
        if (may_press(step_block.movers[number], center.x, center.y)) {
            let part = scene.solids.first_row + number * SOLID_ROWS;
            let solid = solid_of_rows(number, row(part), row(part + 1u), row(part + 2u), row(part + 3u), 0.0);
            after = snow_pressed(solid, center.x, center.y, floor_m, after);
        }
    }
    snow_words[first + SNOW_DEPTH * cells] = after.depth;
}
