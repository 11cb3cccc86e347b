// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/collide.rs
// Lets the active leaves that fly as bodies collide with the others of their cells.
#import bindings
#import leaf/collide
#import lists/active

@group(2) @binding(0) var<storage, read> cells: array<CollisionSums>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn collide(@builtin(global_invocation_id) id: vec3<u32>) {
    let lists = scene.wind.interval_steps;
    let turn = list_of(id.x, lists);
    let place = place_of(id.x, lists);
    if (place < active_list.counts[turn]) {
        let leaf = active_list.leaves[list_start(turn) + place];
        if (flies(places[leaf].bits)) {
            let cell = collision_cell(places[leaf].position);
            leaf_collide(leaf, cell, cells[cell.index]);
        }
    }
}
