// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/gather_collisions.rs
// Adds the active leaves that fly as bodies to the cells of the air that they are in.
#import bindings
#import leaf/collide
#import lists/active

// The words of all cells (CollisionSums).
@group(2) @binding(0) var<storage, read_write> cell_words: array<atomic<u32>>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn gather_collisions(@builtin(global_invocation_id) id: vec3<u32>) {
    let lists = scene.wind.interval_steps;
    let turn = list_of(id.x, lists);
    let place = place_of(id.x, lists);
    if (place < active_list.counts[turn]) {
        let leaf = active_list.leaves[list_start(turn) + place];
        let bits = places[leaf].bits;
        if (flies(bits)) {
            let cell = collision_cell(places[leaf].position);
            let sums = own_sums(cell, bits, schedules[leaf].size, drifts[leaf].velocity);
            let first = cell.index * COLLISION_WORDS;
            atomicAdd(&cell_words[first], sums.count);
            atomicAdd(&cell_words[first + 1u], sums.key);
            atomicAdd(&cell_words[first + 2u], sums.weight);
            atomicAdd(&cell_words[first + 3u], sums.area);
            atomicAdd(&cell_words[first + 4u], sums.momentum.x);
            atomicAdd(&cell_words[first + 5u], sums.momentum.y);
            atomicAdd(&cell_words[first + 6u], sums.momentum.z);
            atomicAdd(&cell_words[first + 7u], sums.energy);
            atomicAdd(&cell_words[first + 8u], sums.place.x);
            atomicAdd(&cell_words[first + 9u], sums.place.y);
            atomicAdd(&cell_words[first + 10u], sums.place.z);
            atomicAdd(&cell_words[first + 11u], sums.virial);
        }
    }
}
