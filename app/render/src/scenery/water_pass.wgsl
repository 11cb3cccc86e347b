// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Still water: it mirrors what stands around it, more so at a glance, and shows its dark bottom where it is shallow.

#import frame/light
#import scenery/horizon
#import scenery/meadow

// Light that the water mirrors, as the same pixels of the picture show it.
@group(2) @binding(0) var mirror: texture_2d<f32>;

// Reflectance of water seen from straight above (Fresnel, index of refraction 1.33).
const WATER_F0: f32 = 0.02;
// Light that a metre of pond water takes away, per metre: red first, and blue by what is dissolved in it.
const WATER_EXTINCTION: vec3<f32> = vec3(1.5, 0.9, 1.3);
// Albedo of deep pond water and of the silt at its bottom.
const WATER_DEEP: vec3<f32> = vec3(0.010, 0.017, 0.011);
const WATER_BOTTOM: vec3<f32> = vec3(0.095, 0.075, 0.042);
// Depths in m at which the bottom is still that of the shore, and all silt.
const SHORE_DEPTH_M: f32 = 0.01;
const SILT_DEPTH_M: f32 = 0.22;

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    @location(0) world: vec3<f32>,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Varyings {
    let at = horizon_fan(index);
    var out: Varyings;
    out.world = vec3(at.x, land.water_m, at.y);
    out.clip = frame.view_projection * vec4(out.world, 1.0);
    return out;
}

// Slope of the ripples that a breath of air makes: two trains that cross, by differences of soft noise, and patches where
// the air is quite still.
fn ripples(at: vec2<f32>, lod: f32) -> vec2<f32> {
    let time_s = frame.time_s;
    let apart = 1.0 / 256.0;
    var slope = vec2(0.0);
    for (var train = 0u; train < 2u; train++) {
        let scale = select(0.21, 0.53, train == 1u);
        let drift = select(vec2(0.012, 0.007), vec2(-0.010, 0.016), train == 1u) * time_s;
        let place = at * scale + drift;
        let here = textureSampleLevel(noise, repeat_sampler, place, lod).g;
        let east = textureSampleLevel(noise, repeat_sampler, place + vec2(apart, 0.0), lod).g;
        let south = textureSampleLevel(noise, repeat_sampler, place + vec2(0.0, apart), lod).g;
        slope += vec2(east - here, south - here);
    }
    let breath = textureSampleLevel(noise, repeat_sampler, at * 0.021 + time_s * 0.002, 0.0).r;
    return slope * (0.22 * smoothstep(0.35, 0.75, breath) + 0.03);
}

@fragment
fn fragment(in: Varyings) -> @location(0) vec4<f32> {
    let to_eye = frame.eye_m - in.world;
    let distance_m = length(to_eye);
    let view = to_eye / distance_m;
    let slope = ripples(in.world.xz, clamp(log2(distance_m * 0.12), 0.0, 6.0));
    let normal = normalize(vec3(-slope.x, 1.0, -slope.y));
    let facing = max(dot(normal, view), 0.0);
    let mirrored = WATER_F0 + (1.0 - WATER_F0) * pow(1.0 - facing, 5.0);

    // Light from under it, by the way that light goes down and back up.
    let depth = max(land.water_m - ground_height(in.world.xz), 0.0);
    let kept = exp(-WATER_EXTINCTION * depth * (1.0 / max(view.y, 0.25) + 1.0));
    let mottled = textureSample(noise, repeat_sampler, in.world.xz * 0.35).a;
    let grain = ground_grain(in.world.xz);
    let path = path_share(in.world.xz, distance_m);
    let shore = mix(soil_albedo(grain, -depth), gravel_albedo(grain, -depth), path);
    // Grains differ in depth: silt begins in a ragged line.
    let silt = smoothstep(SHORE_DEPTH_M, SILT_DEPTH_M, depth + 0.08 * grain.y);
    let bottom = mix(shore, WATER_BOTTOM * (0.6 + 0.8 * mottled), silt);
    let albedo = mix(WATER_DEEP, bottom, kept);
    let up = vec3(0.0, 1.0, 0.0);
    let sun = tree_shade(in.world).r * leaf_shadow(in.world);
    // The shore's share of the sky, as the ground beside it has it.
    let open = mix(mix(0.55, 0.95, path), 1.0, silt);
    let below = albedo * (frame.sun_color * (sun * max(frame.sun_direction.y, 0.0)) + ambient_light(up) * open);

    // A slope turns the mirrored ray by twice as much, which is as far in the picture, as that reaches twice its axes.
    let across = normalize(frame.right.xz);
    let along = vec2(across.y, -across.x);
    let shift = vec2(dot(slope, across) / length(frame.right), dot(slope, along) / length(frame.up));
    let place = (in.clip.xy * frame.inv_viewport_px + shift) / frame.tile_scale;
    let image = textureSampleLevel(mirror, clamp_sampler, place, 0.0).rgb;
    // The mirrored picture has its haze already.
    return vec4(mix(haze(below, in.world), image, mirrored), 1.0);
}
