// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/clear_collisions.rs
// Clears the cells of the air that the active leaves are in, so that all are clear again.
#import bindings
#import leaf/collide
#import lists/active

// The words of all cells (CollisionSums).
@group(2) @binding(0) var<storage, read_write> cell_words: array<atomic<u32>>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn clear_collisions(@builtin(global_invocation_id) id: vec3<u32>) {
    let lists = scene.wind.interval_steps;
    let turn = list_of(id.x, lists);
    let place = place_of(id.x, lists);
    if (place < active_list.counts[turn]) {
        let leaf = active_list.leaves[list_start(turn) + place];
        if (flies(places[leaf].bits)) {
            let first = collision_cell(places[leaf].position).index * COLLISION_WORDS;
            for (var word = 0u; word < COLLISION_WORDS; word++) {
                atomicStore(&cell_words[first + word], 0u);
            }
        }
    }
}
