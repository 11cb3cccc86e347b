// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/solid/grid.rs
// Distance to a mesh, on a grid.
#import bindings
#import arith/math
#import arith/vector
#import solid/shape

struct GridAxis {
    node: u32,
    share: f32,
    beyond: f32,
}

fn grid_axis(cells: f32, nodes: u32) -> GridAxis {
    let last = f32(nodes - 1u);
    if (cells <= 0.0) {
        return GridAxis(0u, 0.0, cells);
    }
    if (last <= cells) {
        return GridAxis(nodes - 2u, 1.0, cells - last);
    }
    let before = floor(cells);
    return GridAxis(u32(before), cells - before, 0.0);
}

fn grid_node(first_row: u32, node: u32) -> f32 {
    let word = tables[first_row + GRID_ROWS + (node >> 3u)][(node >> 1u) & 3u];
    let half = select(word, word << 16u, (node & 1u) == 0u);
    return f32(bitcast<i32>(half) >> 16u);
}

fn grid_cell_m(solid: SolidAt) -> f32 {
    return bitcast<f32>(tables[solid.first_row + 1u].w);
}

fn grid_distance(solid: SolidAt, inner: vec3<f32>) -> SolidDistance {
    let counts = tables[solid.first_row];
    let cell_m = grid_cell_m(solid);
    let cells = (inner - row_vector(tables[solid.first_row + 1u])) * reciprocal(cell_m);
    let x = grid_axis(cells.x, counts.x);
    let y = grid_axis(cells.y, counts.y);
    let z = grid_axis(cells.z, counts.z);
    let beyond = vec3<f32>(x.beyond, y.beyond, z.beyond);
    let beyond_squared = vec3_dot(beyond, beyond);
    if (TINY_SQUARED < beyond_squared) {
        let inverse = inverse_sqrt(beyond_squared);
        return SolidDistance(beyond_squared * inverse * cell_m + bitcast<f32>(counts.w), beyond * inverse);
    }
    let node = (z.node * counts.y + y.node) * counts.x + x.node;
    let line = counts.x;
    let layer = counts.x * counts.y;
    let first = solid.first_row;
    let low = vec4<f32>(
        grid_node(first, node),
        grid_node(first, node + line),
        grid_node(first, node + layer),
        grid_node(first, node + layer + line),
    );
    let high = vec4<f32>(
        grid_node(first, node + 1u),
        grid_node(first, node + line + 1u),
        grid_node(first, node + layer + 1u),
        grid_node(first, node + layer + line + 1u),
    );
    let rise = high - low;
    let along = low + rise * x.share;
    let near = along.x + (along.y - along.x) * y.share;
    let far = along.z + (along.w - along.z) * y.share;
    let rise_near = rise.x + (rise.y - rise.x) * y.share;
    let rise_far = rise.z + (rise.w - rise.z) * y.share;
    let climb_near = along.y - along.x;
    let climb_far = along.w - along.z;
    let slope = vec3<f32>(
        rise_near + (rise_far - rise_near) * z.share,
        climb_near + (climb_far - climb_near) * z.share,
        far - near,
    );
    let slope_squared = vec3_dot(slope, slope);
    var normal = vec3<f32>(0.0, 1.0, 0.0);
    if (TINY_SQUARED < slope_squared) {
        normal = slope * inverse_sqrt(slope_squared);
    }
    let distance = near + (far - near) * z.share;
    return SolidDistance(distance * (cell_m * (1.0 / GRID_UNITS)), normal);
}
