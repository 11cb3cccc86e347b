// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The functions of litter: its heights, contacts with it, lying in it and waking.

use windfall_core::device::flight::body::{LeafBody, body_of};
use windfall_core::device::flight::contact::{contact_friction, contact_yield, flight_contact, support};
use windfall_core::device::flight::rates::{FlightMotion, still_load};
use windfall_core::device::leaf::at_rest::{
    LeafAtRest, leaf_at_rest, least_wake_square, slides_down, wake_square, wind_moves,
};
use windfall_core::device::leaf::fly::{count_calm_steps, flight_ends};
use windfall_core::device::leaf::lie::{flatten_to, lying_tilt, lying_units, own_friction, reach_down};
use windfall_core::device::leaf::record::{
    SIZE_ONE, SPECIES_SHIFT, is_covered, lies, lies_still, litter_change, lying_friction, lying_raise,
    lying_support, lying_support_word, lying_volume, lying_word, touch_steps, wake_speed_squared,
    wake_speed_word, with_cover, with_litter_change, with_touch_steps,
};
use windfall_core::device::leaf::stack::leaf_changes_litter;
use windfall_core::device::leaf::wake::{cover_is_due, cover_of, layers_above, lying_wind, wake_is_due};
use windfall_core::device::terrain::ground::{
    drop_direction, ground_bare, ground_gradient, ground_is_water, ground_rest, ground_slope, lying_height,
};
use windfall_core::device::terrain::litter::{above_litter, litter_cell, litter_height, litter_shares};
use windfall_core::device::wind::pile_shadow::wind_behind_piles;

use super::{Function, Input, float, floats, functions, integers, quaternion, vector};
use crate::runner::Words;

const ANY: Input = Input::Word;
const SPECIES: Input = Input::Below(2);
const SIZE: Input = Input::Below(8192);
/// Places in the littered rectangle of the test scene, and somewhat beyond.
const NEAR: Input = Input::Floats(2, -9.0, 9.0);
const FLOW: Input = Input::Floats(3, -6.0, 6.0);
const SPIN: Input = Input::Floats(3, -20.0, 20.0);
/// Near enough to unit length, as between two stages of a step.
const POSE: Input = Input::Floats(4, -0.55, 0.55);
const DIRECTION: Input = Input::Floats(3, -0.57, 0.57);
const FRICTION: Input = Input::Float(0.2, 1.5);

fn body(cx: &windfall_core::Context<'_>, words: &Words) -> LeafBody {
    body_of(cx, words[0] << SPECIES_SHIFT, (SIZE_ONE - 4096 + words[1]) | (words[2] << 16))
}

fn at_rest(cx: &windfall_core::Context<'_>, words: &Words) -> LeafAtRest {
    let slope = ground_slope(cx, float(words[3]), float(words[4]));
    leaf_at_rest(cx, body(cx, words), quaternion(words, 6), slope, float(words[5]), words[2] & 0x1fff)
}

