// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/stack_litter.rs
// Makes the changes of the litter that active leaves wait for, after all leaves have gone through a step.
#import bindings
#import leaf/stack
#import lists/active

// The tables, behind which the heights are: nothing else of them is written.
@group(0) @binding(2) var<storage, read_write> table_words: array<atomic<u32>>;

fn change_height(node: u32, height: u32, is_added: bool) {
    atomicAdd(&table_words[scene.litter.first_row * 4u + node], select(0u - height, height, is_added));
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn stack_litter(@builtin(global_invocation_id) id: vec3<u32>) {
    let lists = scene.wind.interval_steps;
    let turn = list_of(id.x, lists);
    let place = place_of(id.x, lists);
    if (place < active_list.counts[turn]) {
        let leaf = active_list.leaves[list_start(turn) + place];
        if (leaf_changes_litter(places[leaf].bits)) {
            let change = leaf_stack(leaf);
            let line = scene.litter.columns + 1u;
            let near = change.shares.node;
            let heights = change.shares.heights;
            change_height(near, heights.x, change.is_added);
            change_height(near + 1u, heights.y, change.is_added);
            change_height(near + line, heights.z, change.is_added);
            change_height(near + line + 1u, heights.w, change.is_added);
            if (change.is_woken) {
                change_height(line * (scene.litter.lines + 1u), 1u, true);
            }
        }
    }
}
