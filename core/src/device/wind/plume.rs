// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/wind/plume.wgsl
//!
//! Hot air that rises above a fire and draws in the air around it.
//!
//! # Model
//! On the axis the air rises as McCaffrey measured (Purely Buoyant Diffusion Flames, NBSIR 79-1910, 1979): of a fire of Q kW, at
//! z / Q^0.4 = ζ, with `6.84 ζ^0.5 Q^0.2` m/s in the steady flame, `1.93 Q^0.2` where it flickers and `1.12 ζ^(-1/3) Q^0.2` above, the three
//! joined smoothly. About the axis the speed falls as a bell `exp(-r² / b²)`, of a width b that grows by [`PLUME_SPREAD`] per metre from
//! the radius of the fire. Towards the axis comes what the stream function `W b² (1 - exp(-r² / b²)) / 2` draws in: no divergence, for any
//! speed and width. What lies below the base does not move. The temperature, which heats leaves, is that of the same measurements.
//!
//! Fires puff, `1.5 D^(-1/2)` times a second over a base D m wide (Cetegen & Ahmed, Combustion and Flame 93, 1993): swellings of the speed
//! rise from the base at half the speed of the flickering flame, largest at its tip, and are gone at three times its height. They leave the mean as
//! measured, and the air that comes in follows them, so that there is no divergence either. By how much they swell is an assumption.
//!
//! In wind the axis leans: each disc of the plume is shifted along the wind, by so much that the axis is the path of the air on it. The wind goes on through the
//! axis and around the plume, as about something in its way, in flat layers without divergence.

use crate::arith::lane::{Mask, Real};
use crate::arith::math::{exponential, inverse_cube_root, inverse_sqrt, reciprocal};
use crate::arith::vector::{Vec3, vec3_select};
use crate::blocks::PlumeBlock;
use crate::context::Context;

crate::shared_constants! {
    /// Growth of a plume's width b per metre.
    pub const PLUME_SPREAD: f32 = 0.12;
    /// Speed on the axis in the steady flame over that of the fire, per root of the height.
    pub const PLUME_FLAME: f32 = 6.84;
    /// Speed on the axis where the flame flickers over that of the fire.
    pub const PLUME_FLICKER: f32 = 1.93;
    /// Speed on the axis above the flame over that of the fire, times the cube root of the height.
    pub const PLUME_ABOVE: f32 = 1.12;
    /// Temperature rise in K in the steady flame.
    pub const PLUME_FLAME_K: f32 = 800.0;
    /// Temperature rise in K where the flame flickers, times the height over Q^0.4.
    pub const PLUME_FLICKER_K: f32 = 63.0;
    /// Temperature rise in K above the flame, times that height to the power of 5/3.
    pub const PLUME_ABOVE_K: f32 = 21.6;
    /// Share of the speed by which puffs change it at the most.
    pub const PLUME_PUFF: f32 = 0.3;
    /// Height over Q^0.4 at which puffs are gone.
    pub const PLUME_PUFF_TOP: f32 = 0.6;
    /// Speed at which puffs rise over that of the fire.
    pub const PLUME_PUFF_SPEED: f32 = 0.965;
    /// Difference of two of these speeds below which they are blended.
    pub const PLUME_BLEND: f32 = 0.06;
    /// Height below which the speed falls to nothing at the base.
    pub const PLUME_FOOT: f32 = 0.01;
    /// Squared distance from the axis in widths below which the share of a bell within it comes from its series.
    pub const PLUME_NEAR_AXIS: f32 = 0.02;
    /// The same from which on there is nothing of it: further out it would become a subnormal number, which devices may take for zero.
    pub const PLUME_EDGE: f32 = 40.0;
}

/// Speed on the axis of a plume over that of its fire, and how much it grows per height.
#[derive(Clone, Copy, Debug)]
pub struct PlumeRise<R> {
    /// The speed.
    pub speed: R,
    /// Its growth.
    pub growth: R,
}

/// The smaller one, blended where they are nearly the same.
#[inline(always)]
fn rise_least<R: Real>(one: PlumeRise<R>, other: PlumeRise<R>) -> PlumeRise<R> {
    let difference = (other.speed - one.speed) * (0.5 / PLUME_BLEND);
    let share = (difference + 0.5).max(one.speed.all(0.0)).min(one.speed.all(1.0));
    let rest = one.speed.all(1.0) - share;
    PlumeRise {
        speed: (one.speed * share + other.speed * rest) - (share * rest) * PLUME_BLEND,
        growth: one.growth * share + other.growth * rest,
    }
}

