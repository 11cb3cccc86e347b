// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Sun, sky and haze.

#import frame/common

@group(1) @binding(0) var shadow_maps: texture_depth_2d_array;
@group(1) @binding(1) var shadow_sampler: sampler_comparison;
// Top view of the park: sunlight let through by the trees (r), litter under them (g), sky hidden by their crowns (b).
@group(1) @binding(2) var shade_map: texture_2d<f32>;
@group(1) @binding(3) var clamp_sampler: sampler;
@group(1) @binding(4) var noise: texture_2d<f32>;
@group(1) @binding(5) var repeat_sampler: sampler;
// Top view of the rectangle on which snow lies: ground that melted snow has soaked, and leaves that hang under snow.
@group(1) @binding(6) var snow_map: texture_2d<f32>;
// Radiance by latitude and longitude.
@group(1) @binding(7) var sky_map: texture_2d<f32>;
@group(1) @binding(8) var sky_sampler: sampler;
// The sky without its sun as surfaces mirror it, rougher from level to level.
@group(1) @binding(9) var mirrored_sky: texture_2d<f32>;

// Mean share of sunlight that reaches the air between the eye and a place, by the place in the view and the distance.
@group(1) @binding(11) var sunlit_air: texture_3d<f32>;

// Sunlight that reaches a place past what one shadow map holds: four taps that are turned from place to place.
fn map_shadow(map: u32, clip: vec3<f32>, turn: vec2<f32>) -> f32 {
    let uv = clip.xy * vec2(0.5, -0.5) + 0.5;
    if SHADOW_TAPS == 1u {
        return textureSampleCompareLevel(shadow_maps, shadow_sampler, uv, map, clip.z);
    }
    // Near maps are finer: their edges are as soft in metres only with wider taps.
    let reach = select(select(1.0, 1.3, map == 1u), 2.0, map == 0u) / f32(textureDimensions(shadow_maps).x);
    let one = turn * reach;
    let two = vec2(-one.y, one.x) * 0.55;
    var sum = textureSampleCompareLevel(shadow_maps, shadow_sampler, uv + one, map, clip.z);
    sum += textureSampleCompareLevel(shadow_maps, shadow_sampler, uv - one, map, clip.z);
    if SHADOW_TAPS == 2u {
        return sum * 0.5;
    }
    sum += textureSampleCompareLevel(shadow_maps, shadow_sampler, uv + two, map, clip.z);
    sum += textureSampleCompareLevel(shadow_maps, shadow_sampler, uv - two, map, clip.z);
    return sum * 0.25;
}

// Place in a shadow map. A texel is wide: what lies in it must not shade itself.
fn map_place(map: u32, position: vec3<f32>) -> vec3<f32> {
    let lifted = position + frame.sun_direction * (1.5 * frame.texels_m[map]);
    return (frame.shadows[map] * vec4(lifted, 1.0)).xyz;
}

// Share of a full turn by which a place turns the samples around it, at random for cells of four millimetres: a wave would make rings with the pixels.
fn own_turn(position: vec3<f32>) -> f32 {
    let cell = bitcast<vec3<u32>>(vec3<i32>(floor(position * 250.0)));
    return unit_from(hash_u32(cell.x + hash_u32(cell.y + hash_u32(cell.z))));
}

// Sunlight that leaves and trees in the shadow maps let through to `position`, 0 to 1: by the finest map that holds it.
// Towards the edge of a map more and more places are left to the next one, so that one map is read for each.
fn leaf_shadow(position: vec3<f32>) -> f32 {
    let own = own_turn(position);
    let spin = own * 6.2831853;
    let limit = mix(0.86, 0.985, fract(own * 61.7));
    var map = CASCADES;
    var place = vec3(0.0);
    for (var coarser = CASCADES; coarser > FIRST_MAP; coarser--) {
        let clip = map_place(coarser - 1u, position);
        if max(abs(clip.x), abs(clip.y)) < limit && clip.z > 0.0 && clip.z < 1.0 {
            map = coarser - 1u;
            place = clip;
        }
    }
    let lit = map_shadow(min(map, CASCADES - 1u), place, vec2(cos(spin), sin(spin)));
    return select(1.0, lit, map < CASCADES);
}

