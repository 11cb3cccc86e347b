// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Density of leaves that have landed, as a cloth of colours on the ground.

#import frame/light
#import marks/structs

@group(2) @binding(0) var<uniform> landing: LandingUniform;
@group(2) @binding(1) var<storage, read> cells: array<u32>;

// Height of the cloth over the ground in metres: over grass and litter.
const LIFT_M: f32 = 0.07;

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    @location(0) @interpolate(perspective, centroid) density: f32,
}

fn cell(x: i32, z: i32) -> f32 {
    let edge = i32(landing.cells);
    if x < 0 || z < 0 || x >= edge || z >= edge {
        return 0.0;
    }
    return f32(cells[z * edge + x]);
}

// Leaves per square metre around a corner of the grid.
fn density_at(x: i32, z: i32) -> f32 {
    let sum = cell(x - 1, z - 1) + cell(x, z - 1) + cell(x - 1, z) + cell(x, z);
    return 0.25 * sum / (landing.cell_m * landing.cell_m);
}

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(instance_index) instance: u32) -> Varyings {
    let edge = landing.cells;
    let corner = vec2(
        i32(instance % edge) + i32(index == 1u || index == 2u || index == 4u),
        i32(instance / edge) + i32(index == 2u || index == 4u || index == 5u),
    );
    let at = landing.corner_m + vec2<f32>(corner) * landing.cell_m;
    var out: Varyings;
    out.density = density_at(corner.x, corner.y);
    out.clip = frame.view_projection * vec4(at.x, surface_height(at) + LIFT_M, at.y, 1.0);
    return out;
}

@fragment
fn fragment(in: Varyings) -> @location(0) vec4<f32> {
    let low = landing.low_per_m2;
    let amount = log(max(in.density, 1.0e-3) / low) / log(landing.high_per_m2 / low);
    let at = clamp(amount, 0.0, 1.0) * f32(SHADES - 1u);
    let first = min(u32(at), SHADES - 2u);
    let color = mix(landing.palette[first].rgb, landing.palette[first + 1u].rgb, at - f32(first));
    // Fades out where there is less than the scale begins with.
    let alpha = 0.82 * smoothstep(0.15 * low, low, in.density);
    let light = 0.42 * luminance(ambient_light(vec3(0.0, 1.0, 0.0)) + frame.sun_color);
    return vec4(color * light * alpha, alpha);
}
