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

fn winds(bits: u32) -> bool {
    return leaf_primitive(bits) == CONE_SPIRAL;
}

fn cone_age(age: u32) -> f32 {
    return f32(age >> 16u) * 65536.0 + f32(age & HALF_MASK);
}

fn cone_share(bits: u32, age: u32) -> f32 {
    let species = leaf_species(bits);
    let share = cone_age(age) * scene.cones.share_per_age[species >> 2u][species & 3u];
    return min(share, 1.0);
}

fn cone_radius(bits: u32, age: u32) -> f32 {
    let species = leaf_species(bits);
    let share = cone_share(bits, age);
    let root = share * inverse_sqrt(max(share, LEAST_SHARE));
    let is_bowl = 0.5 < scene.cones.is_bowl[species >> 2u][species & 3u];
    return select(share, root, is_bowl) * scene.cones.radius_m[species >> 2u][species & 3u];
}

fn cone_table_rate(bits: u32) -> u32 {
    let species = leaf_species(bits);
    return scene.cones.table_rate[species >> 2u][species & 3u];
}

fn cone_orbit_rate(bits: u32) -> u32 {
    let species = leaf_species(bits);
    return scene.cones.orbit_rate[species >> 2u][species & 3u];
}

fn cone_angle(bits: u32, age: u32, heading: u32) -> u32 {
    return mul_q16(age, cone_orbit_rate(bits)) + (heading_angle(heading) << 16u);
}

fn cone_table_phase(bits: u32, age: u32, heading: u32) -> u32 {
    return mul_q16(age, cone_table_rate(bits)) + heading_angle(heading) * SWING_SPREAD;
}

fn cone_offset(bits: u32, age: u32, heading: u32) -> vec3<f32> {
    let radius = cone_radius(bits, age);
    let turn = sin_cos_turns(cone_angle(bits, age, heading));
    return vec3<f32>(turn.y * radius, 0.0, -(turn.x * radius));
}

fn cone_orientation(bits: u32, age: u32, heading: u32, swing: vec4<f32>, spin: u32) -> vec4<f32> {
    let species = leaf_species(bits);
    let slope = cone_radius(bits, age) * scene.cones.bank_per_m[species >> 2u][species & 3u];
    let cosine = inverse_sqrt(slope * slope + 1.0);
    let half_squared = (cosine + 1.0) * 0.5;
    let inverse = inverse_sqrt(half_squared);
    let bank = vec4<f32>(0.0, 0.0, ((slope * cosine) * inverse) * 0.5, half_squared * inverse);
    let turned = sin_cos_half(spin);
    let banked = quat_multiply(bank, quat_turn_after(swing, turned.x, turned.y));
    let orbit = sin_cos_half(cone_angle(bits, age, heading) >> 16u);
    return quat_turn_after(banked, orbit.x, orbit.y);
}

fn cone_start(bits: u32) -> u32 {
    let species = leaf_species(bits);
    return scene.cones.start_age[species >> 2u][species & 3u];
}

fn cone_velocity(bits: u32, age: u32, heading: u32) -> vec3<f32> {
    let species = leaf_species(bits);
    let per_step = scene.cones.share_per_age[species >> 2u][species & 3u] * 65536.0;
    let radius = cone_radius(bits, age);
    let share = cone_share(bits, age);
    let full = scene.cones.radius_m[species >> 2u][species & 3u];
    let inverse = inverse_sqrt(max(share, LEAST_SHARE));
    let growth = select(1.0, inverse * 0.5, scene.cones.is_bowl[species >> 2u][species & 3u] > 0.5);
    let outward = select(0.0, (full * per_step) * growth, share < 1.0);
    let around = radius * (f32(cone_orbit_rate(bits)) * PHASE_RADIANS);
    let turn = sin_cos_turns(cone_angle(bits, age, heading));
    let phase = cone_table_phase(bits, age, heading);
    let table = motion_velocity(motion_table(bits), phase);
    return vec3<f32>(
        turn.y * outward - turn.x * around,
        table.y * (f32(cone_table_rate(bits)) * PHASE_UNIT),
        (-(turn.x * outward)) - turn.y * around,
    );
}
