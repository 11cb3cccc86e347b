// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/leaf/settle.rs
#import bindings
#import kernel/math
#import kernel/quaternion

struct Slide {
    way: vec3<f32>,
    velocity: vec3<f32>,
}

fn slide(velocity: vec3<f32>, seconds: f32) -> Slide {
    let squared = velocity.x * velocity.x + velocity.z * velocity.z;
    if (squared < 1e-12) {
        return Slide(vec3<f32>(0.0, 0.0, 0.0), vec3<f32>(0.0, 0.0, 0.0));
    }
    let inverse = inverse_sqrt(squared);
    let speed = squared * inverse;
    let left = max(speed - environment.ground.z * seconds, 0.0);
    let way = select(squared * environment.ground.w, (0.5 * seconds) * (speed + left), left > 0.0);
    return Slide(velocity * (way * inverse), velocity * (left * inverse));
}

fn flatten(q: vec4<f32>, kept: f32) -> vec4<f32> {
    let face_up = q.y * q.y + q.w * q.w >= q.x * q.x + q.z * q.z;
    let upright = select(kept, 1.0, face_up);
    let tilted = select(1.0, kept, face_up);
    return quat_normalize(vec4<f32>(q.x * tilted, q.y * upright, q.z * tilted, q.w * upright));
}

fn leaf_land(leaf: u32, start: vec3<f32>) {
    let rest_height = environment.ground.y;
    let place = places[leaf];
    let end = bitcast<vec3<f32>>(place.xyz);
    let drop = max(start.y - end.y, 1e-6);
    let share = min(max((start.y - rest_height) * reciprocal(drop), 0.0), 1.0);
    let way = end - start;
    let hit = start + way * share;
    let dt = environment.time.x;
    let slid = slide(way * environment.time.y, (1.0 - share) * dt);
    let identity = identities[leaf];
    let lifetime = environment.sources[(identity.w >> SOURCE_SHIFT) & SOURCE_MASK].timing.w;
    let position = vec3<f32>(hit.x + slid.way.x, rest_height, hit.z + slid.way.z);
    let bits = (place.w & ~(STATE_MASK | (BLEND_MASK << BLEND_SHIFT))) | STATE_RESTING;
    places[leaf] = vec4<u32>(bitcast<vec3<u32>>(position), bits);
    drifts[leaf] = vec4<u32>(bitcast<vec3<u32>>(vec3<f32>(slid.velocity.x, 0.0, slid.velocity.z)), 0u);
    courses[leaf].x = select(identity.y + lifetime, NEVER, lifetime == 0u);
}

fn leaf_settle(leaf: u32) {
    let drift = drifts[leaf];
    let velocity = bitcast<vec3<f32>>(drift.xyz);
    if (drift.w < environment.counts.y) {
        attitudes[leaf] = flatten(attitudes[leaf], environment.settle.x);
        drifts[leaf].w = drift.w + 1u;
    }
    if (velocity.x != 0.0 || velocity.z != 0.0) {
        let slid = slide(velocity, environment.time.x);
        let place = places[leaf];
        let position = bitcast<vec3<f32>>(place.xyz);
        let moved = vec3<f32>(position.x + slid.way.x, position.y, position.z + slid.way.z);
        places[leaf] = vec4<u32>(bitcast<vec3<u32>>(moved), place.w);
        drifts[leaf] = vec4<u32>(bitcast<vec3<u32>>(slid.velocity), drifts[leaf].w);
    }
}
