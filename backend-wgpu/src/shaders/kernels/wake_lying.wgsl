// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/wake_lying.rs
// Wakes leaves in the litter that the wind takes, in units that have their turn. Those afloat it sets drifting. Only where it blows.
#import bindings
#import leaf/wake
#import lists/append_active

@compute @workgroup_size(WORKGROUP_SIZE)
fn wake_lying(@builtin(global_invocation_id) id: vec3<u32>) {
    let leaf = slot_in_turn(id.x, scene.litter.wake_steps);
    if (leaf < arrayLength(&places) && leaf_wake(leaf)) {
        list_released(leaf);
    }
}
