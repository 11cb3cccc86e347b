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
    let frayed = textureSampleLevel(noise, repeat_sampler, at * 1.1, 0.0).r - 0.5;
    let middle = PATH_BEND_M * sin(along * PATH_BEND_RAD_M + frame.path_phase_rad);
    return abs(aside - middle) - PATH_HALF_WIDTH_M + 0.35 * ragged + 0.22 * frayed;
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

// Scale of the noise that tufts follow: tiles per metre.
const TUFT_TILES_PER_M: f32 = 0.27;

// Plants of the meadow at a place.
struct Sward {
    // Albedo of their blades.
    albedo: vec3<f32>,
    // Share of blades that are dry.
    dry: f32,
    // Height of blades relative to the mean of a mown lawn.
    height: f32,
    // Shares of clover and of moss among them.
    clover: f32,
    moss: f32,
    // Share of stalks that stand above the blades.
    stalks: f32,
}

// Width of the strip along the path that is mown short, in metres.
const MOWN_M: f32 = 0.8;

fn sward(at: vec2<f32>, lod: f32) -> Sward {
    let wide = textureSampleLevel(noise, repeat_sampler, at * 0.011, lod).r;
    let patches = textureSampleLevel(noise, repeat_sampler, at * 0.063 + 0.37, lod).g;
    let tufts = textureSampleLevel(noise, repeat_sampler, at * TUFT_TILES_PER_M, max(lod - 0.5, 0.0)).rg;
    let other = textureSampleLevel(noise, repeat_sampler, at * 0.19 + 0.71, max(lod - 1.0, 0.0)).rg;
    // Knolls dry out, hollows stay moist.
    let hill = hills_at(at);
    var out: Sward;
    out.dry = clamp(0.26 + 1.5 * (wide - 0.5) + 1.3 * (patches - 0.5) - 0.35 * hill.w, 0.0, 1.0);
    out.clover = 0.85 * smoothstep(0.62, 0.80, other.y + 0.3 * (tufts.y - 0.5));
    out.moss = smoothstep(0.62, 0.74, other.x + 0.2 * (tufts.y - 0.5) + 0.12 * hill.w) * (1.0 - out.clover);
    let mown = 1.0 - smoothstep(0.3 * MOWN_M, MOWN_M, beyond_path(at));
    let unmown = (1.0 - mown) * (1.0 - out.clover) * (1.0 - out.moss);
    out.height = mix(0.55, 2.1, smoothstep(0.36, 0.78, tufts.x)) * mix(0.8, 1.25, smoothstep(0.4, 0.65, patches));
    out.height = mix(out.height, 0.55, max(0.8 * mown, max(0.55 * out.clover, out.moss)));
    out.stalks = 0.035 * smoothstep(0.42, 0.70, patches + 0.3 * (tufts.y - 0.5)) * unmown;
    // Young grass after rain is yellower than the old in tufts, which goes to blue.
    let young = vec3(0.086, 0.130, 0.027);
    let old = vec3(0.050, 0.096, 0.032);
    let straw = vec3(0.210, 0.178, 0.078);
    var green = mix(young, old, smoothstep(0.35, 0.68, tufts.x));
    green = mix(green, vec3(0.048, 0.092, 0.030), 0.9 * out.clover);
    green = mix(green, vec3(0.105, 0.118, 0.022), 0.85 * out.moss);
    let dead = out.dry * (1.0 - 0.7 * out.clover) * (1.0 - 0.8 * out.moss) * (1.0 - 0.4 * mown);
    out.albedo = mix(green, straw, dead * 0.75) * (0.85 + 0.6 * (patches - 0.5) + 0.5 * (tufts.y - 0.5));
    return out;
}

// Distance in metres over which a tuft shades the grass behind it where the sun is low.
const TUFT_SHADE_M: f32 = 0.16;

// Sunlight that taller tufts towards the sun let through to the grass at a place, relative to the mean.
fn tuft_light(at: vec2<f32>) -> f32 {
    let toward = frame.sun_direction.xz;
    let here = textureSampleLevel(noise, repeat_sampler, at * TUFT_TILES_PER_M, 0.5).r;
    let before = textureSampleLevel(noise, repeat_sampler, (at + TUFT_SHADE_M * toward) * TUFT_TILES_PER_M, 0.5).r;
    return clamp(1.0 - 4.5 * (before - here), 0.25, 1.5);
}

// Fine and coarse grains and specks of bare ground at a place, about zero.
fn ground_grain(at: vec2<f32>) -> vec3<f32> {
    return vec3(
        textureSample(noise, repeat_sampler, at * 0.9).b,
        textureSample(noise, repeat_sampler, at * 0.17 + 0.2).a,
        textureSample(noise, repeat_sampler, at * 1.7 + 0.6).b,
    ) - 0.5;
}

// Light on grains of bare ground relative to that on smooth ground: they slope towards the sun or away from it.
fn grain_relief(at: vec2<f32>) -> f32 {
    let toward = frame.sun_direction.xz / max(frame.sun_direction.y, 0.25);
    let fine = textureSample(noise, repeat_sampler, at * 0.9).b - textureSample(noise, repeat_sampler, (at + 0.006 * toward) * 0.9).b;
    let coarse = textureSample(noise, repeat_sampler, at * 0.31).b - textureSample(noise, repeat_sampler, (at + 0.018 * toward) * 0.31).b;
    return clamp(1.0 + 2.6 * fine + 1.8 * coarse, 0.3, 1.9);
}

