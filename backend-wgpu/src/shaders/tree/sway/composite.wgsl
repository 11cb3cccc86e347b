// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/tree/sway/composite.rs
#import arith/matrix
#import arith/vector
#import tree/sway/body
#import tree/sway/load

struct Composite {
    inertia: Sym3,
    moment: vec3<f32>,
    mass: f32,
    torque: vec3<f32>,
    force: vec3<f32>,
    drag: f32,
    drag_moment: vec3<f32>,
    drag_inertia: f32,
}

fn segment_composite(
    constants: SegmentConstants,
    body: Body,
    axis: vec3<f32>,
    air: vec3<f32>,
    leaf_count: f32,
    snow_kg: f32,
) -> Composite {
    let half = constants.length * 0.5;
    let middle = axis * half;
    let velocity = body.velocity + vec3_cross(body.spin, middle);
    let drag = segment_drag(constants, axis, air, velocity, leaf_count);
    let held = drag.wood + drag.leaves;
    let push = air * held - axis * (vec3_dot(air, axis) * drag.wood);

    let leaves = constants.leaf_mass * leaf_count + snow_kg;
    let mass = constants.mass + leaves;
    let moment = constants.first_moment + leaves * half;
    let across = constants.inertia_across + leaves * ((constants.length * constants.length) * THIRD);
    let weight = vec3<f32>(0.0, -scene.gravity_m_s2, 0.0);
    return Composite(
        sym3_axial(axis, constants.inertia_along, across),
        axis * moment,
        mass,
        vec3_cross(middle, push) + vec3_cross(axis, weight) * moment,
        push + weight * mass,
        held,
        middle * held,
        held * (half * half),
    );
}

fn composite_add(a: Composite, b: Composite) -> Composite {
    return Composite(
        sym3_add(a.inertia, b.inertia),
        a.moment + b.moment,
        a.mass + b.mass,
        a.torque + b.torque,
        a.force + b.force,
        a.drag + b.drag,
        a.drag_moment + b.drag_moment,
        a.drag_inertia + b.drag_inertia,
    );
}

fn composite_shift(body: Composite, arm: vec3<f32>) -> Composite {
    let swung = arm * body.mass + body.moment * 2.0;
    let round = vec3_dot(arm, swung);
    let own = arm * body.mass + body.moment;
    let moved = Sym3(
        vec3<f32>(
            round - (arm.x * own.x + body.moment.x * arm.x),
            round - (arm.y * own.y + body.moment.y * arm.y),
            round - (arm.z * own.z + body.moment.z * arm.z),
        ),
        vec3<f32>(
            -(arm.y * own.z + body.moment.y * arm.z),
            -(arm.x * own.z + body.moment.x * arm.z),
            -(arm.x * own.y + body.moment.x * arm.y),
        ),
    );
    let reach = vec3_dot(arm, arm * body.drag + body.drag_moment * 2.0);
    return Composite(
        sym3_add(body.inertia, moved),
        body.moment + arm * body.mass,
        body.mass,
        body.torque + vec3_cross(arm, body.force),
        body.force,
        body.drag,
        body.drag_moment + arm * body.drag,
        body.drag_inertia + reach,
    );
}
