// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/tree/sway/row.rs
#import tree/bindings
#import tree/sway/fold
#import tree/sway/load
#import tree/sway/unfold

fn timber_floats(row: u32, index: u32) -> vec4<f32> {
    return bitcast<vec4<f32>>(timber_rows[row * TIMBER_ROWS + index]);
}

// Parent, first child, number of children, tree.
fn timber_links(row: u32) -> vec4<u32> {
    return timber_rows[row * TIMBER_ROWS + (TIMBER_ROWS - 1u)];
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

fn store_articulated(row: u32, body: Articulated) {
    let at = row * WORK_ROWS;
    work_rows[at] = vec4<f32>(body.rotation.diagonal, body.moment.x);
    work_rows[at + 1u] = vec4<f32>(body.rotation.off, body.moment.y);
    work_rows[at + 2u] = vec4<f32>(body.coupling.x, body.moment.z);
    work_rows[at + 3u] = vec4<f32>(body.coupling.y, body.force.x);
    work_rows[at + 4u] = vec4<f32>(body.coupling.z, body.force.y);
    work_rows[at + 5u] = vec4<f32>(body.mass.diagonal, body.force.z);
    work_rows[at + 6u] = vec4<f32>(body.mass.off, 0.0);
}

fn load_articulated(row: u32) -> Articulated {
    let at = row * WORK_ROWS;
    let a = work_rows[at];
    let b = work_rows[at + 1u];
    let c = work_rows[at + 2u];
    let d = work_rows[at + 3u];
    let e = work_rows[at + 4u];
    let f = work_rows[at + 5u];
    let g = work_rows[at + 6u];
    return Articulated(
        Sym3(a.xyz, b.xyz),
        Mat3(c.xyz, d.xyz, e.xyz),
        Sym3(f.xyz, g.xyz),
        vec3<f32>(a.w, b.w, c.w),
        vec3<f32>(d.w, e.w, f.w),
    );
}

fn store_answer(row: u32, answer: Answer) {
    let at = row * WORK_ROWS + WORK_ANSWER;
    work_rows[at] = vec4<f32>(answer.free, answer.turning.x);
    work_rows[at + 1u] = vec4<f32>(answer.spring.x, answer.turning.y);
    work_rows[at + 2u] = vec4<f32>(answer.spring.y, answer.turning.z);
    work_rows[at + 3u] = vec4<f32>(answer.spring.z, answer.centripetal.x);
    work_rows[at + 4u] = vec4<f32>(answer.lever.x, answer.centripetal.y);
    work_rows[at + 5u] = vec4<f32>(answer.lever.y, answer.centripetal.z);
    work_rows[at + 6u] = vec4<f32>(answer.lever.z, 0.0);
    work_rows[at + 7u] = vec4<f32>(answer.arm, 0.0);
}

fn load_answer(row: u32) -> Answer {
    let at = row * WORK_ROWS + WORK_ANSWER;
    let a = work_rows[at];
    let b = work_rows[at + 1u];
    let c = work_rows[at + 2u];
    let d = work_rows[at + 3u];
    let e = work_rows[at + 4u];
    let f = work_rows[at + 5u];
    let g = work_rows[at + 6u];
    let h = work_rows[at + 7u];
    return Answer(
        a.xyz,
        Mat3(b.xyz, c.xyz, d.xyz),
        Mat3(e.xyz, f.xyz, g.xyz),
        h.xyz,
        vec3<f32>(a.w, b.w, c.w),
        vec3<f32>(d.w, e.w, f.w),
    );
}

fn row_fold(row: u32) {
    let constants = timber_constants(row);
    let links = timber_links(row);
    let body = row_body(row);
    let joint = row_joint(row);
    let parent = parent_body(links.x);
    let axis = segment_axis(body);
    let bearing = f32(bearings[row]);
    var whole = segment_body(constants, body, axis, bearing);
    for (var child = links.y; child < links.y + links.z; child++) {
        whole = articulated_add(whole, load_articulated(child));
    }
    let spring = joint_spring(constants, joint, body, axis, whole.rotation);
    let left = joint_answer(spring.torque, spring.inertia, whole, body, parent);
    store_articulated(row, articulated_shift(left.body, left.answer.arm));
    store_answer(row, left.answer);
}

fn row_unfold(row: u32) {
    let constants = timber_constants(row);
    let parent = timber_links(row).x;
    let answer = load_answer(row);
    var angular = vec3<f32>(0.0, 0.0, 0.0);
    var linear = vec3<f32>(0.0, 0.0, 0.0);
    if (parent != NO_SEGMENT) {
        angular = work_rows[parent * WORK_ROWS].xyz;
        linear = work_rows[parent * WORK_ROWS + 1u].xyz;
    }
    let motion = joint_motion(answer, angular, linear);
    work_rows[row * WORK_ROWS] = vec4<f32>(motion.angular, 0.0);
    work_rows[row * WORK_ROWS + 1u] = vec4<f32>(motion.linear, 0.0);
    let joint = joint_step(row_joint(row), row_body(row), motion.own);
    let body = segment_place(constants, joint, parent_body(parent));
    let columns = level.rows.z;
    branch_rows[BRANCH_TURN * columns + row] = joint.turn;
    branch_rows[BRANCH_RATE * columns + row] = vec4<f32>(joint.rate, 0.0);
    branch_rows[BRANCH_BASE * columns + row] = vec4<f32>(body.base, 0.0);
    branch_rows[BRANCH_POSE * columns + row] = body.pose;
    branch_rows[BRANCH_VELOCITY * columns + row] = vec4<f32>(body.velocity, 0.0);
    branch_rows[BRANCH_SPIN * columns + row] = vec4<f32>(body.spin, 0.0);
}
