// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/tree/sway/row.rs
// One segment in each pass of a step.
#import tree/bindings
#import tree/branch_snow
#import tree/sway/coast
#import tree/sway/composite
#import tree/sway/inward
#import tree/sway/load
#import tree/sway/oliapuram_kumar
#import tree/sway/quigley
#import tree/sway/twig
#import tree/sway/work
#import tree/sway/outward

fn row_body(row: u32) -> Body {
    let columns = level.column_stride;
    return Body(
        branch_rows[BRANCH_BASE * columns + row].xyz,
        branch_rows[BRANCH_POSE * columns + row],
        branch_rows[BRANCH_VELOCITY * columns + row].xyz,
        branch_rows[BRANCH_SPIN * columns + row].xyz,
    );
}

fn row_joint(row: u32) -> Joint {
    let columns = level.column_stride;
    return Joint(branch_rows[BRANCH_TURN * columns + row], branch_rows[BRANCH_RATE * columns + row].xyz);
}

fn parent_body(parent: u32) -> Body {
    if (parent == NO_SEGMENT) {
        let zero = vec3<f32>(0.0, 0.0, 0.0);
        return Body(zero, vec4<f32>(0.0, 0.0, 0.0, 1.0), zero, zero);
    }
    return row_body(parent);
}

fn move_to(row: u32, joint: Joint, body: Body) {
    let columns = level.column_stride;
    branch_rows[BRANCH_TURN * columns + row] = joint.turn;
    branch_rows[BRANCH_RATE * columns + row] = vec4<f32>(joint.rate, 0.0);
    branch_rows[BRANCH_BASE * columns + row] = vec4<f32>(body.base, 0.0);
    branch_rows[BRANCH_POSE * columns + row] = body.pose;
    branch_rows[BRANCH_VELOCITY * columns + row] = vec4<f32>(body.velocity, 0.0);
    branch_rows[BRANCH_SPIN * columns + row] = vec4<f32>(body.spin, 0.0);
}

fn row_air(row: u32) -> vec3<f32> {
    let columns = level.column_stride;
    let is_twig = segments[row].first_child == TWIG;
    let felt = select(row, segments[row].parent, is_twig);
    if (!segment_air_is_sampled()) {
        return branch_rows[BRANCH_AIR * columns + felt].xyz;
    }
    let body = row_body(felt);
    let air = segment_air(body, segment_axis(body), segments[felt].length);
    if (!is_twig) {
        branch_rows[BRANCH_AIR * columns + row] = vec4<f32>(air, 0.0);
    }
    return air;
}

fn row_inward(row: u32) {
    let constants = segments[row];
    let body = row_body(row);
    let joint = row_joint(row);
    let axis = segment_axis(body);
    let products = velocity_products(body, parent_body(constants.parent));
    let leaf_count = f32(leaf_counts[row]);
    let load = segment_load(constants, body, axis, row_air(row), leaf_count, branch_snow_kg(row));
    if (constants.first_child == TWIG) {
        let spring = joint_spring(constants, joint, body, load_trace(load));
        let reduction = twig_response(spring, load, axis, products);
        store_twig_response(row, reduction.response);
        store_articulated(row, articulated_shift(reduction.apparent, products.arm));
        return;
    }
    var whole = segment_body(load, axis);
    for (var child = constants.first_child; child < TWIG; child = segments[child].next_sibling) {
        whole = articulated_add(whole, load_articulated(child));
    }
    let spring = joint_spring(constants, joint, body, sym3_trace(whole.rotation));
    let reduction = joint_response(spring, whole, axis, products);
    store_response(row, reduction.response);
    store_articulated(row, articulated_shift(reduction.apparent, products.arm));
}

fn row_outward(row: u32) {
    let constants = segments[row];
    let before = row_body(row);
    let zero = vec3<f32>(0.0, 0.0, 0.0);
    var above = Acceleration(zero, zero);
    if (constants.parent != NO_SEGMENT) {
        above = load_acceleration(constants.parent);
    }
    var own: vec3<f32>;
    if (constants.first_child == TWIG) {
        own = twig_acceleration(load_twig_response(row), segment_axis(before), above);
    } else {
        let moved = joint_acceleration(load_response(row), above);
        store_acceleration(row, moved.acceleration);
        own = moved.own;
    }
    let joint = joint_step(row_joint(row), before, own);
    let body = segment_place(constants, joint, parent_body(constants.parent));
    move_to(row, joint, body);
}

fn row_gather(row: u32) {
    let constants = segments[row];
    let body = row_body(row);
    let leaf_count = f32(leaf_counts[row]);
    var whole = segment_composite(constants, body, segment_axis(body), row_air(row), leaf_count, branch_snow_kg(row));
    for (var child = constants.first_child; child < TWIG; child = segments[child].next_sibling) {
        let arm = row_body(child).base - body.base;
        whole = composite_add(whole, composite_shift(load_composite(child), arm));
    }
    store_composite(row, whole);
}

fn row_follow(row: u32) {
    let constants = segments[row];
    let body = row_body(row);
    let joint = row_joint(row);
    let whole = load_composite(row);
    var moved: Moved;
    if (scene.sway_scheme == SCHEME_QUIGLEY) {
        moved = quigley_step(constants, joint, body, segment_axis(body), whole);
    } else {
        moved = oliapuram_kumar_step(constants, joint, body, whole);
    }
    let held = joint_held(moved.turn, moved.rate);
    move_to(row, held, segment_place(constants, held, parent_body(constants.parent)));
}

fn row_coast(row: u32) {
    let columns = level.column_stride;
    let body = segment_coast(row_body(row));
    branch_rows[BRANCH_BASE * columns + row] = vec4<f32>(body.base, 0.0);
    branch_rows[BRANCH_POSE * columns + row] = body.pose;
}
