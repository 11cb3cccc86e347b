// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Trees as upright pictures that turn to the camera, lit anew by the sun of the scene.

#import frame/fire_light
#import frame/coverage
#import frame/light
#import park/structs

@group(2) @binding(0) var sprites: texture_2d_array<f32>;
@group(2) @binding(1) var sprite_sampler: sampler;

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    @location(0) world: vec3<f32>,
    @location(1) uv: vec2<f32>,
    // Layers of the two sides that are nearest to the one that is seen; -1 or 1 as their pictures are mirrored.
    @location(2) @interpolate(flat) layers: vec2<u32>,
    @location(3) @interpolate(flat) mirrors: vec2<f32>,
    // Share of the second side.
    @location(4) @interpolate(flat) second: f32,
    @location(5) @interpolate(flat) look: vec2<f32>,
    // Effect of the air on its light, which changes little over a tree.
    @location(6) air: vec4<f32>,
}

// Half of the turn in quarters over which one side fades into the next.
const FADE: f32 = 0.12;

@vertex
fn vertex(@builtin(vertex_index) index: u32, tree: TreeInstance) -> Varyings {
    let corner = vec2(f32(index & 1u), f32(index >> 1u));
    let foot = tree.foot_m;
    let height = tree.height_m;
    let toward = frame.eye_m.xz - foot.xz;
    let side = normalize(vec2(toward.y, -toward.x) + vec2(1.0e-5, 0.0));
    let across = (corner.x - 0.5) * height * abs(tree.width);
    let up = mix(tree.cut, 1.0, corner.y);
    var out: Varyings;
    out.world = foot + vec3(side.x * across, (up - tree.cut) * height - 0.15, side.y * across);
    out.clip = frame.view_projection * vec4(out.world, 1.0);
    out.air = air_before(out.world);
    out.uv = vec2(corner.x, 1.0 - up);
    // Quarters of a turn from the side that was painted first to the one that is seen.
    let quarters = fract((tree.turn_rad - atan2(toward.y, toward.x)) * 0.15915494) * 4.0;
    let first = floor(quarters);
    let sides = vec2<u32>(u32(first), u32(first) + 1u) % 4u;
    out.layers = 2u * (tree.kind * SIDES + sides % SIDES);
    out.mirrors = sign(tree.width) * select(vec2(1.0), vec2(-1.0), sides >= vec2(SIDES));
    out.second = smoothstep(0.5 - FADE, 0.5 + FADE, quarters - first);
    out.look = vec2(tree.hue, tree.brightness);
    return out;
}

// Foliage from green (0) over gold and orange to russet (1).
fn autumn(hue: f32) -> vec3<f32> {
    let h = clamp(hue, 0.0, 1.0) * 3.0;
    var color = mix(vec3(0.17, 0.20, 0.045), vec3(0.50, 0.29, 0.040), clamp(h, 0.0, 1.0));
    color = mix(color, vec3(0.55, 0.19, 0.030), clamp(h - 1.0, 0.0, 1.0));
    return mix(color, vec3(0.33, 0.085, 0.030), clamp(h - 2.0, 0.0, 1.0));
}

// Share of a crown or of wood that snow covers: what faces up, and more of it the deeper snow lies in the open. By eye.
fn snow_on_tree(normal: vec3<f32>, grain: f32) -> f32 {
    let deep = smoothstep(0.0, 0.10, frame.snow_depth_m);
    return deep * smoothstep(0.75, 1.0, normal.y + 0.5 * grain + 0.45 * deep);
}

struct Painted {
    @location(0) color: vec4<f32>,
    @builtin(sample_mask) mask: u32,
}

