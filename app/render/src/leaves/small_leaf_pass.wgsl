// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Leaves of a few pixels, in the light that `leaves/small_leaf_light.wgsl` has found for each: what their blades do with it is all that is left
// to their points.

#import leaves/leaf_light

@group(3) @binding(1) var<storage, read> lights: array<LeafLight>;

struct Varyings {
    @builtin(position) @invariant clip: vec4<f32>,
    @location(0) @interpolate(perspective, centroid) uv: vec2<f32>,
    @location(1) @interpolate(flat) layer: u32,
    // Random word of the leaf.
    @location(2) @interpolate(flat) random: u32,
    // Factor on the colour; clearness, negative if its lower side is seen.
    @location(3) @interpolate(flat) tint_clear: vec4<f32>,
    // Share of light that other leaves send back; settled; wet; snow on the side that is seen.
    @location(4) @interpolate(flat) shares: vec4<f32>,
    // Light on the side that is seen and on the other, and what the wax mirrors.
    @location(5) @interpolate(flat) front: vec3<f32>,
    @location(6) @interpolate(flat) back: vec3<f32>,
    @location(7) @interpolate(flat) mirrored: vec3<f32>,
    @location(8) @interpolate(flat) air: vec4<f32>,
}

@vertex
fn vertex(in: LeafVertex) -> Varyings {
    let record = record_of(in);
    let light = lights[in.first_record + in.instance];
    let point = blade_point(record, in.level, in.vertex);
    let front_back = vec4(unpack2x16float(light.front_rg), unpack2x16float(light.front_b_back_r));
    let back_gb = unpack2x16float(light.back_gb);
    let mirrored_clear = unpack2x16float(light.mirrored_b_clear);
    var out: Varyings;
    out.clip = frame.view_projection * vec4(point.world, 1.0);
    out.uv = point.uv;
    out.layer = record.layer_slot & LAYER_MASK;
    out.random = leaf_random(record);
    out.tint_clear = vec4(unpack2x16float(record.red_green), unpack2x16float(record.blue_open).x, mirrored_clear.y);
    out.shares = unpack4x8unorm(light.shares);
    out.front = front_back.xyz;
    out.back = vec3(front_back.w, back_gb);
    out.mirrored = vec3(unpack2x16float(light.mirrored_rg), mirrored_clear.x);
    out.air = vec4(unpack2x16float(light.air_rg), unpack2x16float(light.air_ba));
    return out;
}

@fragment
fn fragment(in: Varyings) -> Painted {
    let image = textureSample(images, image_sampler, in.uv, in.layer);
    let alpha = blade_cover(image.a, in.uv);
    let mask = covered(alpha, in.random);
    if mask == 0u {
        discard;
    }
    var reflectance = blade_color(image.rgb, in.tint_clear.rgb);
    var transmittance = crossing(reflectance, abs(in.tint_clear.w), in.shares.y);
    if in.tint_clear.w < 0.0 && !IS_PAINTED {
        reflectance = pale(reflectance);
    }
    reflectance = wet_reflectance(min(reflectance, vec3(0.8)), in.shares.z);
    reflectance = mix(reflectance, SNOW_COLOR, in.shares.w);
    transmittance = min(transmittance, MOST - reflectance);
    var color = reflectance * in.front + transmittance * in.back;
    color = color / (1.0 - in.shares.x * (reflectance + transmittance)) + in.mirrored;
    return Painted(vec4(color * in.air.a + in.air.rgb, 1.0), mask);
}
