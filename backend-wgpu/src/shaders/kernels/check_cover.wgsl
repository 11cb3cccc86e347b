// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/check_cover.rs
// Sees what lies on and beneath the leaves in the litter, in units that have their turn: those that have lost their support leave it.
#import bindings
#import leaf/wake
#import lists/append_active

@compute @workgroup_size(WORKGROUP_SIZE)
fn check_cover(@builtin(global_invocation_id) id: vec3<u32>) {
    let leaf = slot_in_turn(id.x, scene.litter.cover_steps);
    if (leaf < arrayLength(&places) && leaf_check_cover(leaf)) {
        list_released(leaf);
    }
}
