// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/leaf/wake.rs
// Leaves in the litter wake by their own forces, in the wind at their own edge.
#import bindings
#import arith/math
#import arith/quaternion
#import arith/vector
#import flight/body
#import leaf/afloat
#import leaf/at_rest
#import leaf/record
#import leaf/strike
#import terrain/ground
#import wind/pile_shadow
#import wind/sample

fn unit_has_turn(slot: u32, interval_steps: u32) -> bool {
    return (((slot >> AIR_UNIT_SHIFT) + step_block.index) & (interval_steps - 1u)) == 0u;
}

fn wake_is_due(slot: u32) -> bool {
    return unit_has_turn(slot, scene.litter.wake_steps);
}

fn cover_is_due(slot: u32) -> bool {
    return unit_has_turn(slot, scene.litter.cover_steps);
}

fn layers_above(bits: u32, height: f32) -> f32 {
    return height * reciprocal(scene.bodies[leaf_species(bits)].layer_m);
}

struct Cover {
    is_loose: bool,
    is_covered: bool,
}

struct LyingWind {
    wind: vec3<f32>,
    cover: f32,
    may_wake: bool,
}

fn cover_of(bits: u32, place: vec3<f32>, reach: f32) -> Cover {
    let rest = ground_rest(place.x, place.z);
    let lowest = lying_over(place.x, place.z, reach, rest);
    let beneath = layers_above(bits, place.y - lowest);
    let above = layers_above(bits, rest - place.y);
    let on_ground = is_on_ground(bits);
    var is_loose = on_ground && LOOSE_LAYERS < beneath;
    if (is_afloat(bits)) {
        let height = place.y - (ground_bare(place.x, place.z) + scene.rest_height_m);
        is_loose = height < 0.0 || reach < height || !ground_is_water(place.x, place.z);
    }
    return Cover(is_loose, is_sunk(bits) || (on_ground && COVERED_LAYERS < above));
}

fn leaf_check_cover(leaf: u32) -> bool {
    let place = places[leaf];
    let bits = place.bits;
    if (!lies_still(bits)) {
        return false;
    }
    let cover = cover_of(bits, place.position, lying_support(schedules[leaf].rate));
    places[leaf].bits = with_cover(bits, cover.is_covered);
    if (cover.is_loose) {
        places[leaf].bits = with_litter_change(bits, CHANGE_REMOVED);
    }
    return cover.is_loose;
}

fn lying_wind(bits: u32, place: vec3<f32>, reach: f32, wake_square: f32) -> LyingWind {
    let rest = select(ground_rest(place.x, place.z), place.y - reach, is_held(bits));
    let cover = max(layers_above(bits, rest - place.y) - 1.0, 0.0);
    let wind = wind_at(vec3<f32>(place.x, rest + reach, place.z));
    let may_wake = !(vec3_dot(wind, wind) < wake_square * (cover + 1.0));
    return LyingWind(wind, cover, may_wake);
}

fn leaf_wake(leaf: u32) -> bool {
    let place = places[leaf];
    let bits = place.bits;
    if (!lies_still(bits) || is_covered(bits)) {
        return false;
    }
    let x = place.position.x;
    let z = place.position.z;
    let reach = lying_support(schedules[leaf].rate);
    let met = lying_wind(bits, place.position, reach, wake_speed_squared(drifts[leaf].phase));
    if (!met.may_wake) {
        return false;
    }
    if (is_afloat(bits)) {
        return leaf_float(leaf, met.wind);
    }
    let body = body_of(bits, schedules[leaf].size);
    let pose = attitudes[leaf].quaternion;
    var slope: Slope;
    var wind = met.wind;
    if (is_held(bits)) {
        slope = solid_footing(body, pose, place.position).slope;
    } else {
        slope = ground_slope(x, z);
        wind = wind_behind_piles(x, z, wind);
    }
    let heading = schedules[leaf].heading;
    var at_rest = leaf_at_rest(body, pose, slope, lying_friction(heading), lying_raise(heading));
    at_rest.pressing_m_s2 = at_rest.pressing_m_s2 + scene.gravity_m_s2 * met.cover;
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
