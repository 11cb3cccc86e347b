// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// What every shader of the scene shares. `Frame` is laid out by `environment.rs`.

struct Frame {
    view_projection: mat4x4<f32>,
    // World to the sun's clip space, for the slices of the view from near to far; then to that of a look from above.
    shadows: array<mat4x4<f32>, 4>,
    // Camera position; time in seconds.
    eye: vec4<f32>,
    // Camera axes, scaled so that forward + x * right + y * up is a ray through place (x, y) of the whole picture's clip
    // space.
    right: vec4<f32>,
    up: vec4<f32>,
    forward: vec4<f32>,
    // Direction towards the sun; tangent of its distance from the zenith.
    sun_direction: vec4<f32>,
    // Radiance of a white matt surface that faces the sun; light is in kcd/m² throughout.
    sun_color: vec4<f32>,
    // w: x and z of the direction the park's path leads.
    sky_zenith: vec4<f32>,
    sky_horizon: vec4<f32>,
    // Radiance of the ground; w: phase of the path's bends.
    ground_bounce: vec4<f32>,
    // Haze per metre; exposure; half edge of the shade map in metres; edge of a shadow texel in metres.
    air: vec4<f32>,
    // Centre of the park: x, height of the ground, z; radius of the shadow map in metres.
    park: vec4<f32>,
    // Width and height of the whole picture in pixels, and their reciprocals.
    viewport: vec4<f32>,
    // Middle and size, in clip coordinates of the whole picture, of the part of it that is drawn.
    tile: vec4<f32>,
    // Edges of the texels of the shadow maps in metres.
    texels: vec4<f32>,
    // Light of the sky on white matt surfaces: coefficients of spherical harmonics.
    ambient: array<vec4<f32>, 9>,
    // Cloud cover; reciprocal of the depth of the haze in metres; 0 where a picture is the sky;
    // time of the clouds in seconds.
    sky: vec4<f32>,
    // Radiance of clouds, at their brightest and at their darkest.
    cloud_light: vec4<f32>,
    cloud_shade: vec4<f32>,
}

@group(0) @binding(0) var<uniform> frame: Frame;

// Laid out by `land_texture.rs`.
struct Land {
    // Cells of the hills per metre, 0 on level ground; cells along an edge; height at the origin and of water in m.
    shape: vec4<f32>,
}

@group(0) @binding(1) var<uniform> land: Land;
// Of every grid point: height above the origin's in metres, rise along x and z, how much of a hollow (1) or knoll (-1) it is.
@group(0) @binding(2) var hills: texture_2d<f32>;
// Of every grid point: height above the origin's up to which hills hide the sun, and how far away they are, in metres.
@group(0) @binding(3) var hill_shade: texture_2d<f32>;

// Where the land is level, shaders are built without hills: software adapters take both ways through a condition.
override IS_HILLY: bool = true;
// Where no tree stands, nothing hides the sky.
override HAS_TREES: bool = true;

// The grid points around a place, lowest (xy) and highest (zw), and where between them it lies.
struct Cell {
    points: vec4<i32>,
    t: vec2<f32>,
}

fn cell_of(at: vec2<f32>) -> Cell {
    let place = at * land.shape.x;
    let mask = vec2(i32(land.shape.y) - 1);
    let low = vec2<i32>(floor(place)) & mask;
    return Cell(vec4(low, (low + 1) & mask), fract(place));
}

// The hills at a place, as the simulation has them.
fn hills_at(at: vec2<f32>) -> vec4<f32> {
    if !IS_HILLY || land.shape.x == 0.0 {
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
    if !IS_HILLY || land.shape.x == 0.0 {
        return 1.0;
    }
    let cell = cell_of(position.xz);
    let p = cell.points;
    let near = mix(textureLoad(hill_shade, p.xy, 0).xy, textureLoad(hill_shade, p.zy, 0).xy, cell.t.x);
    let far = mix(textureLoad(hill_shade, p.xw, 0).xy, textureLoad(hill_shade, p.zw, 0).xy, cell.t.x);
    let shade = mix(near, far, cell.t.y);
    let soft = 0.02 + 0.0047 * shade.y;
    return smoothstep(-soft, soft, position.y - land.shape.z - shade.x);
}

// Height of the ground at a place in metres.
fn ground_height(at: vec2<f32>) -> f32 {
    return land.shape.z + hills_at(at).x;
}

// Height of ground or water at a place in metres, whichever is higher.
fn surface_height(at: vec2<f32>) -> f32 {
    return max(ground_height(at), land.shape.w);
}

// Direction, not of unit length, of what is seen at a place in clip space.
fn view_ray(clip: vec2<f32>) -> vec3<f32> {
    let whole = frame.tile.xy + clip * frame.tile.zw;
    return frame.forward.xyz + whole.x * frame.right.xyz + whole.y * frame.up.xyz;
}

const PI: f32 = 3.14159265;

// Grass stands this deep below the leaves that lie on its tips, in metres.
const SWARD_M: f32 = 0.028;

fn luminance(color: vec3<f32>) -> f32 {
    return dot(color, vec3(0.2126, 0.7152, 0.0722));
}
