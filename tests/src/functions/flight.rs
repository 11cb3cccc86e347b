// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The functions that fly bodies.

use windfall_core::arith::Vec3;
use windfall_core::device::flight::body::{LeafBody, body_of};
use windfall_core::device::flight::contact::OverGround;
use windfall_core::device::flight::rates::{FlightMotion, flight_rates};
use windfall_core::device::flight::regime::{regime_after, regime_in_spin, regime_of};
use windfall_core::device::flight::runge_kutta::{flight_step, substep_count};
use windfall_core::device::leaf::fly::{
    Flight, flight_advance, flight_load, longest_way_squared, update_regime,
};
use windfall_core::device::leaf::launch::{hold_pose, random_asymmetry, random_pose};
use windfall_core::device::leaf::record::{SIZE_ONE, SPECIES_SHIFT, flies};

use super::{Function, Input, float, floats, functions, integers, quaternion, vector};
use crate::runner::Words;

const ANY: Input = Input::Word;
const FLOW: Input = Input::Floats(3, -12.0, 12.0);
const SPIN: Input = Input::Floats(3, -40.0, 40.0);
/// Near enough to unit length, as between two stages of a step.
const POSE: Input = Input::Floats(4, -0.55, 0.55);
/// The species of the test scene that fly as bodies.
const SPECIES: Input = Input::Below(2);
const SIZE: Input = Input::Below(8192);

fn body(cx: &windfall_core::Context<'_>, species: u32, size: u32, asymmetry: u32) -> LeafBody {
    body_of(cx, (1 + species) << SPECIES_SHIFT, (SIZE_ONE - 4096 + size) | (asymmetry << 16))
}

fn motion(words: &Words, at: usize) -> FlightMotion {
    FlightMotion {
        velocity: vector(words, at),
        pose: quaternion(words, at + 3),
        turning: vector(words, at + 7),
    }
}

fn components(motion: &FlightMotion) -> [f32; 10] {
    let mut all = [0.0; 10];
    all[..3].copy_from_slice(&motion.velocity.to_array());
    all[3..7].copy_from_slice(&motion.pose.to_array());
    all[7..].copy_from_slice(&motion.turning.to_array());
    all
}