@fragment
fn fragment(in: Varyings) -> Painted {
    // Texels of a pixel, and the finest square of texels that is no finer than a pixel: random numbers belong to those, and stay
    // with them as the view moves.
    let size = vec2<f32>(textureDimensions(sprites));
    let span = max(length(dpdx(in.uv) * size), length(dpdy(in.uv) * size));
    let square = vec2<u32>(floor(in.uv * size / exp2(max(floor(log2(span)), 0.0))));
    let random = hash_u32(square.x + hash_u32(square.y + hash_u32(in.layers.x)));
    let takes_second = unit_from(hash_u32(random)) < in.second;
    let layer = select(in.layers.x, in.layers.y, takes_second);
    let mirror = select(in.mirrors.x, in.mirrors.y, takes_second);
    let uv = vec2(select(1.0 - in.uv.x, in.uv.x, mirror > 0.0), in.uv.y);
    let level = log2(max(span, 1.0));
    let surface = textureSampleLevel(sprites, sprite_sampler, uv, layer, level);
    let relief = textureSampleLevel(sprites, sprite_sampler, uv, layer + 1u, level);
    // Close by, leaves have a sharp rim; from afar a texel says which share of a pixel they cover.
    let rim = mix(0.3, 1.0, smoothstep(0.4, 1.0, span));
    let mask = covered(clamp((surface.a - 0.5) / rim + 0.5, 0.0, 1.0), random);
    if mask == 0u {
        discard;
    }
    let to_eye = normalize(frame.eye_m - in.world);
    let side = normalize(vec3(to_eye.z, 0.0, -to_eye.x));
    let tilt = vec2((relief.r * 2.0 - 1.0) * mirror, relief.g * 2.0 - 1.0);
    let front = sqrt(max(1.0 - dot(tilt, tilt), 0.05));
    let ahead = normalize(vec3(to_eye.x, 0.0, to_eye.z));
    let normal = normalize(side * tilt.x + vec3(0.0, tilt.y, 0.0) + ahead * front);

    let leaf = autumn(in.look.x + (surface.g - 0.5) * 0.5) * in.look.y * (0.35 + 0.9 * surface.r);
    let bark = vec3(0.105, 0.074, 0.052) * (0.5 + surface.r);
    let snow = snow_on_tree(normal, surface.r);
    let albedo = mix(mix(leaf, bark, surface.b), vec3(0.84, 0.86, 0.88), snow);
    let light = frame.sun_direction;
    let facing = dot(normal, light);
    let open = relief.b;
    let lit = pow(max(facing * 0.55 + 0.45, 0.0), 1.5) * (0.3 + 0.7 * open);
    // Leaves let the sun through: the crown's thin rim glows against it.
    let against = pow(max(dot(-to_eye, light), 0.0), 2.0);
    let saturated = mix(vec3(luminance(leaf)), leaf, 1.4) * vec3(1.15, 0.95, 0.6);
    let through = saturated * (1.0 - surface.b) * (1.0 - snow) * against * open * (0.25 + 1.1 * lit);
    var color = frame.sun_color * hill_light(in.world) * (albedo * lit + through);
    color += albedo * (ambient_light(normal) * (0.32 + 0.68 * open) + fire_light(in.world, normal));
    return Painted(vec4(color * in.air.a + in.air.rgb, 1.0), mask);
}

// Shadows of the trees, and under them the litter and the sky that crowns hide, seen from above; drawn once per sun.

struct ShadeVaryings {
    @builtin(position) clip: vec4<f32>,
    @location(0) uv: vec2<f32>,
    @location(1) @interpolate(flat) sprite: u32,
    // 0 for a tree that strews no litter.
    @location(2) @interpolate(flat) strewn: f32,
}

// Vertices 0-3: the shadow, a picture of the tree laid down away from the sun. 4-7: what is around the foot.
@vertex
fn vertex_shade(@builtin(vertex_index) index: u32, tree: TreeInstance) -> ShadeVaryings {
    let corner = vec2(f32(index & 1u), f32((index >> 1u) & 1u));
    let height = tree.height_m;
    let away = -normalize(frame.sun_direction.xz + vec2(1.0e-5, 0.0));
    let side = vec2(-away.y, away.x);
    var at = tree.foot_m.xz;
    var out: ShadeVaryings;
    if index < 4u {
        // A low sun would lay shadows over the whole park.
        let reach = min(frame.sun_zenith_tan, 4.0);
        at += side * ((corner.x - 0.5) * height * abs(tree.width)) + away * (corner.y * height * reach);
        out.sprite = tree.kind * SIDES;
    } else {
        at += (corner - 0.5) * height * 1.15;
        out.sprite = 1000u + tree.kind * SIDES;
    }
    out.uv = vec2(corner.x, 1.0 - corner.y);
    out.strewn = min(tree.brightness, 1.0);
    let offset = (at - frame.park_center_m.xz) / PARK_RADIUS_M;
    out.clip = vec4(offset.x, -offset.y, 0.0, 1.0);
    return out;
}

// Blending multiplies red (light let through), and adds green (litter) and blue (hidden sky).
@fragment
fn fragment_shade(in: ShadeVaryings) -> @location(0) vec4<f32> {
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
