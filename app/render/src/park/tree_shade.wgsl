// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Shadows of the trees, and under them the litter and the sky that crowns hide, seen from above; drawn once per sun.

@group(1) @binding(0) var sprites: texture_2d_array<f32>;
@group(1) @binding(1) var sprite_sampler: sampler;

struct Tree {
    @location(0) foot_height: vec4<f32>,
    @location(1) width: f32,
    @location(2) sprite: u32,
    @location(3) hue_brightness: vec2<f32>,
}

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    @location(0) uv: vec2<f32>,
    @location(1) @interpolate(flat) sprite: u32,
    // 0 for a tree that strews no litter.
    @location(2) @interpolate(flat) strewn: f32,
}

// Vertices 0-3: the shadow, a picture of the tree laid down away from the sun. 4-7: what is around the foot.
@vertex
fn vertex(@builtin(vertex_index) index: u32, tree: Tree) -> Varyings {
    let corner = vec2(f32(index & 1u), f32((index >> 1u) & 1u));
    let height = tree.foot_height.w;
    let sun = frame.sun_direction;
    let away = -normalize(sun.xz + vec2(1.0e-5, 0.0));
    let side = vec2(-away.y, away.x);
    var at = tree.foot_height.xz;
    var out: Varyings;
    if index < 4u {
        // A low sun would lay shadows over the whole park.
        let reach = min(sun.w, 4.0);
        at += side * ((corner.x - 0.5) * height * abs(tree.width)) + away * (corner.y * height * reach);
        out.sprite = tree.sprite;
    } else {
        at += (corner - 0.5) * height * 1.15;
        out.sprite = 1000u + tree.sprite;
    }
    out.uv = vec2(corner.x, 1.0 - corner.y);
    out.strewn = min(tree.hue_brightness.y, 1.0);
    let offset = (at - frame.park.xz) / frame.air.z;
    out.clip = vec4(offset.x, -offset.y, 0.0, 1.0);
    return out;
}

// Blending multiplies red (light let through), and adds green (litter) and blue (hidden sky).
@fragment
fn fragment(in: Varyings) -> @location(0) vec4<f32> {
    if in.sprite < 1000u {
        // Half shadow widens with the height of what casts it.
        let blur = 2.2 + 1.6 * (1.0 - in.uv.y);
        let cover = textureSampleLevel(sprites, sprite_sampler, in.uv, in.sprite * 2u, blur).a;
        let dark = min(cover * 1.05, 1.0) * 0.86;
        return vec4(0.0, 0.0, 0.0, dark);
    }
    let radius = length(in.uv - 0.5) * 2.0;
    // A crown hides as much sky as its picture is dense.
    let crown = textureSampleLevel(sprites, sprite_sampler, vec2(0.5, 0.35), (in.sprite - 1000u) * 2u, 5.0).a;
    let hidden = 0.55 * crown * (1.0 - smoothstep(0.1, 1.0, radius));
    return vec4(0.0, 0.75 * (1.0 - smoothstep(0.2, 1.0, radius)) * in.strewn, hidden, 0.0);
}
