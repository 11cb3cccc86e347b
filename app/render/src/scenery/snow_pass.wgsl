// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Snow that lies: a square for each cell, at the height of what it lies on, of the litter there and of its own depth. Cells on one level share
// corners; where a level ends, snow tapers off.

#import frame/fire_light
#import frame/light
#import scenery/structs

@group(2) @binding(0) var<uniform> snow: SnowUniform;
@group(2) @binding(1) var<storage, read> bed: array<u32>;
// Floors of the cells: bits of the height in metres, and a word of which the lower half says if there is water.
@group(2) @binding(2) var<storage, read> floors: array<vec2<u32>>;

// Width in cells of the rim over which snow sinks to the ground beyond the rectangle, as white without it.
const RIM_CELLS: i32 = 12;

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    @location(0) world: vec3<f32>,
    @location(1) normal: vec3<f32>,
    // Depth of the snow in metres.
    @location(2) depth_m: f32,
}

// Height in metres of what a cell lies on, and its depth; less than no depth outside of the grid. Water is as far below as any edge.
fn level_of(cell: vec2<i32>) -> vec2<f32> {
    if any(cell < vec2(0)) || any(cell >= vec2<i32>(snow.snow_cells)) {
        return vec2(0.0, -1.0);
    }
    let number = u32(cell.y) * snow.snow_cells.x + u32(cell.x);
    let cells = snow.snow_cells.x * snow.snow_cells.y;
    let floor_m = bitcast<f32>(floors[number].x);
    if is_water(number) {
        return vec2(floor_m - 2.0 * snow.step_m, 0.0);
    }
    return vec2(floor_m, f32(bed[snow.snow_word + cells + number]) * snow.depth_unit_m);
}

fn is_water(number: u32) -> bool {
    return (floors[number].y & 0xffffu) == FLOOR_ON_WATER;
}

// Height of litter in metres at a corner of cells, by its number from the origin on.
fn litter_at(corner: vec2<i32>) -> f32 {
    let most = vec2<i32>(snow.litter_cells);
    let node = corner - snow.litter_first;
    let inside = clamp(node, vec2(0), most);
    let height = f32(bed[snow.bed_word + u32(inside.y * (most.x + 1) + inside.x)]) * snow.litter_unit_m;
    return select(0.0, height, all(node == inside) && most.x > 0);
}

// Sums over the cells around a corner.
struct Corner {
    depth_m: f32,
    base_m: f32,
    level_count: f32,
    depth_count: f32,
}

