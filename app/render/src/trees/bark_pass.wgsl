// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Trunks, limbs and twigs.

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

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    @location(0) @interpolate(perspective, centroid) world: vec3<f32>,
    @location(1) @interpolate(perspective, centroid) normal: vec3<f32>,
    @location(2) @interpolate(perspective, centroid) uv: vec2<f32>,
    // Radius of the limb in metres, share of a pixel that it covers, open sky, height at rest.
    @location(3) @interpolate(perspective, centroid) limb: vec4<f32>,
    @location(4) @interpolate(flat) kind: u32,
    // Random number of the tree.
    @location(5) @interpolate(flat) own: f32,
    // Depth in metres of the snow on it.
    @location(6) @interpolate(perspective, centroid) snow_m: f32,
}

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

@vertex
fn vertex(bark: BarkVertex, @builtin(instance_index) record: u32) -> Varyings {
    let tree = tree_records[record];
    let point = bark_point(bark);
    let radius = bark.radius_m;
    // A twig thinner than a pixel is drawn a pixel wide, and as faint as it is thin.
    let pixel = distance(frame.eye_m, point.world) * length(frame.up) * 2.0 * frame.inv_viewport_px.y;
    let least = tree.twig_px * pixel;
    var out: Varyings;
    out.world = point.world + point.normal * max(least - radius, 0.0);
    // Snow lies on the upper side, no thicker than a thin twig bears.
    out.snow_m = branch_snow_m(bark);
    out.world.y += min(out.snow_m, 0.004 + 2.0 * radius) * smoothstep(0.0, 0.7, point.normal.y);
    out.clip = frame.view_projection * vec4(out.world, 1.0);
    out.normal = point.normal;
    out.uv = bark.uv;
    let height = bark.position_m.y - frame.park_center_m.y;
    out.limb = vec4(radius, min(radius / least, 1.0), crown_openness(tree, point.world).w, height);
    out.kind = tree.bark_kind;
    out.own = tree.own;
    return out;
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

@fragment
fn fragment(in: Varyings) -> @location(0) vec4<f32> {
    let kind = in.kind;
    // Every tree begins elsewhere on its bark.
    let uv = in.uv + in.own * vec2(3.7, 11.3);
    // Two looks at the tile, the second taller and elsewhere, take turns along the limb: no repeat shows.
    let other_uv = vec2(uv.x + 0.37, uv.y * 0.61 + 0.19);
    let choice = textureSample(noise, repeat_sampler, vec2(uv.x * 0.5, uv.y * 0.29)).r;
    let blend = smoothstep(0.44, 0.56, choice);
    let one = textureSample(barks, bark_sampler, uv, kind * 2u);
    let other = textureSample(barks, bark_sampler, other_uv, kind * 2u);
    let one_relief = textureSample(barks, bark_sampler, uv, kind * 2u + 1u);
    let other_relief = textureSample(barks, bark_sampler, other_uv, kind * 2u + 1u);
    let surface = mix(one, other, blend);
    let relief = mix(one_relief, other_relief, blend);
    let radius = in.limb.x;
    let height = in.limb.w;
    // Old bark cracks; twigs are smooth and have their own colour.
    let old = smoothstep(0.006, select(0.05, 0.035, kind == 1u), radius);
    let stain = textureSample(noise, repeat_sampler, vec2(uv.x * 0.5, uv.y * 0.13 + 0.4)).g;
    var albedo = mix(twig_color(kind), surface.rgb * surface.rgb * (0.55 + 0.9 * stain), old);
    // Some of the places where white bark may crack have done so, most of them low on the trunk.
    let crack = textureSample(noise, repeat_sampler, vec2(uv.x * 0.5 + 0.3, uv.y * 0.21 + 0.7)).r;
    let cracked = smoothstep(0.56, 0.62, crack + 0.35 * smoothstep(1.2, 0.1, height)) * relief.a * old;
    albedo = mix(albedo, vec3(0.030, 0.026, 0.023), cracked);
    // Green algae near the ground, on the side away from the sun.
    let dull = smoothstep(1.3, 0.0, height) * smoothstep(0.03, 0.12, radius);
    let away = 0.5 - 0.5 * dot(in.normal.xz, frame.sun_direction.xz);
    albedo = mix(albedo, albedo * 0.55 + vec3(0.012, 0.022, 0.004), dull * (0.25 + 0.6 * away) * (1.2 - surface.a));

    // Grooves, in the frame that the texture spans on the bark.
    let across = dpdx(in.world);
    let down = dpdy(in.world);
    let smooth_normal = normalize(in.normal);
    let du = cross(down, smooth_normal) * dpdx(uv.x) + cross(smooth_normal, across) * dpdy(uv.x);
    let dv = cross(down, smooth_normal) * dpdx(uv.y) + cross(smooth_normal, across) * dpdy(uv.y);
    let scale = inverseSqrt(max(max(dot(du, du), dot(dv, dv)), 1.0e-20));
    let tilt = (relief.xy * 2.0 - 1.0) * old;
    let rough_normal = normalize(smooth_normal + scale * (du * tilt.x + dv * tilt.y));

    // Thin snow lies on what is level first.
    let covers = in.snow_m * (0.6 + 0.8 * stain);
    let snow = smoothstep(0.0, 0.2, smooth_normal.y - mix(0.95, 0.1, smoothstep(0.0005, 0.012, covers))) * f32(in.snow_m > 0.0);
    albedo = mix(albedo, vec3(0.84, 0.86, 0.89), snow);
    let normal = normalize(mix(rough_normal, smooth_normal, snow));

    let to_eye = normalize(frame.eye_m - in.world);
    let light = frame.sun_direction;
    let facing = dot(normal, light);
    let deep = mix(1.0, relief.z, old);
    let shade = tree_shade(in.world);
    let sun = frame.sun_color * shade.r * leaf_shadow(in.world + smooth_normal * 0.02 + light * 0.03);
    // Rough wood looks lit a little beyond the edge of the light.
    let lit = clamp((facing + 0.08) / 1.08, 0.0, 1.0) * mix(0.6, 1.0, max(deep, snow));
    // Grass hides the sky from the foot.
    let foot = mix(0.45, 1.0, smoothstep(-0.02, 0.35, height));
    // Beside a trunk the sky is open to the sides; what grows out of it above is none of its shade.
    let around = in.world + smooth_normal * (in.limb.x + 0.3);
    let open = min(in.limb.z, mix(0.5, 1.0, open_above(around, SKY_TAPS))) * deep * foot;
    var color = sun * albedo * lit;
    color += albedo * (ambient_light(normal) * open + fire_light(in.world, normal));
    let half_way = normalize(light + to_eye);
    color += sun * 0.012 * pow(max(dot(normal, half_way), 0.0), 12.0) * max(facing, 0.0);
    // Bark is dull, but at a grazing view it mirrors the sky.
    let fresnel = 0.03 + 0.35 * pow(1.0 - clamp(dot(normal, to_eye), 0.0, 1.0), 5.0);
    color += sky_reflection(reflect(-to_eye, normal), 0.8) * fresnel * open;
    return vec4(haze(color, in.world), in.limb.y);
}
