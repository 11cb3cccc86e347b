// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/wind/jet.wgsl
//!
//! Round turbulent jets, which turn along the ground that they meet.
//!
//! # Model
//! In the open: a jet of uniform eddy viscosity (Pope, Turbulent Flows, 2000, section 5.2.2) with the stream function
//! `K b r² / 2 (r² + b²)` of distance r from the axis. Its velocity along the axis is `K b³ / (r² + b²)²`, and towards the axis it draws air
//! in. For any growth of the width b with distance it is free of divergence and keeps its momentum `π K² / 3` per density: that of
//! air which leaves the nozzle at one speed, `π d² U² / 4`. The width grows by [`JET_SPREAD`] per metre, so the half width by 0.094 (Hussein, Capp and
//! George, 1994, doi 10.1017/S002211209400323X), from where it is as wide as at the nozzle; there the core ends, at 5.9 diameters. Beyond, the speed on the axis is
//! `5.9 U d / x`, where 5.8 to 6.1 have been measured.
//!
//! On the ground: the axis bends and runs along it, at the speed that it had. What is lost of the momentum along the ground spreads
//! evenly all around as a radial wall jet, `C R / (R² + R0²)` along the ground times `(1 + η²)^-1.5` above it, free of divergence too: of an
//! oblique jet a share (1 + cos θ) / 2 goes on and (1 - cos θ) / 2 turns back (Taylor, "Oblique impact of a jet on a plane surface", 1966).
//! Wall jets from round nozzles are lower and wider than free ones and slow down alike (Launder and Rodi, 1983, doi
//! 10.1146/annurev.fl.15.010183.002241); here the upper half of a free one runs along the ground, with half of the momentum. A mirror image
//! would instead double the speed, and hold a downdraught up without letting it out sideways. Only where the axis bends is there divergence.
//! The ground slows a thin layer, by the logarithmic law of its roughness, and lets air neither in nor out.

use crate::arith::lane::{Mask, Real};
use crate::arith::math::{inverse_sqrt, reciprocal};
use crate::arith::vector::{Vec3, vec3_dot};
use crate::blocks::JetBlock;
use crate::context::Context;
use crate::device::wind::profile::{wind_profile, wind_vertical};

crate::shared_constants! {
    /// Growth of a jet's width b per metre: that of its half width, 0.094, over the root of √2 - 1.
    pub const JET_SPREAD: f32 = 0.146_054_75;
    /// Growth of the height of a radial wall jet per metre: that of the height of half its speed, 0.09, over the root of ∛4 - 1.
    pub const WALL_JET_SPREAD: f32 = 0.117_428_94;
    /// Height of the layer that the ground slows, in widths b: 0.15 of the half width (Launder and Rodi, 1983).
    pub const JET_LAYER: f32 = 0.096_539_14;
}

/// Part of a jet at a place.
#[derive(Clone, Copy, Debug)]
struct JetPart<R: Real> {
    /// Velocity in m/s, but for the friction of the ground.
    velocity: Vec3<R>,
    /// Width b in m.
    width: R,
}

/// Part of a jet along and around its axis.
#[inline(always)]
fn jet_along_axis<R: Real>(jet: &JetBlock, place: Vec3<R>) -> JetPart<R> {
    let none = place.x.all(0.0);
    let one = place.x.all(1.0);
    let axis = Vec3::from(jet.axis).spread(place.x);
    let heading = Vec3::from(jet.heading).spread(place.x);
    let from_nozzle = place - Vec3::from(jet.nozzle_m).spread(place.x);
    let along = vec3_dot(from_nozzle, axis);
    let past = (along - jet.turn_start_m).max(none);
    let turn = (past * jet.turns_per_m).min(one);
    let bent = turn * (past - turn * jet.half_turn_m);
    let radial = (from_nozzle - axis * along) - Vec3::from(jet.bend).spread(place.x) * bent;
    let grown = along * JET_SPREAD;
    let width = grown.max(place.x.all(jet.width_m));
    let half_growth =
        place.x.all(jet.width_m).less_than(grown).select_real(place.x.all(0.5 * JET_SPREAD), none);
    let width_squared = width * width;
    let squared = vec3_dot(radial, radial);
    let inverse = reciprocal(squared + width_squared);
    let share = (along * jet.diameters_per_m + 1.0).max(none).min(one);
    let level = (inverse * inverse) * (share * jet.strength_m2_s);
    let forward = level * (width * width_squared);
    let outward = (level * half_growth) * (width_squared - squared);
    JetPart { velocity: (axis + (heading - axis) * turn) * forward + radial * outward, width }
}

/// Part of a jet that spreads along the ground from where it meets it.
#[inline(always)]
fn jet_along_ground<R: Real>(jet: &JetBlock, place: Vec3<R>) -> JetPart<R> {
    let from_middle = place - Vec3::from(jet.middle_m).spread(place.x);
    let squared = from_middle.x * from_middle.x + from_middle.z * from_middle.z;
    let reach_squared = squared + jet.middle_m2;
    let inverse_reach = inverse_sqrt(reach_squared);
    let height = (reach_squared * inverse_reach) * WALL_JET_SPREAD;
    let inverse_rim = inverse_sqrt(height * height + from_middle.y * from_middle.y);
    let low = height * inverse_rim;
    let within = from_middle.y * inverse_rim;
    let inverse_squared = inverse_reach * inverse_reach;
    let outward = (inverse_squared * jet.wall_m2_s) * (low * (low * low));
    let rise = (squared * inverse_squared) * (within * (low * low - 1.0))
        - within * ((inverse_squared * jet.middle_m2) * 2.0);
    let up = (inverse_reach * (jet.wall_m2_s * WALL_JET_SPREAD)) * rise;
    JetPart { velocity: Vec3::new(from_middle.x * outward, up, from_middle.z * outward), width: height }
}

/// Velocity that one jet adds at `place`, so far above the ground, in m/s.
#[inline(always)]
pub fn wind_jet<R: Real>(cx: &Context<'_>, jet: &JetBlock, place: Vec3<R>, above: R) -> Vec3<R> {
    let part = jet_along_axis(jet, place);
    let wall = jet_along_ground(jet, place);
    let velocity = part.velocity + wall.velocity;
    let [_, level] = wind_profile(cx, above);
    let [_, layer] = wind_profile(cx, part.width.max(wall.width) * JET_LAYER);
    let slowed = (level * reciprocal(layer)).min(above.all(1.0));
    Vec3::new(velocity.x * slowed, velocity.y * wind_vertical(cx, above), velocity.z * slowed)
}
