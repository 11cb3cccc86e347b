// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// twin: core/src/device/flight/contact.rs
// Contact of a body with the ground or the litter on it: an impulse at the lowest point of its outline, an ellipse.
#import flight/body
#import flight/rates
#import arith/math
#import arith/quaternion
#import arith/vector
#import terrain/ground
#import terrain/litter

struct Contact {
    position: vec3<f32>,
    motion: FlightMotion,
    touches: bool,
}

struct Support {
    radius: f32,
    arm: vec3<f32>,
}

struct Surface {
    normal: vec3<f32>,
    arm: vec3<f32>,
    restitution: f32,
    friction: f32,
    weight_m_s: f32,
    takes_share: bool,
}

struct Struck {
    velocity: vec3<f32>,
    spin: vec3<f32>,
}

fn contact_friction(depth: f32) -> f32 {
    return select(scene.litter.friction, scene.litter.ground_friction, depth < LITTER_DEEP_M);
}

fn support(body: LeafBody, normal: vec3<f32>) -> Support {
    let across = body.half_across_m * body.size_ratio;
    let along = body.half_along_m * body.size_ratio;
    let x = (across * across) * normal.x;
    let z = (along * along) * normal.z;
    let squared = max(x * normal.x + z * normal.z, TINY_SQUARED);
    let inverse = inverse_sqrt(squared);
    return Support(squared * inverse, vec3<f32>((x * inverse) * -1.0, 0.0, (z * inverse) * -1.0));
}

fn flight_contact(body: LeafBody, position: vec3<f32>, motion: FlightMotion, time: f32) -> Contact {
    let reach = max(body.half_along_m, body.half_across_m) * body.size_ratio;
    if (!(position.y < reach + scene.highest_rest_m)) {
        return Contact(position, motion, false);
    }
    let above = position.y - ground_rest(position.x, position.z);
    if (!(above < reach * CONTACT_REACH)) {
        return Contact(position, motion, false);
    }
    let rise = ground_gradient(position.x, position.z);
    let up = inverse_sqrt((rise.x * rise.x + rise.y * rise.y) + 1.0);
    let normal = vec3<f32>((rise.x * up) * -1.0, up, (rise.y * up) * -1.0);
    let inner = quat_rotate_back(motion.pose, normal);
    let lowest = support(body, inner);
    let gap = above * up - lowest.radius;
    if (!(gap < 0.0)) {
        return Contact(position, motion, false);
    }
    let depth = litter_height(position.x, position.z);
    let is_bare = depth < LITTER_DEEP_M;
    let restitution = select(0.0, scene.litter.restitution, is_bare);
    let weight = (time * scene.gravity_m_s2) * up;
    let surface = Surface(inner, lowest.arm, restitution, contact_friction(depth), weight, false);
    let next = contact_response(body, motion, surface);
    let out = normal * (gap * -1.0);
    return Contact(position + out, next, true);
}

fn contact_response(body: LeafBody, motion: FlightMotion, surface: Surface) -> FlightMotion {
    let normal = surface.normal;
    let arm = surface.arm;
    let share = body.inv_size_ratio * body.inv_size_ratio;
    let inv_inertia = body.inv_inertia * share;
    let velocity = quat_rotate_back(motion.pose, motion.velocity);
    let spin = motion.turning * body.inv_size_ratio;
    let meeting = velocity + vec3_cross(spin, arm);
    let closing = vec3_dot(meeting, normal);
    let restitution = select(0.0, surface.restitution, closing < -BOUNCE_M_S);
    let striking = (closing * (restitution + 1.0)) * reciprocal(contact_yield(inv_inertia, arm, normal));
    let push = max(striking * -1.0, 0.0);
    let struck = contact_impulse(inv_inertia, arm, velocity, spin, normal * push);
    let left = struck.velocity + vec3_cross(struck.spin, arm);
    let sliding = left - normal * vec3_dot(left, normal);
    let squared = max(vec3_dot(sliding, sliding), TINY_SQUARED);
    let inverse = inverse_sqrt(squared);
    let way = sliding * inverse;
    let stopping = (squared * inverse) * reciprocal(contact_yield(inv_inertia, arm, way));
    let weight = surface.weight_m_s;
    let resting = max(min(vec3_dot(velocity, normal) * -1.0, weight), 0.0);
    let pressing = select(push, resting, push < weight + weight);
    let taken = select(0.0, stopping * surface.friction, 0.0 < push);
    let drag = select(min(stopping, surface.friction * pressing), taken, surface.takes_share);
    let next = contact_impulse(inv_inertia, arm, struck.velocity, struck.spin, way * (drag * -1.0));
    return FlightMotion(quat_rotate(motion.pose, next.velocity), motion.pose, next.spin * body.size_ratio);
}

fn contact_impulse(
    inv_inertia: vec3<f32>,
    arm: vec3<f32>,
    velocity: vec3<f32>,
    spin: vec3<f32>,
    impulse: vec3<f32>,
) -> Struck {
    let turned = vec3_cross(arm, impulse);
    let next_spin = vec3<f32>(
        spin.x + inv_inertia.x * turned.x,
        spin.y + inv_inertia.y * turned.y,
        spin.z + inv_inertia.z * turned.z,
    );
    return Struck(velocity + impulse, next_spin);
}

fn contact_yield(inv_inertia: vec3<f32>, arm: vec3<f32>, direction: vec3<f32>) -> f32 {
    let lever = vec3_cross(arm, direction);
    let turn = vec3<f32>(inv_inertia.x * lever.x, inv_inertia.y * lever.y, inv_inertia.z * lever.z);
    return vec3_dot(lever, turn) + 1.0;
}
