// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: backend-cpu/src/kernels/follow_leaves.rs
// Lets the particles of burning leaves be where these are at the end of a step.
#import particle/on_leaf_bindings
#import particle/on_leaf

@compute @workgroup_size(WORKGROUP_SIZE)
fn follow_leaves(@builtin(global_invocation_id) id: vec3<u32>) {
    let leaf = id.x;
    if (leaf >= leaf_particles.count) {
        return;
    }
    let slot = leaf_particles.first_leaf + leaf;
    let place = places[leaf];
    let burn = followed_burns[leaf];
    let followed = FollowedLeaf(slot, place.bits, place.position, drifts[leaf].velocity);
    particle_on_leaf(leaf_particles.first + leaf, leaf_particles.population, followed, burn);
}
