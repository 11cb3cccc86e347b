// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Flames as soft lights around their splines. They hide nothing, so no order matters among them.

#import frame/light
#import particles/flame_spine

@group(2) @binding(7) var<uniform> drawn_flame: DrawnFlame;

// Radius of a light over that of the flame.
const LIGHT_SIZE: f32 = 0.55;
// Least radius of a light in pixels.
const LEAST_PX: f32 = 1.5;

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    // Place on the disc in radii.
    @location(0) at: vec2<f32>,
    @location(1) @interpolate(flat) light: vec3<f32>,
}

@vertex
fn vertex(@builtin(vertex_index) corner: u32, @builtin(instance_index) instance: u32) -> Varyings {
    let population = drawn_flame.population;
    let flame = flames[population];
    let look = populations[population];
    let slot = flame.first_slot + instance / flame.samples;
    let number = instance % flame.samples;
    var out: Varyings;
    out.clip = vec4(0.0, 0.0, -1.0, 1.0);
    let stretch = flame_stretch(flame, slot);
    if !stretch.is_there {
        return out;
    }
    // Stratified along the spline and around it; the light keeps its place as its points move.
    let key = hash_u32(traits[slot].id * 64u + number);
    let u = (f32(number) + unit_from(key)) / f32(flame.samples);
    let turn = 2.3999632 * f32(number) + 6.2831853 * unit_from(hash_u32(key + 1u));
    // Distances d from the spline of a density that falls as 1 / (1 + d / shell), up to the radius.
    let off = flame.shell * (pow(1.0 + 1.0 / flame.shell, unit_from(hash_u32(key + 2u))) - 1.0);
    let row = stretch_row(population, stretch, u);
    let radius_m = flame_radius(look, row, stretch, u);
    let way = spline_way(stretch, u);
    let way_m = length(way);
    let along = way / max(way_m, 1.0e-6);
    let side = normalize(cross(along, select(vec3(1.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0), abs(along.x) > 0.7)));
    let front = cross(side, along);
    // Lights touch each other even in a thin flame.
    let true_m = max(LIGHT_SIZE * radius_m, way_m / f32(flame.samples));
    let center = spline_place(stretch, u) + max(radius_m - 0.5 * true_m, 0.0) * off * (cos(turn) * side + sin(turn) * front);

    let to_eye = frame.eye_m - center;
    let distance_m = max(length(to_eye), 1.0e-4);
    let pixel_m = distance_m * length(frame.up) * 2.0 * frame.inv_viewport_px.y;
    let light_m = max(true_m, LEAST_PX * pixel_m);
    let view = to_eye / distance_m;
    let right = normalize(cross(vec3(0.0, 1.0, 0.0), view) + 1.0e-6 * frame.right);
    let up = cross(view, right);
    let at = vec2(f32(corner & 1u), f32(corner >> 1u)) * 2.0 - 1.0;
    let world = center + (right * at.x + up * at.y) * light_m;
    out.clip = frame.view_projection * vec4(world, 1.0);
    out.at = at;
    // All lights of a stretch together give the light of its face, however many there are.
    let face_m2 = 2.0 * radius_m * way_m / f32(flame.samples);
    let share = face_m2 / (3.14159265 * light_m * light_m * MEAN_COVER);
    out.light = row.color * (row.opacity * share * air_before(center).a);
    return out;
}

@fragment
fn fragment(in: Varyings) -> @location(0) vec4<f32> {
    let thin = max(1.0 - dot(in.at, in.at), 0.0);
    return vec4(in.light * (thin * thin), 0.0);
}
