// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The functions of solid parts: their distance, what is near, and contacts with them.

use windfall_core::Context;
use windfall_core::arith::Vec3;
use windfall_core::arith::quaternion::quat_rotate;
use windfall_core::arith::vector::vec3_dot;
use windfall_core::device::flight::body::{LeafBody, body_of};
use windfall_core::device::flight::contact::Contact;
use windfall_core::device::flight::rates::FlightMotion;
use windfall_core::device::flight::strike::{Passage, first_strike, strike_solids};
use windfall_core::device::leaf::record::{SIZE_ONE, SPECIES_SHIFT, held_bits, is_held};
use windfall_core::device::leaf::strike::{comes_upon, is_borne, is_inside_solid, solid_footing};
use windfall_core::device::solid::distance::solid_distance;
use windfall_core::device::solid::near::{
    Core, core_may_be_met, is_occupied, may_meet_solids, may_meet_solids_on_way, near_count, near_solid,
    solids_cell,
};
use windfall_core::device::solid::shape::{SolidAt, SolidDistance, solid_at, solid_velocity};

use super::{Function, Input, float, floats, functions, integers, quaternion, vector};
use crate::runner::Words;

const ANY: Input = Input::Word;
const SPECIES: Input = Input::Below(2);
const SIZE: Input = Input::Below(8192);
/// Places among the objects of the test scene, and somewhat beyond.
const PLACE: Input = Input::Floats(3, -4.0, 4.0);
/// Places in and around the first of them.
const CLOSE: Input = Input::Floats(3, -0.9, 0.9);
const FLOW: Input = Input::Floats(3, -30.0, 30.0);
const SPIN: Input = Input::Floats(3, -20.0, 20.0);
const POSE: Input = Input::Floats(4, -0.55, 0.55);

fn body(cx: &Context<'_>, words: &Words) -> LeafBody {
    body_of(cx, words[0] << SPECIES_SHIFT, (SIZE_ONE - 4096 + words[1]) | (words[2] << 16))
}

/// A part, and a place about its centre.
fn beside(cx: &Context<'_>, number: u32, from: Vec3) -> (SolidAt, Vec3) {
    let solid = solid_at(cx, number, 0.01);
    let place = solid.center + from;
    (solid, place)
}

