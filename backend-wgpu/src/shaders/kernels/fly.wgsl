// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/fly.rs
// Moves the leaves that fly as bodies through one step.
#import bindings
#import leaf/fly

@compute @workgroup_size(WORKGROUP_SIZE)
fn fly(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let count = arrayLength(&places);
    for (var leaf = id.x; leaf < count; leaf += groups.x * WORKGROUP_SIZE) {
        leaf_fly(leaf);
    }
}