// One of the four cells around a corner, added to it, and its height as seen from a cell. Those on the level of that cell count in full; lower ones
// are an edge; higher ones, a wall, do not count.
fn add_cell(corner: ptr<function, Corner>, here: vec2<f32>, number: vec2<i32>) -> f32 {
    let found = level_of(number);
    let level = select(found, here, found.y < 0.0);
    let apart = level.x - here.x;
    if abs(apart) < snow.step_m {
        (*corner).depth_m += level.y;
        (*corner).base_m += level.x;
        (*corner).level_count += 1.0;
        (*corner).depth_count += 1.0;
        return level.x + level.y;
    }
    let is_edge = apart < 0.0;
    (*corner).depth_count += select(0.0, 1.0, is_edge);
    return here.x + select(here.y, 0.0, is_edge);
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Varyings {
    let number = index / 6u;
    let own = vec2(i32(number % snow.snow_cells.x), i32(number / snow.snow_cells.x));
    // Two triangles: corners 0, 2, 3 and 0, 3, 1, two bits each.
    let corner = (0x738u >> (2u * (index % 6u))) & 3u;
    let at = own + vec2(i32(corner & 1u), i32(corner >> 1u));
    let here = level_of(own);
    var sums = Corner(0.0, 0.0, 0.0, 0.0);
    let a = add_cell(&sums, here, at - 1);
    let b = add_cell(&sums, here, at - vec2(0, 1));
    let c = add_cell(&sums, here, at - vec2(1, 0));
    let d = add_cell(&sums, here, at);
    let depth_m = sums.depth_m / max(sums.depth_count, 1.0);
    let litter_m = litter_at(at + snow.snow_first);
    let slope = 0.5 * vec2(b + d - a - c, c + d - a - b) * snow.cells_per_m;
    let place = vec2<f32>(at + snow.snow_first) * snow.cell_m;
    var out: Varyings;
    out.depth_m = depth_m;
    out.normal = vec3(-slope.x, 1.0, -slope.y);
    let inner = min(at, vec2<i32>(snow.snow_cells) - at);
    let risen = clamp(f32(min(inner.x, inner.y)) / f32(RIM_CELLS), 0.0, 1.0);
    out.world = vec3(place.x, sums.base_m / max(sums.level_count, 1.0) + litter_m + max(depth_m * risen, 0.002), place.y);
    out.clip = frame.view_projection * vec4(out.world, 1.0);
    // No square lies on water.
    if is_water(number) {
        out.clip = vec4(0.0, 0.0, -1.0, 1.0);
    }
    return out;
}

// Bumps of the surface at a place: height in metres and its slope, which fade with distance.
fn bumps(at: vec2<f32>, lod: f32) -> vec3<f32> {
    let step = 0.012 * exp2(lod);
    let here = textureSampleLevel(noise, repeat_sampler, at * 0.31, lod).g;
    let right = textureSampleLevel(noise, repeat_sampler, (at + vec2(step, 0.0)) * 0.31, lod).g;
    let far = textureSampleLevel(noise, repeat_sampler, (at + vec2(0.0, step)) * 0.31, lod).g;
    return vec3(here - 0.5, vec2(right - here, far - here) / step);
}

@fragment
fn fragment(in: Varyings) -> @location(0) vec4<f32> {
    let at = in.world.xz;
    let distance_m = distance(in.world, frame.eye_m);
    let lod = clamp(log2(distance_m * 0.16), 0.0, 5.0);
    let bump = bumps(at, lod);
    let grain = textureSampleLevel(noise, repeat_sampler, at * 2.3, max(lod - 1.0, 0.0)).b - 0.5;
    // Thin snow lies in patches, first between what sticks out.
    let patches = 0.006 + 0.012 * (bump.x + 0.5) + 0.006 * grain;
    let cover = smoothstep(0.25 * patches, patches, in.depth_m);
    if cover <= 0.01 {
        discard;
    }
    let full = smoothstep(0.01, 0.06, in.depth_m);
    let rough = mix(0.004, 0.016, full);
    let normal = normalize(normalize(in.normal) - vec3(bump.y, 0.0, bump.z) * rough * exp2(-0.35 * lod));
    let view = normalize(frame.eye_m - in.world);
    let light = frame.sun_direction;
    // The ground shows through where it is thin.
    let albedo = mix(vec3(0.62, 0.60, 0.57), vec3(0.86, 0.88, 0.90), full) * (1.0 + 0.10 * grain);
    let shade = tree_shade(in.world);
    let sun = shade.r * leaf_shadow(in.world + vec3(0.0, 0.01, 0.0));
    // Light goes some millimetres into snow: its shaded side is never black.
    let facing = max((dot(normal, light) + 0.12) / 1.12, 0.0);
    var color = albedo * frame.sun_color * sun * facing;
    color += albedo * ambient_light(normal) * min(sky_openness(in.world), open_above(in.world, SKY_TAPS)) * open_beside(in.world);
    color += albedo * fire_light(in.world, normal);
    // Facets that mirror the sun, one in a few hundred at a time.
    let facet = hash_u32(bitcast<u32>(i32(floor(at.x * 260.0))) + hash_u32(bitcast<u32>(i32(floor(at.y * 260.0)))));
    let tilt = vec3(unit_from(facet) - 0.5, 0.0, unit_from(hash_u32(facet)) - 0.5) * 1.6;
    let half_way = normalize(view + light);
    let glint = pow(max(dot(normalize(normal + tilt), half_way), 0.0), 400.0);
    color += frame.sun_color * sun * glint * 2.5 * full * exp2(-0.25 * distance_m);
    return vec4(haze(color, in.world), cover);
}
