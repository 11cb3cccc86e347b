// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/wind/turbulence.rs
#import bindings
#import kernel/vector

fn turbulence_node(ix: u32, iy: u32, iz: u32) -> vec3<f32> {
    let x = ix & (TURBULENCE_X - 1u);
    let y = iy & (TURBULENCE_Y - 1u);
    let z = iz & (TURBULENCE_Z - 1u);
    let node = wind_rows[environment.wind.tables.z + ((z * TURBULENCE_Y + y) * TURBULENCE_X + x)];
    return vec3<f32>(node.x, node.y, node.z);
}

fn wind_turbulence(place: vec3<f32>) -> vec3<f32> {
    let cells = environment.wind.cells;
    let x = place.x * cells.x - step_block.offsets.y;
    let y = place.y * cells.y;
    let z = place.z * cells.z;
    let kx = floor(x);
    let ky = floor(y);
    let kz = floor(z);
    let ix = bitcast<u32>(i32(kx));
    let iy = bitcast<u32>(i32(ky));
    let iz = bitcast<u32>(i32(kz));
    let tx = x - kx;
    let ty = y - ky;
    let tz = z - kz;
    let ix1 = ix + 1u;
    let iy1 = iy + 1u;
    let iz1 = iz + 1u;
    let a = vec3_lerp(turbulence_node(ix, iy, iz), turbulence_node(ix1, iy, iz), tx);
    let b = vec3_lerp(turbulence_node(ix, iy1, iz), turbulence_node(ix1, iy1, iz), tx);
    let c = vec3_lerp(turbulence_node(ix, iy, iz1), turbulence_node(ix1, iy, iz1), tx);
    let d = vec3_lerp(turbulence_node(ix, iy1, iz1), turbulence_node(ix1, iy1, iz1), tx);
    return vec3_lerp(vec3_lerp(a, b, ty), vec3_lerp(c, d, ty), tz);
}
