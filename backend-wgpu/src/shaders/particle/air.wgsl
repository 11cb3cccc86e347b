// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/particle/air.rs
// Drag of the air on a particle.
#import bindings
#import arith/math
#import arith/vector
#import particle/draw

fn lost_share(x: f32) -> f32 {
    if (SMALL_EXPONENT < x) {
        return 1.0 - exponential(-x);
    }
    let r = -x;
    let series = EXP_2 + r * (EXP_3 + r * (EXP_4 + r * (EXP_5 + r * (EXP_6 + r * EXP_7))));
    return x - (r * r) * series;
}

fn air_numbers(number: u32, size: u32, a: u32, b: u32) -> vec2<f32> {
    let ratio = f32(size) * PARTICLE_SIZE_UNIT;
    let drag = spread_draw(scene.populations[number].drag, a, b);
    let air = scene.populations[number].air;
    if (air == AIR_QUADRATIC) {
        return vec2<f32>(drag * reciprocal(ratio), 0.0);
    }
    if (air != AIR_LINEAR && air != AIR_STOKES) {
        return vec2<f32>(0.0, 0.0);
    }
    let time_s = select(drag, drag * (ratio * ratio), air == AIR_STOKES);
    return vec2<f32>(lost_share(scene.dt_s * reciprocal(time_s)), time_s);
}

fn air_drag(number: u32, wind: vec3<f32>, velocity: vec3<f32>, air: vec2<f32>) -> vec3<f32> {
    let kind = scene.populations[number].air;
    if (kind == AIR_VACUUM) {
        return velocity;
    }
    let through = velocity - wind;
    if (kind == AIR_QUADRATIC) {
        let squared = vec3_dot(through, through);
        let speed = squared * inverse_sqrt(max(squared, TINY_SQUARED));
        return wind + through * reciprocal(air.x * speed + 1.0);
    }
    return velocity - through * air.x;
}
