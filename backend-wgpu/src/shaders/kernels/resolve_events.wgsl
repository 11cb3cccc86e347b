// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/resolve_events.rs
// Moves the listed leaves through one step with an event in it.
#import bindings
#import leaf/advance
#import lists/events

@compute @workgroup_size(WORKGROUP_SIZE)
fn resolve_events(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x < event_lists.counts[step_block.index & 1u]) {
        leaf_advance(event_lists.leaves[id.x]);
    }
}
