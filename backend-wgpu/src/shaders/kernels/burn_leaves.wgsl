// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/burn_leaves.rs
// Heats leaves, and lets those that are lit burn on.
#import leaf/burn
#import lists/append_active

// The words of all cells (BurnSums), then the sums of the fires.
@group(2) @binding(2) var<storage, read> heat_words: array<u32>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn burn_leaves(@builtin(global_invocation_id) id: vec3<u32>) {
    let leaf = id.x;
    if (leaf >= arrayLength(&burns)) {
        return;
    }
    let cell = burn_cell(places[leaf].position);
    let first = cell.index * BURN_WORDS;
    let sums = BurnSums(heat_words[first], heat_words[first + 1u], heat_words[first + 2u], 0u);
    if (leaf_burn(leaf, burn_page.first_slot + leaf, cell_power(cell, sums))) {
        list_released(leaf);
    }
}
