// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The functions of the schemes that move joints one by one.

use windfall_core::device::tree::sway::composite::{
    Composite, composite_add, composite_shift, segment_composite,
};
use windfall_core::device::tree::sway::load::segment_axis;
use windfall_core::device::tree::sway::oliapuram_kumar::oliapuram_kumar_step;
use windfall_core::device::tree::sway::outward::joint_held;
use windfall_core::device::tree::sway::quigley::quigley_step;

use super::bodies::{
    DIAGONAL, DIRECTION, LENGTH, OFF, PLACE, PRELOAD, QUATERNION, Results, SCALARS, SPRINGS, TURN,
    TURN_COSINE, VELOCITY, body, constants, joint, sym3,
};
use super::{Function, Input, float, functions, vector};
use crate::runner::Words;

fn composite(words: &Words, at: usize) -> Composite {
    Composite {
        inertia: sym3(words, at),
        moment: vector(words, at + 6),
        mass: float(words[at + 9]),
        torque: vector(words, at + 10),
        force: vector(words, at + 13),
        drag: float(words[at + 16]),
        drag_moment: vector(words, at + 17),
        drag_inertia: float(words[at + 20]),
    }
}

fn results(c: &Composite) -> Results {
    let heavy = Results::new().sym3(c.inertia).vec3(c.moment).floats(&[c.mass]).vec3(c.torque).vec3(c.force);
    heavy.floats(&[c.drag]).vec3(c.drag_moment).floats(&[c.drag_inertia])
}

/// A body of which only what a joint's step reads is given: inertia, torque, drag about the joint.
fn carried(words: &Words, at: usize) -> Composite {
    let torque = vector(words, at + 6);
    let drag_inertia = float(words[at + 9]);
    Composite {
        inertia: sym3(words, at),
        moment: torque,
        mass: drag_inertia,
        torque,
        force: torque,
        drag: drag_inertia,
        drag_moment: torque,
        drag_inertia,
    }
}

functions! {
    SCHEME_FUNCTIONS;

    segment_composite in "tree/sway/composite" (
        QUATERNION, DIRECTION, LENGTH, SCALARS, PRELOAD, SPRINGS, PLACE, QUATERNION, VELOCITY, VELOCITY,
        Input::Below(500), VELOCITY, Input::Float(0.0, 3.0)
    ) tolerance Some(1e-5);
    wgsl "let body = in_body(22u);
        let whole = segment_composite(
            in_constants(0u), body, segment_axis(body), in_vec3(36u), f32(in_word(35u)), in_float(39u));
        out_sym3(0u, whole.inertia); out_vec3(6u, whole.moment); out_float(9u, whole.mass); out_vec3(10u, whole.torque);
        out_vec3(13u, whole.force); out_float(16u, whole.drag); out_vec3(17u, whole.drag_moment);
        out_float(20u, whole.drag_inertia);";
    rust |cx, w| {
        let body = body(w, 22);
        let axis = segment_axis(&body);
        results(&segment_composite(cx, &constants(w, 0), &body, axis, vector(w, 36), w[35] as f32, float(w[39]))).0
    };

    composite_shift in "tree/sway/composite" (Input::Floats(42, -9.0, 9.0), DIRECTION) tolerance Some(4e-6);
    wgsl "let moved = Composite(in_sym3(0u), in_vec3(6u), in_float(9u), in_vec3(10u), in_vec3(13u), in_float(16u),
            in_vec3(17u), in_float(20u));
        let other = Composite(in_sym3(21u), in_vec3(27u), in_float(30u), in_vec3(31u), in_vec3(34u), in_float(37u),
            in_vec3(38u), in_float(41u));
        let whole = composite_add(composite_shift(moved, in_vec3(42u)), other);
        out_sym3(0u, whole.inertia); out_vec3(6u, whole.moment); out_float(9u, whole.mass); out_vec3(10u, whole.torque);
        out_vec3(13u, whole.force); out_float(16u, whole.drag); out_vec3(17u, whole.drag_moment);
        out_float(20u, whole.drag_inertia);";
    rust |_cx, w| {
        let moved = composite_shift(&composite(w, 0), vector(w, 42));
        results(&composite_add(&moved, &composite(w, 21))).0
    };

    quigley_step in "tree/sway/quigley" (
        QUATERNION, DIRECTION, LENGTH, SCALARS, PRELOAD, SPRINGS, TURN, TURN_COSINE, VELOCITY, PLACE, QUATERNION,
        VELOCITY, VELOCITY, DIAGONAL, OFF, VELOCITY, Input::Float(0.0, 60.0)
    ) tolerance Some(1e-3);
    wgsl "let body = in_body(29u); let t = in_vec3(48u); let d = in_float(51u);
        let whole = Composite(in_sym3(42u), t, d, t, t, d, t, d);
        let m = quigley_step(in_constants(0u), in_joint(22u), body, segment_axis(body), whole);
        out_vec3(0u, m.turn); out_vec3(3u, m.rate);";
    rust |cx, w| {
        let body = body(w, 29);
        let axis = segment_axis(&body);
        let moved = quigley_step(cx, &constants(w, 0), &joint(w, 22), &body, axis, &carried(w, 42));
        Results::new().vec3(moved.turn).vec3(moved.rate).0
    };

    oliapuram_kumar_step in "tree/sway/oliapuram_kumar" (
        QUATERNION, DIRECTION, LENGTH, SCALARS, PRELOAD, SPRINGS, TURN, TURN_COSINE, VELOCITY, PLACE, QUATERNION,
        VELOCITY, VELOCITY, DIAGONAL, OFF, VELOCITY, Input::Float(0.0, 60.0)
    ) tolerance Some(1e-5);
    wgsl "let t = in_vec3(48u); let d = in_float(51u);
        let whole = Composite(in_sym3(42u), t, d, t, t, d, t, d);
        let m = oliapuram_kumar_step(in_constants(0u), in_joint(22u), in_body(29u), whole);
        out_vec3(0u, m.turn); out_vec3(3u, m.rate);";
    rust |cx, w| {
        let body = body(w, 29);
        let moved = oliapuram_kumar_step(cx, &constants(w, 0), &joint(w, 22), &body, &carried(w, 42));
        Results::new().vec3(moved.turn).vec3(moved.rate).0
    };

    // Rotations on both sides of where they are cut off.
    joint_held in "tree/sway/outward" (Input::Floats(3, -0.9, 0.9), Input::Floats(3, -90.0, 90.0))
    tolerance Some(1e-5);
    wgsl "out_joint(0u, joint_held(in_vec3(0u), in_vec3(3u)));";
    rust |cx, w| Results::new().joint(joint_held(cx, vector(w, 0), vector(w, 3))).0;
}
