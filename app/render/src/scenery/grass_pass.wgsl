// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Blades of grass near the camera: one triangle each, thinned out with distance.

#import frame/fire_light
#import scenery/meadow
#import scenery/structs

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    @location(0) @interpolate(perspective, centroid) color: vec3<f32>,
}

// Part of the blades that still stand at a distance, if all do up to another; twin: `standing` of `grass_pass.rs`.
fn standing(distance_m: f32, dense_m: f32) -> f32 {
    let near = dense_m / max(distance_m, dense_m);
    return near * near * (1.0 - smoothstep(GRASS_SPARSE_M, GRASS_REACH_M, distance_m));
}

@vertex
fn vertex(
    @builtin(vertex_index) index: u32,
    cell: GrassCell,
) -> Varyings {
    let blade = index / 3u;
    let corner = index % 3u;
    let cell_key = hash_u32(bitcast<u32>(i32(cell.corner_m.x)) + hash_u32(bitcast<u32>(i32(cell.corner_m.y))));
    let key = hash_u32(cell_key ^ (blade * 2654435769u));
    let key_2 = hash_u32(key);
    let key_3 = hash_u32(key_2);
    let at = cell.corner_m + GRASS_CELL_M * vec2(unit_from(key), unit_from(key_2));
    let hill = hills_at(at);
    let foot = vec3(at.x, land.base_m + hill.x - ground_depth(), at.y);
    let to_eye = frame.eye_m - foot;
    let distance_m = length(to_eye);

    // The rank of a blade is its number: fewer stand farther away, and the last ones shrink before they vanish.
    let rank = f32(blade) / cell.blades;
    let kept = standing(distance_m, cell.dense_m);
    let verge = smoothstep(-0.1, 0.2, beyond_path(at) - 0.25 * (unit_from(key_3) - 0.5)) * (1.0 - paved_share(at, 0.04));
    let grown = smoothstep(rank, rank * 1.25 + 0.002, kept) * verge
        * (1.0 - smoothstep(0.3, 0.6, bare_soil(at, foot.y, length(hill.yz)) + 0.2 * (unit_from(key_3) - 0.5)));
    let tall = 0.6 + 0.8 * textureSampleLevel(noise, repeat_sampler, at * 0.31, 0.0).g;
    let buried = 1.0 - smoothstep(0.05 * SWARD_M, 0.35 * SWARD_M, frame.snow_depth_m);
    let height = buried * SWARD_M * 1.45 * tall * mix(0.65, 1.35, unit_from(key_3)) * grown;
    // Wide enough to be seen: a pixel at least.
    let pixel = distance_m * length(frame.up) * 2.0 * frame.inv_viewport_px.y;
    let width = max(0.0045, pixel * 1.15) * (1.0 + 0.5 * smoothstep(8.0, 25.0, distance_m));
    let heading = unit_from(hash_u32(key_3)) * 6.2831853;
    let lean = vec2(cos(heading), sin(heading));
    let sway = 0.12 * sin(frame.time_s * GRASS_RAD_S + at.x * 0.9 + at.y * 0.7 + heading);
    let side = normalize(cross(vec3(0.0, 1.0, 0.0), to_eye));

    var world = foot;
    var rise = 0.0;
    if corner == 2u {
        let bend = height * (0.65 + sway) * mix(0.5, 1.3, unit_from(key_2));
        world += vec3(lean.x * bend, height, lean.y * bend);
        rise = 1.0;
    } else {
        world += side * (width * select(-0.5, 0.5, corner == 0u));
    }

    let shade = tree_shade(foot);
    let sun = shade.r * leaf_shadow(world + vec3(0.0, 0.005, 0.0));
    let ground = meadow(at, 0.0);
    let own = unit_from(hash_u32(key ^ 77u));
    var albedo = ground.rgb * mix(0.75, 1.35, own);
    // Some blades are dry.
    albedo = mix(albedo, vec3(0.34, 0.27, 0.11), step(0.86 - 0.25 * ground.a, own) * 0.7);
    // Water runs off blades; the dead ones among them soak.
    albedo = wet_reflectance(albedo, 0.5 * wetness(at));
    let light = frame.sun_direction;
    let view = to_eye / distance_m;
    let normal = normalize(vec3(lean.x - hill.y, 0.9, lean.y - hill.z));
    let reflected = 0.25 + 0.75 * max(dot(normal, light), 0.0);
    let against = pow(max(dot(-view, light), 0.0), 2.0);
    let glow = albedo * vec3(1.12, 1.25, 0.45) * against * 1.1;
    // Roots are dark, but far away they are as bright as the ground that stands for grass there.
    let depth = mix(mix(0.30, 0.95, smoothstep(7.0, 20.0, distance_m)), 1.0, rise);
    var color = frame.sun_color * sun * (albedo * reflected * 0.72 + glow) * depth;
    color += albedo * ambient_light(vec3(0.0, 1.0, 0.0)) * mix(0.35, 1.0, rise)
        * min(sky_openness(foot), mix(0.35, 1.0, open_above(foot, SKY_TAPS))) * open_beside(foot);
    color += albedo * fire_light(world, normal) * depth;
    // A sheen of the sky on the bend.
    color += frame.sky_horizon * 0.02 * rise * sun;

    var out: Varyings;
    out.clip = frame.view_projection * vec4(world, 1.0);
    if grown * buried <= 0.02 {
        out.clip = vec4(0.0, 0.0, -1.0, 1.0);
    }
    out.color = haze(color, world);
    return out;
}

@fragment
fn fragment(in: Varyings) -> @location(0) vec4<f32> {
    return vec4(in.color, 1.0);
}
