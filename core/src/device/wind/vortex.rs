// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/wind/vortex.wgsl
//!
//! A vortex about a straight axis or a curve: swirl by its profile, that of Kaufmann `Gamma r / (2 pi (r^2 + a^2))`, and an axial jet
//! `w a^2 / (r^2 + a^2)`. About a straight axis both are free of divergence.

use crate::arith::lane::{Mask, Real};
use crate::arith::math::{inverse_sqrt, reciprocal};
use crate::arith::vector::{TINY_SQUARED, Vec3, vec3_cross, vec3_dot, vec3_select};
use crate::blocks::VortexBlock;
use crate::scene::SPLINE_SEGMENTS;

crate::shared_constants! {
    /// Profile that ends at its radius.
    pub const SWIRL_COMPACT: u32 = 3;
    /// Profile of Kaufmann; smaller numbers are exponents.
    pub const SWIRL_KAUFMANN: u32 = 4;
    /// Square of the least distance from its axis, in radii, from which on a swirl grows no more.
    pub const SWIRL_LEAST_SQUARED: f32 = 0.01;
    /// Segments of a curved axis.
    pub const CURVE_SEGMENTS: u32 = SPLINE_SEGMENTS as u32;
}

/// Axis of a vortex nearest to a place.
#[derive(Clone, Copy, Debug)]
pub struct NearAxis<R> {
    /// Way from the axis to the place, across it, in m.
    pub radial: Vec3<R>,
    /// Unit vector along it.
    pub axis: Vec3<R>,
}

/// Velocity that one vortex adds at `place`, in m/s.
#[inline(always)]
pub fn wind_vortex<R: Real>(vortex: &VortexBlock, place: Vec3<R>) -> Vec3<R> {
    let NearAxis { radial, axis } = vortex_axis(vortex, place);
    let squared = vec3_dot(radial, radial);
    let inverse = reciprocal(squared + vortex.core_m2);
    if vortex.profile == SWIRL_KAUFMANN {
        return vec3_cross(axis, radial) * (inverse * vortex.swirl_m2_s)
            + axis * (inverse * vortex.axial_m3_s);
    }
    let inv_core = reciprocal(vortex.core_m2);
    let share = swirl_profile(vortex.profile, vortex.widening, squared * inv_core);
    vec3_cross(axis, radial) * (share * (inv_core * vortex.swirl_m2_s)) + axis * (inverse * vortex.axial_m3_s)
}

/// The axis nearest to a place: a straight one, or the nearest segment of the curve, the first and the last of which go on beyond it.
#[inline(always)]
pub fn vortex_axis<R: Real>(vortex: &VortexBlock, place: Vec3<R>) -> NearAxis<R> {
    let mut axis = Vec3::from(vortex.axis).spread(place.x);
    let from_center = place - Vec3::from(vortex.center_m).spread(place.x);
    let mut radial = from_center - axis * vec3_dot(from_center, axis);
    if vortex.is_curved == 0 {
        return NearAxis { radial, axis };
    }
    let mut least = place.x.all(1e30);
    for number in 0..CURVE_SEGMENTS {
        let node = &vortex.nodes[number as usize];
        let start = Vec3::from(node.place_m);
        let along = (Vec3::from(vortex.nodes[number as usize + 1].place_m) - start).spread(place.x);
        let apart = place - start.spread(place.x);
        let mut share = vec3_dot(apart, along) * node.inv_squared;
        if number != 0 {
            share = share.max(share.all(0.0));
        }
        if number + 1 != CURVE_SEGMENTS {
            share = share.min(share.all(1.0));
        }
        let across = apart - along * share;
        let squared = vec3_dot(across, across);
        let is_nearer = squared.less_than(least);
        least = is_nearer.select_real(squared, least);
        radial = vec3_select(is_nearer, across, radial);
        axis = vec3_select(is_nearer, along, axis);
    }
    let length_squared = vec3_dot(axis, axis);
    NearAxis { radial, axis: axis * inverse_sqrt(length_squared.max(length_squared.all(TINY_SQUARED))) }
}

/// Rate of a vortex over that of its number, so many squared radii from its axis.
#[inline(always)]
pub fn swirl_profile<R: Real>(profile: u32, widening: f32, squared: R) -> R {
    let one = squared.all(1.0);
    if profile == SWIRL_COMPACT {
        let inside = squared.less_than(one);
        let left = one - squared;
        let share = (left * left) * reciprocal(squared * widening + 1.0);
        return inside.select_real(share, squared.all(0.0));
    }
    let least = squared.max(squared.all(SWIRL_LEAST_SQUARED));
    if profile == 0 {
        one
    } else if profile == 1 {
        inverse_sqrt(least)
    } else {
        reciprocal(least)
    }
}
