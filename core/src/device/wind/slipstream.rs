// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/wind/slipstream.wgsl
//!
//! Air that a solid thing drags along as it moves: the momentum that its drag gives to the air, spread over a bell that widens behind it,
//! as behind a tree that stands in the wind (see [`PorousWake`](crate::wind)), in the frame of the thing.

use crate::arith::lane::Real;
use crate::arith::math::{inverse_sqrt, reciprocal};
use crate::arith::vector::{Vec3, vec3_dot};
use crate::blocks::SlipstreamBlock;

crate::shared_constants! {
    /// Widening of a slipstream per metre behind its thing; an assumption, as of the wakes of trees.
    pub const SLIPSTREAM_SPREAD: f32 = 0.1;
    /// Inverse of the part of its length in which the rest of it fades out.
    pub const SLIPSTREAM_FADES: f32 = 4.0;
}

/// Velocity that one slipstream adds at `place`, in m/s.
#[inline(always)]
pub fn wind_slipstream<R: Real>(stream: &SlipstreamBlock, place: Vec3<R>) -> Vec3<R> {
    let heading = Vec3::from(stream.heading).spread(place.x);
    let from_center = place - Vec3::from(stream.center_m).spread(place.x);
    let behind = vec3_dot(from_center, heading) * -1.0;
    let radial = from_center + heading * behind;
    let (none, all) = (behind.all(0.0), behind.all(1.0));
    let spread = behind.max(none) * SLIPSTREAM_SPREAD + stream.spread_m;
    let inverse = reciprocal(spread * spread);
    // As much on the axis as makes the momentum behind the thing that of its drag.
    let left = all - inverse * stream.drag_m2;
    let lack = (all - left * inverse_sqrt(left)) * 1.5;
    let bell = reciprocal((vec3_dot(radial, radial) * inverse) * 0.5 + 1.0);
    let front = (behind * stream.fronts_per_m + 1.0).max(none).min(all);
    let fade = ((all - behind * stream.lengths_per_m) * SLIPSTREAM_FADES).max(none).min(all);
    heading * (((lack * (bell * bell)) * (front * fade)) * stream.speed_m_s)
}