functions! {
    FLIGHT_FUNCTIONS;

    body_of in "flight/body" (SPECIES, SIZE, ANY) tolerance Some(1e-5);
    wgsl "let body = body_of((1u + a.x) << SPECIES_SHIFT, (SIZE_ONE - 4096u + a.y) | (a.z << 16u));
        out_float(0u, body.air_per_m); out_float(1u, body.added_mass); out_float(2u, body.air_along);
        out_float(3u, body.air_across); out_float(4u, body.half_along_m); out_float(5u, body.half_across_m);
        out_float(6u, body.half_mean_m); out_float(7u, body.twist_m); out_vec3(8u, body.inv_inertia);
        out_vec3(11u, body.gyration); out_vec3(14u, body.centroid); out_float(17u, body.resistance);
        out_float(18u, body.size_ratio); out_float(19u, body.inv_size_ratio); out_float(20u, body.lift_slope_across);
        out_float(21u, body.lift_slope_along); out_float(22u, body.pitch_damping); out_float(23u, body.edge_drag);
        out_float(24u, body.screw_m); out_float(25u, body.viscous_m_s);";
    rust |cx, w| {
        let body = body(cx, w[0], w[1], w[2]);
        let mut all = [0.0; 26];
        all[..8].copy_from_slice(&[
            body.air_per_m, body.added_mass, body.air_along, body.air_across,
            body.half_along_m, body.half_across_m, body.half_mean_m, body.twist_m,
        ]);
        all[8..11].copy_from_slice(&body.inv_inertia.to_array());
        all[11..14].copy_from_slice(&body.gyration.to_array());
        all[14..17].copy_from_slice(&body.centroid.to_array());
        all[17..].copy_from_slice(&[
            body.resistance, body.size_ratio, body.inv_size_ratio, body.lift_slope_across, body.lift_slope_along,
            body.pitch_damping, body.edge_drag, body.screw_m, body.viscous_m_s,
        ]);
        floats(all)
    };

    flight_rates in "flight/rates" (SPECIES, SIZE, ANY, FLOW, POSE, SPIN, FLOW) tolerance Some(1e-4);
    wgsl "let body = body_of((1u + a.x) << SPECIES_SHIFT, (SIZE_ONE - 4096u + a.y) | (a.z << 16u));
        let rates = flight_rates(body, FlightMotion(in_vec3(3u), in_vec4(6u), in_vec3(10u)), in_vec3(13u));
        out_vec3(0u, rates.velocity); out_vec4(3u, rates.pose); out_vec3(7u, rates.turning);";
    rust |cx, w| {
        let rates = flight_rates(cx, &body(cx, w[0], w[1], w[2]), &motion(w, 3), vector(w, 13));
        floats(components(&rates))
    };

    flight_step in "flight/runge_kutta" (
        SPECIES, SIZE, ANY, FLOW, POSE, SPIN, FLOW, Input::Float(0.0001, 0.002)
    ) tolerance Some(1e-4);
    wgsl "let body = body_of((1u + a.x) << SPECIES_SHIFT, (SIZE_ONE - 4096u + a.y) | (a.z << 16u));
        let motion = FlightMotion(in_vec3(3u), in_vec4(6u), in_vec3(10u));
        let step = flight_step(body, motion, in_vec3(13u), in_float(16u));
        out_vec3(0u, step.end.velocity); out_vec4(3u, step.end.pose); out_vec3(7u, step.end.turning);
        out_vec3(10u, step.way);";
    rust |cx, w| {
        let (way, end) = flight_step(cx, &body(cx, w[0], w[1], w[2]), &motion(w, 3), vector(w, 13), float(w[16]));
        let mut all = [0.0; 13];
        all[..10].copy_from_slice(&components(&end));
        all[10..].copy_from_slice(&way.to_array());
        floats(all)
    };

    substep_count in "flight/runge_kutta" (Input::Scale(-2.0, 3.0)) tolerance Some(0.0);
    wgsl "let n = substep_count(bitcast<f32>(a.x)); r.x = bitcast<u32>(n.count); r.y = bitcast<u32>(n.share);";
    rust |_cx, w| {
        let substeps = substep_count(float(w[0]));
        floats([substeps.count, substeps.share])
    };

    flight_load in "leaf/fly" (SPECIES, FLOW, SPIN) tolerance Some(1e-6);
    wgsl "r.x = bitcast<u32>(flight_load((1u + a.x) << SPECIES_SHIFT, in_vec3(1u), in_vec3(4u)));
        r.y = u32(flies(in_word(1u)));";
    rust |cx, w| integers([
        flight_load(cx, (1 + w[0]) << SPECIES_SHIFT, vector(w, 1), vector(w, 4)).to_bits(),
        u32::from(flies(w[1])),
    ]);

    longest_way_squared in "leaf/fly" (FLOW, FLOW) tolerance Some(1e-6);
    wgsl "r.x = bitcast<u32>(longest_way_squared(in_vec3(0u), in_vec3(3u)));";
    rust |cx, w| integers([longest_way_squared(cx, vector(w, 0), vector(w, 3)).to_bits()]);

    flight_advance in "leaf/fly" (SPECIES, SIZE, ANY, FLOW, FLOW, POSE, SPIN, FLOW) tolerance Some(1e-2);
    wgsl "let flown = flight_advance(
            Flight(in_vec3(3u), in_vec3(6u), in_vec4(9u), in_vec3(13u)),
            (1u + a.x) << SPECIES_SHIFT, (SIZE_ONE - 4096u + a.y) | (a.z << 16u), in_vec3(16u), false);
        let flight = flown.flight;
        out_vec3(0u, flight.position); out_vec3(3u, flight.velocity); out_vec4(6u, flight.pose);
        out_vec3(10u, flight.spin);";
    rust |cx, w| {
        let start =
            Flight { position: vector(w, 3), velocity: vector(w, 6), pose: quaternion(w, 9), spin: vector(w, 13) };
        let size = (SIZE_ONE - 4096 + w[1]) | (w[2] << 16);
        let flight = flight_advance::<f32, OverGround>(cx, start, (1 + w[0]) << SPECIES_SHIFT, size, vector(w, 16)).flight;
        let mut all = [0.0; 13];
        all[..3].copy_from_slice(&flight.position.to_array());
        all[3..6].copy_from_slice(&flight.velocity.to_array());
        all[6..10].copy_from_slice(&flight.pose.to_array());
        all[10..].copy_from_slice(&flight.spin.to_array());
        floats(all)
    };

    regime_after in "flight/regime" (ANY, FLOW, SPIN, FLOW, Input::Below(9), Input::Below(64)) tolerance None;
    wgsl "r.x = regime_after(a.x, in_vec3(1u), in_vec3(4u), in_vec3(7u), in_word(10u), in_word(11u));
        r.y = regime_of(a.x);";
    rust |_cx, w| integers([
        regime_after(w[0], vector(w, 1), vector(w, 4), vector(w, 7), w[10], w[11]),
        regime_of(w[0]),
    ]);

    regime_in_spin in "flight/regime" (Input::Below(7), FLOW, SPIN, Input::Float(0.01, 0.2)) tolerance None;
    wgsl "r.x = regime_in_spin(a.x, in_vec3(1u), in_vec3(4u), in_float(7u));";
    rust |_cx, w| integers([regime_in_spin(w[0], vector(w, 1), vector(w, 4), float(w[7]))]);

    update_regime in "leaf/fly" (SPECIES, ANY, FLOW, POSE, SPIN, FLOW, SIZE) tolerance None;
    wgsl "let flight = Flight(vec3<f32>(), in_vec3(2u), in_vec4(5u), in_vec3(9u));
        let regime = update_regime(flight, in_vec3(12u), a.y, (1u + a.x) << SPECIES_SHIFT, SIZE_ONE - 4096u + in_word(15u));
        r.x = regime.state; r.y = regime.bits;";
    rust |cx, w| {
        let flight = Flight {
            position: Vec3::ZERO,
            velocity: vector(w, 2),
            pose: quaternion(w, 5),
            spin: vector(w, 9),
        };
        let size = SIZE_ONE - 4096 + w[15];
        let regime = update_regime(cx, &flight, vector(w, 12), w[1], (1 + w[0]) << SPECIES_SHIFT, size);
        integers([regime.state, regime.bits])
    };

    hold_pose in "leaf/launch" (SPECIES, ANY) tolerance Some(1e-6);
    wgsl "r = bitcast<vec4<u32>>(hold_pose(1u + a.x, a.y)); s = bitcast<vec4<u32>>(random_pose(vec4<u32>(a.y, a.y, ~a.y, 0u)));";
    rust |cx, w| {
        let (held, any) = (hold_pose(cx, 1 + w[0], w[1]), random_pose([w[1], w[1], !w[1], 0]));
        floats([held.x, held.y, held.z, held.w, any.x, any.y, any.z, any.w])
    };

    random_asymmetry in "leaf/launch" (ANY) tolerance None;
    wgsl "r.x = random_asymmetry(a.x);";
    rust |cx, w| integers([random_asymmetry(cx, w[0])]);
}
