// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/flight/contact.wgsl
//!
//! Contact of a body with the ground or the litter on it: an impulse at the lowest point of its outline, an ellipse, with
//! restitution and Coulomb friction. What has sunk in is pushed out; that moves its place, never its velocity.

use super::body::LeafBody;
use super::rates::FlightMotion;
use crate::arith::lane::{Mask, Real};
use crate::arith::math::{inverse_sqrt, reciprocal};
use crate::arith::quaternion::{quat_rotate, quat_rotate_back};
use crate::arith::vector::{TINY_SQUARED, Vec3, vec3_cross, vec3_dot, vec3_select};
use crate::context::Context;
use crate::device::terrain::ground::{ground_gradient, ground_rest};
use crate::device::terrain::litter::litter_height;

crate::shared_constants! {
    /// Speed in m/s at which a body must strike to bounce.
    pub const BOUNCE_M_S: f32 = 0.3;
    /// Height above the ground, in half lengths of a body, below which it may touch: on slopes up to 75 degrees.
    pub const CONTACT_REACH: f32 = 4.0;
    /// Height in m of litter from which on a body strikes litter, not the ground beneath.
    pub const LITTER_DEEP_M: f32 = 0.002;
}

/// A body after a contact.
#[derive(Clone, Copy, Debug)]
pub struct Contact<R: Real = f32> {
    /// Position in m.
    pub position: Vec3<R>,
    /// Velocity, pose and turning.
    pub motion: FlightMotion<R>,
    /// True where there was a contact.
    pub touches: R::Mask,
}

/// Friction coefficient where a body touches what it lies on.
#[inline(always)]
pub fn contact_friction<R: Real>(cx: &Context<'_>, depth: R) -> R {
    let litter = &cx.scene.litter;
    depth
        .less_than(depth.all(LITTER_DEEP_M))
        .select_real(depth.all(litter.ground_friction), depth.all(litter.friction))
}

/// Distance in m from a body's centre to the lowest point of its outline, against a direction in the leaf's frame, and that point.
#[inline(always)]
pub fn support<R: Real>(body: &LeafBody<R>, normal: Vec3<R>) -> (R, Vec3<R>) {
    let across = body.half_across_m * body.size_ratio;
    let along = body.half_along_m * body.size_ratio;
    let x = (across * across) * normal.x;
    let z = (along * along) * normal.z;
    let squared = (x * normal.x + z * normal.z).max(x.all(TINY_SQUARED));
    let inverse = inverse_sqrt(squared);
    (squared * inverse, Vec3::new((x * inverse) * -1.0, x.all(0.0), (z * inverse) * -1.0))
}

/// Contacts of bodies with everything that may be in their way.
pub trait Contacts<R: Real> {
    /// Contacts of a body in a substep of `time` that began `seconds` into the step, and took it from a place `way` on in free flight.
    /// Only in scenes with litter.
    fn contact(
        cx: &Context<'_>,
        body: &LeafBody<R>,
        from: Vec3<R>,
        way: Vec3<R>,
        motion: FlightMotion<R>,
        seconds: R,
        time: R,
    ) -> Contact<R>;
}

/// Contacts with the ground and the litter on it.
#[derive(Clone, Copy, Debug)]
pub struct OverGround;

impl<R: Real> Contacts<R> for OverGround {
    #[inline(always)]
    fn contact(
        cx: &Context<'_>,
        body: &LeafBody<R>,
        from: Vec3<R>,
        way: Vec3<R>,
        motion: FlightMotion<R>,
        _: R,
        time: R,
    ) -> Contact<R> {
        flight_contact(cx, body, from + way, motion, time)
    }
}

/// Contact of a body at the end of a substep of `time`. Only in scenes with litter.
#[inline(always)]
pub fn flight_contact<R: Real>(
    cx: &Context<'_>,
    body: &LeafBody<R>,
    position: Vec3<R>,
    motion: FlightMotion<R>,
    time: R,
) -> Contact<R> {
    let reach = (body.half_along_m.max(body.half_across_m)) * body.size_ratio;
    let low = position.y.less_than(reach + cx.scene.highest_rest_m);
    if !low.any() {
        return Contact { position, motion, touches: low };
    }
    let above = position.y - ground_rest(cx, position.x, position.z);
    let near = low & above.less_than(reach * CONTACT_REACH);
    if !near.any() {
        return Contact { position, motion, touches: near };
    }
    let [rise_x, rise_z] = ground_gradient(cx, position.x, position.z);
    let none = reach.all(0.0);
    let up = inverse_sqrt((rise_x * rise_x + rise_z * rise_z) + 1.0);
    let normal = Vec3::new((rise_x * up) * -1.0, up, (rise_z * up) * -1.0);
    let inner = quat_rotate_back(motion.pose, normal);
    let (radius, arm) = support(body, inner);
    let gap = above * up - radius;
    let touches = near & gap.less_than(none);
    if !touches.any() {
        return Contact { position, motion, touches };
    }
    let depth = litter_height(cx, position.x, position.z);
    let is_bare = depth.less_than(reach.all(LITTER_DEEP_M));
    let surface = Surface {
        normal: inner,
        arm,
        restitution: is_bare.select_real(reach.all(cx.scene.litter.restitution), none),
        friction: contact_friction(cx, depth),
        weight_m_s: (time * cx.scene.gravity_m_s2) * up,
        takes_share: none.less_than(none),
    };
    let next = contact_response(body, &motion, &surface);
    let out = normal * (gap * -1.0);
    Contact {
        position: vec3_select(touches, position + out, position),
        motion: FlightMotion {
            velocity: vec3_select(touches, next.velocity, motion.velocity),
            pose: motion.pose,
            turning: vec3_select(touches, next.turning, motion.turning),
        },
        touches,
    }
}

