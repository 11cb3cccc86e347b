// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Shoots of a branchlet, in the frame of the leaf that stands for it: upper side +y, tip towards +z. Lengths are in diameters of a
// leaf. Twin: `branchlet.rs`.

#import gpu/numbers
#import trees/structs

fn signed_bytes(word: u32) -> vec4<f32> {
    return vec4<f32>((vec4<u32>(word) >> vec4(0u, 8u, 16u, 24u)) & vec4(255u)) / 127.5 - 1.0;
}

// Key of the branchlet that the leaf of a slot stands for.
fn branchlet_key(slot: u32) -> u32 {
    return hash_u32(slot ^ 0x5b3a71u);
}

struct Shoot {
    toward: vec3<f32>,
    length: f32,
    // Angle between its middle and the leaf's, about the leaf's upper side.
    yaw: f32,
    // Rise of its end above where it sets out for, per length.
    rise: f32,
}

// Point of a shoot as a share of its length from the leaf that stands for the branchlet.
fn shoot_point(shoot: Shoot, along: f32) -> vec3<f32> {
    return (shoot.toward * along + vec3(0.0, shoot.rise * along * abs(along), 0.0)) * shoot.length;
}

fn shoot_count(count: f32) -> u32 {
    return max(u32(ceil(count / SHOOT_LEAVES)), 1u);
}

// Shoot `number` of a branchlet of `count` leaves.
fn shoot_of(count: f32, number: u32, key: u32) -> Shoot {
    let shoots = shoot_count(count);
    let astray = signed_bytes(hash_u32(key + number));
    let in_fan = (f32(number) + 0.5) / f32(shoots) * 2.0 - 1.0;
    let yaw = SHOOT_FAN_RAD * in_fan + SHOOT_YAW_RAD * astray.x;
    let pitch = SHOOT_PITCH_RAD * astray.y;
    let toward = vec3(sin(yaw) * cos(pitch), sin(pitch), cos(yaw) * cos(pitch));
    let length = SHOOT_LENGTH * sqrt(count) * (0.85 + 0.15 * astray.z);
    return Shoot(toward, length, yaw, SHOOT_RISE * (1.0 + astray.w));
}

// Place, and turn, of a leaf of a branchlet.
struct OnShoot {
    place: vec3<f32>,
    turn: vec4<f32>,
}

// The leaf `copy` of a branchlet of `count`.
fn on_shoot(count: f32, copy: u32, key: u32, leaf_key: u32) -> OnShoot {
    let shoots = shoot_count(count);
    let shoot = shoot_of(count, copy % shoots, key);
    let astray = signed_bytes(leaf_key);
    let own = signed_bytes(hash_u32(leaf_key)).xyz * CLUSTER_TURN;
    let rank = copy / shoots;
    let along = min((f32(rank) + 0.5 + 0.5 * astray.w) * f32(shoots) / count, 1.0) - SHOOT_BACK;
    let side = select(-1.0, 1.0, rank % 2u == 0u);
    let aside = vec3(cos(shoot.yaw), 0.0, -sin(shoot.yaw)) * (side * SHOOT_WIDTH);
    let half_turn = 0.5 * (shoot.yaw + side * SHOOT_LEAF_RAD);
    let turned = vec4(0.0, sin(half_turn), 0.0, cos(half_turn));
    return OnShoot(
        shoot_point(shoot, along) + aside + astray.xyz * LEAF_ASTRAY,
        normalize(quaternion_product(turned, vec4(own, 1.0))),
    );
}
