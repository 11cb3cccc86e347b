// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Sun, sky and haze.

@group(1) @binding(0) var shadow_map: texture_depth_2d;
@group(1) @binding(1) var shadow_sampler: sampler_comparison;
// Top view of the park: sunlight let through by the trees (r), litter under them (g).
@group(1) @binding(2) var shade_map: texture_2d<f32>;
@group(1) @binding(3) var clamp_sampler: sampler;
@group(1) @binding(4) var noise: texture_2d<f32>;
@group(1) @binding(5) var repeat_sampler: sampler;
@group(1) @binding(6) var wide_map: texture_depth_2d;

// Sunlight that reaches `position` past the leaves and trees of the map around the whole stand.
fn wide_shadow(position: vec3<f32>) -> f32 {
    // A texel is wide: what lies in it must not shade itself.
    let clip = frame.wide_projection * vec4(position + frame.sun_direction.xyz * (1.5 * frame.wide.x), 1.0);
    let uv = clip.xy * vec2(0.5, -0.5) + 0.5;
    let edge = max(abs(clip.x), abs(clip.y));
    if edge > 0.99 || clip.z < 0.0 || clip.z > 1.0 {
        return 1.0;
    }
    let texel = 1.0 / 2048.0;
    var sum = textureSampleCompareLevel(wide_map, shadow_sampler, uv + texel * vec2(-0.9, -0.4), clip.z);
    sum += textureSampleCompareLevel(wide_map, shadow_sampler, uv + texel * vec2(0.4, -0.9), clip.z);
    sum += textureSampleCompareLevel(wide_map, shadow_sampler, uv + texel * vec2(0.9, 0.4), clip.z);
    sum += textureSampleCompareLevel(wide_map, shadow_sampler, uv + texel * vec2(-0.4, 0.9), clip.z);
    return mix(sum * 0.25, 1.0, smoothstep(0.9, 0.99, edge));
}

// Sunlight that leaves and trees in the shadow maps let through to `position`, 0 to 1.
fn leaf_shadow(position: vec3<f32>) -> f32 {
    let clip = frame.shadow_projection * vec4(position, 1.0);
    let uv = clip.xy * vec2(0.5, -0.5) + 0.5;
    let edge = max(abs(clip.x), abs(clip.y));
    if edge > 0.99 || clip.z < 0.0 || clip.z > 1.0 {
        return wide_shadow(position);
    }
    let texel = 1.0 / 2048.0;
    var sum = textureSampleCompareLevel(shadow_map, shadow_sampler, uv + texel * vec2(-0.9, -0.4), clip.z);
    sum += textureSampleCompareLevel(shadow_map, shadow_sampler, uv + texel * vec2(0.4, -0.9), clip.z);
    sum += textureSampleCompareLevel(shadow_map, shadow_sampler, uv + texel * vec2(0.9, 0.4), clip.z);
    sum += textureSampleCompareLevel(shadow_map, shadow_sampler, uv + texel * vec2(-0.4, 0.9), clip.z);
    if edge < 0.8 {
        return sum * 0.25;
    }
    return mix(sum * 0.25, wide_shadow(position), smoothstep(0.8, 0.99, edge));
}

// Sunlight that the trees let through (r) and litter density (g) where the sun ray through `position` meets the ground.
fn tree_shade(position: vec3<f32>) -> vec2<f32> {
    let height = position.y - frame.park.y;
    let down = frame.sun_direction.xz * (height / frame.sun_direction.y);
    let offset = (position.xz - down - frame.park.xz) / frame.air.z;
    let uv = offset * 0.5 + 0.5;
    let shade = textureSampleLevel(shade_map, clamp_sampler, uv, 0.0).rg;
    // Trees are as high as they are: far above them the sun is free again.
    let free = max(smoothstep(2.0, 14.0, height), smoothstep(0.9, 1.0, max(abs(offset.x), abs(offset.y))));
    return vec2(mix(shade.r, 1.0, free), shade.g);
}

// Light of the whole sky and the ground on a surface facing `normal`.
fn ambient_light(normal: vec3<f32>) -> vec3<f32> {
    let sky = mix(frame.sky_horizon.rgb, frame.sky_zenith.rgb, 0.30);
    return mix(frame.ground_bounce.rgb, sky, normal.y * 0.5 + 0.5);
}

// Sky without clouds in a direction.
fn clear_sky(direction: vec3<f32>) -> vec3<f32> {
    let height = max(direction.y, 0.0);
    let toward_sun = max(dot(direction, frame.sun_direction.xyz), 0.0);
    var color = mix(frame.sky_horizon.rgb, frame.sky_zenith.rgb, 1.0 - exp(-4.2 * height));
    // Forward scattering: a wide warm veil and a tighter glow.
    let veil = 0.07 * pow(toward_sun, 5.0) + 0.22 * pow(toward_sun, 24.0) + 0.8 * pow(toward_sun, 300.0);
    color += frame.sun_color.rgb * veil;
    return color;
}

// Adds the air between the eye and a surface at `position`.
fn haze(color: vec3<f32>, position: vec3<f32>) -> vec3<f32> {
    let ray = position - frame.eye.xyz;
    let distance_m = length(ray);
    let direction = ray / max(distance_m, 1.0e-4);
    let level = normalize(vec3(direction.x, max(direction.y, 0.0) * 0.4 + 0.04, direction.z));
    let veil = 1.0 - exp(-max(distance_m - 4.0, 0.0) * frame.air.x);
    return mix(color, clear_sky(level), veil);
}
