// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/leaf/collide.rs
// Collisions in the air of leaves that fly as bodies: integers summed over the leaves of a cell of the air give their mean motion, and
// leaves that draw nearer to each other lose a share of what theirs is beyond it.
#import bindings
#import arith/math
#import arith/vector
#import leaf/air_cell
#import leaf/record

struct CollisionCell {
    index: u32,
    key: u32,
    within: vec3<f32>,
}

struct Collisions {
    velocity: vec3<f32>,
    share: f32,
}

fn bounded_speed(along: f32) -> f32 {
    return min(max(along, -COLLISION_SPEED_MOST), COLLISION_SPEED_MOST);
}

fn nearest_whole(number: f32) -> u32 {
    return bitcast<u32>(i32(floor(number + 0.5)));
}

fn collision_cell(place: vec3<f32>) -> CollisionCell {
    let shifted = (place + step_block.collision_shift_m) * COLLISION_CELLS_PER_M;
    let corner = vec3<f32>(cell_floor(shifted.x), cell_floor(shifted.y), cell_floor(shifted.z));
    let within = shifted - corner;
    let column = bitcast<u32>(i32(corner.x));
    let layer = bitcast<u32>(i32(corner.y));
    let line = bitcast<u32>(i32(corner.z));
    let key = cell_key(column, layer, line);
    return CollisionCell(key >> (32u - COLLISION_CELL_BITS), key, within);
}

fn own_sums(cell: CollisionCell, bits: u32, size: u32, own_velocity: vec3<f32>) -> CollisionSums {
    let body = scene.bodies[leaf_species(bits)];
    let ratio = size_ratio(size);
    let units = (body.litter_units * ratio) * ratio;
    let weight = floor(min(units * scene.collisions.weight_per_unit + 1.0, COLLISION_WEIGHT_MOST));
    let velocity =
        vec3<f32>(bounded_speed(own_velocity.x), bounded_speed(own_velocity.y), bounded_speed(own_velocity.z));
    let momentum = velocity * (weight * COLLISION_MOMENTUM_ONE);
    let place = cell.within * (weight * COLLISION_PLACE_ONE);
    let radius = body.half_mean_m * ratio;
    let area = min((radius * radius) * COLLISION_AREA_ONE, COLLISION_AREA_MOST);
    let energy = vec3_dot(velocity, velocity) * (weight * COLLISION_ENERGY_ONE);
    let virial = vec3_dot(velocity, cell.within) * (weight * COLLISION_VIRIAL_ONE);
    return CollisionSums(
        1u,
        cell.key,
        bitcast<u32>(i32(weight)),
        nearest_whole(area),
        vec3<u32>(nearest_whole(momentum.x), nearest_whole(momentum.y), nearest_whole(momentum.z)),
        nearest_whole(energy),
        vec3<u32>(nearest_whole(place.x), nearest_whole(place.y), nearest_whole(place.z)),
        nearest_whole(virial),
    );
}

fn sum_to_real(sum: u32) -> f32 {
    return f32(bitcast<i32>(sum) >> 12u) * 4096.0 + f32(sum & 4095u);
}

fn collisions_of(cell: CollisionCell, sums: CollisionSums) -> Collisions {
    let none = Collisions(vec3<f32>(0.0, 0.0, 0.0), 0.0);
    let count = sums.count;
    // Cells of the air that share a place in the table are left alone.
    if (count < 2u || MOST_COLLIDING < count || sums.key != count * cell.key) {
        return none;
    }
    let per_weight = reciprocal(sum_to_real(sums.weight));
    let momentum =
        vec3<f32>(sum_to_real(sums.momentum.x), sum_to_real(sums.momentum.y), sum_to_real(sums.momentum.z));
    let velocity = momentum * (per_weight * (1.0 / COLLISION_MOMENTUM_ONE));
    let place = vec3<f32>(sum_to_real(sums.place.x), sum_to_real(sums.place.y), sum_to_real(sums.place.z));
    let middle = place * (per_weight * (1.0 / COLLISION_PLACE_ONE));
    let virial = sum_to_real(sums.virial) * (per_weight * (1.0 / COLLISION_VIRIAL_ONE));
    if (virial >= vec3_dot(velocity, middle)) {
        return none;
    }
    let energy = sum_to_real(sums.energy) * (per_weight * (1.0 / COLLISION_ENERGY_ONE));
    let beyond = max(energy - vec3_dot(velocity, velocity), 0.0);
    let leaves = f32(count);
    let others = leaves - 1.0;
    let squared = max((beyond + beyond) * (leaves * reciprocal(others)), TINY_SQUARED);
    let cells_per_m3 = (COLLISION_CELLS_PER_M * COLLISION_CELLS_PER_M) * COLLISION_CELLS_PER_M;
    let area = sum_to_real(sums.area) * (DISC_CROSS_SECTION / COLLISION_AREA_ONE);
    let rate = (area * cells_per_m3) * (others * reciprocal(leaves)) * (squared * inverse_sqrt(squared));
    let lost = rate * (scene.collisions.interval_s * (1.0 + scene.collisions.restitution));
    return Collisions(velocity, lost * reciprocal(1.0 + lost));
}

fn leaf_collide(leaf: u32, cell: CollisionCell, sums: CollisionSums) {
    let collisions = collisions_of(cell, sums);
    if (collisions.share == 0.0) {
        return;
    }
    let drift = drifts[leaf];
    let schedule = schedules[leaf];
    let own = drift.velocity;
    let spin = body_spin(drift.phase, schedule.rate, schedule.heading) * (1.0 - collisions.share);
    let words = body_spin_words(spin);
    drifts[leaf] = Drift(own + (collisions.velocity - own) * collisions.share, words.x);
    schedules[leaf].rate = words.y;
    schedules[leaf].heading = words.z;
}
