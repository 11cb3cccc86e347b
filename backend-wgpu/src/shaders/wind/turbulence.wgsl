// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/wind/turbulence.rs
// Turbulence: a periodic box of velocities, interpolated linearly in each direction.
#import bindings

fn turbulence_unpack(word: u32) -> vec2<f32> {
    return vec2<f32>(f32(bitcast<i32>(word << 16u) >> 16u), f32(bitcast<i32>(word) >> 16u));
}

fn turbulence_index(column: u32, layer: u32) -> u32 {
    return ((layer & (TURBULENCE_Z - 1u)) << 11u) | column;
}

fn turbulence_face(index: u32, along: f32, up: f32) -> vec2<f32> {
    let row = tables[scene.wind.first_turbulence_row + index];
    let a = turbulence_unpack(row.x);
    let b = turbulence_unpack(row.y);
    let c = turbulence_unpack(row.z);
    let d = turbulence_unpack(row.w);
    let lower = vec2<f32>(a.x + along * (b.x - a.x), a.y + along * (b.y - a.y));
    let upper = vec2<f32>(c.x + along * (d.x - c.x), c.y + along * (d.y - c.y));
    return vec2<f32>(lower.x + up * (upper.x - lower.x), lower.y + up * (upper.y - lower.y));
}

fn turbulence_edge(edge: u32, along: f32) -> f32 {
    let ends = turbulence_unpack(edge);
    return ends.x + along * (ends.y - ends.x);
}

fn turbulence_across(index: u32, t: vec3<f32>) -> f32 {
    let edges = tables[scene.wind.first_turbulence_row + TURBULENCE_NODES + index];
    let a = turbulence_edge(edges.x, t.x);
    let b = turbulence_edge(edges.y, t.x);
    let c = turbulence_edge(edges.z, t.x);
    let d = turbulence_edge(edges.w, t.x);
    let near = a + t.y * (b - a);
    let far = c + t.y * (d - c);
    return near + t.z * (far - near);
}

fn wind_turbulence(moment: u32, place: vec3<f32>) -> vec3<f32> {
    let cells = scene.wind.cells_per_m;
    let x = place.x * cells.x - step_block.moments[moment].turbulence_offset;
    let y = place.y * cells.y;
    let z = place.z * cells.z;
    let kx = floor(x);
    let ky = floor(y);
    let kz = floor(z);
    let t = vec3<f32>(x - kx, y - ky, z - kz);
    let column =
        ((bitcast<u32>(i32(ky)) & (TURBULENCE_Y - 1u)) << 6u) | (bitcast<u32>(i32(kx)) & (TURBULENCE_X - 1u));
    let layer = bitcast<u32>(i32(kz));
    let index = turbulence_index(column, layer);
    let near = turbulence_face(index, t.x, t.y);
    let far = turbulence_face(turbulence_index(column, layer + 1u), t.x, t.y);
    let across = turbulence_across(index, t);
    return vec3<f32>(
        (near.x + t.z * (far.x - near.x)) * TURBULENCE_UNIT,
        (near.y + t.z * (far.y - near.y)) * TURBULENCE_UNIT,
        across * TURBULENCE_UNIT,
    );
}
