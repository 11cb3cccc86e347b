// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/wind/turbulence.rs
// Turbulence: a periodic box of velocities, interpolated linearly in each direction.
#import bindings

fn turbulence_unpack(word: u32) -> vec2<f32> {
    return vec2<f32>(f32(bitcast<i32>(word << 16u) >> 16u), f32(bitcast<i32>(word) >> 16u));
}

fn turbulence_index(column: u32, level: u32, layer: u32) -> u32 {
    return ((layer & (TURBULENCE_Z - 1u)) << 11u) | ((level & (TURBULENCE_Y - 1u)) << 6u) | (column & (TURBULENCE_X - 1u));
}

fn turbulence_component(edge: u32, along: f32) -> f32 {
    let ends = turbulence_unpack(edge);
    return ends.x + along * (ends.y - ends.x);
}

fn turbulence_edge(index: u32, along: f32) -> vec3<f32> {
    let row = tables[scene.wind.first_turbulence_row + index];
    return vec3<f32>(
        turbulence_component(row.x, along),
        turbulence_component(row.y, along),
        turbulence_component(row.z, along),
    );
}

fn wind_turbulence(moment: u32, place: vec3<f32>) -> vec3<f32> {
    let cells = scene.wind.cells_per_m;
    let x = place.x * cells.x - step_block.moments[moment].turbulence_offset;
    return turbulence_in_cells(vec3<f32>(x, place.y * cells.y, place.z * cells.z));
}

fn turbulence_in_cells(cells: vec3<f32>) -> vec3<f32> {
    let x = cells.x;
    let y = cells.y;
    let z = cells.z;
    let kx = floor(x);
    let ky = floor(y);
    let kz = floor(z);
    let t = vec3<f32>(x - kx, y - ky, z - kz);
    let column = bitcast<u32>(i32(kx));
    let level = bitcast<u32>(i32(ky));
    let layer = bitcast<u32>(i32(kz));
    let above = level + 1u;
    let beyond = layer + 1u;
    let a = turbulence_edge(turbulence_index(column, level, layer), t.x);
    let b = turbulence_edge(turbulence_index(column, above, layer), t.x);
    let c = turbulence_edge(turbulence_index(column, level, beyond), t.x);
    let d = turbulence_edge(turbulence_index(column, above, beyond), t.x);
    let near = a + (b - a) * t.y;
    let far = c + (d - c) * t.y;
    return (near + (far - near) * t.z) * TURBULENCE_UNIT;
}
