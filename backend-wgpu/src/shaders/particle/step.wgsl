// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/particle/step.rs
// One step of one particle.
#import particle/bindings
#import arith/vector
#import particle/birth
#import particle/fly
#import particle/local_space
#import particle/nest
#import particle/record
#import particle/strike
#import solid/near
#import terrain/ground
#import tree/branch_fall

struct ParticleChange {
    born: u32,
    died: u32,
    hits: u32,
    stopped: u32,
    cut_short: u32,
}

fn life_is_over(birth: u32, life_size: u32) -> bool {
    let life = particle_life(life_size);
    let age = step_block.index - birth;
    return !(life == 0u || age < life);
}

fn is_outside(number: u32, place: vec3<f32>) -> bool {
    let low = scene.populations[number].low_m;
    let high = scene.populations[number].high_m;
    return place.x < low.x || place.y < low.y || place.z < low.z || high.x < place.x || high.y < place.y || high.z < place.z;
}

fn through_sides(number: u32, place: vec3<f32>) -> vec3<f32> {
    if ((scene.populations[number].flags & POPULATION_THROUGH) == 0u) {
        return place;
    }
    let low = scene.populations[number].low_m;
    let high = scene.populations[number].high_m;
    let width = high - low;
    let none = vec3<f32>(0.0, 0.0, 0.0);
    let again = (place + select(none, width, place < low)) - select(none, width, high < place);
    return vec3<f32>(again.x, place.y, again.z);
}

fn may_be_struck(number: u32, start: vec3<f32>, end: vec3<f32>) -> bool {
    if (scene.populations[number].meets == MEETS_NOTHING) {
        return false;
    }
    let meets_ground = ground_met(end);
    if (scene.solids.count == 0u) {
        return meets_ground;
    }
    return meets_ground || is_in_reach_of_solids(start, end - start);
}

fn is_in_reach_of_solids(start: vec3<f32>, way: vec3<f32>) -> bool {
    let reach_m = scene.solids.reach_m;
    return may_meet_solids_on_way(start, way) || reach_m * reach_m < vec3_dot(way, way);
}

fn rest_is_checked(id: u32) -> bool {
    return ((step_block.index + id) & 7u) == 0u;
}

fn slot_birth(particle: u32, slot: u32, change: ptr<function, ParticleChange>) -> f32 {
    let number = particle_population(particle_places[particle].bits);
    if ((scene.populations[number].flags & POPULATION_BRANCH_SNOW) != 0u) {
        let row = fall_row(slot - scene.populations[number].first_slot);
        if (row == NEVER || particle_state(particle_places[particle].bits) == PARTICLE_ALIVE) {
            return 1.0;
        }
        (*change).born = 1u;
        particle_birth(particle, number, row);
        particle_places[particle].position = fall_start(row);
        return 1.0;
    }
    if (scene.populations[number].nest.fan == 0u) {
        let among = birth_number(number, slot - scene.populations[number].first_slot);
        if (among == NEVER) {
            return 1.0;
        }
        (*change).born = 1u;
        return particle_birth(particle, number, step_block.births[number].first_id + among);
    }
    let place = nest_place(number, slot - scene.populations[number].first_slot);
    // Parents are in the same window, as far from there as their slots are.
    let row = particle - (slot - (scene.populations[number].nest.parent_slot + place.parent));
    let bits = particle_places[row].bits;
    let id = particle_traits[row].id;
    let events = nest_events(number, bits, particle_motions[row].birth, id, place.round);
    (*change).born = events.count;
    if (events.count == 0u) {
        return 1.0;
    }
    let own_id = nest_id(number, id, events.last, place.ordinal);
    let rest = nest_rest(number, bits, particle_birth(particle, number, own_id));
    let own = ParticleFlight(particle_places[particle].position, particle_motions[particle].velocity);
    let parent = ParticleFlight(particle_places[row].position, particle_motions[row].velocity);
    var start = nest_start(number, own, parent, rest);
    if (scene.populations[number].meets != MEETS_NOTHING) {
        start.position = particle_push(start.position, scene.dt_s * (1.0 - rest));
    }
    particle_places[particle].position = start.position;
    particle_motions[particle].velocity = start.velocity;
    return rest;
}

fn slot_frame(particle: u32, slot: u32, birth: u32, new_way_s: f32) -> ParticleFrame {
    let number = particle_population(particle_places[particle].bits);
    let first = scene.populations[number].first_slot;
    let row = particle - (slot - (scene.populations[number].nest.parent_slot + nest_place(number, slot - first).parent));
    let frame = parent_frame(particle_places[row], particle_motions[row], particle_starts[row], birth);
    if (birth == step_block.index) {
        return rest_frame(frame, new_way_s);
    }
    return frame;
}

