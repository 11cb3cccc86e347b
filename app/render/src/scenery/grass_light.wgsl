// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Blades of grass near the camera, each found and lit once: thinned out with distance.

#import frame/fire_light
#import scenery/meadow
#import scenery/structs

@group(2) @binding(0) var<uniform> class_of: GrassClass;
@group(2) @binding(1) var<storage, read> cells: array<GrassCell>;
@group(2) @binding(2) var<storage, read_write> blades: array<GrassBlade>;

// Height of a stalk relative to the mean blade, and width of a leaf of clover in metres.
const STALK: f32 = 3.6;
const CLOVER_WIDTH_M: f32 = 0.013;

// Part of the blades that still stand at a distance, if all do up to another; twin: `standing` of `grass_pass.rs`.
fn standing(distance_m: f32, dense_m: f32) -> f32 {
    let near = dense_m / max(distance_m, dense_m);
    return near * near * (1.0 - smoothstep(GRASS_SPARSE_M, GRASS_REACH_M, distance_m));
}

fn blade_of(cell: GrassCell, blade: u32) -> GrassBlade {
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
    let plants = sward(at, 0.0);
    let kind = unit_from(hash_u32(key ^ 51u));
    let is_stalk = kind < plants.stalks;
    let is_clover = !is_stalk && unit_from(hash_u32(key ^ 93u)) < plants.clover;
    let above = SWARD_M * select(1.0, STALK, is_stalk);
    let buried = 1.0 - smoothstep(0.05 * above, 0.35 * above, frame.snow_depth_m);
    if grown <= 0.02 || buried <= 0.0 {
        return GrassBlade(foot, 0u, 0u, 0u, 0u, 0u);
    }
    let tall = select(plants.height, STALK, is_stalk);
    let height = buried * SWARD_M * 1.45 * tall * mix(0.65, 1.35, unit_from(key_3)) * grown;
    // Wide enough to be seen: a pixel at least.
    let pixel = distance_m * length(frame.up) * 2.0 * frame.inv_viewport_px.y;
    let own_width = select(select(0.0045, CLOVER_WIDTH_M, is_clover), 0.0025, is_stalk);
    let width = max(own_width, pixel * 1.15) * (1.0 + 0.5 * smoothstep(8.0, 25.0, distance_m));
    let heading = unit_from(hash_u32(key_3)) * 6.2831853;
    let lean = vec2(cos(heading), sin(heading));
    let sway = 0.12 * sin(frame.time_s * GRASS_RAD_S + at.x * 0.9 + at.y * 0.7 + heading);
    let bend = height * (select(0.65, 0.22, is_stalk) + sway) * mix(0.5, 1.3, unit_from(key_2));
    let tip = foot + vec3(lean.x * bend, height, lean.y * bend);

    let shade = tree_shade(foot);
    let own = unit_from(hash_u32(key ^ 77u));
    var albedo = plants.albedo * mix(0.75, 1.35, own);
    // Some blades are dry.
    albedo = mix(albedo, vec3(0.34, 0.27, 0.11), step(0.88 - 0.25 * plants.dry, own) * select(0.7, 0.1, is_clover));
    albedo = select(albedo, vec3(0.30, 0.235, 0.115) * mix(0.7, 1.2, own), is_stalk);
    // Water runs off blades; the dead ones among them soak.
    albedo = wet_reflectance(albedo, 0.5 * wetness(at));
    let light = frame.sun_direction;
    let view = to_eye / distance_m;
    let normal = normalize(vec3(lean.x - hill.y, 0.9, lean.y - hill.z));
    let reflected = 0.25 + 0.75 * max(dot(normal, light), 0.0);
    let against = pow(max(dot(-view, light), 0.0), 2.0);
    let glow = albedo * vec3(1.12, 1.25, 0.45) * against * 1.1;
    // Roots are dark, but far away they are as bright as the ground that stands for grass there.
    let root = mix(0.30 / (0.5 + 0.5 * plants.height), 0.95, smoothstep(7.0, 20.0, distance_m));
    let in_sun = frame.sun_color * (albedo * reflected * 0.72 + glow);
    let ambient = albedo * ambient_light(vec3(0.0, 1.0, 0.0))
        * min(sky_openness(foot), mix(0.35, 1.0, open_above(foot, SKY_TAPS))) * open_beside(foot);
    let fire = albedo * fire_light(foot, normal);
    let lift = vec3(0.0, 0.005, 0.0);
    let free = shade.r * tuft_light(at);
    let low_lit = free * leaf_shadow(foot + lift);
    let high_lit = mix(shade.r, free, 0.7) * leaf_shadow(tip + lift);
    // A sheen of the sky on the bend.
    let sheen = frame.sky_horizon * 0.02 * high_lit;
    let low = haze(in_sun * low_lit * root + ambient * 0.35 + fire * root, foot);
    let high = haze(in_sun * high_lit + ambient + fire + sheen, tip);
    return GrassBlade(
        foot,
        pack2x16float(vec2(width, height)),
        pack2x16float(lean * bend),
        pack2x16float(low.rg),
        pack2x16float(vec2(low.b, high.r)),
        pack2x16float(high.gb),
    );
}

@compute @workgroup_size(GRASS_GROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x < class_of.blade_count {
        blades[class_of.first_blade + id.y * class_of.blade_count + id.x] = blade_of(cells[class_of.first_cell + id.y], id.x);
    }
}
