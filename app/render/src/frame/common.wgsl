// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// The frame and the land, which every shader of the scene shares.

#import frame/structs
#import gpu/numbers

@group(0) @binding(0) var<uniform> frame: FrameUniform;

@group(0) @binding(1) var<uniform> land: LandUniform;
// Of every grid point: height above the origin's in metres, rise along x and z, how much of a hollow (1) or knoll (-1) it is.
@group(0) @binding(2) var hills: texture_2d<f32>;
// Of every grid point: height above the origin's up to which hills hide the sun, and how far away they are, in metres.
@group(0) @binding(3) var hill_shade: texture_2d<f32>;

// On level land shaders are built without hills: software adapters take both ways through a condition.
override IS_HILLY: bool = true;
// Without trees and objects nothing hides the sky.
override HAS_ROOF: bool = true;
override HAS_OBJECTS: bool = true;
// Number of fires that light the scene.
override FIRE_LIGHTS: u32 = 0u;
// Without snow nothing is wet of it.
override HAS_SNOW: bool = false;
// First map of the sun's shadows that is drawn, and samples of it: 1, 2 or 4.
override FIRST_MAP: u32 = 0u;
override SHADOW_TAPS: u32 = 4u;
// Haze has shafts of light.
override HAS_SHAFTS: bool = false;
// Samples of the sky overhead.
override SKY_TAPS: u32 = 6u;

// The grid points around a place, lowest (xy) and highest (zw), and where between them it lies.
struct Cell {
    points: vec4<i32>,
    t: vec2<f32>,
}

fn cell_of(at: vec2<f32>) -> Cell {
    let place = at * land.cells_per_m;
    let mask = vec2(i32(land.cells) - 1);
    let low = vec2<i32>(floor(place)) & mask;
    return Cell(vec4(low, (low + 1) & mask), fract(place));
}

// The hills at a place, as the simulation has them.
fn hills_at(at: vec2<f32>) -> vec4<f32> {
    if !IS_HILLY || land.cells_per_m == 0.0 {
        return vec4(0.0);
    }
    let cell = cell_of(at);
    let p = cell.points;
    let near = mix(textureLoad(hills, p.xy, 0), textureLoad(hills, p.zy, 0), cell.t.x);
    let far = mix(textureLoad(hills, p.xw, 0), textureLoad(hills, p.zw, 0), cell.t.x);
    return mix(near, far, cell.t.y);
}

// Sunlight that the hills let through to a place; the edge of their shadow is as soft as the sun is wide.
fn hill_light(position: vec3<f32>) -> f32 {
    if !IS_HILLY || land.cells_per_m == 0.0 {
        return 1.0;
    }
    let cell = cell_of(position.xz);
    let p = cell.points;
    let near = mix(textureLoad(hill_shade, p.xy, 0).xy, textureLoad(hill_shade, p.zy, 0).xy, cell.t.x);
    let far = mix(textureLoad(hill_shade, p.xw, 0).xy, textureLoad(hill_shade, p.zw, 0).xy, cell.t.x);
    let shade = mix(near, far, cell.t.y);
    let soft = 0.02 + 0.0047 * shade.y;
    return smoothstep(-soft, soft, position.y - land.base_m - shade.x);
}

// Height of the ground at a place in metres.
fn ground_height(at: vec2<f32>) -> f32 {
    return land.base_m + hills_at(at).x;
}

// Height of ground or water at a place in metres, whichever is higher.
fn surface_height(at: vec2<f32>) -> f32 {
    return max(ground_height(at), land.water_m);
}

// Direction, not of unit length, of what is seen at a place in clip space.
fn view_ray(clip: vec2<f32>) -> vec3<f32> {
    let whole = frame.tile_center + clip * frame.tile_scale;
    return frame.forward + whole.x * frame.right + whole.y * frame.up;
}

// Grass stands this deep below the leaves that lie on its tips, in metres.
const SWARD_M: f32 = 0.028;
// Paving lies this deep below them.
const PAVING_M: f32 = 0.003;

// Depth in metres of the ground that is drawn below the leaves on it.
fn ground_depth() -> f32 {
    return select(SWARD_M, PAVING_M, land.paved_half_m.x > 0.0);
}
