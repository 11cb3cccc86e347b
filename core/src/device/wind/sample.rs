// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/wind/sample.wgsl
//!
//! The wind at a place and step. The mean wind and turbulence grow with height above the ground beneath;
//! turbulence is carried on the level. Shelter takes from the mean wind alone.

use super::gust::wind_gust;
use super::jet::wind_jet;
use super::plume::wind_plume;
use super::profile::{wind_profile, wind_vertical};
use super::shelter::wind_shelter;
use super::slipstream::wind_slipstream;
use super::turbulence::wind_turbulence;
use super::vortex::wind_vortex;
use crate::arith::lane::Real;
use crate::arith::vector::Vec3;
use crate::blocks::MOMENT_NOW;
use crate::context::Context;
use crate::device::terrain::ground::ground_relief;
use crate::device::terrain::litter::above_litter;

/// Velocity of the air at `place` at the start of the step, in m/s.
#[inline(always)]
pub fn wind_at<R: Real>(cx: &Context<'_>, place: Vec3<R>) -> Vec3<R> {
    wind_at_moment(cx, MOMENT_NOW, place)
}

/// Velocity of the air at `place` at a moment of the step, in m/s.
#[inline(always)]
pub fn wind_at_moment<R: Real>(cx: &Context<'_>, moment: u32, place: Vec3<R>) -> Vec3<R> {
    let at = &cx.step.moments[moment as usize];
    let wind = &cx.scene.wind;
    let direction_x = wind.direction_x;
    let direction_z = wind.direction_z;
    let along = place.x * direction_x + place.z * direction_z;
    let across = place.z * direction_x - place.x * direction_z;
    let height = place.y - cx.scene.ground_height_m;
    let lowest = height.all(wind.lowest_surface_m);
    let above = if cx.scene.has_terrain() {
        height - ground_relief(cx, place.x, place.z).max(lowest)
    } else {
        height - lowest.max(height.all(0.0))
    };
    let above = if cx.has_litter() { above_litter(cx, above, place.x, place.z) } else { above };
    let [profile, level] = wind_profile(cx, above);
    let mut mean = (profile * wind.mean_speed_m_s) * (wind_gust(cx, at, along) * wind.gust_strength + 1.0);
    if cx.scene.has_shelter() {
        mean = mean * wind_shelter(cx, place.x, above, place.z);
    }
    let deviation = Vec3::from(wind.deviation_m_s);
    let mut turbulence = Vec3::<f32>::ZERO.spread(height);
    if deviation.x != 0.0 {
        turbulence = wind_turbulence(cx, at, Vec3::new(along, height, across));
    }
    let u = mean + (turbulence.x * deviation.x) * level;
    let v = (turbulence.y * deviation.y) * wind_vertical(cx, above);
    let w = (turbulence.z * deviation.z) * level;
    let mut air = Vec3::new(u * direction_x - w * direction_z, v, u * direction_z + w * direction_x);
    for index in 0..cx.step.vortex_count {
        air = air + wind_vortex(&at.vortices[index as usize], place);
    }
    for index in 0..cx.step.jet_count {
        air = air + wind_jet(cx, &at.jets[index as usize], place, above);
    }
    for index in 0..cx.step.plume_count {
        air = air + wind_plume(cx, &at.plumes[index as usize], place, level);
    }
    for index in 0..cx.step.slipstream_count {
        air = air + wind_slipstream(&at.slipstreams[index as usize], place);
    }
    air
}
