// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/particle/on_leaf.rs
// Particles that are where leaves burn, one for each leaf.
#import leaf/burn
#import particle/birth
#import particle/record

struct FollowedLeaf {
    slot: u32,
    bits: u32,
    place: vec3<f32>,
    velocity: vec3<f32>,
}

fn particle_on_leaf(particle: u32, population: u32, leaf: FollowedLeaf, burn: Burn) {
    let time = step_block.index + 1u;
    let is_alive = particle_state(particle_places[particle].bits) == PARTICLE_ALIVE;
    let still_burns = burn.lit != UNLIT && burn_way(time, burn) < 1.0 && leaf_state(leaf.bits) != STATE_DORMANT;
    if (!still_burns) {
        if (is_alive) {
            let age = time - particle_motions[particle].birth;
            let size = particle_size(particle_traits[particle].life_size);
            particle_traits[particle].life_size = life_size_word(trait_word(f32(bitcast<i32>(age))), size);
        }
        return;
    }
    if (!is_alive) {
        _ = particle_birth(particle, population, leaf.slot);
        let age = time - burn.lit;
        let size = particle_size(particle_traits[particle].life_size);
        particle_motions[particle].birth = time;
        particle_traits[particle].life_size =
            life_size_word(trait_word(burn.steps - f32(bitcast<i32>(age))), size);
    }
    particle_places[particle].position = leaf.place;
    particle_motions[particle].velocity = select(vec3<f32>(0.0, 0.0, 0.0), leaf.velocity, flies(leaf.bits));
}
