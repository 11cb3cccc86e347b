// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Particles and their looks, as list and picture read them.

#import particle_records
#import particles/structs

// Time of a particle's birth to now in steps.
fn particle_age(motion: ParticleMotion, step: u32) -> u32 {
    return u32(max(bitcast<i32>(step - motion.birth), 0));
}

// Age as a share of the life; 0 where age does not end it.
fn age_share(age: u32, life_size: u32) -> f32 {
    let life = particle_life(life_size);
    return select(clamp(f32(age) / f32(max(life, 1u)), 0.0, 1.0), 0.0, life == 0u);
}

// Way in which a population is drawn: LOOK_DOT and so on.
fn look_kind(look: PopulationLook) -> u32 {
    return look.kind_flags & LOOK_MASK;
}

// True for particles that are there, moving or at rest.
fn is_there(bits: u32) -> bool {
    let state = particle_state(bits);
    return state == PARTICLE_ALIVE || state == PARTICLE_RESTING;
}