/// Speed on the axis at a height over Q^0.4, which is not negative.
#[inline(always)]
pub fn plume_rise<R: Real>(height: R) -> PlumeRise<R> {
    let foot = height.all(PLUME_FOOT);
    let above_foot = height.max(foot);
    let inverse_root = inverse_sqrt(above_foot);
    let inverse_cube = inverse_cube_root(above_foot);
    let flame = (above_foot * inverse_root) * PLUME_FLAME;
    let share = height.min(foot) * (1.0 / PLUME_FOOT);
    let steady = PlumeRise {
        speed: flame * (share * (height.all(1.5) - share * 0.5)),
        growth: inverse_root * ((height.all(1.5) - share) * PLUME_FLAME),
    };
    let in_foot = height.less_than(foot);
    let steady = PlumeRise {
        speed: steady.speed,
        growth: in_foot.select_real(steady.growth, inverse_root * (0.5 * PLUME_FLAME)),
    };
    let flicker = PlumeRise { speed: height.all(PLUME_FLICKER), growth: height.all(0.0) };
    let squared = inverse_cube * inverse_cube;
    let above =
        PlumeRise { speed: inverse_cube * PLUME_ABOVE, growth: (squared * squared) * (-PLUME_ABOVE / 3.0) };
    rise_least(rise_least(steady, flicker), above)
}

/// Share by which puffs change the speed on the axis at a height over Q^0.4, and how much it grows per height: `turns` of them have left the
/// base, and so many fit in one of these heights.
#[inline(always)]
pub fn plume_puff<R: Real>(height: R, turns: R, per_height: R) -> PlumeRise<R> {
    let one = height.all(1.0);
    let done = height * (1.0 / PLUME_PUFF_TOP);
    let rest = (one - done).max(height.all(0.0));
    let size = (done * (rest * rest)) * (6.75 * PLUME_PUFF);
    let swelling = (rest * (rest - done * 2.0)) * (6.75 * PLUME_PUFF / PLUME_PUFF_TOP);
    let left = turns - height * per_height;
    let phase = left - (left + 0.5).floor();
    let off = phase.max(-phase);
    let wave = (phase * (one - off * 2.0)) * 8.0;
    let slope = (one - off * 4.0) * 8.0;
    PlumeRise { speed: size * wave, growth: swelling * wave - (size * per_height) * slope }
}

/// A place in a plume.
#[derive(Clone, Copy, Debug)]
pub struct PlumePoint<R: Real> {
    /// True below the base.
    pub is_below: R::Mask,
    /// Height above the base in m.
    pub height: R,
    /// Slope of the axis there.
    pub slope: R,
    /// Distance from the axis along the wind in m.
    pub along: R,
    /// Distance from it across the wind in m.
    pub across: R,
}

/// A place in the frame of a plume, whose axis leans.
#[inline(always)]
pub fn plume_point<R: Real>(cx: &Context<'_>, plume: &PlumeBlock, place: Vec3<R>) -> PlumePoint<R> {
    let wind = &cx.scene.wind;
    let none = place.x.all(0.0);
    let from_base = place - Vec3::from(plume.base_m).spread(place.x);
    let is_below = from_base.y.less_than(none);
    let height = from_base.y.max(none);
    let mut slope = place.x.all(plume.base_slope);
    let mut lean = height * plume.base_slope;
    for bend in &plume.bends {
        let past = (height - bend.from_m).max(none);
        let turned = past * bend.turned_per_m;
        slope = slope + turned;
        lean = lean + (turned * past) * 0.5;
    }
    let along = (from_base.x * wind.direction_x + from_base.z * wind.direction_z) - lean;
    let across = from_base.z * wind.direction_x - from_base.x * wind.direction_z;
    PlumePoint { is_below, height, slope, along, across }
}

/// Fire beneath a plume.
#[derive(Clone, Copy, Debug)]
pub struct PlumeFire {
    /// Speed that it gives in m/s.
    pub speed_m_s: f32,
    /// Inverse of the height that scales the plume in 1/m.
    pub heights_per_m: f32,
}

