// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/fly.rs
// Moves the active leaves that fly as bodies through one step.
#import bindings
#import leaf/fly
#import lists/active

@compute @workgroup_size(WORKGROUP_SIZE)
fn fly(@builtin(global_invocation_id) id: vec3<u32>) {
    let lists = scene.wind.interval_steps;
    let turn = list_of(id.x, lists);
    let place = place_of(id.x, lists);
    if (place < active_list.counts[turn]) {
        leaf_fly(active_list.leaves[list_start(turn) + place]);
    }
}
