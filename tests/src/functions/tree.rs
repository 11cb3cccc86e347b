// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The functions that sway trees.

use windfall_core::arith::matrix::{
    axial_times, mat3_add, mat3_cross, mat3_cross_from_left, mat3_cross_from_right, mat3_product,
    mat3_product_symmetric, mat3_times, mat3_transposed_product_symmetric, mat3_transposed_times,
    mat3_twice_symmetric, sym3_add, sym3_axial, sym3_inverse, sym3_minus, sym3_rows, sym3_times, sym3_trace,
};
use windfall_core::arith::quaternion::{quat_axis_y, quat_of_turn, quat_rotate_back, turn_of_quat};
use windfall_core::device::tree::sway::coast::segment_coast;
use windfall_core::device::tree::sway::inward::{
    articulated_add, articulated_shift, joint_response, joint_spring, velocity_products,
};
use windfall_core::device::tree::sway::load::{
    load_trace, segment_air, segment_air_is_sampled, segment_axis, segment_body, segment_drag, segment_load,
};
use windfall_core::device::tree::sway::outward::{
    Acceleration, joint_acceleration, joint_step, segment_place,
};
use windfall_core::device::tree::sway::twig::{twig_acceleration, twig_response};
use windfall_core::device::tree::sway::{JointResponse, TwigResponse};

use super::bodies::{
    AXIAL, AXIS, COUPLING, DIAGONAL, DIRECTION, LENGTH, LOAD, MATRIX, OFF, PLACE, PRELOAD, QUATERNION,
    Results, SCALARS, SPRINGS, TURN, TURN_COSINE, VELOCITY, articulated, body, constants, joint, load, mat3,
    products, spring, sym3,
};
use super::{Function, Input, float, functions, quaternion, vector};