// Sunlight that far trees and hills let through (r) and litter density (g) where the sun ray through `position` meets the ground.
fn tree_shade(position: vec3<f32>) -> vec2<f32> {
    let height = position.y - ground_height(position.xz);
    let down = frame.sun_direction.xz * (height / max(frame.sun_direction.y, 0.02));
    let offset = (position.xz - down - frame.park_center_m.xz) / PARK_RADIUS_M;
    let uv = offset * 0.5 + 0.5;
    let shade = textureSampleLevel(shade_map, clamp_sampler, uv, 0.0).rg;
    // Trees are as high as they are: far above them the sun is free again.
    let free = max(smoothstep(2.0, 14.0, height), smoothstep(0.9, 1.0, max(abs(offset.x), abs(offset.y))));
    return vec2(mix(shade.r, 1.0, free) * hill_light(position), shade.g);
}

// Part of the sky that crowns leave open above a place on the ground.
fn sky_openness(position: vec3<f32>) -> f32 {
    let uv = (position.xz - frame.park_center_m.xz) / PARK_RADIUS_M * 0.5 + 0.5;
    return 1.0 - 0.75 * textureSampleLevel(shade_map, clamp_sampler, uv, 0.0).b;
}

// Share to which a place on the ground is wet, by rain or by melted snow that has soaked it; beyond the rectangle of snow as at its edge.
fn wetness(at: vec2<f32>) -> f32 {
    if !HAS_SNOW {
        return land.wet;
    }
    let melted = textureSampleLevel(snow_map, clamp_sampler, (at - frame.snow_corner_m) * frame.snow_per_m, 0.0).r;
    return max(land.wet, melted);
}

// Share of rain that stays on leaves which hang or fly.
const HANGING_WET: f32 = 0.7;

// Share to which a leaf is wet at a place, as far as it has come to rest: melted snow soaks what lies, rain wets all.
fn leaf_wetness(at: vec2<f32>, settled: f32) -> f32 {
    return max(wetness(at) * settled, HANGING_WET * land.wet);
}

// Share to which snow covers leaves that hang above a place on the ground.
fn snow_on_leaves(at: vec2<f32>) -> f32 {
    if !HAS_SNOW {
        return 0.0;
    }
    return textureSampleLevel(snow_map, clamp_sampler, (at - frame.snow_corner_m) * frame.snow_per_m, 0.0).g;
}

// Share of the light from within a wet matt surface that its film of water mirrors back into it.
const FILM: f32 = 0.45;

// Reflectance of a matt surface of which a share is wet: light goes back and forth beneath the film (Lekner and Dorf, 1988).
fn wet_reflectance(dry: vec3<f32>, wet: f32) -> vec3<f32> {
    let back = FILM * wet;
    return dry * (1.0 - back) / (1.0 - back * dry);
}

// Light of the sky and the sun's glint that a film of water mirrors on a surface that is wet to some share. The film is as smooth as `roughness` has it.
fn film_light(normal: vec3<f32>, to_eye: vec3<f32>, sun: vec3<f32>, wet: f32, roughness: f32) -> vec3<f32> {
    let slant = 1.0 - clamp(dot(normal, to_eye), 0.0, 1.0);
    let fresnel = 0.02 + 0.98 * (slant * slant) * (slant * slant) * slant;
    let half_way = normalize(frame.sun_direction + to_eye);
    let shine = 2.0 / (roughness * roughness * roughness * roughness);
    let glint = sun * (0.004 * min(shine, 2000.0)) * pow(max(dot(normal, half_way), 0.0), shine);
    return wet * (fresnel * sky_reflection(reflect(-to_eye, normal), roughness) + glint);
}

// Radius around a place within which the sky is sampled, in metres.
const SKY_REACH_M: f32 = 2.4;

