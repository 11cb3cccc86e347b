// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/advance.rs
// Moves every active leaf through one step without an event in it, and lists the others.
#import bindings
#import leaf/advance
#import lists/active
#import lists/fill_events

fn list_event(leaf: u32) {
    let parity = step_block.index & 1u;
    let place = atomicAdd(&event_lists.counts[parity], 1u);
    event_lists.leaves[place] = leaf;
    if ((place & (WORKGROUP_SIZE - 1u)) == 0u) {
        atomicMax(&event_lists.groups[parity][0], place / WORKGROUP_SIZE + 1u);
    }
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn advance(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x == 0u) {
        let next = (step_block.index + 1u) & 1u;
        atomicStore(&event_lists.counts[next], 0u);
        atomicStore(&event_lists.groups[next][0], 0u);
    }
    let lists = scene.wind.interval_steps;
    let turn = list_of(id.x, lists);
    let place = place_of(id.x, lists);
    if (place < active_list.counts[turn]) {
        let leaf = active_list.leaves[list_start(turn) + place];
        if (!leaf_advance_plain(leaf)) {
            list_event(leaf);
        }
    }
}
