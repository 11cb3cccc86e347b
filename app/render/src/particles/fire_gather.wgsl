// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// One light for each population that lights the scene: the sum of what its particles give, from their middle. Each workgroup adds up one
// population, in an order of its own, so that pictures are equal.

#import frame/structs
#import particles/flame_spine

@group(3) @binding(0) var<storage, read_write> lights: array<FireLight>;

// Threads of the workgroup.
const GATHER_THREADS: u32 = 64u;
// Mean share of a cylinder's face that is seen from around it.
const ROUND_SHARE: f32 = 0.78539816;
// Least radius of what shines, in metres.
const LEAST_M: f32 = 0.05;

struct Shining {
    intensity: vec3<f32>,
    // Sum of places, and of their squares, by luminance.
    place: vec3<f32>,
    squared: f32,
    weight: f32,
}

var<workgroup> sums: array<Shining, GATHER_THREADS>;

fn shining_at(place: vec3<f32>, intensity: vec3<f32>) -> Shining {
    let weight = dot(intensity, vec3(0.2126, 0.7152, 0.0722));
    return Shining(intensity, place * weight, dot(place, place) * weight, weight);
}

fn both(one: Shining, other: Shining) -> Shining {
    return Shining(
        one.intensity + other.intensity,
        one.place + other.place,
        one.squared + other.squared,
        one.weight + other.weight,
    );
}

// Light of what is in a slot, around the middle of the population's feet.
fn shining(population: u32, flame: Flame, look: PopulationLook, slot: u32) -> Shining {
    let place = places[slot];
    if !is_there(place.bits) {
        return Shining(vec3(0.0), vec3(0.0), 0.0, 0.0);
    }
    if flame.feet > 0u {
        let stretch = flame_stretch(flame, slot);
        if !stretch.is_there {
            return Shining(vec3(0.0), vec3(0.0), 0.0, 0.0);
        }
        let row = stretch_row(population, stretch, 0.5);
        let face_m2 = 2.0 * flame_radius(look, row, stretch, 0.5) * length(spline_way(stretch, 0.5));
        return shining_at(spline_place(stretch, 0.5) - flame.center_m, row.color * (row.opacity * face_m2 * ROUND_SHARE));
    }
    let born_with = traits[slot];
    let age = particle_age(motions[slot], drawn.step);
    let at = row_place(population, age_share(age, born_with.life_size));
    let row = row_between(rows[at.row], rows[at.row + 1u], at.t);
    let radius_m = 0.5 * look.size_m * row.size * f32(particle_size(born_with.life_size)) / f32(PARTICLE_SIZE_ONE);
    let disc_m2 = 3.14159265 * radius_m * radius_m * MEAN_COVER;
    let lit = blink_share(look, f32(age) * drawn.dt_s, own_number(born_with.id, population));
    return shining_at(place.position - flame.center_m, row.color * (row.opacity * disc_m2 * lit));
}

@compute @workgroup_size(GATHER_THREADS)
fn gather(@builtin(local_invocation_index) thread: u32, @builtin(workgroup_id) group: vec3<u32>) {
    var population = 0u;
    for (var number = 0u; number < arrayLength(&flames); number++) {
        if flames[number].light == group.x + 1u {
            population = number;
        }
    }
    let flame = flames[population];
    let look = populations[population];
    var sum = Shining(vec3(0.0), vec3(0.0), 0.0, 0.0);
    for (var number = thread; number < flame.count; number += GATHER_THREADS) {
        let slot = flame.first_slot + number;
        if slot < drawn.count {
            sum = both(sum, shining(population, flame, look, slot));
        }
    }
    sums[thread] = sum;
    workgroupBarrier();
    if thread > 0u {
        return;
    }
    for (var other = 1u; other < GATHER_THREADS; other++) {
        sum = both(sum, sums[other]);
    }
    let share = 1.0 / max(sum.weight, 1.0e-20);
    let middle = sum.place * share;
    let spread_m2 = max(sum.squared * share - dot(middle, middle), LEAST_M * LEAST_M);
    lights[group.x] = FireLight(middle + flame.center_m, spread_m2, sum.intensity, 0.0);
}
