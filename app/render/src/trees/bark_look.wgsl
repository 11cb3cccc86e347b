// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Bark as limbs and twigs share it: where a point of it is drawn, and what lies on it.

#import frame/fire_light
#import frame/light
#import trees/records
#import trees/bark_shape

@group(2) @binding(4) var barks: texture_2d_array<f32>;
@group(2) @binding(5) var bark_sampler: sampler;
@group(2) @binding(6) var<storage, read> tree_records: array<TreeRecord>;
@group(2) @binding(7) var<storage, read> bed_words: array<u32>;

// Metres of depth per kg/m² of snow: set by eye.
const SNOW_M_PER_KG_M2: f32 = 0.011;

// Depth in metres of the snow on the segments that a point of the bark goes with.
fn branch_snow_m(vertex: BarkVertex) -> f32 {
    if frame.branch_snow_word == 0u {
        return 0.0;
    }
    var depth_m = 0.0;
    for (var slot = 0u; slot < 4u; slot++) {
        let row = vertex.rows[slot];
        let held_kg = f32(bed_words[frame.branch_snow_word + row]) * SNOW_UNIT_KG;
        depth_m += vertex.shares[slot] * held_kg / max(rest_base[row].w, 1.0e-4);
    }
    return depth_m * SNOW_M_PER_KG_M2 / max(dot(vertex.shares, vec4(1.0)), 1.0e-6);
}

// A point of the bark as it is drawn.
struct DrawnBark {
    world: vec3<f32>,
    normal: vec3<f32>,
    // Share of a pixel that the limb covers.
    share: f32,
    // Depth in metres of the snow on it.
    snow_m: f32,
    // Height at rest above the ground in metres.
    height_m: f32,
}

fn drawn_bark(bark: BarkVertex, tree: TreeRecord) -> DrawnBark {
    let point = bark_point(bark);
    let radius = bark.radius_m;
    // A twig thinner than a pixel is drawn a pixel wide, and as faint as it is thin.
    let pixel = distance(frame.eye_m, point.world) * length(frame.up) * 2.0 * frame.inv_viewport_px.y;
    let least = tree.twig_px * pixel;
    var out: DrawnBark;
    out.world = point.world + point.normal * max(least - radius, 0.0);
    // Snow lies on the upper side, no thicker than a thin twig bears.
    out.snow_m = branch_snow_m(bark);
    out.world.y += min(out.snow_m, 0.004 + 2.0 * radius) * smoothstep(0.0, 0.7, point.normal.y);
    out.normal = point.normal;
    out.share = min(radius / least, 1.0);
    out.height_m = bark.position_m.y - frame.park_center_m.y;
    return out;
}

// Share of old bark, which cracks, on a limb of some radius; twigs are smooth and have their own colour.
fn old_share(kind: u32, radius_m: f32) -> f32 {
    return smoothstep(0.006, select(0.05, 0.035, kind == 1u), radius_m);
}

// Colour of this year's twigs.
fn twig_color(kind: u32) -> vec3<f32> {
    switch kind {
        case 1u: { return vec3(0.085, 0.040, 0.030); }
        case 2u: { return vec3(0.095, 0.078, 0.052); }
        case 3u: { return vec3(0.110, 0.075, 0.038); }
        case 4u: { return vec3(0.120, 0.150, 0.040); }
        default: { return vec3(0.110, 0.068, 0.040); }
    }
}

// Colour of bark of some albedo to which algae have grown near the ground, on the side away from the sun; `high` of 1 on ridges.
fn algae(albedo: vec3<f32>, normal: vec3<f32>, height_m: f32, radius_m: f32, high: f32) -> vec3<f32> {
    let dull = smoothstep(1.3, 0.0, height_m) * smoothstep(0.03, 0.12, radius_m);
    let away = 0.5 - 0.5 * dot(normal.xz, frame.sun_direction.xz);
    return mix(albedo, albedo * 0.55 + vec3(0.012, 0.022, 0.004), dull * (0.25 + 0.6 * away) * (1.2 - high));
}

