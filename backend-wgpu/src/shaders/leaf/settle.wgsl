// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/leaf/settle.rs
// A leaf on the ground: it slides, loses speed to friction and lies down flat on the slope.
#import bindings
#import arith/math
#import arith/quaternion
#import leaf/record
#import terrain/ground

struct Slide {
    way: vec3<f32>,
    velocity: vec3<f32>,
}

struct Friction {
    loss_m_s2: f32,
    stop_s2_m: f32,
}

fn ground_friction() -> Friction {
    return Friction(scene.friction_m_s2, scene.stop_s2_m);
}

fn slide(came: vec3<f32>, seconds: f32, slope: Slope, friction: Friction) -> Slide {
    let pull = (scene.gravity_m_s2 * seconds) * slope.inv_gain;
    let velocity = vec3<f32>(came.x - slope.x * pull, came.y, came.z - slope.z * pull);
    if (velocity.x * came.x + velocity.z * came.z < 0.0) {
        return Slide(vec3<f32>(0.0, 0.0, 0.0), vec3<f32>(0.0, 0.0, 0.0));
    }
    let squared = velocity.x * velocity.x + velocity.z * velocity.z;
    if (squared < 1e-12) {
        return Slide(vec3<f32>(0.0, 0.0, 0.0), vec3<f32>(0.0, 0.0, 0.0));
    }
    let inverse = inverse_sqrt(squared);
    let speed = squared * inverse;
    let left = max(speed - (friction.loss_m_s2 * slope.inv_gain) * seconds, 0.0);
    let stop = squared * (friction.stop_s2_m * slope.gain);
    let way = select(stop, (0.5 * seconds) * (speed + left), left > 0.0);
    return Slide(velocity * (way * inverse), velocity * (left * inverse));
}

fn flatten(q: vec4<f32>, kept: f32) -> vec4<f32> {
    let face_up = q.y * q.y + q.w * q.w >= q.x * q.x + q.z * q.z;
    let upright = select(kept, 1.0, face_up);
    let tilted = select(1.0, kept, face_up);
    let flat = vec4<f32>(q.x * tilted, q.y * upright, q.z * tilted, q.w * upright);
    return quat_normalize(select(flat, vec4<f32>(0.0), flat * flat < vec4<f32>(FLAT_SQUARED)));
}

fn flatten_on(slope: Slope, q: vec4<f32>, kept: f32) -> vec4<f32> {
    if (slope.gain == 1.0) {
        return flatten(q, kept);
    }
    let lean = ground_lean(slope);
    let back = vec4<f32>(-lean.x, -lean.y, -lean.z, lean.w);
    return quat_multiply(lean, flatten(quat_multiply(back, q), kept));
}

fn recycling_step(leaf: u32) -> u32 {
    let identity = identities[leaf];
    let lifetime = scene.sources[leaf_source(identity.appearance)].lifetime_steps;
    return select(identity.release + lifetime, NEVER, lifetime == 0u);
}

// Landing is decided by a float comparison, the one place where the backends' integers could part for a step under the
// tolerant contract; the step is continuous across that decision.
fn leaf_land(leaf: u32, start: vec3<f32>) {
    let place = places[leaf];
    let end = place.position;
    let above = ground_rest(start.x, start.z);
    let rise = ground_rest(end.x, end.z) - above;
    let drop = max((start.y - end.y) + rise, 1e-6);
    let share = min(max((start.y - above) * reciprocal(drop), 0.0), 1.0);
    let way = end - start;
    let hit = start + way * share;
    let left = (1.0 - share) * scene.dt_s;
    let slid = slide(way * scene.inv_dt_s, left, ground_slope(hit.x, hit.z), ground_friction());
    let x = hit.x + slid.way.x;
    let z = hit.z + slid.way.z;
    let position = vec3<f32>(x, ground_rest(x, z), z);
    places[leaf] = Place(position, landed_bits(place.bits));
    drifts[leaf] = Drift(vec3<f32>(slid.velocity.x, 0.0, slid.velocity.z), 0u);
    schedules[leaf].event = recycling_step(leaf);
}

fn leaf_settle(leaf: u32) {
    let drift = drifts[leaf];
    let steps = ground_steps(drift.phase);
    let position = places[leaf].position;
    let slides = drift.velocity.x != 0.0 || drift.velocity.z != 0.0;
    let is_hilly = scene.has_terrain != 0u;
    let slope = ground_slope(position.x, position.z);
    if (steps < scene.settle_steps || (slides && is_hilly)) {
        let before = attitudes[leaf].quaternion;
        let kept = scene.tilt_kept;
        if (is_hilly) {
            attitudes[leaf].quaternion = flatten_on(slope, before, kept);
        } else {
            attitudes[leaf].quaternion = flatten(before, kept);
        }
        drifts[leaf].phase = select(steps + 1u, 0u, slides && is_hilly);
    }
    if (slides) {
        let slid = slide(drift.velocity, scene.dt_s, slope, ground_friction());
        let x = position.x + slid.way.x;
        let z = position.z + slid.way.z;
        var y = position.y;
        if (is_hilly) {
            y = ground_rest(x, z);
        }
        places[leaf].position = vec3<f32>(x, y, z);
        drifts[leaf].velocity = slid.velocity;
    }
}
