// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/flight/body.rs
#import bindings
#import kernel/math

struct LeafBody {
    size: vec2<f32>,
    air: vec4<f32>,
    reach: vec4<f32>,
    slope: vec2<f32>,
    own: vec2<f32>,
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
    let reach = environment.bodies[species].reach;
    let slope = environment.bodies[species].slope;
    let inertia = environment.bodies[species].inertia;
    let middle = environment.bodies[species].arm;
    let quirks = environment.bodies[species].quirks;

    let ratio = f32(size & HALF_MASK) * SIZE_UNIT;
    let smallness = reciprocal(ratio);
    let x = inertia.x + slope.z * ratio;
    let y = inertia.y;
    let z = inertia.z + slope.w * ratio;
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
        vec4<f32>(reach.xyz, reach.w + body_quirk(size, 3u) * quirks.w),
        slope.xy,
        vec2<f32>(inertia.w, middle.w),
        added * reciprocal((added + added * swing) + 1.0),
        ease,
        gyration,
        arm,
    );
}
