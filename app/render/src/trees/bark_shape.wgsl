// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Moves what grows on branches with them. Rows of the branch columns, now and at rest; a segment turns about its lower
// joint.

#import trees/structs
#import gpu/numbers

@group(2) @binding(0) var<storage, read> branch_base: array<vec4<f32>>;
@group(2) @binding(1) var<storage, read> branch_pose: array<vec4<f32>>;
@group(2) @binding(2) var<storage, read> rest_base: array<vec4<f32>>;
@group(2) @binding(3) var<storage, read> rest_pose: array<vec4<f32>>;

// Turn of a segment since it was at rest.
fn branch_turn(row: u32) -> vec4<f32> {
    let a = branch_pose[row];
    let b = vec4(-rest_pose[row].xyz, rest_pose[row].w);
    return quaternion_product(a, b);
}

// Place to which the segment has taken a point that was at `position` at rest.
fn moved(row: u32, position: vec3<f32>) -> vec3<f32> {
    return branch_base[row].xyz + rotate(branch_turn(row), position - rest_base[row].xyz);
}

struct BarkPoint {
    world: vec3<f32>,
    normal: vec3<f32>,
}

fn bark_point(vertex: BarkVertex) -> BarkPoint {
    var out: BarkPoint;
    for (var slot = 0u; slot < 4u; slot++) {
        let share = vertex.shares[slot];
        if share > 0.0 {
            let row = vertex.rows[slot];
            let turn = branch_turn(row);
            let arm = vertex.position_m - rest_base[row].xyz;
            out.world += share * (branch_base[row].xyz + rotate(turn, arm));
            out.normal += share * rotate(turn, vertex.normal.xyz);
        }
    }
    let sum = max(dot(vertex.shares, vec4(1.0)), 1.0e-6);
    out.world /= sum;
    out.normal = normalize(out.normal);
    return out;
}
