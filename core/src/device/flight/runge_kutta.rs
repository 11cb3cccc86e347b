// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/flight/runge_kutta.wgsl
//!
//! The classical fourth-order Runge-Kutta step of a body, and the number of substeps of a step.

use super::body::LeafBody;
use super::rates::{FlightMotion, flight_rates};
use crate::arith::lane::{Mask, Real};
use crate::arith::quaternion::{Quat, quat_normalize};
use crate::arith::vector::Vec3;
use crate::context::Context;

crate::shared_constants! {
    /// Largest number of halvings of a step.
    pub const MAX_HALVINGS: u32 = 6;
    /// Largest number of substeps.
    pub const MAX_SUBSTEPS: f32 = 64.0;
    /// A sixth.
    pub const SIXTH: f32 = 1.0 / 6.0;
}

/// Motion after a time in s at these rates.
#[inline(always)]
pub fn flight_stage<R: Real>(motion: &FlightMotion<R>, rates: &FlightMotion<R>, time: R) -> FlightMotion<R> {
    FlightMotion {
        velocity: motion.velocity + rates.velocity * time,
        pose: Quat::new(
            motion.pose.x + rates.pose.x * time,
            motion.pose.y + rates.pose.y * time,
            motion.pose.z + rates.pose.z * time,
            motion.pose.w + rates.pose.w * time,
        ),
        turning: motion.turning + rates.turning * time,
    }
}

/// The sum of two rates.
#[inline(always)]
pub fn flight_sum<R: Real>(a: &FlightMotion<R>, b: &FlightMotion<R>) -> FlightMotion<R> {
    FlightMotion {
        velocity: a.velocity + b.velocity,
        pose: Quat::new(a.pose.x + b.pose.x, a.pose.y + b.pose.y, a.pose.z + b.pose.z, a.pose.w + b.pose.w),
        turning: a.turning + b.turning,
    }
}

/// One step of `time` seconds: way in m and the motion at its end.
#[inline(always)]
pub fn flight_step<R: Real>(
    cx: &Context<'_>,
    body: &LeafBody<R>,
    motion: &FlightMotion<R>,
    wind: Vec3<R>,
    time: R,
) -> (Vec3<R>, FlightMotion<R>) {
    let half = time * 0.5;
    let k1 = flight_rates(cx, body, motion, wind);
    let k2 = flight_rates(cx, body, &flight_stage(motion, &k1, half), wind);
    let k3 = flight_rates(cx, body, &flight_stage(motion, &k2, half), wind);
    let k4 = flight_rates(cx, body, &flight_stage(motion, &k3, time), wind);
    let middle = flight_sum(&k2, &k3);
    let all = flight_sum(&flight_sum(&k1, &k4), &flight_sum(&middle, &middle));
    let sixth = time * SIXTH;
    let mut end = flight_stage(motion, &all, sixth);
    end.pose = quat_normalize(end.pose);
    let way = motion.velocity * time + (k1.velocity + middle.velocity) * (time * sixth);
    (way, end)
}

/// Substeps of a step.
#[derive(Clone, Copy, Debug)]
pub struct Substeps<R = f32> {
    /// Number of substeps, a power of two.
    pub count: R,
    /// Share of the step that each takes.
    pub share: R,
}

/// Substeps of a step under such a load: the smallest power of two that is not below it.
#[inline(always)]
pub fn substep_count<R: Real>(load: R) -> Substeps<R> {
    let mut count = load.all(1.0);
    let mut share = load.all(1.0);
    for _ in 0..MAX_HALVINGS {
        let more = count.less_than(load);
        count = more.select_real(count + count, count);
        share = more.select_real(share * 0.5, share);
    }
    Substeps { count, share }
}
