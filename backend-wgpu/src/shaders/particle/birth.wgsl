// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/particle/birth.rs
// Birth of a particle.
#import particle/bindings
#import arith/math
#import arith/rng
#import arith/vector
#import particle/air
#import particle/draw
#import particle/record

fn birth_number(number: u32, place: u32) -> u32 {
    let first_place = step_block.births[number].first_place;
    let wrapped = select(place, place + scene.populations[number].count, place < first_place);
    let among = wrapped - first_place;
    return select(NEVER, among, among < step_block.births[number].count);
}

fn root(x: f32) -> f32 {
    return x * inverse_sqrt(max(x, TINY_SQUARED));
}

fn shape_point(shape: u32, near: vec4<u32>, far: vec4<u32>) -> vec3<f32> {
    let a = unit_float(near.x);
    let b = unit_float(near.y);
    let c = unit_float(near.z);
    let d = unit_float(near.w);
    let e = unit_float(far.x);
    if (shape == PARTICLE_BOX) {
        return vec3<f32>(a * 2.0 - 1.0, b * 2.0 - 1.0, c * 2.0 - 1.0);
    }
    if (shape == PARTICLE_LINE) {
        return vec3<f32>(0.0, a * 2.0 - 1.0, 0.0);
    }
    let turn = sin_cos_turns(far.y);
    if (shape == PARTICLE_BALL || shape == PARTICLE_SHELL) {
        let up = a * 2.0 - 1.0;
        let across = root(max(1.0 - up * up, 0.0));
        let radius = select(1.0, max(max(b, c), d), shape == PARTICLE_BALL);
        return vec3<f32>((across * turn.y) * radius, up * radius, (across * turn.x) * radius);
    }
    let along = select(0.0, max(max(a, b), c), shape == PARTICLE_CONE);
    var radius = max(d, e);
    if (shape == PARTICLE_RING) {
        radius = 1.0;
    }
    if (shape == PARTICLE_CONE) {
        radius = radius * along;
    }
    return vec3<f32>(radius * turn.y, along, radius * turn.x);
}

fn foot_point(feet: u32, id: u32) -> vec3<f32> {
    let foot = id % feet;
    let radius = root((f32(foot) + 0.5) * reciprocal(f32(feet)));
    let turn = sin_cos_turns(foot * FOOT_TURN);
    return vec3<f32>(radius * turn.y, 0.0, radius * turn.x);
}

fn cap_direction(number: u32, a: u32, b: u32) -> vec3<f32> {
    let drop = scene.populations[number].cap * unit_float(a);
    let across = root(max(drop * (2.0 - drop), 0.0));
    let turn = sin_cos_turns(b);
    let sideward = scene.populations[number].side * (across * turn.y) + scene.populations[number].front * (across * turn.x);
    return scene.populations[number].axis * (1.0 - drop) + sideward;
}

fn trait_word(value: f32) -> u32 {
    return u32(min(max(floor(value + 0.5), 1.0), MOST_TRAIT));
}

fn particle_birth(particle: u32, number: u32, id: u32) -> f32 {
    let seed = scene.seed;
    let near = particle_words(seed, number, id, DRAW_PLACE);
    let far = particle_words(seed, number, id, DRAW_DEPTH);
    let motion = particle_words(seed, number, id, DRAW_MOTION);
    let lives = particle_words(seed, number, id, DRAW_LIFE);
    let airs_drawn = particle_words(seed, number, id, DRAW_AIR);
    var point = shape_point(scene.populations[number].shape, near, far);
    if (scene.populations[number].shape == PARTICLE_FEET) {
        point = foot_point(scene.populations[number].feet, id);
    }
    let spread = scene.populations[number].span_x_m * point.x
        + (scene.populations[number].span_y_m * point.y + scene.populations[number].span_z_m * point.z);
    var direction = cap_direction(number, motion.x, motion.y);
    var toward = spread;
    if (scene.populations[number].direction == DIRECTION_AROUND) {
        toward = vec3_cross(scene.populations[number].axis, spread);
    }
    let squared = vec3_dot(toward, toward);
    if (scene.populations[number].direction != DIRECTION_CAP && TINY_SQUARED < squared) {
        direction = toward * inverse_sqrt(squared);
    }
    let speed = max(spread_draw(scene.populations[number].speed_m_s, motion.z, motion.w), 0.0);
    var life = 0u;
    if (0.0 < scene.populations[number].life_steps.mean) {
        life = trait_word(spread_draw(scene.populations[number].life_steps, lives.x, lives.y));
    }
    let size = trait_word(spread_draw(scene.populations[number].size, lives.z, lives.w));
    particle_places[particle] = ParticlePlace(
        scene.populations[number].center_m + spread,
        particle_bits(PARTICLE_ALIVE, number) | PARTICLE_BORN,
    );
    particle_motions[particle] = ParticleMotion(direction * speed, step_block.index);
    particle_traits[particle] = ParticleTraits(
        id,
        life_size_word(life, size),
        air_numbers(number, size, airs_drawn.x, airs_drawn.y),
    );
    return select(1.0 - unit_float(airs_drawn.z), 1.0, step_block.births[number].is_burst != 0u);
}
