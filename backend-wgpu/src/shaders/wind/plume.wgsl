// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/wind/plume.rs
// Hot air that rises above a fire and draws in the air around it.
#import arith/math
#import bindings

struct PlumeRise {
    speed: f32,
    growth: f32,
}

fn rise_least(one: PlumeRise, other: PlumeRise) -> PlumeRise {
    let difference = (other.speed - one.speed) * (0.5 / PLUME_BLEND);
    let share = min(max(difference + 0.5, 0.0), 1.0);
    let rest = 1.0 - share;
    return PlumeRise(
        (one.speed * share + other.speed * rest) - (share * rest) * PLUME_BLEND,
        one.growth * share + other.growth * rest,
    );
}

fn plume_rise(height: f32) -> PlumeRise {
    let above_foot = max(height, PLUME_FOOT);
    let inverse_root = inverse_sqrt(above_foot);
    let inverse_cube = inverse_cube_root(above_foot);
    let flame = (above_foot * inverse_root) * PLUME_FLAME;
    let share = min(height, PLUME_FOOT) * (1.0 / PLUME_FOOT);
    var steady = PlumeRise(
        flame * (share * (1.5 - share * 0.5)),
        inverse_root * ((1.5 - share) * PLUME_FLAME),
    );
    if (!(height < PLUME_FOOT)) {
        steady.growth = inverse_root * (0.5 * PLUME_FLAME);
    }
    let flicker = PlumeRise(PLUME_FLICKER, 0.0);
    let squared = inverse_cube * inverse_cube;
    let above = PlumeRise(inverse_cube * PLUME_ABOVE, (squared * squared) * (-PLUME_ABOVE / 3.0));
    return rise_least(rise_least(steady, flicker), above);
}

fn plume_puff(height: f32, turns: f32, per_height: f32) -> PlumeRise {
    let done = height * (1.0 / PLUME_PUFF_TOP);
    let rest = max(1.0 - done, 0.0);
    let size = (done * (rest * rest)) * (6.75 * PLUME_PUFF);
    let swelling = (rest * (rest - done * 2.0)) * (6.75 * PLUME_PUFF / PLUME_PUFF_TOP);
    let left = turns - height * per_height;
    let phase = left - floor(left + 0.5);
    let off = max(phase, -phase);
    let wave = (phase * (1.0 - off * 2.0)) * 8.0;
    let slope = (1.0 - off * 4.0) * 8.0;
    return PlumeRise(size * wave, swelling * wave - (size * per_height) * slope);
}

struct PlumePoint {
    is_below: bool,
    height: f32,
    slope: f32,
    along: f32,
    across: f32,
}

fn plume_point(moment: u32, plume: u32, place: vec3<f32>) -> PlumePoint {
    let direction_x = scene.wind.direction_x;
    let direction_z = scene.wind.direction_z;
    let from_base = place - step_block.moments[moment].plumes[plume].base_m;
    let is_below = from_base.y < 0.0;
    let height = max(from_base.y, 0.0);
    var slope = step_block.moments[moment].plumes[plume].base_slope;
    var lean = height * slope;
    for (var number = 0u; number < PLUME_BENDS; number++) {
        let bend = step_block.moments[moment].plumes[plume].bends[number];
        let past = max(height - bend.from_m, 0.0);
        let turned = past * bend.turned_per_m;
        slope = slope + turned;
        lean = lean + (turned * past) * 0.5;
    }
    let along = (from_base.x * direction_x + from_base.z * direction_z) - lean;
    let across = from_base.z * direction_x - from_base.x * direction_z;
    return PlumePoint(is_below, height, slope, along, across);
}

struct PlumeFire {
    speed_m_s: f32,
    heights_per_m: f32,
}

