// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Twigs and the shoots that grow on them, lit at their corners: they are hardly wider than a pixel.

#import trees/bark_look
#import trees/branchlet

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

// Radius of a shoot at its base and at its tip in metres.
const SHOOT_RADII_M: vec2<f32> = vec2(0.0017, 0.0006);

// A shoot as a ribbon that faces the eye, bent from the leaf's petiole to where it leads.
@vertex
fn vertex_shoot(@builtin(vertex_index) index: u32, shoot: ShootInstance) -> Varyings {
    let tree = tree_records[shoot.record];
    let attitude = normalize(shoot.attitude);
    let own = shoot_of(f32(shoot.leaves), shoot.number, branchlet_key(shoot.slot));
    let along = f32(index >> 1u) / f32(SHOOT_PARTS);
    let ahead = (1.0 - SHOOT_BACK) * along;
    let petiole = vec3(0.0, 0.0, min(2.0 * along, 1.0));
    let rest = shoot.base_m + rotate(attitude, petiole + shoot_point(own, ahead)) * tree.leaf_m;
    let tangent = rotate(attitude, own.toward + vec3(0.0, 2.0 * own.rise * ahead, 0.0));

    // Of those that are too thin to be seen, some stand for the others.
    let turn = branch_turn(shoot.row);
    let world = moved(shoot.row, rest);
    let to_eye = normalize(frame.eye_m - world);
    let side = normalize(cross(rotate(turn, tangent), to_eye)) * select(-1.0, 1.0, (index & 1u) == 0u);
    let pixel_rad = length(frame.up) * 2.0 * frame.inv_viewport_px.y;
    let radius_m = mix(SHOOT_RADII_M.x, SHOOT_RADII_M.y, along);
    let share = shoot_share(distance(frame.eye_m, tree.center_m) * pixel_rad);
    let bark = BarkVertex(
        rest,
        radius_m / share,
        vec4(rotate(vec4(-turn.xyz, turn.w), side), 0.0),
        vec2(0.0),
        vec4(shoot.row, 0u, 0u, 0u),
        vec4(1.0, 0.0, 0.0, 0.0),
    );
    let drawn = drawn_bark(bark, tree);
    let corner = drawn.world + side * bark.radius_m;
    let normal = normalize(side + to_eye);
    let snow = snow_on_bark(vec3(0.0, 1.0, 0.0), drawn.snow_m, 0.6);
    let albedo = mix(twig_color(tree.bark_kind), vec3(0.84, 0.86, 0.89), snow);
    let open = crown_openness(tree, world).w;
    let lit = BarkSurface(corner, normal, normal, radius_m, drawn.height_m, albedo, 1.0, 1.0, open, 0u);
    return Varyings(frame.view_projection * vec4(corner, 1.0), vec4(lit_bark(lit), drawn.share));
}

// Share of a tree's shoots that are drawn, and as many times as thick. Twin: `shoot_share` of `shoots.rs`.
fn shoot_share(pixel_m: f32) -> f32 {
    return clamp(SHOOT_SEEN_M / pixel_m, LEAST_SHOOTS, 1.0);
}

@fragment
fn fragment(in: Varyings) -> @location(0) vec4<f32> {
    return in.light;
}
