// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/tree/sway/row.rs
#import tree/bindings
#import tree/sway/composite
#import tree/sway/inward
#import tree/sway/load
#import tree/sway/oliapuram_kumar
#import tree/sway/quigley
#import tree/sway/twig
#import tree/sway/outward

fn timber_floats(row: u32, index: u32) -> vec4<f32> {
    return bitcast<vec4<f32>>(segment_rows[row * SEGMENT_ROWS + index]);
}

// Parent, first child, next sibling, tree.
fn timber_links(row: u32) -> vec4<u32> {
    return segment_rows[row * SEGMENT_ROWS + (SEGMENT_ROWS - 1u)];
}

fn timber_constants(row: u32) -> Constants {
    let rest = timber_floats(row, 0u);
    let offset = timber_floats(row, 1u);
    let wood = timber_floats(row, 2u);
    let air = timber_floats(row, 3u);
    let preload = timber_floats(row, 4u);
    let spring = timber_floats(row, 5u);
    return Constants(
        rest, offset.xyz, offset.w, wood.x, wood.y, wood.z, wood.w, air.x, air.y, air.z, air.w, preload.xyz, preload.w,
        spring.x, spring.y, spring.z, spring.w,
    );
}

fn branch_row(column: u32, row: u32) -> vec4<f32> {
    return branch_rows[column * level.rows.z + row];
}

fn row_body(row: u32) -> Body {
    return Body(
        branch_row(BRANCH_BASE, row).xyz,
        branch_row(BRANCH_POSE, row),
        branch_row(BRANCH_VELOCITY, row).xyz,
        branch_row(BRANCH_SPIN, row).xyz,
    );
}

fn row_joint(row: u32) -> Joint {
    return Joint(branch_row(BRANCH_TURN, row), branch_row(BRANCH_RATE, row).xyz);
}

fn parent_body(parent: u32) -> Body {
    if (parent == NO_SEGMENT) {
        let zero = vec3<f32>(0.0, 0.0, 0.0);
        return Body(zero, vec4<f32>(0.0, 0.0, 0.0, 1.0), zero, zero);
    }
    return row_body(parent);
}

fn move_to(row: u32, joint: Joint, body: Body) {
    let columns = level.rows.z;
    branch_rows[BRANCH_TURN * columns + row] = joint.turn;
    branch_rows[BRANCH_RATE * columns + row] = vec4<f32>(joint.rate, 0.0);
    branch_rows[BRANCH_BASE * columns + row] = vec4<f32>(body.base, 0.0);
    branch_rows[BRANCH_POSE * columns + row] = body.pose;
    branch_rows[BRANCH_VELOCITY * columns + row] = vec4<f32>(body.velocity, 0.0);
    branch_rows[BRANCH_SPIN * columns + row] = vec4<f32>(body.spin, 0.0);
}

fn store_articulated(row: u32, body: ArticulatedInertia) {
    let at = row * WORK_ROWS;
    work_rows[at] = vec4<f32>(body.rotation.diagonal, body.moment.x);
    work_rows[at + 1u] = vec4<f32>(body.rotation.off, body.moment.y);
    work_rows[at + 2u] = vec4<f32>(body.coupling.x, body.moment.z);
    work_rows[at + 3u] = vec4<f32>(body.coupling.y, body.force.x);
    work_rows[at + 4u] = vec4<f32>(body.coupling.z, body.force.y);
    work_rows[at + 5u] = vec4<f32>(body.mass.diagonal, body.force.z);
    work_rows[at + 6u] = vec4<f32>(body.mass.off, 0.0);
}

fn load_articulated(row: u32) -> ArticulatedInertia {
    let at = row * WORK_ROWS;
    let a = work_rows[at];
    let b = work_rows[at + 1u];
    let c = work_rows[at + 2u];
    let d = work_rows[at + 3u];
    let e = work_rows[at + 4u];
    let f = work_rows[at + 5u];
    let g = work_rows[at + 6u];
    return ArticulatedInertia(
        Sym3(a.xyz, b.xyz),
        Mat3(c.xyz, d.xyz, e.xyz),
        Sym3(f.xyz, g.xyz),
        vec3<f32>(a.w, b.w, c.w),
        vec3<f32>(d.w, e.w, f.w),
    );
}

fn store_response(row: u32, response: JointResponse) {
    let at = row * WORK_ROWS + WORK_RESPONSE;
    let products = response.products;
    work_rows[at] = vec4<f32>(response.free, products.angular.x);
    work_rows[at + 1u] = vec4<f32>(response.spring.x, products.angular.y);
    work_rows[at + 2u] = vec4<f32>(response.spring.y, products.angular.z);
    work_rows[at + 3u] = vec4<f32>(response.spring.z, products.centripetal.x);
    work_rows[at + 4u] = vec4<f32>(response.lever.x, products.centripetal.y);
    work_rows[at + 5u] = vec4<f32>(response.lever.y, products.centripetal.z);
    work_rows[at + 6u] = vec4<f32>(response.lever.z, 0.0);
    work_rows[at + 7u] = vec4<f32>(products.arm, 0.0);
}

fn load_response(row: u32) -> JointResponse {
    let at = row * WORK_ROWS + WORK_RESPONSE;
    let a = work_rows[at];
    let b = work_rows[at + 1u];
    let c = work_rows[at + 2u];
    let d = work_rows[at + 3u];
    let e = work_rows[at + 4u];
    let f = work_rows[at + 5u];
    let g = work_rows[at + 6u];
    let h = work_rows[at + 7u];
    return JointResponse(
        a.xyz,
        Mat3(b.xyz, c.xyz, d.xyz),
        Mat3(e.xyz, f.xyz, g.xyz),
        VelocityProducts(h.xyz, vec3<f32>(a.w, b.w, c.w), vec3<f32>(d.w, e.w, f.w)),
    );
}

