// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Snow that lies. On the ground a square for each cell, at the height of the ground, of the litter there and of its own depth; cells share
// corners. On things a cap, whose depth is that of the cells around; at its rims it rounds off.

#import frame/fire_light
#import frame/light
#import scenery/structs

@group(2) @binding(0) var<uniform> snow: SnowUniform;
@group(2) @binding(1) var<storage, read> bed: array<u32>;
@group(2) @binding(2) var<storage, read> cells: array<DrawnCell>;
@group(2) @binding(3) var<storage, read> caps: array<CapNode>;

// Width in cells of the rim over which snow sinks to the ground beyond the rectangle, as white without it.
const RIM_CELLS: i32 = 12;
// Height in metres within which a cell's snow lies on the same side of a thing.
const CAP_STEP_M: f32 = 0.35;
// Reach in cells of what a cell bears.
const CAP_REACH: f32 = 1.5;

// Periods of the noise in a metre, of bumps and of grains.
const BUMPS_PER_M: f32 = 0.31;
const GRAINS_PER_M: f32 = 2.3;

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    @location(0) world: vec3<f32>,
    @location(1) normal: vec3<f32>,
    // Depth of the snow in metres.
    @location(2) depth_m: f32,
}

fn is_outside(cell: vec2<i32>) -> bool {
    return any(cell < vec2(0)) || any(cell >= vec2<i32>(snow.snow_cells));
}

fn number_of(cell: vec2<i32>) -> u32 {
    return u32(cell.y) * snow.snow_cells.x + u32(cell.x);
}

fn depth_of(number: u32) -> f32 {
    return f32(bed[snow.snow_word + snow.snow_cells.x * snow.snow_cells.y + number]) * snow.depth_unit_m;
}

// Snow of a cell on the ground.
struct Level {
    base_m: f32,
    depth_m: f32,
    // Snow lies on the ground there, not on a thing.
    lies: bool,
}

// The snow of a cell; that of another outside of the grid. Water is as far below as any edge.
fn level_of(cell: vec2<i32>, other: Level) -> Level {
    if is_outside(cell) {
        return other;
    }
    let number = number_of(cell);
    let found = cells[number];
    if found.is_water != 0u {
        return Level(found.floor_m - 2.0 * snow.step_m, 0.0, true);
    }
    if found.has_cap != 0u {
        return Level(found.ground_m, 0.0, false);
    }
    return Level(found.floor_m, depth_of(number), true);
}

// Height of litter in metres at a corner of cells, by its number from the origin on.
fn litter_at(corner: vec2<i32>) -> f32 {
    let most = vec2<i32>(snow.litter_cells);
    let node = corner - snow.litter_first;
    let inside = clamp(node, vec2(0), most);
    let height = f32(bed[snow.bed_word + u32(inside.y * (most.x + 1) + inside.x)]) * snow.litter_unit_m;
    return select(0.0, height, all(node == inside) && most.x > 0);
}

// Snow at a corner of cells.
struct Corner {
    base_m: f32,
    depth_m: f32,
    slope: vec2<f32>,
}

