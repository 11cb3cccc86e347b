// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/leaf/wake.rs
// Leaves in the litter wake by their own forces, in the wind at their own edge.
#import bindings
#import arith/math
#import arith/quaternion
#import arith/vector
#import flight/body
#import leaf/at_rest
#import leaf/record
#import terrain/ground
#import wind/sample

fn unit_has_turn(slot: u32, interval_steps: u32) -> bool {
    return (((slot >> AIR_UNIT_SHIFT) + step_block.index) & (interval_steps - 1u)) == 0u;
}

fn wake_is_due(slot: u32) -> bool {
    return unit_has_turn(slot, scene.litter.wake_steps);
}

fn cover_is_due(slot: u32) -> bool {
    return unit_has_turn(slot, COVER_INTERVAL);
}

fn layers_above(bits: u32, height: f32) -> f32 {
    return height * reciprocal(scene.bodies[leaf_species(bits)].layer_m);
}

fn leaf_check_cover(leaf: u32) -> bool {
    let place = places[leaf];
    let bits = place.bits;
    if (!lies(bits) || litter_change(bits) != CHANGE_NONE) {
        return false;
    }
    let x = place.position.x;
    let z = place.position.z;
    let ground = lying_height(x, z, lying_support(schedules[leaf].rate));
    if (layers_above(bits, place.position.y - ground) > LOOSE_LAYERS) {
        places[leaf].bits = with_litter_change(bits, CHANGE_REMOVED);
        return true;
    }
    let above = layers_above(bits, ground_rest(x, z) - place.position.y);
    places[leaf].bits = with_cover(bits, above > COVERED_LAYERS);
    return false;
}

fn leaf_wake(leaf: u32) -> bool {
    let place = places[leaf];
    let bits = place.bits;
    if (!lies(bits) || is_covered(bits) || litter_change(bits) != CHANGE_NONE) {
        return false;
    }
    let x = place.position.x;
    let z = place.position.z;
    let reach = lying_support(schedules[leaf].rate);
    let rest = ground_rest(x, z);
    let cover = max(layers_above(bits, rest - place.position.y) - 1.0, 0.0);
    let wind = wind_at(vec3<f32>(x, rest + reach, z));
    if (vec3_dot(wind, wind) < wake_speed_squared(drifts[leaf].phase) * (1.0 + cover)) {
        return false;
    }
    let slope = ground_slope(x, z);
    let body = body_of(bits, schedules[leaf].size);
    let pose = attitudes[leaf].quaternion;
    let heading = schedules[leaf].heading;
    var at_rest = leaf_at_rest(body, pose, slope, lying_friction(heading), lying_raise(heading));
    at_rest.pressing_m_s2 = at_rest.pressing_m_s2 + scene.gravity_m_s2 * cover;
    if (!wind_moves(at_rest, wind, 1.0)) {
        return false;
    }
    places[leaf].bits = with_litter_change(bits, CHANGE_WOKEN);
    let spin = body_spin_words(quat_rotate_back(pose, raising_axis(at_rest, wind) * RAISING_RAD_S));
    drifts[leaf].phase = spin.x;
    schedules[leaf].rate = spin.y;
    schedules[leaf].heading = spin.z;
    return true;
}
