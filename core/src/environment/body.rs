// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compiles a species as a body in the air.

use std::f64::consts::PI;

use glam::DVec3;

use super::convert::{float4, single, word};
use crate::flight::block::{BodyBlock, HOLD_RANDOM, HOLD_TILTED};
use crate::flight::coefficients::{
    DRAG_BEND, DRAG_BORNE, DRAG_EDGE, DRAG_RISE, LIFT_FLAT, LIFT_STEEP, MUNK_EDGE, SPIN_BORNE_RAD,
    SWING_BORNE_RAD, TWIST_TORQUE,
};
use crate::layout::{Float4, Uint4};
use crate::motion::AIR_DENSITY;
use crate::scene::{Aerodynamics, FlightModel, Hold, Species};

/// The body of a species; of a synthesised one the numbers of a plain disc, which nothing uses.
pub(super) fn body_block(species: &Species, dt_s: f32) -> BodyBlock {
    let body = match species.flight {
        FlightModel::Synthesis => Aerodynamics::default(),
        FlightModel::Aerodynamic(body) => body,
    };
    let areal = f64::from(species.areal_density_kg_m2) * (1.0 + f64::from(body.moisture));
    // Air per mass and area, in 1/m.
    let air = AIR_DENSITY / areal;
    let radius = 0.5 * f64::from(species.size_m);
    let planform = body.planform.unwrap_or_else(|| species.shape.planform());
    let stretch = libm::sqrt(f64::from(planform.aspect));
    let reach = radius * f64::from(planform.extent);
    let (along, across) = (reach * stretch, reach / stretch);
    let [along2, across2] = [along * along, across * across];
    // Of a disc in potential flow.
    let added = 8.0 / (3.0 * PI) * air * radius;
    let added_inertia = 16.0 / (45.0 * PI) * air * radius * radius * radius;
    let offset =
        DVec3::new(f64::from(body.mass_offset.1), -f64::from(body.curl), f64::from(body.mass_offset.0));
    let quirk = f64::from(body.irregularity) * radius;
    let dt = f64::from(dt_s);
    // Angular rate, per speed, at which the flow swings the body about the axis that resists least.
    let lever = offset.length() * radius + quirk;
    let inertia = 0.25 * along2.min(across2) + added_inertia;
    let broadside = 0.5 * f64::from(DRAG_EDGE + DRAG_RISE - DRAG_BEND);
    let lift = f64::from(LIFT_FLAT + LIFT_STEEP);
    let swing = libm::sqrt((added * f64::from(MUNK_EDGE) + (broadside + lift) * air * lever) / inertia);
    let load = (broadside * air / DRAG_BORNE).max(swing / SWING_BORNE_RAD);
    BodyBlock {
        air: Float4([air, added, air * along, air * across].map(single)),
        torque: Float4(
            [
                air * along2,
                air * across2,
                air * radius * radius,
                TWIST_TORQUE * f64::from(body.twist) * air * radius,
            ]
            .map(single),
        ),
        reach: Float4([along, across, radius, 0.0].map(single)),
        inertia: Float4(
            [0.25 * along2, 0.25 * (along2 + across2), 0.25 * across2, added_inertia].map(single),
        ),
        arm: float4(offset * -radius, 0.0),
        quirks: float4(DVec3::new(quirk, 0.5 * quirk, quirk), TWIST_TORQUE * air * quirk),
        load: Float4([single(dt * load), single(dt / SPIN_BORNE_RAD), 0.0, 0.0]),
        hold: hold_words(&body),
    }
}

/// Kind, tilt and half width of its spread.
fn hold_words(body: &Aerodynamics) -> Uint4 {
    let tilt = |degrees: f64| word(degrees / 360.0 * 65536.0);
    let spread = tilt(f64::from(body.tilt_deg));
    match body.hold {
        Hold::Random => Uint4([HOLD_RANDOM, 0, 0, 0]),
        Hold::Broadside => Uint4([HOLD_TILTED, 0, spread, 0]),
        Hold::EdgeOn => Uint4([HOLD_TILTED, tilt(90.0), spread, 0]),
    }
}
