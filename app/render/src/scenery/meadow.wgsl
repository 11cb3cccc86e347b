// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Colour of the meadow at a place: the ground plane and the blades on it agree.

#import frame/light

// Half width of the path in metres.
const PATH_HALF_WIDTH_M: f32 = 1.05;

// Distance of a place from the edge of the winding path, in metres; negative on it. `park/layout.rs` keeps trees off it.
fn beyond_path(at: vec2<f32>) -> f32 {
    let lead = frame.path_lead;
    let local = at - frame.park_center_m.xz;
    let along = dot(local, lead);
    let aside = dot(local, vec2(-lead.y, lead.x));
    let ragged = textureSampleLevel(noise, repeat_sampler, at * 0.23, 0.0).g - 0.5;
    return abs(aside - PATH_BEND_M * sin(along * PATH_BEND_RAD_M + frame.path_phase_rad)) - PATH_HALF_WIDTH_M + 0.35 * ragged;
}

// Share of paving in a pixel of some width in metres; none beyond its edge.
fn paved_share(at: vec2<f32>, pixel_m: f32) -> f32 {
    let beyond = abs(at - land.paved_center_m) - land.paved_half_m;
    let inside = -max(beyond.x, beyond.y);
    return select(0.0, smoothstep(0.0, max(pixel_m, 0.01), inside), land.paved_half_m.x > 0.0);
}

// Width of a row of paving stones, length of a stone and width of the joints between them, in metres.
const STONE_ROW_M: f32 = 0.40;
const STONE_M: f32 = 0.60;
const JOINT_WIDTH_M: f32 = 0.009;

// Albedo of paving in a pixel of some width in metres: rows of stones, each row half a stone on from the one before.
fn paving(at: vec2<f32>, pixel_m: f32) -> vec3<f32> {
    let row = floor(at.y / STONE_ROW_M);
    let along = at.x / STONE_M + 0.5 * row;
    let stone = floor(along);
    let key = hash_u32(bitcast<u32>(i32(row)) + hash_u32(bitcast<u32>(i32(stone - 0.5 * row))));
    // From the nearest joint.
    let away = vec2(STONE_M, STONE_ROW_M) * (0.5 - abs(vec2(along - stone, at.y / STONE_ROW_M - row) - 0.5));
    let soft = max(pixel_m, 0.004);
    let joint = (1.0 - smoothstep(0.0, 0.5 * (JOINT_WIDTH_M + soft), min(away.x, away.y))) * min(1.0, JOINT_WIDTH_M / soft);
    // Rain washes dust into shallow stains, and treads wear some stones smooth.
    let stain = textureSampleLevel(noise, repeat_sampler, at * 0.07 + 0.19, 0.0).r;
    let tint = mix(vec3(0.205, 0.195, 0.180), vec3(0.235, 0.205, 0.165), unit_from(hash_u32(key)));
    let tone = 0.84 + 0.32 * unit_from(key) + 0.7 * (stain - 0.5);
    return mix(tint * tone, vec3(0.070, 0.066, 0.052), 0.85 * joint);
}

// Grass albedo (rgb) and dryness (a) at a place on the ground.
fn meadow(at: vec2<f32>, lod: f32) -> vec4<f32> {
    let wide = textureSampleLevel(noise, repeat_sampler, at * 0.011, lod).r;
    let patches = textureSampleLevel(noise, repeat_sampler, at * 0.063 + 0.37, lod).g;
    // Knolls dry out, hollows stay moist.
    let hill = hills_at(at);
    let dry = clamp(0.28 + 1.3 * (wide - 0.5) + 1.2 * (patches - 0.5) - 0.35 * hill.w, 0.0, 1.0);
    let lush = vec3(0.066, 0.115, 0.028);
    let straw = vec3(0.205, 0.180, 0.076);
    // Clover and moss, darker than grass.
    let other = textureSampleLevel(noise, repeat_sampler, at * 0.17 + 0.71, max(lod - 1.0, 0.0)).g;
    let green = mix(lush, vec3(0.040, 0.085, 0.030), 0.8 * smoothstep(0.56, 0.70, other));
    return vec4(mix(green, straw, dry * 0.75) * (0.85 + 0.5 * (patches - 0.5)), dry);
}

// Fine and coarse grains and specks of bare ground at a place, about zero.
fn ground_grain(at: vec2<f32>) -> vec3<f32> {
    return vec3(
        textureSample(noise, repeat_sampler, at * 0.9).b,
        textureSample(noise, repeat_sampler, at * 0.17 + 0.2).a,
        textureSample(noise, repeat_sampler, at * 1.7 + 0.6).b,
    ) - 0.5;
}

// Albedo of bare soil of some grain at a height above the water: moist near it.
fn soil_albedo(grain: vec3<f32>, above_water_m: f32) -> vec3<f32> {
    let moist = 1.0 - smoothstep(-0.1, 0.5, above_water_m);
    return mix(vec3(0.105, 0.074, 0.046), vec3(0.048, 0.036, 0.025), moist)
        * (0.75 + dot(grain, vec3(0.9, 0.8, 0.5)));
}

// The same of the gravel of the path, which is wet only where water laps at it.
fn gravel_albedo(grain: vec3<f32>, above_water_m: f32) -> vec3<f32> {
    let wet = 1.0 - smoothstep(0.03, 0.15, above_water_m + 0.1 * grain.y);
    return mix(vec3(0.235, 0.185, 0.130), vec3(0.100, 0.076, 0.050), wet)
        * (0.82 + dot(grain, vec3(0.5, 0.5, 0.3)));
}

// Share of the path at a place, whose edge is as soft as grass or a pixel hides it.
fn path_share(at: vec2<f32>, distance_m: f32) -> f32 {
    let softness = 0.06 + 0.004 * distance_m;
    return 1.0 - smoothstep(-softness, softness + 0.1, beyond_path(at));
}

// Share of bare soil at a place on ground that lies at `height` in metres and rises by `rise`: steep slopes, some worn
// spots and the shore have it.
fn bare_soil(at: vec2<f32>, height: f32, rise: f32) -> f32 {
    let coarse = textureSampleLevel(noise, repeat_sampler, at * 0.09 + 0.13, 0.0).g - 0.5;
    let steep = smoothstep(0.50, 0.85, rise + 0.5 * coarse);
    let worn = 0.6 * smoothstep(0.36, 0.50, coarse);
    let shore = 1.0 - smoothstep(0.0, 0.20, height - land.water_m - 0.22 * coarse);
    return max(max(steep, worn), shore);
}
