// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/advance.rs
#import bindings
#import leaf/advance

@compute @workgroup_size(WORKGROUP_SIZE)
fn advance(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let count = arrayLength(&places);
    for (var leaf = id.x; leaf < count; leaf += groups.x * WORKGROUP_SIZE) {
        leaf_advance(leaf);
    }
}
