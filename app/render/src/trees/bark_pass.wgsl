// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Trunks and limbs.

#import trees/bark_look

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

@vertex
fn vertex(bark: BarkVertex, @builtin(instance_index) record: u32) -> Varyings {
    let tree = tree_records[record];
    let drawn = drawn_bark(bark, tree);
    var out: Varyings;
    out.world = drawn.world;
    out.snow_m = drawn.snow_m;
    out.clip = frame.view_projection * vec4(out.world, 1.0);
    out.normal = drawn.normal;
    out.uv = bark.uv;
    out.limb = vec4(bark.radius_m, drawn.share, crown_openness(tree, out.world).w, drawn.height_m);
    out.kind = tree.bark_kind;
    out.own = tree.own;
    return out;
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
    let old = old_share(kind, radius);
    let stain = textureSample(noise, repeat_sampler, vec2(uv.x * 0.5, uv.y * 0.13 + 0.4)).g;
    var albedo = mix(twig_color(kind), surface.rgb * surface.rgb * (0.55 + 0.9 * stain), old);
    // Some of the places where white bark may crack have done so, most of them low on the trunk.
    let crack = textureSample(noise, repeat_sampler, vec2(uv.x * 0.5 + 0.3, uv.y * 0.21 + 0.7)).r;
    let cracked = smoothstep(0.56, 0.62, crack + 0.35 * smoothstep(1.2, 0.1, height)) * relief.a * old;
    albedo = mix(albedo, vec3(0.030, 0.026, 0.023), cracked);
    let spots = textureSample(noise, repeat_sampler, uv * vec2(1.0, 0.7) + 0.53);
    albedo = overgrown(albedo, in.normal, height, old, spots, surface.a);
    albedo = algae(albedo, in.normal, height, radius, surface.a);

    // Grooves, in the frame that the texture spans on the bark.
    let across = dpdx(in.world);
    let down = dpdy(in.world);
    let smooth_normal = normalize(in.normal);
    let du = cross(down, smooth_normal) * dpdx(uv.x) + cross(smooth_normal, across) * dpdy(uv.x);
    let dv = cross(down, smooth_normal) * dpdx(uv.y) + cross(smooth_normal, across) * dpdy(uv.y);
    let scale = inverseSqrt(max(max(dot(du, du), dot(dv, dv)), 1.0e-20));
    let tilt = (relief.xy * 2.0 - 1.0) * old;
    let rough_normal = normalize(smooth_normal + scale * (du * tilt.x + dv * tilt.y));

    let snow = snow_on_bark(smooth_normal, in.snow_m, 0.6 + 0.8 * stain);
    albedo = mix(albedo, vec3(0.84, 0.86, 0.89), snow);
    let deep = mix(1.0, relief.z, old);
    let bark = BarkSurface(
        in.world,
        smooth_normal,
        normalize(mix(rough_normal, smooth_normal, snow)),
        radius,
        height,
        albedo,
        deep,
        max(deep, snow),
        in.limb.z,
        SKY_TAPS,
    );
    return vec4(lit_bark(bark), in.limb.y);
}
