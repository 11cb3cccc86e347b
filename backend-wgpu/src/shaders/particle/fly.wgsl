// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/particle/fly.rs
// Flight of a particle through a step, with nothing in its way.
#import bindings
#import arith/vector
#import particle/air
#import particle/force
#import wind/sample

const LEAST_M_S: f32 = 1e-20;

struct ParticleFlight {
    position: vec3<f32>,
    velocity: vec3<f32>,
}

fn whole_speed(speed: f32) -> f32 {
    return select(speed, 0.0, max(speed, -speed) < LEAST_M_S);
}

fn whole_velocity(velocity: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(whole_speed(velocity.x), whole_speed(velocity.y), whole_speed(velocity.z));
}

fn interval_share(lost: f32) -> f32 {
    var share = 1.0;
    var kept = share - lost;
    var steps = scene.wind.interval_steps;
    while (steps > 1u) {
        share = share + share * kept;
        kept = kept * kept;
        steps = steps / 2u;
    }
    return share;
}

fn particle_fly(number: u32, start: ParticleFlight, air: vec2<f32>, mutual: vec3<f32>) -> ParticleFlight {
    let position = start.position;
    let velocity = start.velocity;
    let dt = scene.dt_s;
    let half = 0.5 * scene.dt_s;
    let kind = scene.populations[number].air;
    let flags = scene.populations[number].flags;
    let is_massless = kind == AIR_MASSLESS;
    var end = start;
    var moment = MOMENT_NOW;
    var meeting = position;
    if (!is_massless && (flags & POPULATION_COASTS) != 0u) {
        moment = MOMENT_MIDDLE;
        meeting = position + velocity * scene.wind.half_interval_s;
    }
    var samples = u32(kind != AIR_VACUUM);
    if (is_massless) {
        samples = 2u;
    }
    var wind = vec3<f32>(0.0, 0.0, 0.0);
    for (var sample = 0u; sample < samples; sample++) {
        wind = wind_at_moment(moment, meeting);
        meeting = position + wind * half;
    }
    if (is_massless) {
        end.velocity = wind;
        end.position = position + wind * dt;
    } else {
        var pull = vec3<f32>(0.0, -scene.populations[number].gravity_m_s2, 0.0);
        if ((flags & POPULATION_PULLED) != 0u) {
            pull = pull + force_pull(number, position + velocity * half);
        }
        if ((flags & POPULATION_MUTUAL) != 0u) {
            pull = pull + mutual;
        }
        let is_linear = kind == AIR_LINEAR || kind == AIR_STOKES;
        if (is_linear && (flags & POPULATION_TURNED) == 0u) {
            let slip = wind - velocity;
            let way = air.x * air.y;
            let lag = dt - way;
            end.position = position + (velocity * dt + (slip * lag + pull * (air.y * lag)));
            var change = slip * air.x + pull * way;
            if ((flags & POPULATION_COASTS) != 0u) {
                change = change * interval_share(air.x);
            }
            end.velocity = velocity + change;
        } else {
            let kick = pull * half;
            var turned = air_drag(number, wind, velocity + kick, air);
            if ((flags & POPULATION_TURNED) != 0u) {
                turned = force_turn(number, turned);
            }
            end.velocity = turned + kick;
            end.position = position + (velocity + end.velocity) * half;
        }
    }
    end.velocity = whole_velocity(end.velocity);
    if ((flags & POPULATION_SWIRLED) != 0u) {
        end.position = force_swirl(number, end.position);
    }
    return end;
}

fn particle_coasts(number: u32, slot: u32) -> bool {
    if ((scene.populations[number].flags & POPULATION_COASTS) == 0u) {
        return false;
    }
    let turn = (slot >> PARTICLE_UNIT_SHIFT) + step_block.index;
    return (turn & (scene.wind.interval_steps - 1u)) != 0u;
}

fn particle_free_step(number: u32, coasts: bool, start: ParticleFlight, air: vec2<f32>, mutual: vec3<f32>) -> ParticleFlight {
    if (coasts) {
        return ParticleFlight(start.position + start.velocity * scene.dt_s, start.velocity);
    }
    return particle_fly(number, start, air, mutual);
}
