// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/flight/body.rs
#import bindings
#import kernel/math

struct LeafBody {
    size: vec2<f32>,
    air: vec4<f32>,
    torque: vec4<f32>,
    reach: vec4<f32>,
    resistance: f32,
    ease: vec3<f32>,
    gyration: vec3<f32>,
    arm: vec3<f32>,
}

fn body_quirk(size: u32, number: u32) -> f32 {
    return (f32((size >> (QUIRK_SHIFT + 4u * number)) & QUIRK_MASK) - QUIRK_MIDDLE) * QUIRK_UNIT;
}

fn body_of(bits: u32, size: u32) -> LeafBody {
    let species = (bits >> SPECIES_SHIFT) & SPECIES_MASK;
    let air = environment.bodies[species].air;
    let torque = environment.bodies[species].torque;
    let inertia = environment.bodies[species].inertia;
    let middle = environment.bodies[species].arm;
    let quirks = environment.bodies[species].quirks;

    let ratio = f32(size & HALF_MASK) * SIZE_UNIT;
    let smallness = reciprocal(ratio);
    let dragged = inertia.w * ratio;
    let x = inertia.x + dragged;
    let y = inertia.y;
    let z = inertia.z + dragged;
    let ease = vec3<f32>(reciprocal(x), reciprocal(y), reciprocal(z));
    let gyration = vec3<f32>(
        ((y - z) * ease.x) * smallness,
        ((z - x) * ease.y) * smallness,
        ((x - y) * ease.z) * smallness,
    );
    let arm = vec3<f32>(
        middle.x + body_quirk(size, 0u) * quirks.x,
        middle.y + body_quirk(size, 1u) * quirks.y,
        middle.z + body_quirk(size, 2u) * quirks.z,
    );
    let added = air.y * ratio;
    let swing = (arm.x * arm.x) * ease.z + (arm.z * arm.z) * ease.x;
    return LeafBody(
        vec2<f32>(ratio, smallness),
        air,
        vec4<f32>(torque.xyz, torque.w + body_quirk(size, 3u) * quirks.w),
        environment.bodies[species].reach,
        added * reciprocal((added + added * swing) + 1.0),
        ease,
        gyration,
        arm,
    );
}