functions! {
    LITTER_FUNCTIONS;

    lies in "leaf/wake" (ANY, Input::Below(4)) tolerance None;
    wgsl "r = vec4<u32>(u32(lies(a.x)), litter_change(a.x), with_litter_change(a.x, a.y), lying_volume(a.x));
        s = vec4<u32>(touch_steps(a.x), with_touch_steps(a.x, a.y), u32(wake_is_due(a.x)),
            wake_speed_word(in_float(0u)) ^ lying_support_word(in_float(1u)) ^ lying_word(0.5, a.y));
        answer[2] = bitcast<vec4<u32>>(vec4<f32>(wake_speed_squared(a.x), lying_support(a.x), lying_friction(a.x), f32(lying_raise(a.x))));";
    rust |cx, w| integers([
        u32::from(lies(w[0])), litter_change(w[0]), with_litter_change(w[0], w[1]), lying_volume(w[0]),
        touch_steps(w[0]), with_touch_steps(w[0], w[1]), u32::from(wake_is_due(cx, w[0])),
        wake_speed_word(float(w[0])) ^ lying_support_word(float(w[1])) ^ lying_word(0.5, w[1]),
        wake_speed_squared(w[0]).to_bits(), lying_support(w[0]).to_bits(), lying_friction(w[0]).to_bits(), (lying_raise(w[0]) as f32).to_bits(),
    ]);

    cover_is_due in "leaf/wake" (ANY, Input::Below(2)) tolerance Some(1e-6);
    wgsl "r = vec4<u32>(u32(cover_is_due(a.x)), u32(is_covered(a.x)), with_cover(a.x, a.y == 1u),
            bitcast<u32>(layers_above((a.x & 1u) << SPECIES_SHIFT, 0.01)));";
    rust |cx, w| integers([
        u32::from(cover_is_due(cx, w[0])), u32::from(is_covered(w[0])), with_cover(w[0], w[1] == 1),
        layers_above(cx, (w[0] & 1) << SPECIES_SHIFT, 0.01).to_bits(),
    ]);

    lying_wind in "leaf/wake" (SPECIES, NEAR, Input::Float(-0.02, 0.06), Input::Float(0.0, 0.02), Input::Float(0.1, 2.0)) tolerance Some(1e-2);
    wgsl "let p = in_vec3(1u); let place = vec3<f32>(p.x, ground_rest(p.x, p.y) - p.z, p.y); let bits = a.x << SPECIES_SHIFT;
        let met = lying_wind(bits, place, in_float(4u), in_float(5u)); let cover = cover_of(bits, place, in_float(4u));
        out_vec3(0u, met.wind); out_float(3u, met.cover);
        out_vec3(4u, vec3<f32>(f32(met.may_wake), f32(cover.is_loose), f32(cover.is_covered)));
        out_float(7u, f32(lies_still(a.y)));";
    rust |cx, w| {
        let (x, z, reach, bits) = (float(w[1]), float(w[2]), float(w[4]), w[0] << SPECIES_SHIFT);
        let place = windfall_core::arith::Vec3::new(x, ground_rest(cx, x, z) - float(w[3]), z);
        let met = lying_wind(cx, bits, place, reach, float(w[5]));
        let cover = cover_of(cx, bits, place, reach);
        let truth = |is: bool| f32::from(u8::from(is));
        let (wind, signs) = (met.wind, [met.may_wake, cover.is_loose, cover.is_covered].map(truth));
        floats([wind.x, wind.y, wind.z, met.cover, signs[0], signs[1], signs[2], truth(lies_still(w[1]))])
    };

    leaf_changes_litter in "leaf/stack" (ANY, Input::Below(2)) tolerance None;
    wgsl "r.x = u32(leaf_changes_litter(a.x, vec3<f32>(f32(a.y), 0.0, 0.0)));";
    rust |_cx, w| {
        let velocity = windfall_core::arith::Vec3::new(w[1] as f32, 0.0, 0.0);
        integers([u32::from(leaf_changes_litter(w[0], velocity))])
    };

    litter_height in "terrain/litter" (NEAR, Input::Float(-0.5, 4.0)) tolerance Some(1e-5);
    wgsl "let p = in_vec3(0u);
        r = bitcast<vec4<u32>>(vec4<f32>(litter_height(p.x, p.y), above_litter(p.z, p.x, p.y), 0.0, 0.0));";
    rust |cx, w| {
        let (x, z) = (float(w[0]), float(w[1]));
        floats([litter_height(cx, x, z), above_litter(cx, float(w[2]), x, z), 0.0, 0.0])
    };

    wind_behind_piles in "wind/pile_shadow" (NEAR, FLOW) tolerance Some(1e-3);
    wgsl "out_vec3(0u, wind_behind_piles(in_float(0u), in_float(1u), in_vec3(2u)));";
    rust |cx, w| {
        let wind = wind_behind_piles(cx, float(w[0]), float(w[1]), vector(w, 2));
        floats(wind.to_array())
    };

    litter_shares in "terrain/litter" (NEAR, Input::Below(65536)) tolerance None;
    wgsl "let p = in_vec3(0u); let cell = litter_cell(p.x, p.y); let shares = litter_shares(a.z, p.x, p.y);
        r = vec4<u32>(cell.node, u32(cell.is_inside), u32(cell.bears), shares.node); s = shares.heights;";
    rust |cx, w| {
        let (x, z) = (float(w[0]), float(w[1]));
        let (cell, shares) = (litter_cell(cx, x, z), litter_shares(cx, w[2], x, z));
        let [a, b, c, d] = shares.heights;
        integers([cell.node, u32::from(cell.is_inside), u32::from(cell.bears), shares.node, a, b, c, d])
    };

    ground_gradient in "terrain/ground" (NEAR, Input::Float(0.0, 0.1)) tolerance Some(1e-4);
    wgsl "let p = in_vec3(0u); let rise = ground_gradient(p.x, p.y); let slope = ground_slope(p.x, p.y);
        r = bitcast<vec4<u32>>(vec4<f32>(rise.x, rise.y, ground_bare(p.x, p.y), lying_height(p.x, p.y, p.z)));
        s = bitcast<vec4<u32>>(vec4<f32>(slope.x, slope.z, slope.gain, f32(ground_is_water(p.x, p.y))));
        answer[2] = bitcast<vec4<u32>>(vec4<f32>(drop_direction(a.x & 7u), drop_direction(a.y & 7u)));";
    rust |cx, w| {
        let (x, z) = (float(w[0]), float(w[1]));
        let ([rise_x, rise_z], slope) = (ground_gradient(cx, x, z), ground_slope(cx, x, z));
        let ([a, b], [c, d]) = (drop_direction(w[0] & 7), drop_direction(w[1] & 7));
        floats([
            rise_x, rise_z, ground_bare(cx, x, z), lying_height(cx, x, z, float(w[2])),
            slope.x, slope.z, slope.gain, f32::from(u8::from(ground_is_water(cx, x, z))), a, b, c, d,
        ])
    };

    support in "flight/contact" (SPECIES, SIZE, ANY, DIRECTION, DIRECTION, Input::Float(0.0, 0.004)) tolerance Some(1e-5);
    wgsl "let body = body_of(a.x << SPECIES_SHIFT, (SIZE_ONE - 4096u + a.y) | (a.z << 16u));
        let lowest = support(body, in_vec3(3u));
        out_vec3(0u, lowest.arm); out_float(3u, lowest.radius);
        out_float(4u, contact_yield(body.inv_inertia, lowest.arm, in_vec3(6u)));
        out_float(5u, contact_friction(in_float(9u)));";
    rust |cx, w| {
        let body = body(cx, w);
        let (radius, arm) = support(&body, vector(w, 3));
        floats([
            arm.x, arm.y, arm.z, radius, contact_yield(body.inv_inertia, arm, vector(w, 6)),
            contact_friction(cx, float(w[9])),
        ])
    };

    flight_contact in "flight/contact" (
        SPECIES, SIZE, ANY, NEAR, Input::Float(-0.06, 0.06), FLOW, POSE, SPIN
    ) tolerance Some(1e-3);
    wgsl "let body = body_of(a.x << SPECIES_SHIFT, (SIZE_ONE - 4096u + a.y) | (a.z << 16u));
        let p = in_vec3(3u); let y = ground_rest(p.x, p.y) + p.z;
        let c = flight_contact(body, vec3<f32>(p.x, y, p.y), FlightMotion(in_vec3(6u), in_vec4(9u), in_vec3(13u)), 0.3);
        out_vec3(0u, c.position); out_vec3(3u, c.motion.velocity); out_vec3(6u, c.motion.turning);
        out_float(9u, f32(c.touches));";
    rust |cx, w| {
        let (x, z) = (float(w[3]), float(w[4]));
        let y = ground_rest(cx, x, z) + float(w[5]);
        let motion = FlightMotion { velocity: vector(w, 6), pose: quaternion(w, 9), turning: vector(w, 13) };
        let c = flight_contact(cx, &body(cx, w), windfall_core::arith::Vec3::new(x, y, z), motion, 0.3);
        let (p, v, t) = (c.position, c.motion.velocity, c.motion.turning);
        floats([p.x, p.y, p.z, v.x, v.y, v.z, t.x, t.y, t.z, f32::from(u8::from(c.touches))])
    };

    still_load in "flight/rates" (SPECIES, SIZE, ANY, FLOW) tolerance Some(1e-4);
    wgsl "let load = still_load(body_of(a.x << SPECIES_SHIFT, (SIZE_ONE - 4096u + a.y) | (a.z << 16u)), in_vec3(3u));
        out_vec3(0u, load.force); out_vec3(3u, load.torque);";
    rust |cx, w| {
        let (f, t) = still_load(&body(cx, w), vector(w, 3));
        floats([f.x, f.y, f.z, t.x, t.y, t.z])
    };

    wake_square in "leaf/at_rest" (SPECIES, SIZE, ANY, NEAR, FRICTION, POSE, DIRECTION) tolerance Some(1e-2);
    wgsl "let body = body_of(a.x << SPECIES_SHIFT, (SIZE_ONE - 4096u + a.y) | (a.z << 16u));
        let leaf = leaf_at_rest(body, in_vec4(6u), ground_slope(in_float(3u), in_float(4u)), in_float(5u), a.z & 0x1fffu);
        out_float(0u, wake_square(leaf, in_vec3(10u))); out_float(1u, least_wake_square(leaf));
        out_float(2u, leaf.pressing_m_s2); out_vec3(3u, leaf.normal);";
    rust |cx, w| {
        let leaf = at_rest(cx, w);
        let n = leaf.normal;
        floats([wake_square(cx, &leaf, vector(w, 10)), least_wake_square(cx, &leaf), leaf.pressing_m_s2, n.x, n.y, n.z])
    };

    wind_moves in "leaf/at_rest" (SPECIES, SIZE, ANY, NEAR, FRICTION, POSE, FLOW) tolerance Some(1.0);
    wgsl "let body = body_of(a.x << SPECIES_SHIFT, (SIZE_ONE - 4096u + a.y) | (a.z << 16u));
        let leaf = leaf_at_rest(body, in_vec4(6u), ground_slope(in_float(3u), in_float(4u)), in_float(5u), a.z & 0x1fffu);
        out_float(0u, f32(wind_moves(leaf, in_vec3(10u), 1.0))); out_float(1u, f32(slides_down(leaf)));";
    rust |cx, w| {
        let leaf = at_rest(cx, w);
        let moves = [wind_moves(cx, &leaf, vector(w, 10), 1.0), slides_down(&leaf)];
        floats(moves.map(|moves| f32::from(u8::from(moves))))
    };

    lying_tilt in "leaf/lie" (ANY, ANY, ANY, ANY, Input::Float(0.0, 0.004), POSE, SPECIES, SIZE) tolerance Some(1e-5);
    wgsl "let tilt = lying_tilt(a); let pose = flatten_to(tilt, in_vec4(5u), 0.6);
        let body = body_of(in_word(9u) << SPECIES_SHIFT, SIZE_ONE - 4096u + in_word(10u));
        out_vec4(0u, tilt); out_vec4(4u, pose); out_float(8u, own_friction(a, in_float(4u)));
        out_float(9u, reach_down(body, in_vec4(5u)));
        out_float(10u, f32(lying_units(in_word(9u) << SPECIES_SHIFT, in_word(10u), 0.1)));";
    rust |cx, w| {
        let words = [w[0], w[1], w[2], w[3]];
        let tilt = lying_tilt(cx, words);
        let pose = flatten_to(tilt, quaternion(w, 5), 0.6);
        let body = body_of(cx, w[9] << SPECIES_SHIFT, SIZE_ONE - 4096 + w[10]);
        let mut all = [0.0; 11];
        all[..4].copy_from_slice(&tilt.to_array());
        all[4..8].copy_from_slice(&pose.to_array());
        all[8] = own_friction(cx, words, float(w[4]));
        all[9] = reach_down(&body, quaternion(w, 5));
        all[10] = lying_units(cx, w[9] << SPECIES_SHIFT, w[10], 0.1) as f32;
        floats(all)
    };

    flight_ends in "leaf/fly" (ANY, Input::Below(3), Input::Floats(3, -9.0, 9.0)) tolerance None;
    wgsl "let bits = count_calm_steps(a.x & 0x1fffffu, a.y == 1u, a.y == 2u);
        r = vec4<u32>(bits, u32(flight_ends(bits, in_vec3(2u))), 0u, 0u);";
    rust |cx, w| {
        let bits = count_calm_steps(cx, w[0] & 0x1f_ffff, w[1] == 1, w[1] == 2);
        integers([bits, u32::from(flight_ends(cx, bits, vector(w, 2))), 0, 0])
    };
}