// Part of the sky overhead that the scene's own trees, their leaves and its objects leave open, by looks straight up from around a place,
// as far out as leaves of a middling crown are above it; `taps` of 0 see all of it.
fn open_above(position: vec3<f32>, taps: u32) -> f32 {
    if !HAS_ROOF {
        return 1.0;
    }
    let clip = (frame.shadows[CASCADES] * vec4(position + vec3(0.0, 0.12, 0.0), 1.0)).xyz;
    let own = own_turn(position);
    let scale = SKY_REACH_M / (frame.texels_m[CASCADES] * f32(textureDimensions(shadow_maps).x));
    var sum = 0.0;
    for (var tap = 0u; tap < taps; tap++) {
        let reach = scale * sqrt((f32(tap) + 0.5) / f32(taps));
        let angle = 2.3999632 * f32(tap) + 6.2831853 * own;
        let uv = clip.xy * vec2(0.5, -0.5) + 0.5 + reach * vec2(cos(angle), sin(angle));
        sum += textureSampleCompareLevel(shadow_maps, shadow_sampler, uv, CASCADES, clip.z);
    }
    let beyond = select(0.0, 1.0, taps == 0u || clip.z > 1.0);
    let far = max(smoothstep(0.8, 0.98, max(abs(clip.x), abs(clip.y))), beyond);
    return mix(sum / max(f32(taps), 1.0), 1.0, far);
}

// Radius around the foot of an object within which it hides the sky from the ground, in metres, and number of samples.
const FOOT_REACH_M: f32 = 0.32;
const FOOT_TAPS: u32 = 5u;

// Part of the sky that things which stand close by leave open above a place on the ground.
fn open_beside(position: vec3<f32>) -> f32 {
    if !HAS_OBJECTS {
        return 1.0;
    }
    let clip = (frame.shadows[CASCADES] * vec4(position + vec3(0.0, 0.08, 0.0), 1.0)).xyz;
    let own = own_turn(position);
    let scale = FOOT_REACH_M / (frame.texels_m[CASCADES] * f32(textureDimensions(shadow_maps).x));
    var sum = 0.0;
    for (var tap = 0u; tap < FOOT_TAPS; tap++) {
        let reach = scale * sqrt((f32(tap) + 0.5) / f32(FOOT_TAPS));
        let angle = 2.3999632 * f32(tap) + 6.2831853 * own;
        let uv = clip.xy * vec2(0.5, -0.5) + 0.5 + reach * vec2(cos(angle), sin(angle));
        sum += textureSampleCompareLevel(shadow_maps, shadow_sampler, uv, CASCADES, clip.z);
    }
    let far = smoothstep(0.8, 0.98, max(abs(clip.x), abs(clip.y)));
    return mix(0.45, 1.0, mix(sum / f32(FOOT_TAPS), 1.0, far));
}

struct Ambient {
    front: vec3<f32>,
    back: vec3<f32>,
}

// Light of the whole sky and the ground on both sides of a white matt sheet facing `n`, of unit length.
fn ambient_light_on(n: vec3<f32>) -> Ambient {
    let odd = 0.488603 * (n.y * frame.ambient[1].rgb + n.z * frame.ambient[2].rgb + n.x * frame.ambient[3].rgb);
    var even = 0.282095 * frame.ambient[0].rgb;
    even += 1.092548 * (n.x * n.y * frame.ambient[4].rgb + n.y * n.z * frame.ambient[5].rgb + n.x * n.z * frame.ambient[7].rgb);
    even += 0.315392 * (3.0 * n.z * n.z - 1.0) * frame.ambient[6].rgb;
    even += 0.546274 * (n.x * n.x - n.y * n.y) * frame.ambient[8].rgb;
    return Ambient(max(even + odd, vec3(0.0)), max(even - odd, vec3(0.0)));
}

// The same on the side that faces `n`.
fn ambient_light(n: vec3<f32>) -> vec3<f32> {
    return ambient_light_on(n).front;
}

