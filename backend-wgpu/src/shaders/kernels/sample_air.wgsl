// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/sample_air.rs
// Samples the air for the active leaves of those units of slots that have their turn. In a world that repeats these are all in some
// steps; in other steps the kernel does not run.
#import bindings
#import leaf/air
#import lists/active

@compute @workgroup_size(WORKGROUP_SIZE)
fn sample_air(@builtin(global_invocation_id) id: vec3<u32>) {
    let lists = sampled_lists();
    let turn = ((0u - step_block.index) & (scene.wind.interval_steps - 1u)) + list_of(id.x, lists);
    let place = place_of(id.x, lists);
    if (place < active_list.counts[turn]) {
        leaf_sample_air(active_list.leaves[list_start(turn) + place]);
    }
}
