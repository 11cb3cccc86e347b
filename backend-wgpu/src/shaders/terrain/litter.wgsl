// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/terrain/litter.rs
// The height of litter: integers at the nodes of a grid, behind the rows of all tables, interpolated linearly in each direction.
#import bindings
#import terrain/snow

struct LitterCell {
    node: u32,
    is_inside: bool,
    bears: bool,
    x: f32,
    z: f32,
}

struct LitterShares {
    node: u32,
    heights: vec4<u32>,
}

fn litter_cell(x: f32, z: f32) -> LitterCell {
    let u = x * LITTER_CELLS_PER_M;
    let v = z * LITTER_CELLS_PER_M;
    let ku = floor(u);
    let kv = floor(v);
    let column = bitcast<u32>(i32(ku)) - scene.litter.first_column;
    let line = bitcast<u32>(i32(kv)) - scene.litter.first_line;
    let is_inside = column < scene.litter.columns && line < scene.litter.lines;
    let bears = column - 1u < scene.litter.columns - 2u && line - 1u < scene.litter.lines - 2u;
    let node = line * (scene.litter.columns + 1u) + column;
    return LitterCell(select(0u, node, is_inside), is_inside, bears, u - ku, v - kv);
}

fn litter_node(node: u32) -> f32 {
    return f32(tables[scene.litter.first_row + (node >> 2u)][node & 3u]);
}

fn litter_corners(cell: LitterCell) -> vec4<f32> {
    if (!cell.is_inside) {
        return vec4<f32>(0.0, 0.0, 0.0, 0.0);
    }
    let far = cell.node + scene.litter.columns + 1u;
    return vec4<f32>(
        litter_node(cell.node),
        litter_node(cell.node + 1u),
        litter_node(far),
        litter_node(far + 1u),
    );
}

fn litter_height(x: f32, z: f32) -> f32 {
    if (scene.litter.columns == 0u) {
        return 0.0;
    }
    let cell = litter_cell(x, z);
    let corners = litter_corners(cell);
    let near = corners.x + cell.x * (corners.y - corners.x);
    let far = corners.z + cell.x * (corners.w - corners.z);
    return (near + cell.z * (far - near)) * LITTER_UNIT_M;
}

fn ground_cover(x: f32, z: f32) -> f32 {
    let litter = litter_height(x, z);
    if (scene.snow.columns == 0u) {
        return litter;
    }
    return litter + snow_height(x, z);
}

fn above_litter(above_ground: f32, x: f32, z: f32) -> f32 {
    if (!(above_ground < LITTER_WIND_M)) {
        return above_ground;
    }
    let fading = 2.0 - above_ground * (2.0 / LITTER_WIND_M);
    let share = min(max(fading, 0.0), 1.0);
    return above_ground - share * ground_cover(x, z);
}

fn litter_shares(volume: u32, x: f32, z: f32) -> LitterShares {
    let cell = litter_cell(x, z);
    let right = u32(cell.x * LITTER_WEIGHT);
    let far = u32(cell.z * LITTER_WEIGHT);
    let left = u32(LITTER_WEIGHT) - right;
    let near = u32(LITTER_WEIGHT) - far;
    let first = (volume * left * near) >> 16u;
    let second = (volume * right * near) >> 16u;
    let third = (volume * left * far) >> 16u;
    return LitterShares(cell.node, vec4<u32>(first, second, third, volume - first - second - third));
}
