// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/stack_litter.rs
// Makes the changes of the litter that active leaves wait for, after all leaves have gone through a step.
#import bindings
#import leaf/stack
#import lists/active

// The tables, behind which the heights are: nothing else of them is written.
@group(0) @binding(2) var<storage, read_write> table_words: array<atomic<u32>>;

fn change_height(node: u32, height: u32) {
    atomicAdd(&table_words[scene.litter.first_row * 4u + node], height);
}

fn change_heights(node: u32, heights: vec4<u32>) {
    let line = scene.litter.columns + 1u;
    if (any(heights != vec4<u32>(0u, 0u, 0u, 0u))) {
        change_height(node, heights.x);
        change_height(node + 1u, heights.y);
        change_height(node + line, heights.z);
        change_height(node + line + 1u, heights.w);
    }
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn stack_litter(@builtin(global_invocation_id) id: vec3<u32>) {
    let lists = scene.wind.interval_steps;
    let turn = list_of(id.x, lists);
    let place = place_of(id.x, lists);
    if (place < active_list.counts[turn]) {
        let leaf = active_list.leaves[list_start(turn) + place];
        if (leaf_changes_litter(places[leaf].bits, drifts[leaf].velocity)) {
            let change = leaf_stack(leaf);
            change_heights(change.taken.node, vec4<u32>(0u, 0u, 0u, 0u) - change.taken.heights);
            change_heights(change.added.node, change.added.heights);
            if (change.is_woken) {
                change_height((scene.litter.columns + 1u) * (scene.litter.lines + 1u), 1u);
            }
        }
    }
}