/// Fire beneath a plume, of a given power or as leaves feed it.
#[inline(always)]
pub fn plume_fire(cx: &Context<'_>, plume: &PlumeBlock) -> PlumeFire {
    if plume.fire == 0 {
        return PlumeFire { speed_m_s: plume.speed_m_s, heights_per_m: plume.heights_per_m };
    }
    // Before there is litter, nothing burns.
    let word =
        |place: u32| f32::from_bits(cx.litter.get((plume.fire + place) as usize).copied().unwrap_or(0));
    PlumeFire { speed_m_s: word(1), heights_per_m: word(2) }
}

/// Bell about the axis of a plume, by the squared distance from it in widths.
#[inline(always)]
fn plume_bell<R: Real>(squared: R) -> R {
    squared.less_than(squared.all(PLUME_EDGE)).select_real(exponential(-squared), squared.all(0.0))
}

/// Temperature rise in K on the axis of a plume at a height over Q^0.4: [`PLUME_FLAME_K`] in the steady flame, then falling as measured.
#[inline(always)]
pub fn plume_axis_warmth(height: f32) -> f32 {
    let above_foot = height.max(PLUME_FOOT);
    let inverse_cube = inverse_cube_root(above_foot);
    let squared = inverse_cube * inverse_cube;
    let above = (squared * squared) * inverse_cube * PLUME_ABOVE_K;
    (reciprocal(above_foot) * PLUME_FLICKER_K).min(above).min(PLUME_FLAME_K)
}

/// Temperature rise in K of the air at a place by all plumes: that of the hottest. It falls away from an axis as the speed does.
#[inline(always)]
pub fn plume_warmth(cx: &Context<'_>, place: Vec3) -> f32 {
    let mut warmth = 0.0_f32;
    let moment = &cx.step.moments[0];
    for plume in &moment.plumes[..cx.step.plume_count as usize] {
        let point = plume_point(cx, plume, place);
        let fire = plume_fire(cx, plume);
        if point.is_below || fire.speed_m_s == 0.0 {
            continue;
        }
        let inverse_width = reciprocal(point.height * PLUME_SPREAD + plume.base_radius_m);
        let squared =
            (point.along * point.along + point.across * point.across) * (inverse_width * inverse_width);
        warmth = warmth.max(plume_axis_warmth(point.height * fire.heights_per_m) * plume_bell(squared));
    }
    warmth
}

/// Velocity that one plume adds at `place` in m/s, where the ground leaves the share `level` of level turbulence.
#[inline(always)]
pub fn wind_plume<R: Real>(cx: &Context<'_>, plume: &PlumeBlock, place: Vec3<R>, level: R) -> Vec3<R> {
    let wind = &cx.scene.wind;
    let none = level.all(0.0);
    let one = level.all(1.0);
    let PlumePoint { is_below, height, slope, along, across } = plume_point(cx, plume, place);
    let inverse_width = reciprocal(height * PLUME_SPREAD + plume.base_radius_m);
    let inverse_squared = inverse_width * inverse_width;
    let squared = (along * along + across * across) * inverse_squared;
    let bell = plume_bell(squared);
    let near = squared.less_than(level.all(PLUME_NEAR_AXIS));
    let series = one - squared * (one * 0.5 - squared * (1.0 / 6.0));
    let within = near.select_real(series, (one - bell) * reciprocal(squared.max(level.all(PLUME_NEAR_AXIS))));
    let PlumeFire { speed_m_s: fire_m_s, heights_per_m } = plume_fire(cx, plume);
    let rise = plume_rise(height * heights_per_m);
    let per_height =
        plume.puffs_per_s * reciprocal((fire_m_s * heights_per_m * PLUME_PUFF_SPEED).max(PLUME_FOOT));
    let puff = plume_puff(height * heights_per_m, level.all(plume.puffs), level.all(per_height));
    let swollen = one + puff.speed;
    let speed = (rise.speed * swollen) * fire_m_s;
    let growth = (rise.growth * swollen + rise.speed * puff.growth) * (fire_m_s * heights_per_m);
    let widening = (speed * inverse_width) * PLUME_SPREAD;
    let inflow = (widening * bell - (growth * 0.5 + widening) * within) * (level * plume.inv_layer).min(one);
    let passing = ((speed * slope) * (bell * inverse_squared)) * 2.0;
    let u = inflow * along + passing * (across * across);
    let w = inflow * across - passing * (along * across);
    let air = Vec3::new(
        u * wind.direction_x - w * wind.direction_z,
        speed * bell,
        u * wind.direction_z + w * wind.direction_x,
    );
    vec3_select(is_below, Vec3::new(none, none, none), air)
}