fn plume_fire(moment: u32, plume: u32) -> PlumeFire {
    let fire = step_block.moments[moment].plumes[plume].fire;
    if (fire == 0u) {
        return PlumeFire(
            step_block.moments[moment].plumes[plume].speed_m_s,
            step_block.moments[moment].plumes[plume].heights_per_m,
        );
    }
    let words = tables[scene.litter.first_row + (fire >> 2u)];
    return PlumeFire(bitcast<f32>(words.y), bitcast<f32>(words.z));
}

fn plume_bell(squared: f32) -> f32 {
    return select(0.0, exponential(-squared), squared < PLUME_EDGE);
}

fn plume_axis_warmth(height: f32) -> f32 {
    let above_foot = max(height, PLUME_FOOT);
    let inverse_cube = inverse_cube_root(above_foot);
    let squared = inverse_cube * inverse_cube;
    let above = (squared * squared) * inverse_cube * PLUME_ABOVE_K;
    return min(min(reciprocal(above_foot) * PLUME_FLICKER_K, above), PLUME_FLAME_K);
}

fn plume_warmth(place: vec3<f32>) -> f32 {
    var warmth = 0.0;
    for (var plume = 0u; plume < step_block.plume_count; plume++) {
        let point = plume_point(MOMENT_NOW, plume, place);
        let fire = plume_fire(MOMENT_NOW, plume);
        if (point.is_below || fire.speed_m_s == 0.0) {
            continue;
        }
        let base_radius_m = step_block.moments[MOMENT_NOW].plumes[plume].base_radius_m;
        let inverse_width = reciprocal(point.height * PLUME_SPREAD + base_radius_m);
        let squared =
            (point.along * point.along + point.across * point.across) * (inverse_width * inverse_width);
        warmth = max(warmth, plume_axis_warmth(point.height * fire.heights_per_m) * plume_bell(squared));
    }
    return warmth;
}

fn wind_plume(moment: u32, plume: u32, place: vec3<f32>, level: f32) -> vec3<f32> {
    let direction_x = scene.wind.direction_x;
    let direction_z = scene.wind.direction_z;
    let point = plume_point(moment, plume, place);
    if (point.is_below) {
        return vec3<f32>(0.0, 0.0, 0.0);
    }
    let height = point.height;
    let slope = point.slope;
    let along = point.along;
    let across = point.across;
    let inverse_width = reciprocal(height * PLUME_SPREAD + step_block.moments[moment].plumes[plume].base_radius_m);
    let inverse_squared = inverse_width * inverse_width;
    let squared = (along * along + across * across) * inverse_squared;
    let bell = plume_bell(squared);
    var within = (1.0 - bell) * reciprocal(max(squared, PLUME_NEAR_AXIS));
    if (squared < PLUME_NEAR_AXIS) {
        within = 1.0 - squared * (0.5 - squared * (1.0 / 6.0));
    }
    let fire = plume_fire(moment, plume);
    let heights_per_m = fire.heights_per_m;
    let fire_m_s = fire.speed_m_s;
    let rise = plume_rise(height * heights_per_m);
    let puffs_per_s = step_block.moments[moment].plumes[plume].puffs_per_s;
    let per_height = puffs_per_s * reciprocal(max(fire_m_s * heights_per_m * PLUME_PUFF_SPEED, PLUME_FOOT));
    let puff = plume_puff(height * heights_per_m, step_block.moments[moment].plumes[plume].puffs, per_height);
    let swollen = 1.0 + puff.speed;
    let speed = (rise.speed * swollen) * fire_m_s;
    let growth = (rise.growth * swollen + rise.speed * puff.growth) * (fire_m_s * heights_per_m);
    let widening = (speed * inverse_width) * PLUME_SPREAD;
    let slowed = min(level * step_block.moments[moment].plumes[plume].inv_layer, 1.0);
    let inflow = (widening * bell - (growth * 0.5 + widening) * within) * slowed;
    let passing = ((speed * slope) * (bell * inverse_squared)) * 2.0;
    let u = inflow * along + passing * (across * across);
    let w = inflow * across - passing * (along * across);
    return vec3<f32>(u * direction_x - w * direction_z, speed * bell, u * direction_z + w * direction_x);
}
