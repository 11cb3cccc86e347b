// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Depth of field: every point of the scene becomes a disc as wide as its circle of confusion. Gathered: a pixel takes the light of
// all around it whose discs reach it, each with the part that falls on one pixel.

#import lens/fullscreen

@group(0) @binding(1) var<uniform> exposure: Exposure;
@group(1) @binding(0) var<uniform> focus: FocusUniform;
@group(1) @binding(1) var depth: texture_depth_multisampled_2d;
@group(1) @binding(2) var circles: texture_2d<f32>;
@group(1) @binding(3) var widest: texture_2d<f32>;
@group(1) @binding(4) var light: texture_2d<f32>;

const GOLDEN_ANGLE: f32 = 2.3999632;
const MOST: f32 = 256.0;

// Radius in pixels of a point's circle of confusion; negative before the focus.
@fragment
fn circle(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    // Depth is reversed: near plane over distance.
    let nearness = textureLoad(depth, (vec2<i32>(position.xy) - focus.corner_px) / lens.shading_px, 0) / lens.near_m;
    let radius = lens.far_circle_px * (1.0 - lens.focus_m * nearness);
    return vec4(clamp(radius, -lens.max_circle_px, lens.max_circle_px), 0.0, 0.0, 1.0);
}

// The largest radius in a block.
@fragment
fn largest(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let corner = vec2<i32>(position.xy) * focus.block_px;
    let end = min(corner + focus.block_px, vec2<i32>(textureDimensions(circles)));
    var radius = 0.0;
    for (var y = corner.y; y < end.y; y++) {
        for (var x = corner.x; x < end.x; x++) {
            radius = max(radius, abs(textureLoad(circles, vec2(x, y), 0).r));
        }
    }
    return vec4(radius, 0.0, 0.0, 1.0);
}

@fragment
fn gather(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let at = vec2<i32>(position.xy);
    let own = textureLoad(circles, at, 0).r;
    // Blocks are as wide as the largest radius: no disc comes from beyond the neighbours.
    let last_block = vec2<i32>(textureDimensions(widest)) - 1;
    var reach = 0.0;
    for (var part = 0; part < 9; part++) {
        let block = clamp(at / focus.block_px + vec2(part % 3, part / 3) - 1, vec2(0), last_block);
        reach = max(reach, textureLoad(widest, block, 0).r);
    }
    var sum = textureLoad(light, at, 0).rgb;
    if reach < 0.5 {
        return vec4(sum, 1.0);
    }
    let count = clamp(PI * reach * reach, 16.0, MOST);
    // Pixels that a sample stands for.
    let area = PI * reach * reach / count;
    let last = vec2<i32>(textureDimensions(light)) - 1;
    let own_width = max(abs(own), 0.5);
    var weights = 1.0 / (PI * own_width * own_width);
    sum *= weights;
    for (var index = 0.5; index < count; index += 1.0) {
        let distance = reach * sqrt(index / count);
        let offset = distance * vec2(cos(index * GOLDEN_ANGLE), sin(index * GOLDEN_ANGLE));
        let there = clamp(vec2<i32>(floor(position.xy + offset)), vec2(0), last);
        let other = textureLoad(circles, there, 0).r;
        // Things behind are hidden by what is sharp in front of them.
        let width = max(select(abs(other), min(other, abs(own)), other > own), 0.5);
        let weight = area * clamp(width - distance + 0.5, 0.0, 1.0) / (PI * width * width);
        sum += weight * textureLoad(light, there, 0).rgb;
        weights += weight;
    }
    return vec4(sum / weights, 1.0);
}
