// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/leaf/carry.rs
// A leaf on its twig: it goes where the branch goes, leans and flutters in the wind, and its petiole breaks.
#import arith/math
#import arith/quaternion
#import arith/rng
#import arith/vector
#import leaf/carrier_bindings
#import leaf/petiole
#import leaf/record
#import tree/sway/body
#import wind/sample

struct TwigPose {
    position: vec3<f32>,
    attitude: vec4<f32>,
    velocity: vec3<f32>,
}

struct AirSample {
    air_speed: f32,
    breaks: bool,
}

fn shed_chance(bits: u32, speed: f32) -> u32 {
    let level = min(bitcast<u32>(i32(floor(speed))), SHED_SPEEDS - 1u);
    let index = (petiole_kind(bits) * SHED_CLASSES + petiole_strength(bits)) * SHED_SPEEDS + level;
    return tables[scene.first_shed_row + (index >> 2u)][index & 3u];
}

fn leaf_twig_pose(air_speed: f32, slot: u32, petiole: Petiole, segment: Body) -> TwigPose {
    let still = quat_multiply(segment.pose, petiole.rest_quaternion);
    let tip = quat_rotate(still, vec3<f32>(0.0, 0.0, 1.0));
    let side = quat_rotate(still, vec3<f32>(1.0, 0.0, 0.0));
    let wind = vec3<f32>(scene.wind.direction_x, 0.0, scene.wind.direction_z);
    let share = air_speed * reciprocal(air_speed + LEAN_SPEED);
    let unrest = share * share;
    let rate = scene.flutter_per_step;
    let own_rate = rate + (rate >> 5u) * (slot & 15u);
    let phase = own_rate * step_block.index + slot * 0x9e3779b9u;
    let roll = sin_cos_turns(phase).x;
    let pitch = sin_cos_turns(phase << 1u).y;
    let lean = vec3_cross(tip, wind) * (share * LEAN_MOST);
    let flutter = tip * ((unrest * FLUTTER_ROLL) * roll) + side * ((unrest * FLUTTER_PITCH) * pitch);
    let attitude = quat_renormalize(quat_multiply(quat_of_turn(lean + flutter), still));
    let length = petiole_length(petiole.bits);
    let arm = quat_rotate(segment.pose, petiole.base) + quat_rotate(attitude, vec3<f32>(0.0, 0.0, length));
    return TwigPose(segment.base + arm, attitude, segment.velocity + vec3_cross(segment.spin, arm));
}

fn leaf_size_on_twig(size: u32, bits: u32) -> u32 {
    return twig_sizes(size, min((size * petiole_cluster(bits)) >> 4u, HALF_MASK));
}

fn leaf_return(leaf: u32, bits: u32) -> u32 {
    let is_back = leaf_state(places[leaf].bits) == STATE_RESTING
        && scene.sources[SOURCE_TREES].lifetime_steps != 0u
        && step_block.index >= schedules[leaf].event
        && !lies(places[leaf].bits);
    if (!is_back) {
        return 0u;
    }
    places[leaf].bits = with_state(with_blend(places[leaf].bits, 0u), STATE_ATTACHED);
    schedules[leaf].event = NEVER;
    schedules[leaf].size = leaf_size_on_twig(drawn_size(schedules[leaf].size), bits);
    drifts[leaf].phase = 0u;
    return 1u;
}

fn leaf_hangs(bits: u32, event: u32) -> bool {
    return leaf_state(bits) == STATE_ATTACHED && step_block.index < event;
}

fn leaf_next_sample(slot: u32) -> u32 {
    return (0u - (step_block.index + slot)) & (SHED_INTERVAL - 1u);
}

fn leaf_sample_air(air_speed: f32, slot: u32, petiole: Petiole, segment: Body) -> AirSample {
    let arm = quat_rotate(segment.pose, petiole.base);
    let velocity = segment.velocity + vec3_cross(segment.spin, arm);
    let relative = wind_at(segment.base + arm) - velocity;
    let squared = vec3_dot(relative, relative);
    let speed = squared * inverse_sqrt(max(squared, TINY_SQUARED));
    let counter = vec4<u32>(slot, STREAM_SHED, step_block.index, 0u);
    let breaks = philox(scene.seed, counter).x < shed_chance(petiole.bits, speed);
    return AirSample(air_speed + (speed - air_speed) * AIR_SPEED_SMOOTHING, breaks);
}

fn leaf_follow(leaf: u32, slot: u32, petiole: Petiole, segment: Body) {
    let phase = drifts[leaf].phase;
    let pose = leaf_twig_pose(smoothed_air_speed(phase), slot, petiole, segment);
    places[leaf].position = pose.position;
    drifts[leaf].velocity = pose.velocity;
    attitudes[leaf].quaternion = pose.attitude;
    if (schedules[leaf].event == step_block.index + 1u) {
        let spin = body_spin_words(quat_rotate_back(pose.attitude, segment.spin));
        drifts[leaf].phase = spin.x;
        schedules[leaf].rate = spin.y;
        schedules[leaf].heading = spin.z;
    }
}

fn leaf_carry(leaf: u32, slot: u32, petiole: Petiole, segment: Body) -> u32 {
    var change = leaf_return(leaf, petiole.bits);
    if (!leaf_hangs(places[leaf].bits, schedules[leaf].event)) {
        return change;
    }
    if (leaf_next_sample(slot) == 0u) {
        let sample = leaf_sample_air(smoothed_air_speed(drifts[leaf].phase), slot, petiole, segment);
        drifts[leaf].phase = smoothed_air_speed_word(sample.air_speed);
        if (sample.breaks) {
            schedules[leaf].event = step_block.index + 1u;
            change = change - 1u;
        }
    }
    leaf_follow(leaf, slot, petiole, segment);
    return change;
}