// Place of a direction in a map by latitude and longitude.
fn sky_place(direction: vec3<f32>) -> vec2<f32> {
    let turn = atan2(direction.z, direction.x) * 0.15915494 + 0.75;
    return vec2(turn, acos(clamp(direction.y, -1.0, 1.0)) * 0.31830989);
}

// Radiance of the sky that a surface of a roughness from 0.1 to 1 mirrors along a direction.
fn sky_reflection(direction: vec3<f32>, roughness: f32) -> vec3<f32> {
    let level = (roughness - LEAST_ROUGHNESS) / ROUGHNESS_STEP;
    return textureSampleLevel(mirrored_sky, sky_sampler, sky_place(direction), level).rgb;
}

// Radiance of the sky in a direction, as if clouds were spread evenly.
fn sky_radiance(direction: vec3<f32>) -> vec3<f32> {
    return textureSampleLevel(sky_map, sky_sampler, sky_place(direction), 0.0).rgb;
}

// Asymmetry of the light that haze scatters: most goes on ahead.
const HAZE_ASYMMETRY: f32 = 0.70;

// Share of direct sunlight in the light of haze that is seen in a direction: the sun's by its phase function (Henyey and Greenstein,
// 1941), that of the sky from all around.
fn direct_share(direction: vec3<f32>) -> vec3<f32> {
    let g = HAZE_ASYMMETRY;
    let base = 1.0 + g * g - 2.0 * g * dot(direction, frame.sun_direction);
    let direct = frame.sun_color * ((1.0 - g * g) / (4.0 * base * sqrt(base)));
    return direct / (direct + 0.282095 * frame.ambient[0].rgb + 1.0e-6);
}

// Share of haze's light that trees and hills leave to the first `SHAFT_REACH_M` metres of a ray from the eye, or to all of it.
fn shaft_light(ray: vec3<f32>, distance_m: f32) -> vec3<f32> {
    if !HAS_SHAFTS {
        return vec3(1.0);
    }
    let ahead = max(dot(ray, frame.forward), 1.0e-3);
    let place = vec2(dot(ray, frame.right) / dot(frame.right, frame.right), dot(ray, frame.up) / dot(frame.up, frame.up)) / ahead;
    let slice = sqrt(min(distance_m / SHAFT_REACH_M, 1.0));
    let sunlit = textureSampleLevel(sunlit_air, clamp_sampler, vec3(place * vec2(0.5, -0.5) + 0.5, slice), 0.0).r;
    return 1.0 - direct_share(ray / max(distance_m, 1.0e-4)) * (frame.shaft_share * (1.0 - sunlit));
}

// The air between the eye and a surface at `position`: light that it adds (rgb) and share that it lets through (a). It is
// as bright as the sky above the horizon, since that is what haze without end looks like.
fn air_before(position: vec3<f32>) -> vec4<f32> {
    let ray = position - frame.eye_m;
    let distance_m = length(ray);
    let direction = ray / max(distance_m, 1.0e-4);
    // Haze thins with height: its mean density along the ray.
    let low = max(frame.eye_m.y - frame.park_center_m.y, 0.0) * frame.inv_haze_depth_m;
    let high = max(position.y - frame.park_center_m.y, 0.0) * frame.inv_haze_depth_m;
    let span = high - low;
    let mean = select((exp(-low) - exp(-high)) / span, exp(-low), abs(span) < 1.0e-3);
    let veil = 1.0 - exp(-distance_m * frame.haze_per_m * mean);
    let level = normalize(vec3(direction.x, max(direction.y, 0.0) * 0.4 + 0.05, direction.z));
    let near_veil = 1.0 - exp(-min(distance_m, SHAFT_REACH_M) * frame.haze_per_m * mean);
    let glow = near_veil * shaft_light(ray, distance_m) + (veil - near_veil);
    return vec4(glow * sky_reflection(level, LEAST_ROUGHNESS), 1.0 - veil);
}

// Light from a surface at `position` as it reaches the eye.
fn haze(color: vec3<f32>, position: vec3<f32>) -> vec3<f32> {
    let air = air_before(position);
    return color * air.a + air.rgb;
}
