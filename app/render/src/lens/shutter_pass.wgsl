// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Draws out along its way what moves while the shutter is open: every pixel gathers the light of those that cross it
// meanwhile, and sees what is behind them for as long as none does.
//
// Source: the blocks and taps of McGuire, Hennessy, Bukowski, Osman, "A reconstruction filter for plausible motion blur"
// (I3D 2012). The weights are shares of time, so that what moves keeps its light.

#import lens/fullscreen

@group(1) @binding(0) var<uniform> shutter: ShutterUniform;
@group(1) @binding(1) var depth: texture_depth_multisampled_2d;
@group(1) @binding(2) var drawn: texture_2d<f32>;
// Half the way in pixels, and distance in metres.
@group(1) @binding(3) var ways: texture_2d<f32>;
@group(1) @binding(4) var longest: texture_2d<f32>;
@group(1) @binding(5) var light: texture_2d<f32>;

const TAPS: i32 = 17;
// Part of a distance over which before and behind fade into each other.
const SOFT: f32 = 0.02;
const FARTHEST_M: f32 = 60000.0;
// Half a way in pixels from which on something moves.
const MOVING: f32 = 0.25;

// Puts the ways of a tile, and how far away what moves is, into the picture.
@fragment
fn take(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let at = (vec2<i32>(position.xy) - shutter.corner_px) / lens.shading_px;
    // A pixel that something covers in part moves as that does.
    let mean = textureLoad(drawn, at, 0);
    let way = mean.xy / max(mean.a, 1.0e-3);
    let span = length(way);
    let distance_m = lens.near_m / max(textureLoad(depth, at, 0), lens.near_m / FARTHEST_M);
    return vec4(way * min(1.0, shutter.max_px / max(span, 1.0e-6)), distance_m, 1.0);
}

fn longer(a: vec2<f32>, b: vec2<f32>) -> vec2<f32> {
    return select(a, b, dot(b, b) > dot(a, a));
}

// The longest way in a block.
@fragment
fn block_longest(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let corner = vec2<i32>(position.xy) * shutter.block_px;
    let end = min(corner + shutter.block_px, vec2<i32>(textureDimensions(ways)));
    var way = vec2(0.0);
    for (var y = corner.y; y < end.y; y++) {
        for (var x = corner.x; x < end.x; x++) {
            way = longer(way, textureLoad(ways, vec2(x, y), 0).xy);
        }
    }
    return vec4(way, 0.0, 1.0);
}

// Weight of the first of two distances being before the second.
fn before(first_m: f32, second_m: f32) -> f32 {
    return clamp(1.0 - (first_m - second_m) / (SOFT * min(first_m, second_m)), 0.0, 1.0);
}

@fragment
fn gather(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let at = vec2<i32>(position.xy);
    // Blocks are as wide as the longest way: nothing comes from beyond the neighbours.
    let last_block = vec2<i32>(textureDimensions(longest)) - 1;
    var way = vec2(0.0);
    for (var part = 0; part < 9; part++) {
        let block = clamp(at / shutter.block_px + vec2(part % 3, part / 3) - 1, vec2(0), last_block);
        way = longer(way, textureLoad(longest, block, 0).xy);
    }
    let own_light = textureLoad(light, at, 0).rgb;
    if length(way) < MOVING {
        return vec4(own_light, 1.0);
    }
    let own = textureLoad(ways, at, 0);
    // Light of what passes here, by the share of the time that it does, and of what is there all the while.
    var passing = vec4(0.0);
    var staying = vec4(0.0);
    let last = vec2<i32>(textureDimensions(light)) - 1;
    let apart = 2.0 * length(way) / f32(TAPS);
    // Taps of neighbouring pixels lie between one another.
    let shift = f32((at.x * 5 + at.y * 3) & 7) / 8.0 - 0.4375;
    for (var tap = 0; tap < TAPS; tap++) {
        let along = 2.0 * (f32(tap) + 0.5 + shift) / f32(TAPS) - 1.0;
        let there = clamp(vec2<i32>(floor(position.xy + way * along)), vec2(0), last);
        let other = textureLoad(ways, there, 0);
        let span = length(other.xy);
        let color = textureLoad(light, there, 0).rgb;
        let reaches = step(MOVING, span) * clamp(span + 0.5 - abs(along) * length(way), 0.0, 1.0);
        // It goes over twice its span, evenly, and is an interval of taps wide.
        passing += reaches * before(other.z, own.z) * apart / (2.0 * max(span, MOVING)) * vec4(color, 1.0);
        staying += (1.0 - reaches) * vec4(color, 1.0);
    }
    let is_still = length(own.xy) < MOVING;
    let behind = select(staying.rgb / max(staying.a, 1.0e-3), own_light, is_still || staying.a < 1.0e-3);
    let over = passing.rgb / max(passing.a, 1.0e-3);
    return vec4(mix(behind, over, min(passing.a, 1.0)), 1.0);
}