functions! {
    SOLID_FUNCTIONS;

    solid_distance in "solid/distance" (ANY, CLOSE) tolerance Some(1e-3);
    wgsl "if (scene.solids.count != 0u) {
            let solid = solid_at(a.x % scene.solids.count, 0.01); let place = solid.center + in_vec3(1u);
            let d = solid_distance(solid, place);
            out_float(0u, d.distance_m); out_vec3(1u, d.normal); out_vec3(4u, solid_velocity(solid, place));
            out_float(7u, solid.bound_m);
        }";
    rust |cx, w| {
        if !cx.scene.has_solids() {
            return floats([0.0; 8]);
        }
        let (solid, place) = beside(cx, w[0] % cx.scene.solids.count, vector(w, 1));
        let SolidDistance { distance_m, normal } = solid_distance(cx, &solid, place);
        let along = solid_velocity(&solid, place);
        floats([distance_m, normal.x, normal.y, normal.z, along.x, along.y, along.z, solid.bound_m])
    };

    solids_cell in "solid/near" (PLACE, FLOW) tolerance None;
    wgsl "if (scene.solids.count != 0u) {
            let cell = solids_cell(in_vec3(0u));
            let way_squared = 0.0001 * vec3_dot(in_vec3(3u), in_vec3(3u));
            r = vec4<u32>(cell, u32(may_meet_solids(in_vec3(0u), way_squared)), near_count(cell), near_solid(cell, 0u));
        }";
    rust |cx, w| {
        if !cx.scene.has_solids() {
            return integers([0; 4]);
        }
        let cell = solids_cell(cx, vector(w, 0));
        let way_squared = 0.0001 * vec3_dot(vector(w, 3), vector(w, 3));
        let may_meet = u32::from(may_meet_solids(cx, vector(w, 0), way_squared));
        integers([cell, may_meet, near_count(cx, cell), near_solid(cx, cell, 0)])
    };

    is_occupied in "solid/near" (PLACE) tolerance None;
    wgsl "if (scene.solids.count != 0u) {
            r.x = u32(is_occupied(in_vec3(0u)));
        }";
    rust |cx, w| {
        if !cx.scene.has_solids() {
            return integers([0; 4]);
        }
        integers([u32::from(is_occupied(cx, vector(w, 0))), 0, 0, 0])
    };

    may_meet_solids_on_way in "solid/near" (PLACE, FLOW) tolerance None;
    wgsl "if (scene.solids.count != 0u) {
            r.x = u32(may_meet_solids_on_way(in_vec3(0u), in_vec3(3u) * 0.1));
        }";
    rust |cx, w| {
        if !cx.scene.has_solids() {
            return integers([0; 4]);
        }
        integers([u32::from(may_meet_solids_on_way(cx, vector(w, 0), vector(w, 3) * 0.1)), 0, 0, 0])
    };

    core_may_be_met in "solid/near" (PLACE, FLOW, PLACE, ANY) tolerance None;
    wgsl "let half = in_vec3(6u) * 0.15 + vec3<f32>(0.6, 0.6, 0.6);
        let shape = Core((in_word(9u) & 1u) != 0u, half, half.y * 0.5);
        r.x = u32(core_may_be_met(shape, in_vec3(0u), in_vec3(3u)));";
    rust |_cx, w| {
        let half_m = vector(w, 6) * 0.15 + Vec3::new(0.6, 0.6, 0.6);
        let shape = Core { is_round: w[9] & 1 != 0, half_m, rounding_m: half_m.y * 0.5 };
        integers([u32::from(core_may_be_met(shape, vector(w, 0), vector(w, 3))), 0, 0, 0])
    };

    strike_solids in "flight/strike" (SPECIES, SIZE, ANY, PLACE, FLOW, POSE, SPIN) tolerance Some(1e-2);
    wgsl "if (scene.solids.count != 0u) {
            let body = body_of(a.x << SPECIES_SHIFT, (SIZE_ONE - 4096u + a.y) | (a.z << 16u));
            let motion = FlightMotion(in_vec3(6u), in_vec4(9u), in_vec3(13u));
            let c = strike_solids(body, in_vec3(3u), motion.velocity * scene.dt_s, motion, 0.0, scene.dt_s);
            out_vec3(0u, c.position); out_vec3(3u, c.motion.velocity); out_vec3(6u, c.motion.turning);
            out_float(9u, f32(c.touches));
        }";
    rust |cx, w| {
        if !cx.scene.has_solids() {
            return floats([0.0; 10]);
        }
        let flown = FlightMotion { velocity: vector(w, 6), pose: quaternion(w, 9), turning: vector(w, 13) };
        let way = flown.velocity * cx.scene.dt_s;
        let Contact { position: p, motion, touches } =
            strike_solids(cx, &body(cx, w), vector(w, 3), way, flown, 0.0, cx.scene.dt_s);
        let (v, t) = (motion.velocity, motion.turning);
        floats([p.x, p.y, p.z, v.x, v.y, v.z, t.x, t.y, t.z, f32::from(u8::from(touches))])
    };

    first_strike in "flight/strike" (SPECIES, SIZE, ANY, PLACE, FLOW, POSE) tolerance Some(1.0);
    wgsl "if (scene.solids.count != 0u) {
            let body = body_of(a.x << SPECIES_SHIFT, (SIZE_ONE - 4096u + a.y) | (a.z << 16u));
            let start = in_vec3(3u);
            let passage = Passage(start, in_vec3(6u), 0.0, scene.dt_s, 0.5);
            let strike = first_strike(body, in_vec4(9u), solids_cell(start), passage);
            r.x = bitcast<u32>(strike.share); r.y = strike.number;
        }";
    rust |cx, w| {
        if !cx.scene.has_solids() {
            return integers([0; 2]);
        }
        let from = vector(w, 3);
        let time = cx.scene.dt_s;
        let passage = Passage { from, way: vector(w, 6), seconds: 0.0, time, reach_share: 0.5 };
        let strike = first_strike(cx, &body(cx, w), quaternion(w, 9), solids_cell(cx, from), &passage);
        integers([strike.share.to_bits(), strike.number])
    };

    solid_footing in "leaf/strike" (SPECIES, SIZE, SIZE, SIZE, Input::Float(-0.02, 0.02), Input::Floats(2, -0.3, 0.3), POSE) tolerance Some(1e-2);
    wgsl "if (scene.solids.count != 0u) {
            let body = body_of(a.x << SPECIES_SHIFT, (SIZE_ONE - 4096u + a.y) | (a.z << 16u));
            let solid = solid_at(a.w % scene.solids.count, 0.0);
            let up = solid.half_m.y + solid.rounding_m + in_float(4u);
            let place = solid.center + quat_rotate(solid.turn, vec3<f32>(in_float(5u), up, in_float(6u)));
            let pose = in_vec4(7u);
            let footing = solid_footing(body, pose, place);
            out_float(0u, footing.slope.x); out_float(1u, footing.slope.z); out_float(2u, footing.friction);
            out_float(3u, f32(footing.is_firm)); out_float(4u, f32(is_borne(body, pose, place)));
            out_float(5u, f32(is_inside_solid(body, pose, place)));
            let mover = a.w % max(scene.solids.mover_count, 1u);
            out_float(6u, f32(comes_upon(solid_at(mover, 0.0), mover, place, 0.05)));
            out_float(7u, f32(is_held(a.w)) + f32(held_bits(a.w & 31u)) * 1e-6);
        }";
    rust |cx, w| {
        if !cx.scene.has_solids() {
            return floats([0.0; 8]);
        }
        let solid = solid_at(cx, w[3] % cx.scene.solids.count, 0.0);
        let up = solid.half_m.y + solid.rounding_m + float(w[4]);
        let place = solid.center + quat_rotate(solid.turn, Vec3::new(float(w[5]), up, float(w[6])));
        let (body, pose) = (body(cx, w), quaternion(w, 7));
        let footing = solid_footing(cx, &body, pose, place);
        let truth = |is: bool| f32::from(u8::from(is));
        let mover = w[3] % cx.scene.solids.mover_count.max(1);
        let comes = comes_upon(cx, &solid_at(cx, mover, 0.0), mover, place, 0.05);
        floats([
            footing.slope.x, footing.slope.z, footing.friction, truth(footing.is_firm),
            truth(is_borne(cx, &body, pose, place)), truth(is_inside_solid(cx, &body, pose, place)),
            truth(comes), truth(is_held(w[3])) + held_bits(w[3] & 31) as f32 * 1e-6,
        ])
    };
}
