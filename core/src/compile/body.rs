// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compiles a species as a body in the air.

use std::f64::consts::PI;

use crate::convert::{single, word};
use crate::device::terrain::litter::{LITTER_CELLS_PER_M, LITTER_UNIT_M};
use crate::flight::block::{BodyBlock, HOLD_RANDOM, HOLD_TILTED};
use crate::flight::coefficients::{
    ASYMMETRY_CURL, DRAG_BORNE, NORMAL_BEND, NORMAL_EDGE, NORMAL_RISE, SPIN_BORNE_RAD, SWING_BORNE_RAD,
    TANGENT_SPIN, TICKS_PER_S, TWIST_TORQUE,
};
use crate::flight::mass::MassDistribution;
use crate::motion::AIR_DENSITY;
use crate::scene::{Aerodynamics, FlightModel, Hold, STANDARD_GRAVITY_M_S2, Scene, Species};

/// Descent of a body of such a mass per area, measured on paper (Howison, Hughes and Iida 2020); others as the root of
/// their weight per area.
const USUAL_DESCENT_M_S: f64 = 0.757;
const USUAL_AREAL_KG_M2: f64 = 0.07;
/// Diameters that a body falls without an event before it counts as idle.
const IDLE_DIAMETERS: f64 = 10.0;

/// The body of a species; of a synthesised one the numbers of a plain disc, which nothing uses.
pub(super) fn body_block(species: &Species, scene: &Scene) -> BodyBlock {
    let body = match species.flight {
        FlightModel::Synthesis => Aerodynamics::default(),
        FlightModel::Aerodynamic(body) => body,
    };
    let litter = scene.ground.litter.unwrap_or_default();
    let water = species.moisture(scene.ground.litter.as_ref());
    let areal = f64::from(species.areal_density_kg_m2) * (1.0 + water);
    // Air per mass and area, in 1/m.
    let air = AIR_DENSITY / areal;
    let radius = 0.5 * f64::from(species.size_m);
    let planform = species.planform();
    let stretch = libm::sqrt(f64::from(planform.aspect));
    let reach = radius * f64::from(planform.extent);
    let (along, across) = (reach * stretch, reach / stretch);
    let (long, short) = (along.max(across), along.min(across));
    // Of an ellipse in potential flow.
    let flatness = libm::pow(short / long, 1.5);
    let elliptic = 1.0 + (PI / 2.0 - 1.0) * flatness;
    let added = 4.0 / 3.0 * air * long * short * short / (elliptic * radius * radius);
    let mass = MassDistribution::of(species);
    let spread = f64::from(body.irregularity) * radius;
    let inertia = mass.inertia * (radius * radius);
    let [air_x, air_z] = [(along, across), (across, along)]
        .map(|(sweeping, other)| added_inertia(sweeping, other) * air / (PI * radius * radius));
    // Angular rate, per speed, at which the flow swings the body about the axis that resists least.
    let broadside = f64::from(NORMAL_EDGE + NORMAL_RISE + NORMAL_BEND + 0.5 * body.edge_drag);
    let lever = (broadside + f64::from(NORMAL_EDGE)) * air * (mass.centre.length() * radius + spread);
    let swing = libm::sqrt((added + lever) / (inertia.x + air_x).min(inertia.z + air_z)) / SWING_BORNE_RAD;
    let spun = f64::from(TANGENT_SPIN) * air * long / DRAG_BORNE;
    let dt = f64::from(scene.dt_s);
    let weight = areal / USUAL_AREAL_KG_M2 * f64::from(scene.gravity_m_s2 / STANDARD_GRAVITY_M_S2);
    let usual_m_s = USUAL_DESCENT_M_S * libm::sqrt(weight);
    let cells_per_m = f64::from(LITTER_CELLS_PER_M);
    let layer = f64::from(species.areal_density_kg_m2) / f64::from(litter.bulk_density_kg_m3);
    let (hold_kind, hold_tilt) = match body.hold {
        Hold::Random => (HOLD_RANDOM, 0),
        Hold::Broadside => (HOLD_TILTED, 0),
        Hold::EdgeOn => (HOLD_TILTED, tilt_q16(90.0)),
    };
    BodyBlock {
        air_per_m: single(air),
        added_mass: single(added),
        air_along: single(air * along),
        air_across: single(air * across),
        half_along_m: single(along),
        half_across_m: single(across),
        half_mean_m: single(reach),
        twist_m: single(TWIST_TORQUE * f64::from(body.twist) * air * radius),
        lift_slope_across: single(lift_slope(along, across)),
        lift_slope_along: single(lift_slope(across, along)),
        air_inertia_x_m2: single(air_x),
        air_inertia_z_m2: single(air_z),
        inertia_m2: inertia.to_array().map(single),
        pitch_damping: body.pitch_damping,
        centroid_m: (mass.centre * -radius).to_array().map(single),
        edge_drag: body.edge_drag,
        centroid_spread_m: [spread, ASYMMETRY_CURL * spread, spread].map(single),
        twist_spread_m: single(TWIST_TORQUE * air * spread),
        load_per_speed: single(dt * (broadside * air / DRAG_BORNE).max(swing)),
        load_per_spin: single(dt * (swing * long + 1.0 / SPIN_BORNE_RAD + spun)),
        idle_timeout_ticks: single(
            libm::round(IDLE_DIAMETERS * 2.0 * reach / usual_m_s * TICKS_PER_S).clamp(2.0, 63.0),
        ),
        hold_kind,
        hold_tilt,
        hold_spread: tilt_q16(f64::from(body.tilt_deg)),
        layer_m: single(layer),
        litter_units: single(
            PI * radius * radius * layer * cells_per_m * cells_per_m / f64::from(LITTER_UNIT_M),
        ),
    }
}

/// Inertia over density, in m⁵, of the air that an ellipse with these half axes drags along as it turns about the second:
/// within 2 % of potential flow.
fn added_inertia(sweeping: f64, other: f64) -> f64 {
    let cubed = sweeping * sweeping * sweeping;
    if sweeping >= other {
        0.8386 * cubed * other * other * (1.0 - 0.576 * other / sweeping)
    } else {
        0.4188 * cubed * sweeping * other * (1.0 - 0.151 * sweeping / other)
    }
}

/// Slope of the lift of an ellipse that slips along its second half axis, relative to a disc's.
///
/// # Source
/// Helmbold (1942), for wings of low aspect ratio.
fn lift_slope(span: f64, chord: f64) -> f64 {
    let slope = |aspect: f64| 2.0 * PI * aspect / (2.0 + libm::sqrt(4.0 + aspect * aspect));
    slope(4.0 * span / (PI * chord)) / slope(4.0 / PI)
}

/// An angle in 2^-16 turns.
fn tilt_q16(degrees: f64) -> u32 {
    word(degrees / 360.0 * 65536.0)
}