// Colour of old bark of some albedo on which lichen grows in crusts, grey ones and a few yellow, and moss at the foot on the side away from the sun;
// `spots` is noise about one half, `high` of 1 on ridges.
fn overgrown(albedo: vec3<f32>, normal: vec3<f32>, height_m: f32, old: f32, spots: vec4<f32>, high: f32) -> vec3<f32> {
    let crust = smoothstep(0.58, 0.66, spots.r + 0.16 * (spots.b - 0.5)) * (0.35 + 0.65 * high);
    let yellow = smoothstep(0.60, 0.66, spots.g);
    let lichen = mix(vec3(0.235, 0.245, 0.195), vec3(0.300, 0.225, 0.045), yellow);
    let crusted = mix(albedo, lichen * (0.75 + 0.5 * spots.a), 0.62 * crust * old);
    let away = 0.5 - 0.5 * dot(normal.xz, frame.sun_direction.xz);
    let foot = smoothstep(0.75, 0.0, height_m + 1.1 * (spots.g - 0.5)) * smoothstep(0.25, 0.75, away + 0.4 * (spots.r - 0.5));
    return mix(crusted, vec3(0.040, 0.056, 0.012) * (0.6 + 0.8 * spots.b), 0.75 * foot * old);
}

// Share of a place that snow covers, thin snow what is level first; `spread` about 1.
fn snow_on_bark(normal: vec3<f32>, snow_m: f32, spread: f32) -> f32 {
    let covers = snow_m * spread;
    return smoothstep(0.0, 0.2, normal.y - mix(0.95, 0.1, smoothstep(0.0005, 0.012, covers))) * f32(snow_m > 0.0);
}

// Surface of bark to be lit.
struct BarkSurface {
    world: vec3<f32>,
    // Of the limb, and with its grooves.
    smooth_normal: vec3<f32>,
    normal: vec3<f32>,
    radius_m: f32,
    height_m: f32,
    albedo: vec3<f32>,
    // Share of the sky that grooves see, 1 on ridges; the same of the sun.
    deep: f32,
    sunlit: f32,
    // Part of the sky that the crown leaves open, and samples of what else hides it.
    open: f32,
    sky_taps: u32,
}

fn lit_bark(bark: BarkSurface) -> vec3<f32> {
    let to_eye = normalize(frame.eye_m - bark.world);
    let light = frame.sun_direction;
    let facing = dot(bark.normal, light);
    let shade = tree_shade(bark.world);
    let sun = frame.sun_color * shade.r * leaf_shadow(bark.world + bark.smooth_normal * 0.02 + light * 0.03);
    // Rough wood looks lit a little beyond the edge of the light.
    let lit = clamp((facing + 0.08) / 1.08, 0.0, 1.0) * mix(0.6, 1.0, bark.sunlit);
    // Grass hides the sky from the foot.
    let foot = mix(0.45, 1.0, smoothstep(-0.02, 0.35, bark.height_m));
    // Beside a trunk the sky is open to the sides; what grows out of it above is none of its shade.
    let around = bark.world + bark.smooth_normal * (bark.radius_m + 0.3);
    let open = min(bark.open, mix(0.5, 1.0, open_above(around, bark.sky_taps))) * bark.deep * foot;
    let wet = 0.85 * land.wet;
    let albedo = wet_reflectance(bark.albedo, wet);
    var color = sun * albedo * lit;
    color += albedo * (ambient_light(bark.normal) * open + fire_light(bark.world, bark.normal));
    let half_way = normalize(light + to_eye);
    color += sun * (0.012 + 0.03 * wet) * pow(max(dot(bark.normal, half_way), 0.0), 12.0) * max(facing, 0.0);
    // Bark is dull, but at a grazing view it mirrors the sky.
    let fresnel = 0.03 + (0.35 + 0.25 * wet) * pow(1.0 - clamp(dot(bark.normal, to_eye), 0.0, 1.0), 5.0);
    color += sky_reflection(reflect(-to_eye, bark.normal), 0.8) * fresnel * open;
    return haze(color, bark.world);
}
