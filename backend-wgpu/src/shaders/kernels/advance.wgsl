// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/advance.rs
// Moves every leaf through one step without an event in it, and lists the others.
#import bindings
#import event_list
#import leaf/advance

@compute @workgroup_size(WORKGROUP_SIZE)
fn advance(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let parity = step_block.index & 1u;
    if (id.x == 0u) {
        atomicStore(&event_list.counts[1u - parity], 0u);
    }
    let count = arrayLength(&places);
    for (var leaf = id.x; leaf < count; leaf += groups.x * WORKGROUP_SIZE) {
        if (!leaf_advance_plain(leaf)) {
            event_list.leaves[atomicAdd(&event_list.counts[parity], 1u)] = leaf;
        }
    }
}
