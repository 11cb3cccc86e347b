// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/wind/vortex.wgsl
//!
//! A straight vortex with a smooth core (Kaufmann): swirl `Gamma r / (2 pi (r^2 + a^2))`, axial jet
//! `w a^2 / (r^2 + a^2)`. Both are free of divergence.

use crate::arith::lane::Real;
use crate::arith::math::reciprocal;
use crate::arith::vector::{Vec3, vec3_cross, vec3_dot};
use crate::blocks::VortexBlock;

/// Velocity that one vortex adds at `place`, in m/s.
#[inline(always)]
pub fn wind_vortex<R: Real>(vortex: &VortexBlock, place: Vec3<R>) -> Vec3<R> {
    let axis = Vec3::from(vortex.axis).spread(place.x);
    let from_center = place - Vec3::from(vortex.center_m).spread(place.x);
    let radial = from_center - axis * vec3_dot(from_center, axis);
    let inverse = reciprocal(vec3_dot(radial, radial) + vortex.core_m2);
    vec3_cross(axis, radial) * (inverse * vortex.swirl_m2_s) + axis * (inverse * vortex.axial_m3_s)
}