// Albedo of bare soil of some grain at a height above the water: moist near it.
fn soil_albedo(grain: vec3<f32>, above_water_m: f32) -> vec3<f32> {
    let moist = 1.0 - smoothstep(-0.1, 0.5, above_water_m);
    return mix(vec3(0.105, 0.074, 0.046), vec3(0.048, 0.036, 0.025), moist)
        * (0.75 + dot(grain, vec3(0.9, 0.8, 0.5)));
}

// Share of bare ground that is rock: what is too steep for soil.
fn rock_share(at: vec2<f32>, rise: f32) -> f32 {
    let coarse = textureSampleLevel(noise, repeat_sampler, at * 0.031 + 0.57, 0.0).r - 0.5;
    return smoothstep(0.66, 0.84, rise + 0.6 * coarse);
}

// Height of the blocks of rock, without scale.
fn rock_height(at: vec2<f32>) -> f32 {
    let blocks = textureSampleLevel(noise, repeat_sampler, at * 0.023, 0.0);
    return blocks.r + 0.5 * textureSampleLevel(noise, repeat_sampler, at * 0.071 + blocks.gb * 0.2, 0.0).g;
}

// Sunlight that the blocks of rock let through to a place.
fn rock_relief(at: vec2<f32>) -> f32 {
    let toward_sun = normalize(frame.sun_direction.xz + vec2(1.0e-5, 0.0));
    return clamp(1.0 + 4.5 * (rock_height(at) - rock_height(at + 0.9 * toward_sun)), 0.15, 1.5);
}

// Albedo of rock in beds that lie a little aslant, with lichen on it.
fn rock_albedo(world: vec3<f32>, grain: vec3<f32>) -> vec3<f32> {
    let height = world.y + 0.11 * world.x + 0.07 * world.z;
    let bed = textureSampleLevel(noise, repeat_sampler, vec2(height * 0.05, 0.004 * (world.x - world.z)), 0.0);
    let patches = textureSampleLevel(noise, repeat_sampler, world.xz * 0.05 + 0.3 * bed.rg, 0.0);
    let stone = mix(vec3(0.105, 0.098, 0.090), vec3(0.200, 0.190, 0.172), smoothstep(0.25, 0.75, bed.g));
    let lichen = smoothstep(0.52, 0.62, patches.b);
    return mix(stone, vec3(0.125, 0.128, 0.078), 0.7 * lichen) * mix(0.45, 1.0, smoothstep(0.2, 0.45, patches.r))
        * (0.8 + dot(grain, vec3(0.7, 0.6, 0.4)));
}

// The same of the gravel of the path, which is wet only where water laps at it.
fn gravel_albedo(grain: vec3<f32>, above_water_m: f32) -> vec3<f32> {
    let wet = 1.0 - smoothstep(0.03, 0.15, above_water_m + 0.1 * grain.y);
    return mix(vec3(0.235, 0.185, 0.130), vec3(0.100, 0.076, 0.050), wet)
        * (0.82 + dot(grain, vec3(0.5, 0.5, 0.3)));
}

// Edges in metres of the cells that hold a stone of the path each, coarse and fine ones.
const PEBBLE_M: vec2<f32> = vec2(0.041, 0.019);

// Stones of the path in a pixel of some width in metres: factor on the albedo (rgb), and on the sunlight (a).
fn pebbles(at: vec2<f32>, pixel_m: f32) -> vec4<f32> {
    let toward_sun = frame.sun_direction.xz / max(frame.sun_direction.y, 0.3);
    var out = vec4(1.0);
    for (var size = 0u; size < 2u; size++) {
        let seen = 1.0 - smoothstep(0.25, 0.9, pixel_m / PEBBLE_M[size]);
        // The finer grid is turned, so that no rows of either show.
        let turned = select(at, vec2(0.8 * at.x - 0.6 * at.y, 0.6 * at.x + 0.8 * at.y), size == 1u) / PEBBLE_M[size];
        let cell = floor(turned);
        let key = hash_u32(bitcast<u32>(i32(cell.x)) + hash_u32(bitcast<u32>(i32(cell.y)) + size));
        let radius = 0.16 + 0.30 * unit_from(key);
        let middle = radius + (1.0 - 2.0 * radius) * vec2(unit_from(hash_u32(key)), unit_from(hash_u32(key ^ 0x9du)));
        let away = (turned - cell - middle) / radius;
        let is_stone = (1.0 - smoothstep(0.75, 1.0, dot(away, away))) * seen;
        let sun = select(toward_sun, vec2(0.8 * toward_sun.x - 0.6 * toward_sun.y, 0.6 * toward_sun.x + 0.8 * toward_sun.y), size == 1u);
        // A stone's side towards the sun is bright, and what lies behind it in its shade.
        let behind = away + 0.7 * sun;
        let shade = (1.0 - smoothstep(0.5, 1.1, dot(behind, behind))) * (1.0 - is_stone) * seen;
        let tint = mix(vec3(0.62, 0.60, 0.60), vec3(1.45, 1.36, 1.22), unit_from(hash_u32(key ^ 0x51u)));
        out = mix(out, vec4(tint, clamp(1.0 + 0.55 * dot(away, sun), 0.25, 1.6)), is_stone);
        out.a *= 1.0 - 0.6 * shade;
    }
    return out;
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
    let steep = smoothstep(0.62, 0.92, rise + 0.6 * coarse);
    let worn = 0.6 * smoothstep(0.36, 0.50, coarse);
    let shore = 1.0 - smoothstep(0.0, 0.20, height - land.water_m - 0.22 * coarse);
    return max(max(steep, worn), shore);
}