functions! {
    TREE_FUNCTIONS;

    sym3_sums in "arith/matrix" (DIAGONAL, OFF, DIAGONAL, OFF) tolerance Some(3e-7);
    wgsl "let m = in_sym3(0u); let n = in_sym3(6u);
        out_sym3(0u, sym3_add(m, n)); out_sym3(6u, sym3_minus(m, n)); out_mat3(12u, sym3_rows(m));
        out_float(21u, sym3_trace(m));";
    rust |_cx, w| {
        let (m, n) = (sym3(w, 0), sym3(w, 6));
        Results::new().sym3(sym3_add(m, n)).sym3(sym3_minus(m, n)).mat3(sym3_rows(m)).floats(&[sym3_trace(m)]).0
    };

    sym3_axial in "arith/matrix" (DIRECTION, Input::Floats(2, 0.0, 9.0), DIRECTION) tolerance Some(1e-6);
    wgsl "out_sym3(0u, sym3_axial(in_vec3(0u), in_float(3u), in_float(4u)));
        out_vec3(6u, axial_times(in_vec3(0u), in_float(3u), in_float(4u), in_vec3(5u)));";
    rust |_cx, w| {
        let (axis, along, across) = (vector(w, 0), float(w[3]), float(w[4]));
        Results::new().sym3(sym3_axial(axis, along, across)).vec3(axial_times(axis, along, across, vector(w, 5))).0
    };

    sym3_times in "arith/matrix" (DIAGONAL, OFF, VELOCITY) tolerance Some(4e-6);
    wgsl "let m = in_sym3(0u); out_vec3(0u, sym3_times(m, in_vec3(6u))); out_sym3(3u, sym3_inverse(m));";
    rust |_cx, w| {
        let m = sym3(w, 0);
        Results::new().vec3(sym3_times(m, vector(w, 6))).sym3(sym3_inverse(m)).0
    };

    // Not positive definite: the pivots that the inverse raises.
    sym3_inverse in "arith/matrix" (Input::Floats(3, 0.5, 1.0), Input::Floats(3, -3.0, 3.0)) tolerance Some(2e-2);
    wgsl "out_sym3(0u, sym3_inverse(in_sym3(0u)));";
    rust |_cx, w| Results::new().sym3(sym3_inverse(sym3(w, 0))).0;

    mat3_products in "arith/matrix" (MATRIX, MATRIX) tolerance Some(4e-6);
    wgsl "let m = in_mat3(0u); let n = in_mat3(9u);
        out_mat3(0u, mat3_add(m, n)); out_mat3(9u, mat3_product(m, n));
        out_sym3(18u, mat3_product_symmetric(m, n)); out_sym3(24u, mat3_transposed_product_symmetric(m, n));";
    rust |_cx, w| {
        let (m, n) = (mat3(w, 0), mat3(w, 9));
        let sums = Results::new().mat3(mat3_add(m, n)).mat3(mat3_product(m, n));
        sums.sym3(mat3_product_symmetric(m, n)).sym3(mat3_transposed_product_symmetric(m, n)).0
    };

    mat3_times in "arith/matrix" (MATRIX, VELOCITY, Input::Float(-3.0, 3.0)) tolerance Some(4e-6);
    wgsl "let m = in_mat3(0u); let v = in_vec3(9u);
        out_mat3(0u, mat3_cross(v, in_float(12u))); out_vec3(9u, mat3_times(m, v));
        out_vec3(12u, mat3_transposed_times(m, v)); out_mat3(15u, mat3_cross_from_left(v, m));
        out_mat3(24u, mat3_cross_from_right(m, v)); out_sym3(33u, mat3_twice_symmetric(m));";
    rust |_cx, w| {
        let (m, v) = (mat3(w, 0), vector(w, 9));
        let products = Results::new().mat3(mat3_cross(v, float(w[12]))).vec3(mat3_times(m, v));
        let crossed = products.vec3(mat3_transposed_times(m, v)).mat3(mat3_cross_from_left(v, m));
        crossed.mat3(mat3_cross_from_right(m, v)).sym3(mat3_twice_symmetric(m)).0
    };

    quat_rotate_back in "arith/quaternion" (QUATERNION, VELOCITY) tolerance Some(4e-6);
    wgsl "let q = in_vec4(0u); out_vec3(0u, quat_rotate_back(q, in_vec3(4u))); out_vec3(3u, quat_axis_y(q));";
    rust |_cx, w| {
        let q = quaternion(w, 0);
        Results::new().vec3(quat_rotate_back(q, vector(w, 4))).vec3(quat_axis_y(q)).0
    };

    quat_of_turn in "arith/quaternion" (TURN, TURN_COSINE) tolerance Some(4e-7);
    wgsl "out_vec4(0u, quat_of_turn(in_vec3(0u) * 2.0)); out_vec3(4u, turn_of_quat(in_vec4(0u)));";
    rust |_cx, w| {
        Results::new().quat(quat_of_turn(vector(w, 0) * 2.0)).vec3(turn_of_quat(quaternion(w, 0))).0
    };

    segment_drag in "tree/sway/load" (
        QUATERNION, DIRECTION, LENGTH, SCALARS, PRELOAD, SPRINGS, DIRECTION, VELOCITY, VELOCITY, Input::Below(500)
    ) tolerance Some(4e-6);
    wgsl "let d = segment_drag(in_constants(0u), in_vec3(22u), in_vec3(25u), in_vec3(28u), f32(in_word(31u)));
        out_vec3(0u, d.wind); out_vec3(3u, d.across); out_float(6u, d.wood); out_float(7u, d.leaves);";
    rust |_cx, w| {
        let d = segment_drag(&constants(w, 0), vector(w, 22), vector(w, 25), vector(w, 28), w[31] as f32);
        Results::new().vec3(d.wind).vec3(d.across).floats(&[d.wood, d.leaves]).0
    };

    // The axis is a direction like any other here, so that wood feels a drag that no branch would.
    segment_load in "tree/sway/load" (
        QUATERNION, DIRECTION, LENGTH, SCALARS, PRELOAD, SPRINGS, PLACE, QUATERNION, VELOCITY, VELOCITY,
        Input::Below(500), VELOCITY, Input::Float(0.0, 3.0)
    ) tolerance Some(1e-5);
    wgsl "let body = in_body(22u); let axis = segment_axis(body); out_vec3(11u, axis);
        let l = segment_load(in_constants(0u), body, axis, in_vec3(36u), f32(in_word(35u)), in_float(39u));
        out_float(0u, l.rotation_along); out_float(1u, l.rotation_across); out_float(2u, l.coupling);
        out_float(3u, l.mass_along); out_float(4u, l.mass_across); out_vec3(5u, l.moment); out_vec3(8u, l.force);";
    rust |cx, w| {
        let body = body(w, 22);
        let axis = segment_axis(&body);
        let load = segment_load(cx, &constants(w, 0), &body, axis, vector(w, 36), w[35] as f32, float(w[39]));
        Results::new().load(&load).vec3(axis).0
    };

    segment_air in "tree/sway/load" (PLACE, QUATERNION, VELOCITY, VELOCITY, LENGTH) tolerance Some(1e-5);
    wgsl "let body = in_body(0u); out_vec3(0u, segment_air(body, segment_axis(body), in_float(13u)));
        out_float(3u, f32(segment_air_is_sampled()));";
    rust |cx, w| {
        let body = body(w, 0);
        let sampled = f32::from(u8::from(segment_air_is_sampled(cx)));
        Results::new().vec3(segment_air(cx, &body, segment_axis(&body), float(w[13]))).floats(&[sampled]).0
    };

    segment_body in "tree/sway/load" (LOAD, VELOCITY, VELOCITY, AXIS) tolerance Some(1e-6);
    wgsl "out_articulated(0u, segment_body(in_load(0u), in_vec3(11u))); out_float(27u, load_trace(in_load(0u)));";
    rust |_cx, w| {
        let load = load(w, 0);
        Results::new().articulated(segment_body(&load, vector(w, 11))).floats(&[load_trace(&load)]).0
    };

    articulated_add in "tree/sway/inward" (Input::Floats(54, -9.0, 9.0)) tolerance Some(3e-7);
    wgsl "out_articulated(0u, articulated_add(in_articulated(0u), in_articulated(27u)));";
    rust |_cx, w| Results::new().articulated(articulated_add(&articulated(w, 0), &articulated(w, 27))).0;

    joint_spring in "tree/sway/inward" (
        QUATERNION, DIRECTION, LENGTH, SCALARS, PRELOAD, SPRINGS, TURN, TURN_COSINE, VELOCITY, PLACE, QUATERNION,
        VELOCITY, VELOCITY, Input::Float(6.0, 12.0)
    ) tolerance Some(1e-5);
    wgsl "let spring = joint_spring(in_constants(0u), in_joint(22u), in_body(29u), in_float(42u));
        out_vec3(0u, spring.torque); out_float(3u, spring.along); out_float(4u, spring.across);";
    rust |cx, w| {
        let (joint, body) = (joint(w, 22), body(w, 29));
        let spring = joint_spring(cx, &constants(w, 0), &joint, &body, float(w[42]));
        Results::new().vec3(spring.torque).floats(&[spring.along, spring.across]).0
    };

    velocity_products in "tree/sway/inward" (
        PLACE, QUATERNION, VELOCITY, VELOCITY, PLACE, QUATERNION, VELOCITY, VELOCITY
    ) tolerance Some(4e-6);
    wgsl "let f = velocity_products(in_body(0u), in_body(13u));
        out_vec3(0u, f.arm); out_vec3(3u, f.angular); out_vec3(6u, f.centripetal);";
    rust |_cx, w| Results::new().products(velocity_products(&body(w, 0), &body(w, 13))).0;

    joint_response in "tree/sway/inward" (
        VELOCITY, AXIAL, DIAGONAL, OFF, COUPLING, DIAGONAL, OFF, VELOCITY, VELOCITY, AXIS, DIRECTION, VELOCITY,
        VELOCITY
    ) tolerance Some(4e-6);
    wgsl "let l = joint_response(in_spring(0u), in_articulated(5u), in_vec3(32u), in_products(35u));
        out_response(0u, l.response); out_articulated(30u, l.apparent);";
    rust |_cx, w| {
        let (response, apparent) =
            joint_response(&spring(w, 0), &articulated(w, 5), vector(w, 32), &products(w, 35));
        Results::new().response(response).articulated(apparent).0
    };

    twig_response in "tree/sway/twig" (
        VELOCITY, AXIAL, LOAD, VELOCITY, VELOCITY, AXIS, DIRECTION, VELOCITY, VELOCITY
    ) tolerance Some(4e-6);
    wgsl "let l = twig_response(in_spring(0u), in_load(5u), in_vec3(16u), in_products(19u)); let t = l.response;
        out_vec3(0u, t.free); out_float(3u, t.spring_along); out_float(4u, t.spring_across); out_float(5u, t.lever);
        out_vec3(6u, t.products.arm); out_vec3(9u, t.products.angular); out_vec3(12u, t.products.centripetal);
        out_articulated(15u, l.apparent);";
    rust |_cx, w| {
        let (t, apparent) = twig_response(&spring(w, 0), &load(w, 5), vector(w, 16), &products(w, 19));
        let response = Results::new().vec3(t.free).floats(&[t.spring_along, t.spring_across, t.lever]);
        response.products(t.products).articulated(apparent).0
    };

    twig_acceleration in "tree/sway/twig" (
        VELOCITY, Input::Floats(3, 0.0, 1.0), DIRECTION, VELOCITY, VELOCITY, AXIS, VELOCITY, VELOCITY
    ) tolerance Some(4e-6);
    wgsl "let t = TwigResponse(in_vec3(0u), in_float(3u), in_float(4u), in_float(5u), in_products(6u));
        out_vec3(0u, twig_acceleration(t, in_vec3(15u), Acceleration(in_vec3(18u), in_vec3(21u))));";
    rust |_cx, w| {
        let response = TwigResponse {
            free: vector(w, 0),
            spring_along: float(w[3]),
            spring_across: float(w[4]),
            lever: float(w[5]),
            products: products(w, 6),
        };
        let parent = Acceleration { angular: vector(w, 18), linear: vector(w, 21) };
        Results::new().vec3(twig_acceleration(&response, vector(w, 15), &parent)).0
    };

    articulated_shift in "tree/sway/inward" (DIAGONAL, OFF, COUPLING, DIAGONAL, OFF, VELOCITY, VELOCITY, DIRECTION)
    tolerance Some(4e-6);
    wgsl "out_articulated(0u, articulated_shift(in_articulated(0u), in_vec3(27u)));";
    rust |_cx, w| Results::new().articulated(articulated_shift(&articulated(w, 0), vector(w, 27))).0;

    joint_acceleration in "tree/sway/outward" (
        VELOCITY, Input::Floats(9, -1.0, 1.0), MATRIX, DIRECTION, VELOCITY, VELOCITY, VELOCITY, VELOCITY
    ) tolerance Some(4e-6);
    wgsl "let m = joint_acceleration(in_response(0u), Acceleration(in_vec3(30u), in_vec3(33u)));
        out_vec3(0u, m.acceleration.angular); out_vec3(3u, m.acceleration.linear); out_vec3(6u, m.own);";
    rust |_cx, w| {
        let response = JointResponse {
            free: vector(w, 0),
            spring: mat3(w, 3),
            lever: mat3(w, 12),
            products: products(w, 21),
        };
        let parent = Acceleration { angular: vector(w, 30), linear: vector(w, 33) };
        let (acceleration, own) = joint_acceleration(&response, &parent);
        Results::new().vec3(acceleration.angular).vec3(acceleration.linear).vec3(own).0
    };

    // Rates and accelerations up to where a step's turn is cut short, and joints on both sides of their stop.
    joint_step in "tree/sway/outward" (
        TURN, TURN_COSINE, Input::Floats(3, -50.0, 50.0), PLACE, QUATERNION, VELOCITY, VELOCITY,
        Input::Floats(3, -4000.0, 4000.0)
    ) tolerance Some(4e-6);
    wgsl "out_joint(0u, joint_step(in_joint(0u), in_body(7u), in_vec3(20u)));";
    rust |cx, w| Results::new().joint(joint_step(cx, &joint(w, 0), &body(w, 7), vector(w, 20))).0;

    segment_coast in "tree/sway/coast" (PLACE, QUATERNION, VELOCITY, VELOCITY) tolerance Some(4e-6);
    wgsl "out_body(0u, segment_coast(in_body(0u)));";
    rust |cx, w| Results::new().body(segment_coast(cx, &body(w, 0))).0;

    segment_place in "tree/sway/outward" (
        QUATERNION, DIRECTION, LENGTH, SCALARS, PRELOAD, SPRINGS, TURN, TURN_COSINE, VELOCITY, PLACE, QUATERNION,
        VELOCITY, VELOCITY
    ) tolerance Some(4e-6);
    wgsl "out_body(0u, segment_place(in_constants(0u), in_joint(22u), in_body(29u)));";
    rust |_cx, w| Results::new().body(segment_place(&constants(w, 0), &joint(w, 22), &body(w, 29))).0;
}
