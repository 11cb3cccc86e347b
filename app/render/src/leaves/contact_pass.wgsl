// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Soft shadows beneath leaves at rest, where their blades keep the light of the sky from what they lie on: squares under the blades, darker the
// more of the blade is overhead.

#import frame/common
#import leaves/front
#import leaves/shape

// Most light that a blade keeps from what it lies on, set by eye: the sun, whose shadow is drawn by itself, is part of it.
const DARKEST: f32 = 0.60;
// Edge of a shadow in edges of its leaf's picture.
const MARGIN: f32 = 1.3;
// Depth of a shadow below the middle of its blade in depths of what holds the blade up, and in metres besides: deep enough for most of a curled
// blade to lie above it. Snow, in which leaves sink, would hide it there.
const DEEPER: f32 = 1.3;
const BELOW_M: f32 = 0.001;
// Edges of pictures in pixels from which shadows are seen, and from which they are whole.
const SEEN_PX: vec2<f32> = vec2(18.0, 40.0);

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    @location(0) @interpolate(perspective, centroid) uv: vec2<f32>,
    @location(1) @interpolate(flat) layer: u32,
    @location(2) @interpolate(flat) darkest: f32,
}

@vertex
fn vertex(in: LeafVertex) -> Varyings {
    let record = record_of(in);
    let settled = outward_of(record).w;
    let corner = vec2(f32(in.vertex & 1u), f32(in.vertex >> 1u)) - 0.5;
    let place = MARGIN * corner;
    var out: Varyings;
    out.layer = record.layer_slot & LAYER_MASK;
    out.uv = 0.5 - place;
    out.darkest = DARKEST * clamp(1.0 - front_of(record).way, 0.0, 1.0);
    let edge = abs(record.edge_m);
    let attitude = normalize(vec4(unpack2x16snorm(record.attitude_xy), unpack2x16snorm(record.attitude_zw)));
    let right = rotate(attitude, vec3(sign(record.edge_m), 0.0, 0.0)).xz;
    let up = rotate(attitude, vec3(0.0, 0.0, 1.0)).xz;
    let aside = edge * (place.x * right + place.y * up);
    // It lies along the ground, whichever way the blade leans.
    let hill = hills_at(record.center_m.xz);
    let depth = lying_depth(out.layer, unpack2x16float(record.stage_fold).x, attitude) * (select(DEEPER, 1.0, HAS_SNOW) * edge) + BELOW_M;
    let world = record.center_m + vec3(aside.x, dot(hill.yz, aside) - depth, aside.y);
    // Leaves that fly or hang have none.
    out.clip = select(vec4(0.0, 0.0, -1.0, 1.0), frame.view_projection * vec4(world, 1.0), settled > 0.5);
    return out;
}

@fragment
fn fragment(in: Varyings) -> @location(0) vec4<f32> {
    let edge_px = 1.0 / max(min(length(dpdx(in.uv)), length(dpdy(in.uv))), 1.0e-5);
    // Eighths and sixteenths of a leaf are as coarse as the light of the sky is soft there.
    let levels = f32(textureNumLevels(images));
    let wide = textureSampleLevel(images, image_sampler, in.uv, in.layer, levels - 4.0).a;
    let narrow = textureSampleLevel(images, image_sampler, in.uv, in.layer, levels - 5.0).a;
    let beyond = max(abs(in.uv.x - 0.5), abs(in.uv.y - 0.5));
    let overhead = 0.5 * (wide + narrow) * (1.0 - smoothstep(0.5, 0.5 * MARGIN, beyond));
    // The middle of a curled blade may lie lower than the shadow: it is beneath nothing but itself.
    let around = 1.0 - 0.45 * smoothstep(0.6, 0.95, wide);
    return vec4(vec3(0.0), in.darkest * overhead * around * smoothstep(SEEN_PX.x, SEEN_PX.y, edge_px));
}
