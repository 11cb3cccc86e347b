// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Share of the mean wind that is left, as a cloth of colours on the ground where some is missing.

#import frame/light
#import marks/structs

@group(2) @binding(0) var<uniform> shelter: ShelterUniform;
@group(2) @binding(1) var<storage, read> nodes: array<f32>;

// Height of the cloth over the ground in metres: over grass and a layer of litter.
const LIFT_M: f32 = 0.07;
// Share that is missing where the cloth is as thick as anywhere.
const SHOWN: f32 = 0.06;

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    @location(0) @interpolate(perspective, centroid) left: f32,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(instance_index) instance: u32) -> Varyings {
    let across = shelter.nodes_x - 1u;
    let first = vec2(instance % across, instance / across);
    let corner = first + vec2(
        u32(index == 1u || index == 2u || index == 4u),
        u32(index == 2u || index == 4u || index == 5u),
    );
    let at = shelter.corner_m + vec2<f32>(corner) * shelter.apart_m;
    let row = first.y * shelter.nodes_x + first.x;
    let least = min(min(nodes[row], nodes[row + 1u]), min(nodes[row + shelter.nodes_x], nodes[row + shelter.nodes_x + 1u]));
    var out: Varyings;
    out.left = nodes[corner.y * shelter.nodes_x + corner.x];
    // In the free wind there is no cloth.
    out.clip = vec4(0.0);
    if least < 0.999 {
        out.clip = frame.view_projection * vec4(at.x, surface_height(at) + LIFT_M, at.y, 1.0);
    }
    return out;
}

@fragment
fn fragment(in: Varyings) -> @location(0) vec4<f32> {
    let at = clamp(in.left / shelter.high, 0.0, 1.0) * f32(SHADES - 1u);
    let first = min(u32(at), SHADES - 2u);
    let color = mix(shelter.palette[first].rgb, shelter.palette[first + 1u].rgb, at - f32(first));
    let alpha = 0.7 * smoothstep(0.0, SHOWN, 1.0 - in.left);
    let light = 0.42 * luminance(ambient_light(vec3(0.0, 1.0, 0.0)) + frame.sun_color);
    return vec4(color * light * alpha, alpha);
}