fn store_twig_response(row: u32, response: TwigResponse) {
    let at = row * WORK_ROWS + WORK_RESPONSE;
    work_rows[at] = vec4<f32>(response.free, response.spring_along);
    work_rows[at + 1u] = vec4<f32>(response.products.arm, response.spring_across);
    work_rows[at + 2u] = vec4<f32>(response.products.angular, response.lever);
    work_rows[at + 3u] = vec4<f32>(response.products.centripetal, 0.0);
}

fn load_twig_response(row: u32) -> TwigResponse {
    let at = row * WORK_ROWS + WORK_RESPONSE;
    let a = work_rows[at];
    let b = work_rows[at + 1u];
    let c = work_rows[at + 2u];
    let d = work_rows[at + 3u];
    return TwigResponse(a.xyz, a.w, b.w, c.w, VelocityProducts(b.xyz, c.xyz, d.xyz));
}

fn row_air(row: u32) -> vec3<f32> {
    let links = timber_links(row);
    let feels = select(row, links.x, links.y == TWIG);
    let body = row_body(feels);
    return segment_air(body, segment_axis(body), timber_floats(feels, 1u).w);
}

fn row_inward(row: u32) {
    let constants = timber_constants(row);
    let links = timber_links(row);
    let body = row_body(row);
    let joint = row_joint(row);
    let axis = segment_axis(body);
    let products = velocity_products(body, parent_body(links.x));
    let bearing = f32(bearings[row]);
    let load = segment_load(constants, body, axis, row_air(row), bearing);
    if (links.y == TWIG) {
        let spring = joint_spring(constants, joint, body, load_trace(load));
        let reduction = twig_response(spring, load, axis, products);
        store_twig_response(row, reduction.response);
        store_articulated(row, articulated_shift(reduction.apparent, products.arm));
        return;
    }
    var whole = segment_body(load, axis);
    for (var child = links.y; child < TWIG; child = timber_links(child).z) {
        whole = articulated_add(whole, load_articulated(child));
    }
    let spring = joint_spring(constants, joint, body, sym3_trace(whole.rotation));
    let reduction = joint_response(spring, whole, axis, products);
    store_response(row, reduction.response);
    store_articulated(row, articulated_shift(reduction.apparent, products.arm));
}

fn row_outward(row: u32) {
    let constants = timber_constants(row);
    let links = timber_links(row);
    let parent = links.x;
    let before = row_body(row);
    let zero = vec3<f32>(0.0, 0.0, 0.0);
    var above = Acceleration(zero, zero);
    if (parent != NO_SEGMENT) {
        above = Acceleration(work_rows[parent * WORK_ROWS].xyz, work_rows[parent * WORK_ROWS + 1u].xyz);
    }
    var own: vec3<f32>;
    if (links.y == TWIG) {
        own = twig_acceleration(load_twig_response(row), segment_axis(before), above);
    } else {
        let moved = joint_acceleration(load_response(row), above);
        work_rows[row * WORK_ROWS] = vec4<f32>(moved.acceleration.angular, 0.0);
        work_rows[row * WORK_ROWS + 1u] = vec4<f32>(moved.acceleration.linear, 0.0);
        own = moved.own;
    }
    let joint = joint_step(row_joint(row), before, own);
    let body = segment_place(constants, joint, parent_body(parent));
    move_to(row, joint, body);
}

fn store_composite(row: u32, whole: Composite) {
    let at = row * WORK_ROWS;
    work_rows[at] = vec4<f32>(whole.inertia.diagonal, whole.mass);
    work_rows[at + 1u] = vec4<f32>(whole.inertia.off, whole.drag);
    work_rows[at + 2u] = vec4<f32>(whole.moment, whole.drag_inertia);
    work_rows[at + 3u] = vec4<f32>(whole.torque, 0.0);
    work_rows[at + 4u] = vec4<f32>(whole.force, 0.0);
    work_rows[at + 5u] = vec4<f32>(whole.drag_moment, 0.0);
}

fn load_composite(row: u32) -> Composite {
    let at = row * WORK_ROWS;
    let a = work_rows[at];
    let b = work_rows[at + 1u];
    let c = work_rows[at + 2u];
    return Composite(
        Sym3(a.xyz, b.xyz),
        c.xyz,
        a.w,
        work_rows[at + 3u].xyz,
        work_rows[at + 4u].xyz,
        b.w,
        work_rows[at + 5u].xyz,
        c.w,
    );
}

fn row_gather(row: u32) {
    let constants = timber_constants(row);
    let links = timber_links(row);
    let body = row_body(row);
    let bearing = f32(bearings[row]);
    var whole = segment_composite(constants, body, segment_axis(body), row_air(row), bearing);
    for (var child = links.y; child < TWIG; child = timber_links(child).z) {
        let arm = row_body(child).base - body.base;
        whole = composite_add(whole, composite_shift(load_composite(child), arm));
    }
    store_composite(row, whole);
}

fn row_follow(row: u32) {
    let constants = timber_constants(row);
    let body = row_body(row);
    let joint = row_joint(row);
    let whole = load_composite(row);
    var moved: Moved;
    if (environment.sway_scheme == SCHEME_QUIGLEY) {
        moved = quigley_step(constants, joint, body, segment_axis(body), whole);
    } else {
        moved = oliapuram_kumar_step(constants, joint, body, whole);
    }
    let held = joint_held(moved.turn, moved.rate);
    move_to(row, held, segment_place(constants, held, parent_body(timber_links(row).x)));
}
