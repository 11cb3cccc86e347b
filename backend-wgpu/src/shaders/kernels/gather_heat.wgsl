// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/gather_heat.rs
// Adds the heat that burning leaves release to cells of the air and to the fires that they feed.
#import leaf/burn

// The words of all cells (BurnSums), then the sums of the fires.
@group(2) @binding(2) var<storage, read_write> heat_words: array<atomic<u32>>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn gather_heat(@builtin(global_invocation_id) id: vec3<u32>) {
    let leaf = id.x;
    if (leaf >= arrayLength(&burns) || burns[leaf].lit == UNLIT) {
        return;
    }
    let place = places[leaf].position;
    let heat = leaf_heat_release(place, places[leaf].bits, schedules[leaf].size, burns[leaf]);
    if (heat.sums.count == 0u) {
        return;
    }
    let first = heat.index * BURN_WORDS;
    atomicAdd(&heat_words[first], heat.sums.count);
    atomicAdd(&heat_words[first + 1u], heat.sums.key);
    atomicAdd(&heat_words[first + 2u], heat.sums.power);
    for (var plume = 0u; plume < step_block.plume_count; plume++) {
        if (feeds_plume(plume, place)) {
            atomicAdd(&heat_words[(BURN_WORDS << BURN_CELL_BITS) + plume], heat.sums.power);
        }
    }
}