fn particle_step(particle: u32, slot: u32, mutual: vec3<f32>) -> ParticleChange {
    var change = ParticleChange(0u, 0u, 0u, 0u, 0u);
    let number = particle_population(particle_places[particle].bits);
    let before = particle_state(particle_places[particle].bits);
    let was_alive = before == PARTICLE_ALIVE || before == PARTICLE_RESTING;
    let is_over = was_alive && life_is_over(particle_motions[particle].birth, particle_traits[particle].life_size);
    if ((scene.populations[number].flags & POPULATION_ON_LEAVES) != 0u) {
        if ((scene.populations[number].flags & POPULATION_FOLLOWED) != 0u) {
            particle_starts[particle].position = particle_places[particle].position;
            particle_starts[particle].velocity = particle_motions[particle].velocity;
        }
        return leaf_particle_step(particle);
    }
    particle_places[particle].bits = particle_places[particle].bits & ~PARTICLE_MARKS;
    let rest = slot_birth(particle, slot, &change);
    let is_new = change.born != 0u;
    if (is_new) {
        change.cut_short = change.born - 1u + u32(was_alive);
    } else if (is_over) {
        particle_places[particle].bits = with_particle_state(particle_places[particle].bits, PARTICLE_DEAD) | PARTICLE_DIED;
        change.died = 1u;
    }
    if ((scene.populations[number].flags & POPULATION_FOLLOWED) != 0u) {
        particle_starts[particle].position = particle_places[particle].position;
        particle_starts[particle].velocity = particle_motions[particle].velocity;
    }
    if (is_new) {
        if (rest <= 0.0) {
            return change;
        }
    } else if (!was_alive || is_over || (before == PARTICLE_RESTING && !rest_wakes(number, particle_traits[particle].id))) {
        return change;
    }
    var bits = particle_places[particle].bits;
    let start = ParticleFlight(particle_places[particle].position, particle_motions[particle].velocity);
    let felt = select(mutual, vec3<f32>(0.0, 0.0, 0.0), is_new);
    let time = scene.dt_s * rest;
    let is_local = (scene.populations[number].flags & POPULATION_LOCAL) != 0u;
    var inside = start;
    var frame: ParticleFrame;
    if (is_local) {
        frame = slot_frame(particle, slot, particle_motions[particle].birth, time);
        inside = in_frame(frame, start);
    }
    // The newborn meets the air at once.
    let coasts = !is_new && particle_coasts(number, slot);
    var end = particle_free_step(number, coasts, inside, particle_traits[particle].air, felt);
    if (rest < 1.0) {
        end.position = inside.position + (end.position - inside.position) * rest;
        end.velocity = inside.velocity + (end.velocity - inside.velocity) * rest;
    }
    if (is_local) {
        end = carried_flight(frame, end);
    }
    var state = PARTICLE_ALIVE;
    bits = bits & ~PARTICLE_GROUNDED;
    if (may_be_struck(number, start.position, end.position)) {
        let contact = particle_contact(number, start, end, scene.dt_s - time, time);
        end = contact.flight;
        if (contact.held_by == NEVER) {
            end.position = particle_push(end.position, scene.dt_s);
        } else {
            state = PARTICLE_RESTING;
            end.velocity = vec3<f32>(0.0, 0.0, 0.0);
            if (before == PARTICLE_RESTING && !is_new) {
                end.position = particle_push(start.position, scene.dt_s);
            }
            if (contact.held_by == STRIKE_GROUND) {
                bits = bits | PARTICLE_GROUNDED;
            }
        }
        if (contact.dies) {
            state = PARTICLE_DEAD;
        }
        change.hits = contact.hits;
        change.stopped = u32(contact.is_stopped);
    }
    if (change.hits != 0u) {
        bits = with_more_hits(bits, change.hits);
    }
    end.position = through_sides(number, end.position);
    if (is_outside(number, end.position)) {
        state = PARTICLE_DEAD;
    }
    if (state == PARTICLE_DEAD) {
        change.died += 1u;
        bits = bits | PARTICLE_DIED;
    }
    particle_places[particle].position = end.position;
    particle_places[particle].bits = with_particle_state(bits, state);
    particle_motions[particle].velocity = end.velocity;
    return change;
}

fn leaf_particle_step(particle: u32) -> ParticleChange {
    var change = ParticleChange(0u, 0u, 0u, 0u, 0u);
    let is_alive = particle_state(particle_places[particle].bits) == PARTICLE_ALIVE;
    let birth = particle_motions[particle].birth;
    if (is_alive && birth == step_block.index) {
        change.born = 1u;
        return change;
    }
    particle_places[particle].bits &= ~PARTICLE_MARKS;
    if (is_alive && life_is_over(birth, particle_traits[particle].life_size)) {
        particle_places[particle].bits =
            with_particle_state(particle_places[particle].bits, PARTICLE_DEAD) | PARTICLE_DIED;
        change.died = 1u;
    }
    return change;
}

fn rest_wakes(number: u32, id: u32) -> bool {
    return scene.populations[number].meets != MEETS_STICK && rest_is_checked(id);
}

fn is_unborn(bits: u32) -> bool {
    let state = particle_state(bits);
    return state == PARTICLE_DORMANT || state == PARTICLE_DEAD;
}
