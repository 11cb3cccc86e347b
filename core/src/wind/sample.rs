// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/wind/sample.wgsl
//!
//! The wind at a place and step.

use super::gust::wind_gust;
use super::profile::wind_profile;
use super::turbulence::wind_turbulence;
use super::vortex::wind_vortex;
use crate::context::Context;
use crate::kernel::vector::Vec3;

/// Velocity of the air at `place` in m/s.
#[inline(always)]
pub fn wind_at(cx: &Context<'_>, place: Vec3) -> Vec3 {
    let wind = &cx.environment.wind;
    let direction_x = wind.mean.0[0];
    let direction_z = wind.mean.0[1];
    let along = place.x * direction_x + place.z * direction_z;
    let across = place.z * direction_x - place.x * direction_z;
    let height = place.y - wind.gust.0[2];
    let mean = (wind.mean.0[2] * wind_profile(cx, height)) * (1.0 + wind.gust.0[0] * wind_gust(cx, along));
    let turbulence = wind_turbulence(cx, Vec3::new(along, height, across));
    let u = mean + turbulence.x * wind.deviation.0[0];
    let v = turbulence.y * wind.deviation.0[1];
    let w = turbulence.z * wind.deviation.0[2];
    let mut air = Vec3::new(u * direction_x - w * direction_z, v, u * direction_z + w * direction_x);
    for index in 0..wind.tables.0[3] {
        air = air + wind_vortex(&cx.step.vortices[index as usize], place);
    }
    air
}
