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

struct SnowFloor {
    height_m: f32,
    open: f32,
    lee_m: f32,
}

struct SnowPair {
    other: u32,
    is_diagonal: bool,
    is_around: bool,
}

struct SnowBetween {
    depths_m: vec4<f32>,
    x: f32,
    z: f32,
}

fn snow_floor(height: u32, word: u32) -> SnowFloor {
    let open = word & 0xffffu;
    return SnowFloor(
        bitcast<f32>(height),
        select(f32(open) * FLOOR_OPEN, -1.0, open == FLOOR_ON_WATER),
        f32(word >> 16u) * FLOOR_LEE_M,
    );
}

fn snow_depth_m(cell: u32) -> f32 {
    let place = scene.snow.first_word + SNOW_DEPTH * (scene.snow.columns * scene.snow.lines) + cell;
    return min(f32(tables[scene.litter.first_row + (place >> 2u)][place & 3u]) * SNOW_DEPTH_M, SNOW_HIGHEST_M);
}

fn snow_between(x: f32, z: f32) -> SnowBetween {
    let u = x * SNOW_CELLS_PER_M - 0.5;
    let v = z * SNOW_CELLS_PER_M - 0.5;
    let ku = floor(u);
    let kv = floor(v);
    let column = bitcast<u32>(i32(ku)) - scene.snow.first_column;
    let line = bitcast<u32>(i32(kv)) - scene.snow.first_line;
    let is_inside = column < scene.snow.columns - 1u && line < scene.snow.lines - 1u;
    var depths_m = vec4<f32>(0.0, 0.0, 0.0, 0.0);
    if (is_inside) {
        let cell = line * scene.snow.columns + column;
        let far = cell + scene.snow.columns;
        depths_m = vec4<f32>(snow_depth_m(cell), snow_depth_m(cell + 1u), snow_depth_m(far), snow_depth_m(far + 1u));
    }
    return SnowBetween(depths_m, u - ku, v - kv);
}

fn snow_height(x: f32, z: f32) -> f32 {
    if (scene.snow.columns == 0u) {
        return 0.0;
    }
    let snow = snow_between(x, z);
    let near = snow.depths_m.x + snow.x * (snow.depths_m.y - snow.depths_m.x);
    let far = snow.depths_m.z + snow.x * (snow.depths_m.w - snow.depths_m.z);
    return near + snow.z * (far - near);
}

fn snow_cell(x: f32, z: f32) -> u32 {
    let column = bitcast<u32>(i32(floor(x * SNOW_CELLS_PER_M))) - scene.snow.first_column;
    let line = bitcast<u32>(i32(floor(z * SNOW_CELLS_PER_M))) - scene.snow.first_line;
    return select(NEVER, line * scene.snow.columns + column, column < scene.snow.columns && line < scene.snow.lines);
}

fn snow_inside(x: f32, z: f32) -> vec2<f32> {
    let low_x = (f32(bitcast<i32>(scene.snow.first_column)) + 0.5) * (1.0 / SNOW_CELLS_PER_M);
    let low_z = (f32(bitcast<i32>(scene.snow.first_line)) + 0.5) * (1.0 / SNOW_CELLS_PER_M);
    let high_x = low_x + f32(scene.snow.columns - 1u) * (1.0 / SNOW_CELLS_PER_M);
    let high_z = low_z + f32(scene.snow.lines - 1u) * (1.0 / SNOW_CELLS_PER_M);
    return vec2<f32>(min(max(x, low_x), high_x), min(max(z, low_z), high_z));
}

fn snow_center(cell: u32) -> vec2<f32> {
    let column = scene.snow.first_column + cell % scene.snow.columns;
    let line = scene.snow.first_line + cell / scene.snow.columns;
    return (vec2<f32>(f32(bitcast<i32>(column)), f32(bitcast<i32>(line))) + 0.5) * (1.0 / SNOW_CELLS_PER_M);
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

fn snow_drifts() -> bool {
    let round_number = step_block.index / (SNOW_INTERVAL * SNOW_TURNS);
    return (round_number % DRIFT_ROUNDS) == 0u && step_block.snow.lifts_fresh_m_s < step_block.snow.drift_m_s;
}

fn snow_pair(cell: u32, turn: u32) -> SnowPair {
    let none = SnowPair(NEVER, false, false);
    let column = cell % scene.snow.columns;
    let line = cell / scene.snow.columns;
    let kind = turn & 3u;
    let odd = turn >> 2u;
    if (kind == 0u) {
        if ((column & 1u) != odd) {
            return none;
        }
        let is_around = column + 1u >= scene.snow.columns;
        return SnowPair(select(cell + 1u, cell - column, is_around), false, is_around);
    }
    if ((line & 1u) != odd) {
        return none;
    }
    if (line + 1u >= scene.snow.lines) {
        if (kind != 2u) {
            return none;
        }
        return SnowPair(column, false, true);
    }
    let across = column + kind - 2u;
    if (across >= scene.snow.columns) {
        return none;
    }
    return SnowPair((line + 1u) * scene.snow.columns + across, kind != 2u, false);
}

fn snow_freshness(cell: SnowCell) -> f32 {
    let per_water = f32(cell.depth) * reciprocal(f32(max(cell.water, 1u)));
    return min(max((per_water - OLD_DEPTH) * (1.0 / (FRESH_DEPTH - OLD_DEPTH)), 0.0), 1.0);
}

fn snow_repose(cell: SnowCell) -> f32 {
    return OLD_SLOPE + snow_freshness(cell) * (FRESH_SLOPE - OLD_SLOPE);
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

fn snow_taken(cell: SnowCell, water: u32) -> SnowCell {
    if (water >= cell.water) {
        return cell;
    }
    let share = f32(water) * reciprocal(f32(cell.water));
    return SnowCell(water, min(bitcast<u32>(i32(floor(f32(cell.depth) * share))), cell.depth));
}

fn left_over_snow(left: f32, depth_m: f32, lee_m: f32) -> f32 {
    if (lee_m <= 0.0) {
        return left;
    }
    let filled = min(depth_m * reciprocal(lee_m), 1.0) * min(lee_m * (1.0 / FULL_LEE_M), 1.0);
    return 1.0 - (1.0 - left) * (1.0 - filled);
}

fn snow_drift(cell: SnowCell, rise_m: f32, left: f32, toward: f32) -> SnowCell {
    let none = SnowCell(0u, 0u);
    let now = step_block.snow;
    let speed = now.drift_m_s * max(left, -left);
    let lifts = now.lifts_old_m_s + snow_freshness(cell) * (now.lifts_fresh_m_s - now.lifts_old_m_s);
    if (cell.water == 0u || SNOW_STEP_M < rise_m || left * toward <= 0.0 || speed <= lifts) {
        return none;
    }
    let carried = (lifts * (speed * speed - lifts * lifts)) * reciprocal(speed);
    let units = carried * (max(toward, -toward) * now.drift_units);
    return snow_taken(cell, bitcast<u32>(i32(floor(min(units, MOST_DRIFT)))));
}

fn drifted_depth(taken: SnowCell) -> u32 {
    return min(bitcast<u32>(i32(floor(f32(taken.water) * OLD_DEPTH))), taken.depth);
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
