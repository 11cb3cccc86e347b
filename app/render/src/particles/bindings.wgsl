// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// Particles and their looks, as list and picture read them.

#import gpu/numbers
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

// Row of the curves before an age, and how far from there to the next row it is.
struct RowPlace {
    row: u32,
    t: f32,
}

// Place of an age, as a share of the life, in a population's curves.
fn row_place(population: u32, share: f32) -> RowPlace {
    let place = share * f32(LOOK_ROWS - 1u);
    let low = min(u32(place), LOOK_ROWS - 2u);
    return RowPlace(population * LOOK_ROWS + low, place - f32(low));
}

// Values between two rows.
fn row_between(first: LookRow, second: LookRow, t: f32) -> LookRow {
    var row = first;
    row.color = mix(first.color, second.color, t);
    row.opacity = mix(first.opacity, second.opacity, t);
    row.size = mix(first.size, second.size, t);
    return row;
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

// A number from 0 to 1 of a particle's own.
fn own_number(id: u32, population: u32) -> f32 {
    return unit_from(hash_u32(id ^ hash_u32(population)));
}

// Share of its light that a particle gives at a moment: blinking ones are dark for most of a period, then flash, swelling and dying.
fn blink_share(look: PopulationLook, time_s: f32, own: f32) -> f32 {
    if look.blink_s <= 0.0 {
        return 1.0;
    }
    let phase = fract(time_s / look.blink_s + own);
    return smoothstep(0.0, 0.12, phase) * (1.0 - smoothstep(0.18, 0.42, phase));
}
