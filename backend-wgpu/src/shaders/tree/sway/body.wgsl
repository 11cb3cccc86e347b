// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/tree/sway/body.rs
// Types of the articulated-body algorithm; the constants of a segment are SegmentConstants of the prelude.
#import arith/matrix

struct Joint {
    turn: vec4<f32>,
    rate: vec3<f32>,
}

struct Body {
    base: vec3<f32>,
    pose: vec4<f32>,
    velocity: vec3<f32>,
    spin: vec3<f32>,
}

struct ArticulatedInertia {
    rotation: Sym3,
    coupling: Mat3,
    mass: Sym3,
    moment: vec3<f32>,
    force: vec3<f32>,
}

struct Load {
    rotation_along: f32,
    rotation_across: f32,
    coupling: f32,
    mass_along: f32,
    mass_across: f32,
    moment: vec3<f32>,
    force: vec3<f32>,
}

struct Spring {
    torque: vec3<f32>,
    along: f32,
    across: f32,
}

struct VelocityProducts {
    arm: vec3<f32>,
    angular: vec3<f32>,
    centripetal: vec3<f32>,
}

struct TwigResponse {
    free: vec3<f32>,
    spring_along: f32,
    spring_across: f32,
    lever: f32,
    products: VelocityProducts,
}

struct JointResponse {
    free: vec3<f32>,
    spring: Mat3,
    lever: Mat3,
    products: VelocityProducts,
}
