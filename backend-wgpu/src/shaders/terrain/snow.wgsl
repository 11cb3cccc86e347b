// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/terrain/snow.rs
// Snow that lies: water and depth in a grid of cells, that lands, settles, melts and slides.
#import arith/math
#import arith/rng
#import bindings

struct SnowCell {
    water: u32,
    depth: u32,
}

struct SnowPair {
    other: u32,
    is_diagonal: bool,
}

fn snow_cell(x: f32, z: f32) -> u32 {
    let column = bitcast<u32>(i32(floor(x * SNOW_CELLS_PER_M))) - scene.snow.first_column;
    let line = bitcast<u32>(i32(floor(z * SNOW_CELLS_PER_M))) - scene.snow.first_line;
    return select(NEVER, line * scene.snow.columns + column, column < scene.snow.columns && line < scene.snow.lines);
}

fn flake_weight(number: u32) -> u32 {
    let inner = number * (FLAKE_CELLS - 1u - number);
    return inner + u32(inner == 0u) + u32(inner != 0u) + u32(inner == 4u);
}

fn flake_cell(cell: u32, part: u32) -> u32 {
    let column = cell % scene.snow.columns + part % FLAKE_CELLS - 2u;
    let line = cell / scene.snow.columns + part / FLAKE_CELLS - 2u;
    return select(NEVER, line * scene.snow.columns + column, column < scene.snow.columns && line < scene.snow.lines);
}

fn flake_share(water: u32, part: u32) -> u32 {
    return (water * flake_weight(part % FLAKE_CELLS) * flake_weight(part / FLAKE_CELLS)) >> 8u;
}

fn fresh_depth(water: u32) -> u32 {
    return (water * step_block.snow.fresh_depth_q12 + 2048u) >> 12u;
}

fn snow_turn(step: u32) -> u32 {
    return select((step / SNOW_INTERVAL) % SNOW_TURNS, NEVER, (step & (SNOW_INTERVAL - 1u)) != 0u);
}

fn snow_pair(cell: u32, turn: u32) -> SnowPair {
    let none = SnowPair(NEVER, false);
    let column = cell % scene.snow.columns;
    let line = cell / scene.snow.columns;
    let kind = turn & 3u;
    let odd = turn >> 2u;
    if (kind == 0u) {
        if ((column & 1u) != odd || column + 1u >= scene.snow.columns) {
            return none;
        }
        return SnowPair(cell + 1u, false);
    }
    if ((line & 1u) != odd || line + 1u >= scene.snow.lines) {
        return none;
    }
    let across = column + kind - 2u;
    if (across >= scene.snow.columns) {
        return none;
    }
    return SnowPair((line + 1u) * scene.snow.columns + across, kind != 2u);
}

fn snow_repose(cell: SnowCell) -> f32 {
    let per_water = f32(cell.depth) * reciprocal(f32(max(cell.water, 1u)));
    let fresh = min(max((per_water - OLD_DEPTH) * (1.0 / (FRESH_DEPTH - OLD_DEPTH)), 0.0), 1.0);
    return OLD_SLOPE + fresh * (FRESH_SLOPE - OLD_SLOPE);
}

fn snow_part(cell: SnowCell, depth: u32) -> SnowCell {
    if (depth >= cell.depth) {
        return cell;
    }
    let share = f32(depth) * reciprocal(f32(cell.depth));
    return SnowCell(min(bitcast<u32>(i32(floor(f32(cell.water) * share))), cell.water), depth);
}

fn snow_slide(above: SnowCell, below: SnowCell, drop_m: f32, way_m: f32) -> SnowCell {
    if (above.depth == 0u || drop_m < -SNOW_STEP_M) {
        return SnowCell(0u, 0u);
    }
    let slope = select(0.0, drop_m, drop_m < SNOW_STEP_M);
    let higher_m = (f32(above.depth) - f32(below.depth)) * SNOW_DEPTH_M + slope;
    let steep_m = higher_m - way_m * snow_repose(above);
    if (steep_m <= 0.0) {
        return SnowCell(0u, 0u);
    }
    return snow_part(above, bitcast<u32>(i32(floor((steep_m * SNOW_SLIDES) * (1.0 / SNOW_DEPTH_M)))));
}

fn round_at_random(number: f32, word: u32) -> u32 {
    return bitcast<u32>(i32(floor(number + unit_float(word))));
}

fn snow_age(number: u32, cell: SnowCell, open: f32) -> SnowCell {
    let words = philox(scene.seed, vec4<u32>(number, STREAM_SNOW, step_block.index, 0u));
    let warmth = step_block.snow.melt_woods + open * (step_block.snow.melt_open - step_block.snow.melt_woods);
    let left = cell.water - min(round_at_random(warmth, words.x), cell.water);
    // The depth goes with the water.
    var kept = cell.depth;
    if (left != cell.water) {
        let share = f32(left) * reciprocal(f32(cell.water));
        kept = min(round_at_random(f32(cell.depth) * share, words.z), cell.depth);
    }
    let least = f32(left) * OLD_DEPTH;
    let loose = max(f32(kept) - least, 0.0);
    return SnowCell(left, kept - min(round_at_random(loose * step_block.snow.settled, words.y), kept));
}
