// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/wake_lying.rs
// Samples the wind at the leaves that lie in the litter, for the units that have their turn: invocations are those of these units.
#import bindings
#import leaf/wake
#import lists/append_active

@compute @workgroup_size(WORKGROUP_SIZE)
fn wake_lying(@builtin(global_invocation_id) id: vec3<u32>) {
    let turns = scene.litter.wake_steps;
    let unit = (id.x >> AIR_UNIT_SHIFT) * turns + ((0u - step_block.index) & (turns - 1u));
    let leaf = (unit << AIR_UNIT_SHIFT) | (id.x & ((1u << AIR_UNIT_SHIFT) - 1u));
    if (leaf < arrayLength(&places) && wake_is_due(leaf)) {
        var leaves_litter = false;
        if (cover_is_due(leaf)) {
            leaves_litter = leaf_check_cover(leaf);
        }
        if (leaves_litter || (scene.litter.is_calm == 0u && leaf_wake(leaf))) {
            list_released(leaf);
        }
    }
}
