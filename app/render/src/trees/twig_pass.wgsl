// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Twigs, lit at their corners: they are hardly wider than a pixel.

#import trees/bark_look

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    // Light, and share of a pixel that the twig covers.
    @location(0) @interpolate(perspective, centroid) light: vec4<f32>,
}

// Halvings of the bark's pictures of which a texel is a wide patch.
const PATCH_LEVEL: f32 = 6.0;

@vertex
fn vertex(bark: BarkVertex, @builtin(instance_index) record: u32) -> Varyings {
    let tree = tree_records[record];
    let drawn = drawn_bark(bark, tree);
    let kind = tree.bark_kind;
    let surface = textureSampleLevel(barks, bark_sampler, bark.uv, kind * 2u, PATCH_LEVEL);
    let relief = textureSampleLevel(barks, bark_sampler, bark.uv, kind * 2u + 1u, PATCH_LEVEL);
    let old = old_share(kind, bark.radius_m);
    var albedo = mix(twig_color(kind), surface.rgb * surface.rgb, old);
    albedo = algae(albedo, drawn.normal, drawn.height_m, bark.radius_m, surface.a);
    let snow = snow_on_bark(drawn.normal, drawn.snow_m, 1.0);
    albedo = mix(albedo, vec3(0.84, 0.86, 0.89), snow);
    let deep = mix(1.0, relief.z, old);
    let lit = BarkSurface(
        drawn.world,
        drawn.normal,
        drawn.normal,
        bark.radius_m,
        drawn.height_m,
        albedo,
        deep,
        max(deep, snow),
        crown_openness(tree, drawn.world).w,
        0u,
    );
    return Varyings(frame.view_projection * vec4(drawn.world, 1.0), vec4(lit_bark(lit), drawn.share));
}

@fragment
fn fragment(in: Varyings) -> @location(0) vec4<f32> {
    return in.light;
}
