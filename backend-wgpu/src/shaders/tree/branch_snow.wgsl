// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/tree/branch_snow.rs
// Snow on the branches of trees.
#import arith/math
#import arith/rng
#import bindings
#import terrain/snow

struct BranchCatch {
    cell: u32,
    area: u32,
    wood_m2: f32,
    leaf_m2: f32,
}

struct BranchRound {
    held: u32,
    caught: u32,
    lost: u32,
}

fn crown_columns() -> u32 {
    return (scene.snow.columns + (CROWN_CELLS - 1u)) / CROWN_CELLS;
}

fn crown_squares() -> u32 {
    return crown_columns() * ((scene.snow.lines + (CROWN_CELLS - 1u)) / CROWN_CELLS);
}

fn crown_cell(cell: u32) -> u32 {
    let words = philox(scene.seed, vec4<u32>(crown_round(step_block.index), STREAM_SHIFT, 0u, 0u));
    let column = (cell % scene.snow.columns + words.x % CROWN_CELLS) % scene.snow.columns;
    let line = (cell / scene.snow.columns + words.y % CROWN_CELLS) % scene.snow.lines;
    return line * scene.snow.columns + column;
}

fn crown_square(cell: u32) -> u32 {
    return (cell / scene.snow.columns / CROWN_CELLS) * crown_columns() + (cell % scene.snow.columns) / CROWN_CELLS;
}

fn crown_width(cell: u32) -> u32 {
    return min(CROWN_CELLS, scene.snow.columns - (cell % scene.snow.columns) / CROWN_CELLS * CROWN_CELLS);
}

fn crown_part(cell: u32, units: u32) -> u32 {
    let column = cell % scene.snow.columns;
    let line = cell / scene.snow.columns;
    let width = crown_width(cell);
    let high = min(CROWN_CELLS, scene.snow.lines - line / CROWN_CELLS * CROWN_CELLS);
    return (units + (line % CROWN_CELLS) * width + column % CROWN_CELLS) / (width * high);
}

fn crown_round(step: u32) -> u32 {
    return (step + (SNOW_INTERVAL - 1u)) / (SNOW_INTERVAL * SNOW_TURNS);
}

fn crown_pool(step: u32) -> u32 {
    return CROWN_POOL * (crown_round(step) & 1u);
}

fn branch_word(row: u32) -> u32 {
    return scene.snow.first_word + SNOW_WORDS * (scene.snow.columns * scene.snow.lines) + row;
}

fn crown_word(square: u32, word: u32) -> u32 {
    return branch_word(scene.snow.branches) + word * crown_squares() + square;
}

fn flake_is_caught(x: f32, z: f32, open: f32) -> bool {
    if (scene.snow.branches == 0u || 1.0 <= open || open < 0.0) {
        return false;
    }
    let words = philox(scene.seed, vec4<u32>(bitcast<u32>(x), STREAM_CROWN, step_block.index, bitcast<u32>(z)));
    return open <= unit_float(words.x);
}

fn branch_catch(row: u32) -> BranchCatch {
    let words = tables[scene.snow.first_branch_row + row];
    return BranchCatch(words.x, words.y, bitcast<f32>(words.z), bitcast<f32>(words.w));
}

fn branch_room(catch_by: BranchCatch, leaf_count: f32, axis_y: f32) -> f32 {
    let level_share = max(1.0 - axis_y * axis_y, 0.0);
    return step_block.snow.branch_units_m2 * (catch_by.wood_m2 * level_share + catch_by.leaf_m2 * leaf_count);
}

fn branch_offer(catch_by: BranchCatch, fresh: u32, area: u32) -> f32 {
    let part = f32(catch_by.area) * reciprocal(f32(max(area, 1u)));
    return f32(fresh) * (part * CROWN_TAKEN);
}

fn branch_round(
    row: u32,
    room: f32,
    held: u32,
    offered: f32,
    spin_squared: f32,
) -> BranchRound {
    let before = f32(held);
    let free = max(1.0 - before * reciprocal(max(room, 1.0)), 0.0);
    let caught = u32(floor(offered * free));
    var share = step_block.snow.branch_sheds;
    if (SHAKING_SQUARED < spin_squared) {
        share += SHAKEN_SHARE;
    }
    let over = max(before - room, 0.0);
    let words = philox(scene.seed, vec4<u32>(row, STREAM_BRANCH, step_block.index, 0u));
    let lump = min(max(share, LUMP_SHARE), 1.0);
    var falls = over;
    if (unit_float(words.y) * lump < share) {
        falls += (before - over) * lump;
    }
    let lost = min(round_at_random(falls, words.x), held);
    return BranchRound(held - lost + caught, caught, lost);
}

fn branch_snow_kg(row: u32) -> f32 {
    if (scene.snow.branches == 0u) {
        return 0.0;
    }
    let place = branch_word(row);
    return f32(tables[scene.litter.first_row + (place >> 2u)][place & 3u]) * SNOW_UNIT_KG;
}