// Snow where four cells meet, as seen from one of them. Those on the level of that cell count in full, but for those on things, which stand in the snow
// around; lower ones are an edge; higher ones, a wall, do not count.
fn corner_of(here: Level, at: vec2<i32>) -> Corner {
    var around = array<Level, 4>(here, here, here, here);
    var depth_sum = 0.0;
    var depth_count = 0.0;
    var under_sum = 0.0;
    var under_count = 0.0;
    var base_sum = 0.0;
    var base_count = 0.0;
    for (var cell = 0; cell < 4; cell++) {
        let level = level_of(at + vec2((cell & 1) - 1, (cell >> 1) - 1), here);
        around[cell] = level;
        let apart = level.base_m - here.base_m;
        let is_level = abs(apart) < snow.step_m;
        if is_level {
            base_sum += level.base_m;
            base_count += 1.0;
        }
        if is_level && level.lies {
            depth_sum += level.depth_m;
        }
        if level.lies && apart < snow.step_m {
            depth_count += 1.0;
        }
    }
    // Snow goes on as deep under the rim of a thing.
    for (var cell = 0; cell < 16 && depth_count == 0.0; cell++) {
        let level = level_of(at + vec2((cell & 3) - 2, (cell >> 2) - 2), here);
        if level.lies && abs(level.base_m - here.base_m) < snow.step_m {
            under_sum += level.depth_m;
            under_count += 1.0;
        }
    }
    let mean_m = select(depth_sum / max(depth_count, 1.0), under_sum / max(under_count, 1.0), depth_count == 0.0);
    var heights = vec4(0.0);
    for (var cell = 0; cell < 4; cell++) {
        let level = around[cell];
        let apart = level.base_m - here.base_m;
        if abs(apart) < snow.step_m {
            heights[cell] = level.base_m + select(mean_m, level.depth_m, level.lies);
        } else {
            heights[cell] = here.base_m + select(mean_m, 0.0, apart < 0.0);
        }
    }
    let slope = 0.5 * vec2(heights.y + heights.w - heights.x - heights.z, heights.z + heights.w - heights.x - heights.y);
    return Corner(base_sum / max(base_count, 1.0), mean_m, slope * snow.cells_per_m);
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Varyings {
    let number = index / 6u;
    let own = vec2(i32(number % snow.snow_cells.x), i32(number / snow.snow_cells.x));
    // Two triangles: corners 0, 2, 3 and 0, 3, 1, two bits each.
    let corner = (0x738u >> (2u * (index % 6u))) & 3u;
    let at = own + vec2(i32(corner & 1u), i32(corner >> 1u));
    let here = level_of(own, Level(0.0, 0.0, true));
    let found = corner_of(here, at);
    let place = vec2<f32>(at + snow.snow_first) * snow.cell_m;
    var out: Varyings;
    out.depth_m = found.depth_m;
    out.normal = vec3(-found.slope.x, 1.0, -found.slope.y);
    let inner = min(at, vec2<i32>(snow.snow_cells) - at);
    let risen = clamp(f32(min(inner.x, inner.y)) / f32(RIM_CELLS), 0.0, 1.0);
    let litter_m = litter_at(at + snow.snow_first);
    out.world = vec3(place.x, found.base_m + litter_m + max(found.depth_m * risen, 0.002), place.y);
    out.clip = frame.view_projection * vec4(out.world, 1.0);
    // No square lies on water.
    if cells[number].is_water != 0u {
        out.clip = vec4(0.0, 0.0, -1.0, 1.0);
    }
    return out;
}

// Depth in metres of the snow at a place on a thing: the mean of the cells around whose snow lies on that side of it, by how near they are.
fn cap_depth(place: vec3<f32>) -> f32 {
    let at = place.xz * snow.cells_per_m - vec2<f32>(snow.snow_first);
    let own = vec2<i32>(floor(at));
    var sum = 0.0;
    var weights = 0.0;
    for (var beside = 0; beside < 9; beside++) {
        let cell = own + vec2(beside % 3 - 1, beside / 3 - 1);
        if is_outside(cell) {
            continue;
        }
        let number = number_of(cell);
        let found = cells[number];
        if found.has_cap == 0u || abs(found.floor_m - place.y) > CAP_STEP_M {
            continue;
        }
        let near = max(CAP_REACH - abs(vec2<f32>(cell) + 0.5 - at), vec2(0.0));
        sum += near.x * near.y * depth_of(number);
        weights += near.x * near.y;
    }
    return sum / max(weights, 1e-6);
}

// Depth of the snow at a corner of a cap, and its surface there: a quarter of a circle from the rim on.
fn cap_surface(node: u32) -> vec4<f32> {
    let corner = caps[node];
    let full_m = cap_depth(corner.place_m) * corner.bears;
    let from_rim = 1.0 - clamp(corner.rim_m / max(full_m, 1e-4), 0.0, 1.0);
    let depth_m = full_m * sqrt(1.0 - from_rim * from_rim);
    return vec4(corner.place_m + vec3(0.0, depth_m + 0.002, 0.0), depth_m);
}

@vertex
fn cap_vertex(@builtin(vertex_index) node: u32) -> Varyings {
    let corner = caps[node];
    let here = cap_surface(node);
    let along = cap_surface(corner.after).xyz - cap_surface(corner.before).xyz;
    let across = cap_surface(corner.far).xyz - cap_surface(corner.near).xyz;
    let normal = cross(across, along);
    var out: Varyings;
    out.world = here.xyz;
    out.normal = select(vec3(0.0, 1.0, 0.0), normal * sign(normal.y), abs(normal.y) > 1e-9);
    out.depth_m = here.w;
    out.clip = frame.view_projection * vec4(out.world, 1.0);
    return out;
}

// Level of the noise, so many of which go into a metre, that is as coarse as a pixel: finer ones would make rings.
fn pixel_lod(pixel_m: f32, per_m: f32) -> f32 {
    return log2(max(pixel_m * per_m * f32(textureDimensions(noise).x), 1.0));
}

// Bumps of the surface at a place: height in metres and its slope, which fade with distance.
fn bumps(at: vec2<f32>, lod: f32) -> vec3<f32> {
    let step = 0.012 * exp2(lod);
    let here = textureSampleLevel(noise, repeat_sampler, at * BUMPS_PER_M, lod).g;
    let right = textureSampleLevel(noise, repeat_sampler, (at + vec2(step, 0.0)) * BUMPS_PER_M, lod).g;
    let far = textureSampleLevel(noise, repeat_sampler, (at + vec2(0.0, step)) * BUMPS_PER_M, lod).g;
    return vec3(here - 0.5, vec2(right - here, far - here) / step);
}

@fragment
fn fragment(in: Varyings) -> @location(0) vec4<f32> {
    let at = in.world.xz;
    let distance_m = distance(in.world, frame.eye_m);
    let pixel_m = max(length(dpdx(at)), length(dpdy(at)));
    let lod = clamp(log2(distance_m * 0.16), 0.0, 5.0);
    let bump = bumps(at, max(lod, pixel_lod(pixel_m, BUMPS_PER_M)));
    let grain = textureSampleLevel(noise, repeat_sampler, at * GRAINS_PER_M, pixel_lod(pixel_m, GRAINS_PER_M)).b - 0.5;
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
