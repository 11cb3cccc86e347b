// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/wake_lying.rs
// Wakes leaves that lie in the litter: those in the way of solid parts that move, and, in units that have their turn, those that the wind
// takes. Invocations are those of these units, or, where parts move, of all.
#import bindings
#import leaf/strike
#import leaf/wake
#import lists/append_active

@compute @workgroup_size(WORKGROUP_SIZE)
fn wake_lying(@builtin(global_invocation_id) id: vec3<u32>) {
    // Solid parts that move may come upon any leaf.
    let turns = select(scene.litter.wake_steps, 1u, scene.solids.mover_count != 0u);
    let unit = (id.x >> AIR_UNIT_SHIFT) * turns + ((0u - step_block.index) & (turns - 1u));
    let leaf = (unit << AIR_UNIT_SHIFT) | (id.x & ((1u << AIR_UNIT_SHIFT) - 1u));
    if (leaf < arrayLength(&places)) {
        var leaves_litter = leaf_push(leaf);
        if (!leaves_litter && cover_is_due(leaf)) {
            leaves_litter = leaf_check_cover(leaf);
        }
        if (leaves_litter || (wake_is_due(leaf) && scene.litter.is_calm == 0u && leaf_wake(leaf))) {
            list_released(leaf);
        }
    }
}
