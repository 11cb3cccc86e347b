// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/push_lying.rs
// Wakes leaves in the litter that are in the way of solid parts that move. Only where some move.
#import bindings
#import leaf/strike
#import lists/append_active

@compute @workgroup_size(WORKGROUP_SIZE)
fn push_lying(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x < arrayLength(&places) && leaf_push(id.x)) {
        list_released(id.x);
    }
}
