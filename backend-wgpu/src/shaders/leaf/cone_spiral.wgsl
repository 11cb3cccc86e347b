// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/leaf/cone_spiral.rs
// The cone spiral: radius and angle as closed forms of a leaf's age, heights and swings from a table.
#import bindings
#import arith/math
#import arith/quaternion
#import arith/rng
#import leaf/record
#import motion/lookup

struct Cone {
    radius_m: f32,
    share_per_age: f32,
    is_bowl: f32,
    bank_per_m: f32,
    orbit_rate: u32,
    table_rate: u32,
    start_age: u32,
}

fn winds(bits: u32) -> bool {
    return leaf_primitive(bits) == CONE_SPIRAL;
}

fn cone_of(bits: u32) -> Cone {
    let vector = leaf_species(bits) >> 2u;
    let lane = leaf_species(bits) & 3u;
    return Cone(
        scene.cones.radius_m[vector][lane],
        scene.cones.share_per_age[vector][lane],
        scene.cones.is_bowl[vector][lane],
        scene.cones.bank_per_m[vector][lane],
        scene.cones.orbit_rate[vector][lane],
        scene.cones.table_rate[vector][lane],
        scene.cones.start_age[vector][lane],
    );
}

fn cone_age(age: u32) -> f32 {
    return f32(age >> 16u) * 65536.0 + f32(age & HALF_MASK);
}

fn cone_share(bits: u32, age: u32) -> f32 {
    let cone = cone_of(bits);
    let share = cone_age(age) * cone.share_per_age;
    return min(share, 1.0);
}

fn cone_radius(bits: u32, age: u32) -> f32 {
    let cone = cone_of(bits);
    let share = cone_share(bits, age);
    let root = share * inverse_sqrt(max(share, LEAST_SHARE));
    let is_bowl = 0.5 < cone.is_bowl;
    return select(share, root, is_bowl) * cone.radius_m;
}

fn cone_angle(bits: u32, age: u32, heading: u32) -> u32 {
    return mul_q16(age, cone_of(bits).orbit_rate) + (heading_angle(heading) << 16u);
}

fn cone_table_phase(bits: u32, age: u32, heading: u32) -> u32 {
    return mul_q16(age, cone_of(bits).table_rate) + heading_angle(heading) * SWING_SPREAD;
}

fn cone_offset(bits: u32, age: u32, heading: u32) -> vec3<f32> {
    let radius = cone_radius(bits, age);
    let turn = sin_cos_turns(cone_angle(bits, age, heading));
    return vec3<f32>(turn.y * radius, 0.0, -(turn.x * radius));
}

fn cone_orientation(bits: u32, age: u32, heading: u32, swing: vec4<f32>, spin: u32) -> vec4<f32> {
    let cone = cone_of(bits);
    let slope = cone_radius(bits, age) * cone.bank_per_m;
    let cosine = inverse_sqrt(slope * slope + 1.0);
    let half_squared = (cosine + 1.0) * 0.5;
    let inverse = inverse_sqrt(half_squared);
    let bank = vec4<f32>(0.0, 0.0, ((slope * cosine) * inverse) * 0.5, half_squared * inverse);
    let turned = sin_cos_half(spin);
    let banked = quat_multiply(bank, quat_turn_after(swing, turned.x, turned.y));
    let orbit = sin_cos_half(cone_angle(bits, age, heading) >> 16u);
    return quat_turn_after(banked, orbit.x, orbit.y);
}

fn cone_velocity(bits: u32, age: u32, heading: u32) -> vec3<f32> {
    let cone = cone_of(bits);
    let per_step = cone.share_per_age * 65536.0;
    let radius = cone_radius(bits, age);
    let share = cone_share(bits, age);
    let full = cone.radius_m;
    let inverse = inverse_sqrt(max(share, LEAST_SHARE));
    let growth = select(1.0, inverse * 0.5, cone.is_bowl > 0.5);
    let outward = select(0.0, (full * per_step) * growth, share < 1.0);
    let around = radius * (f32(cone.orbit_rate) * PHASE_RADIANS);
    let turn = sin_cos_turns(cone_angle(bits, age, heading));
    let phase = cone_table_phase(bits, age, heading);
    let table = motion_velocity(motion_table(bits), phase);
    return vec3<f32>(
        turn.y * outward - turn.x * around,
        table.y * (f32(cone.table_rate) * PHASE_UNIT),
        (-(turn.x * outward)) - turn.y * around,
    );
}
