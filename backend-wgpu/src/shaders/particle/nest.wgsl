// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/particle/nest.rs
// Births of particles by others.
#import particle/bindings
#import particle/fly
#import particle/record

struct NestPlace {
    parent: u32,
    round: u32,
    ordinal: u32,
}

struct NestEvents {
    count: u32,
    last: u32,
}

fn nest_place(number: u32, place: u32) -> NestPlace {
    let fan = scene.populations[number].nest.fan;
    let rounds = scene.populations[number].nest.rounds;
    let group = place / fan;
    let parent = group / rounds;
    return NestPlace(parent, group - parent * rounds, place - group * fan);
}

fn nest_events(number: u32, bits: u32, birth: u32, id: u32, round: u32) -> NestEvents {
    let event = scene.populations[number].nest.event;
    let rounds = scene.populations[number].nest.rounds;
    var count = 0u;
    var first = 0u;
    var turn = id / scene.populations[number].nest.parent_count;
    if (event == NEST_BIRTH) {
        count = u32((bits & PARTICLE_BORN) != 0u);
    } else if (event == NEST_DEATH) {
        count = u32((bits & PARTICLE_DIED) != 0u);
    } else if (event == NEST_HIT) {
        count = particle_struck(bits);
        first = particle_hits(bits) - count;
        turn = turn + first;
    } else {
        let steps = scene.populations[number].nest.steps;
        let state = particle_state(bits);
        let age = step_block.index - birth;
        first = age / steps;
        turn = (step_block.index - scene.populations[number].nest.first_step) / steps;
        let is_alive = state == PARTICLE_ALIVE || state == PARTICLE_RESTING;
        count = u32(is_alive && first != 0u && age == first * steps);
    }
    let ahead = (round + rounds - turn % rounds) % rounds;
    if (count <= ahead) {
        return NestEvents(0u, 0u);
    }
    let more = (count - 1u - ahead) / rounds;
    return NestEvents(more + 1u, first + (ahead + more * rounds));
}

fn nest_id(number: u32, parent: u32, event: u32, ordinal: u32) -> u32 {
    return (parent * scene.populations[number].nest.fan + ordinal) + event * NEST_SPACING;
}

fn nest_rest(number: u32, bits: u32, moment: f32) -> f32 {
    return select(0.0, moment, scene.populations[number].nest.event == NEST_EVERY && (bits & PARTICLE_HIT) == 0u);
}

fn nest_start(number: u32, own: ParticleFlight, parent: ParticleFlight, rest: f32) -> ParticleFlight {
    return ParticleFlight(
        own.position + (parent.position - parent.velocity * (scene.dt_s * rest)),
        own.velocity + parent.velocity * scene.populations[number].nest.inherit,
    );
}
