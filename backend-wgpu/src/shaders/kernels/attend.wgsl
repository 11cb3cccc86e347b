// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/attend.rs
#import bindings
#import due
#import leaf/advance

@compute @workgroup_size(WORKGROUP_SIZE)
fn attend(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let count = atomicLoad(&due.counts[step_block.index & 1u]);
    for (var index = id.x; index < count; index += groups.x * WORKGROUP_SIZE) {
        leaf_advance(due.leaves[index]);
    }
}
