// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/solid/shape.rs
// Solid parts, and the distance to those without faces: a box or a cylinder, rounded by a radius.
#import bindings
#import arith/math
#import arith/vector

struct SolidAt {
    flags: u32,
    first_row: u32,
    face_count: u32,
    half_m: vec3<f32>,
    rounding_m: f32,
    bound_m: f32,
    friction: f32,
    restitution: f32,
    center: vec3<f32>,
    turn: vec4<f32>,
    velocity: vec3<f32>,
    spin: vec3<f32>,
}

struct SolidDistance {
    distance_m: f32,
    normal: vec3<f32>,
}

fn row_vector(row: vec4<u32>) -> vec3<f32> {
    return bitcast<vec4<f32>>(row).xyz;
}

fn solid_at(number: u32, seconds: f32) -> SolidAt {
    let first = scene.solids.first_row + number * SOLID_ROWS;
    return solid_of_rows(number, tables[first], tables[first + 1u], tables[first + 2u], tables[first + 3u], seconds);
}

fn solid_of_rows(
    number: u32,
    sizes: vec4<u32>,
    surface_row: vec4<u32>,
    center: vec4<u32>,
    turn: vec4<u32>,
    seconds: f32,
) -> SolidAt {
    let surface = bitcast<vec4<f32>>(surface_row);
    var half_m = vec3<f32>(0.0, 0.0, 0.0);
    if ((sizes.x & (SOLID_HULL | SOLID_GRID)) == 0u) {
        half_m = bitcast<vec3<f32>>(sizes.yzw);
    }
    var solid = SolidAt(
        sizes.x,
        sizes.y,
        sizes.z,
        half_m,
        surface.x,
        surface.y,
        surface.z,
        surface.w,
        row_vector(center),
        bitcast<vec4<f32>>(turn),
        vec3<f32>(0.0, 0.0, 0.0),
        vec3<f32>(0.0, 0.0, 0.0),
    );
    if (number < scene.solids.mover_count) {
        solid.turn = step_block.movers[number].turn;
        solid.velocity = step_block.movers[number].velocity_m_s;
        solid.spin = step_block.movers[number].spin_rad_s;
        solid.center = step_block.movers[number].center_m + solid.velocity * seconds;
    }
    return solid;
}

fn with_sign(number: f32, sign_of: f32) -> f32 {
    return select(number, -number, sign_of < 0.0);
}

fn core_distance(solid: SolidAt, inner: vec3<f32>) -> SolidDistance {
    let radial_squared = max(inner.x * inner.x + inner.z * inner.z, TINY_SQUARED);
    let inv_radial = inverse_sqrt(radial_squared);
    let is_round = (solid.flags & SOLID_ROUND) != 0u;
    let signs = vec3<f32>(with_sign(1.0, inner.x), with_sign(1.0, inner.y), with_sign(1.0, inner.z));
    let beyond_x = select(inner.x * signs.x, radial_squared * inv_radial, is_round) - solid.half_m.x;
    let beyond_y = inner.y * signs.y - solid.half_m.y;
    let beyond_z = select(inner.z * signs.z - solid.half_m.z, -1.0, is_round);
    let outside = vec3<f32>(max(beyond_x, 0.0), max(beyond_y, 0.0), max(beyond_z, 0.0));
    let squared = vec3_dot(outside, outside);
    var along = vec3<f32>(1.0, 0.0, 0.0);
    var distance = beyond_x;
    if (TINY_SQUARED < squared) {
        let inverse = inverse_sqrt(squared);
        along = outside * inverse;
        distance = squared * inverse;
    } else if (!is_round && beyond_x < beyond_z && beyond_y < beyond_z) {
        along = vec3<f32>(0.0, 0.0, 1.0);
        distance = beyond_z;
    } else if (beyond_x < beyond_y) {
        along = vec3<f32>(0.0, 1.0, 0.0);
        distance = beyond_y;
    }
    var normal = vec3<f32>(along.x * signs.x, along.y * signs.y, along.z * signs.z);
    if (is_round) {
        normal = vec3<f32>(along.x * (inner.x * inv_radial), along.y * signs.y, along.x * (inner.z * inv_radial));
    }
    return SolidDistance(distance - solid.rounding_m, normal);
}

fn solid_velocity(solid: SolidAt, place: vec3<f32>) -> vec3<f32> {
    let arm = place - solid.center;
    return solid.velocity + vec3_cross(solid.spin, arm);
}
