// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/tree/sway/load.rs
#import arith/math
#import arith/matrix
#import arith/quaternion
#import arith/vector
#import tree/sway/body
#import wind/sample

struct Drag {
    wind: vec3<f32>,
    across: vec3<f32>,
    wood: f32,
    leaves: f32,
}

fn segment_drag(constants: SegmentConstants, axis: vec3<f32>, air: vec3<f32>, velocity: vec3<f32>, leaf_count: f32) -> Drag {
    let wind = air - velocity;
    let across = wind - axis * vec3_dot(wind, axis);
    let squared_across = max(vec3_dot(across, across), TINY_SQUARED);
    let speed_across = squared_across * inverse_sqrt(squared_across);
    var leaves = 0.0;
    if (leaves < leaf_count) {
        let squared = vec3_dot(wind, wind);
        let speed = squared * inverse_sqrt(max(squared, TINY_SQUARED));
        let yielding = reciprocal(speed * constants.leaf_yield + 1.0);
        leaves = ((constants.leaf_drag * leaf_count) * speed) * yielding;
    }
    return Drag(wind, across, constants.wood_drag * speed_across, leaves);
}

fn segment_air_is_sampled() -> bool {
    let first = scene.sway.interval_steps - 1u;
    return ((step_block.index - first) & (scene.wind.interval_steps - 1u)) == 0u;
}

fn segment_air(body: Body, axis: vec3<f32>, length: f32) -> vec3<f32> {
    return wind_at_moment(MOMENT_MIDDLE, body.base + axis * length);
}

fn segment_load(constants: SegmentConstants, body: Body, axis: vec3<f32>, air: vec3<f32>, leaf_count: f32, snow_kg: f32) -> Load {
    let half = constants.length * 0.5;
    let middle = axis * half;
    let velocity = body.velocity + vec3_cross(body.spin, middle);
    let drag = segment_drag(constants, axis, air, velocity, leaf_count);
    let held = drag.wood + drag.leaves;
    let push = drag.across * drag.wood + drag.wind * drag.leaves;

    let leaves = constants.leaf_mass * leaf_count + snow_kg;
    let mass = constants.mass + leaves;
    let moment = constants.first_moment + leaves * half;
    let across = constants.inertia_across + leaves * ((constants.length * constants.length) * THIRD);
    let gravity = scene.gravity_m_s2;
    let dt = scene.sway.dt_s;
    let added = held * dt;
    let heavy = across + added * (half * half);
    let bare = mass + added;

    let turning = vec3_dot(body.spin, axis);
    let gyration = body.spin * ((constants.inertia_along - across) * turning);
    let outward = body.spin * turning - axis * vec3_dot(body.spin, body.spin);
    let levered = gyration + push * half;
    let moved = vec3<f32>(levered.x, levered.y - moment * gravity, levered.z);
    let force = outward * moment - push;
    return Load(
        constants.inertia_along,
        heavy,
        moment + added * half,
        bare - drag.wood * dt,
        bare,
        vec3_cross(moved, axis),
        vec3<f32>(force.x, force.y + mass * gravity, force.z),
    );
}

fn load_trace(load: Load) -> f32 {
    return (load.rotation_along + load.rotation_across) + load.rotation_across;
}

fn segment_body(load: Load, axis: vec3<f32>) -> ArticulatedInertia {
    return ArticulatedInertia(
        sym3_axial(axis, load.rotation_along, load.rotation_across),
        mat3_cross(axis, load.coupling),
        sym3_axial(axis, load.mass_along, load.mass_across),
        load.moment,
        load.force,
    );
}

fn segment_axis(body: Body) -> vec3<f32> {
    return quat_axis_y(body.pose);
}
