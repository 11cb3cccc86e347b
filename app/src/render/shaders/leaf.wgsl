// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Leaves, lit by the sun in front of them and through them.

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    @location(0) @interpolate(perspective, centroid) world: vec3<f32>,
    @location(1) @interpolate(perspective, centroid) normal: vec3<f32>,
    @location(2) @interpolate(perspective, centroid) uv: vec2<f32>,
    @location(3) @interpolate(flat) layer: u32,
    // Brightness, warmth, settled.
    @location(4) @interpolate(flat) look: vec3<f32>,
    // Factor on the colour; open sky.
    @location(5) @interpolate(flat) tint_open: vec4<f32>,
    // Direction out of the crown, as far as the leaf is one of its surface.
    @location(6) @interpolate(flat) outward: vec3<f32>,
}

@vertex
fn vertex(leaf: Leaf, @location(4) at: vec3<f32>, stem: Stem) -> Varyings {
    let point = blade_point(leaf, at, stem, true);
    var out: Varyings;
    out.world = point.world;
    out.clip = frame.view_projection * vec4(point.world, 1.0);
    out.normal = point.normal;
    out.uv = point.uv;
    out.layer = point.layer;
    let random = hash_u32(point.tint ^ 0x51u);
    out.look = vec3(unit_from(random), unit_from(hash_u32(random)), point.settled);
    out.tint_open = vec4(stem.tint_cluster.rgb, 1.0);
    out.outward = vec3(0.0);
    if point.attached && stem.center_turned.w >= 0.0 {
        let crown = crown_openness(stem, point.world);
        out.tint_open.w = crown.w;
        out.outward = crown.xyz * inverseSqrt(max(dot(crown.xyz, crown.xyz), 0.01)) * 0.55;
    }
    return out;
}

@fragment
fn fragment(in: Varyings, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let image = textureSample(images, image_sampler, in.uv, in.layer);
    // A sharp rim at any size: the alpha ramp is made one pixel wide.
    let size = vec2<f32>(textureDimensions(images));
    let span = max(length(dpdx(in.uv) * size), length(dpdy(in.uv) * size));
    let lod = max(log2(span), 0.0);
    let rim = max(fwidth(image.a), 0.04);
    let alpha = clamp((image.a * (1.0 + 0.12 * lod) - 0.5) / rim + 0.5, 0.0, 1.0);
    if alpha <= 0.0 {
        discard;
    }
    var albedo = image.rgb * mix(0.78, 1.18, in.look.x);
    albedo *= mix(vec3(0.94, 1.05, 0.95), vec3(1.08, 0.93, 0.92), in.look.y) * in.tint_open.rgb;

    let to_eye = normalize(frame.eye.xyz - in.world);
    let blade = normalize(in.normal);
    let seen = select(-1.0, 1.0, dot(blade, to_eye) > 0.0);
    // A crown is lit like a rounded whole as well as leaf by leaf.
    let normal = normalize(blade * seen + in.outward);
    // The underside is paler and duller.
    if seen < 0.0 {
        albedo = mix(albedo, vec3(luminance(albedo)) * vec3(1.1, 1.05, 0.9), 0.25) * 1.08;
    }
    let light = frame.sun_direction.xyz;
    let facing = dot(normal, light);
    let shade = tree_shade(in.world);
    let sun = frame.sun_color.rgb * shade.r * leaf_shadow(in.world + light * 0.035);

    let reflected = albedo * clamp(facing * 0.9 + 0.1, 0.0, 1.0);
    // Light that crossed the blade has lost its blue and gained colour.
    let deep = albedo * (albedo + 0.10) / (luminance(albedo) + 0.10);
    let through = mix(deep, albedo, 0.25) * vec3(1.25, 1.08, 0.70) * max(-facing * 0.92 + 0.08, 0.0)
        * (0.85 + 0.5 * pow(max(dot(-to_eye, light), 0.0), 4.0)) * mix(1.0, 0.55, in.look.z);
    let half_way = normalize(light + to_eye);
    let gloss = 0.06 * pow(max(dot(normal, half_way), 0.0), 24.0) * max(facing, 0.0) * select(0.4, 1.0, seen > 0.0);
    let nearness = mix(1.0, 0.75, in.look.z) * in.tint_open.w;
    var color = sun * (reflected + through + gloss);
    color += albedo * ambient_light(normal) * nearness;
    // The sky also shines through.
    color += deep * ambient_light(-normal) * 0.25 * nearness;
    return vec4(haze(color, in.world), alpha);
}