/// Surface that a body strikes, in the body's frame.
#[derive(Clone, Copy, Debug)]
pub struct Surface<R: Real = f32> {
    /// Unit vector away from it.
    pub normal: Vec3<R>,
    /// Point of the body that strikes it.
    pub arm: Vec3<R>,
    /// Coefficient of restitution.
    pub restitution: R,
    /// Friction coefficient, or the share of the speed along the surface that a contact takes.
    pub friction: R,
    /// Speed towards it that the body's weight gives it in a substep, in m/s.
    pub weight_m_s: R,
    /// True where it is such a share.
    pub takes_share: R::Mask,
}

/// Motion of a body, relative to a surface, after it has struck that.
#[inline(always)]
pub fn contact_response<R: Real>(
    body: &LeafBody<R>,
    motion: &FlightMotion<R>,
    surface: &Surface<R>,
) -> FlightMotion<R> {
    let Surface { normal, arm, .. } = *surface;
    let none = normal.x.all(0.0);
    let share = body.inv_size_ratio * body.inv_size_ratio;
    let inv_inertia = body.inv_inertia * share;
    let velocity = quat_rotate_back(motion.pose, motion.velocity);
    let spin = motion.turning * body.inv_size_ratio;
    let meeting = velocity + vec3_cross(spin, arm);
    let closing = vec3_dot(meeting, normal);
    let restitution = closing.less_than(none.all(-BOUNCE_M_S)).select_real(surface.restitution, none);
    let striking = (closing * (restitution + 1.0)) * reciprocal(contact_yield(inv_inertia, arm, normal));
    let push = (striking * -1.0).max(none);
    let struck = contact_impulse(inv_inertia, arm, velocity, spin, normal * push);
    // Friction acts on what the push leaves: neither adds energy then.
    let left = struck.0 + vec3_cross(struck.1, arm);
    let sliding = left - normal * vec3_dot(left, normal);
    let squared = vec3_dot(sliding, sliding).max(none.all(TINY_SQUARED));
    let inverse = inverse_sqrt(squared);
    let way = sliding * inverse;
    let stopping = (squared * inverse) * reciprocal(contact_yield(inv_inertia, arm, way));
    // A body that lies on it presses with its weight, whichever of its points strikes.
    let weight = surface.weight_m_s;
    let resting = (vec3_dot(velocity, normal) * -1.0).min(weight).max(none);
    let pressing = push.less_than(weight + weight).select_real(resting, push);
    let shared = none.less_than(push).select_real(stopping * surface.friction, none);
    let drag = surface.takes_share.select_real(shared, stopping.min(surface.friction * pressing));
    let (next_velocity, next_spin) =
        contact_impulse(inv_inertia, arm, struck.0, struck.1, way * (drag * -1.0));
    FlightMotion {
        velocity: quat_rotate(motion.pose, next_velocity),
        pose: motion.pose,
        turning: next_spin * body.size_ratio,
    }
}

/// Velocity and spin of a body after an impulse over mass at a point, all in its frame.
#[inline(always)]
pub fn contact_impulse<R: Real>(
    inv_inertia: Vec3<R>,
    arm: Vec3<R>,
    velocity: Vec3<R>,
    spin: Vec3<R>,
    impulse: Vec3<R>,
) -> (Vec3<R>, Vec3<R>) {
    let turned = vec3_cross(arm, impulse);
    let next_spin = Vec3::new(
        spin.x + inv_inertia.x * turned.x,
        spin.y + inv_inertia.y * turned.y,
        spin.z + inv_inertia.z * turned.z,
    );
    (velocity + impulse, next_spin)
}

/// Change of the velocity of a point of a body, along a direction, per impulse over mass along it.
#[inline(always)]
pub fn contact_yield<R: Real>(inv_inertia: Vec3<R>, arm: Vec3<R>, direction: Vec3<R>) -> R {
    let lever = vec3_cross(arm, direction);
    let turn = Vec3::new(inv_inertia.x * lever.x, inv_inertia.y * lever.y, inv_inertia.z * lever.z);
    vec3_dot(lever, turn) + 1.0
}
