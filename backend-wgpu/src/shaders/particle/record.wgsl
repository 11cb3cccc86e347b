// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/particle/record.rs
// Accessors of the packed words of particles.
#import bindings

fn particle_state(bits: u32) -> u32 {
    return bits & PARTICLE_STATE_MASK;
}

fn particle_population(bits: u32) -> u32 {
    return (bits >> POPULATION_SHIFT) & POPULATION_MASK;
}

fn particle_hits(bits: u32) -> u32 {
    return (bits >> HITS_SHIFT) & HITS_MASK;
}

fn particle_struck(bits: u32) -> u32 {
    return select(0u, ((bits >> STRUCK_SHIFT) & STRUCK_MASK) + 1u, (bits & PARTICLE_HIT) != 0u);
}

fn particle_life(life_size: u32) -> u32 {
    return life_size & TRAIT_MASK;
}

fn particle_size(life_size: u32) -> u32 {
    return life_size >> PARTICLE_SIZE_SHIFT;
}

fn particle_bits(state: u32, population: u32) -> u32 {
    return state | (population << POPULATION_SHIFT);
}

fn with_particle_state(bits: u32, state: u32) -> u32 {
    return (bits & ~PARTICLE_STATE_MASK) | state;
}

fn with_more_hits(bits: u32, hits: u32) -> u32 {
    let sum = min(particle_hits(bits) + hits, HITS_MASK);
    let kept = bits & ~((HITS_MASK << HITS_SHIFT) | (STRUCK_MASK << STRUCK_SHIFT));
    return (kept | (sum << HITS_SHIFT)) | (((hits - 1u) << STRUCK_SHIFT) | PARTICLE_HIT);
}

fn life_size_word(life: u32, size: u32) -> u32 {
    return life | (size << PARTICLE_SIZE_SHIFT);
}
