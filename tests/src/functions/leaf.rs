// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The functions that move leaves and make wind. One list, of which a part would be no easier to read.

use windfall_core::arith::Vec3;
use windfall_core::arith::math::{
    arctangent2, exponential, inverse_cube_root, inverse_sqrt, reciprocal, sin_cos, sin_cos_half,
    sin_cos_turns,
};
use windfall_core::arith::quaternion::{
    quat_blend, quat_multiply, quat_normalize, quat_renormalize, quat_rotate, quat_turn_after,
    quat_turn_before,
};
use windfall_core::arith::rng::{below, mul_high, mul_q16, philox, triangular, unit_float};
use windfall_core::arith::vector::{vec3_cross, vec3_dot, vec3_length, vec3_lerp};
use windfall_core::device::leaf::air::air_sample;
use windfall_core::device::leaf::cone_spiral::{
    cone_angle, cone_of, cone_offset, cone_orientation, cone_table_phase, cone_velocity,
};
use windfall_core::device::leaf::fall::{felt_drift, glide_of, response_of, spin_advance};
use windfall_core::device::leaf::join::part_of_step;
use windfall_core::device::leaf::own::{
    MotionParams, first_phase, motion_params, own_advance, own_orientation, own_velocity, turn_to_heading,
};
use windfall_core::device::leaf::record::{
    CONE_SPIRAL, SPECIES_SHIFT, asymmetry, blend_steps_left, body_spin, body_spin_words, count_down_blend,
    drawn_size, flies, ground_steps, heading_angle, heading_word, landed_bits, leaf_appearance,
    leaf_primitive, leaf_regime, leaf_source, leaf_species, leaf_stage, leaf_state, leaf_tint, leaf_variant,
    motion_table, own_size, place_bits, regime_state, size_ratio, smoothed_air_speed, spin_angle, spin_rate,
    turn_spin, twig_sizes, with_asymmetry, with_blend, with_primitive, with_regime, with_stage, with_state,
};
use windfall_core::device::leaf::release::{
    next_event, release_fall_time, release_place, release_rate, release_ratio, release_size_speed,
    release_species,
};
use windfall_core::device::leaf::settle::{flatten, flatten_on, ground_friction, slide};
use windfall_core::device::motion::feature::{stage_end, stage_words, transition_next};
use windfall_core::device::motion::lookup::{
    motion_displacement, motion_period, motion_state, motion_velocity,
};
use windfall_core::device::terrain::ground::{ground_met, ground_relief, ground_rest, ground_slope};
use windfall_core::device::wind::gust::wind_gust;
use windfall_core::device::wind::jet::wind_jet;
use windfall_core::device::wind::packed::{wind_pack, wind_unpack};
use windfall_core::device::wind::plume::{plume_puff, wind_plume};
use windfall_core::device::wind::profile::{wind_profile, wind_vertical};
use windfall_core::device::wind::sample::wind_at;
use windfall_core::device::wind::shelter::wind_shelter;
use windfall_core::device::wind::slipstream::wind_slipstream;
use windfall_core::device::wind::turbulence::wind_turbulence;
use windfall_core::device::wind::vortex::wind_vortex;
use windfall_core::leaf::{Drift, Place, Schedule};

use super::{Function, Input, float, floats, functions, integers, quaternion, vector};
use crate::runner::Words;

fn seed(words: &Words) -> [u32; 2] {
    [words[0], words[1]]
}

const ANY: Input = Input::Word;
const UNIT: Input = Input::Float(-1.0, 1.0);
const SPEED: Input = Input::Float(-40.0, 40.0);
const METRES: Input = Input::Float(-300.0, 300.0);
/// Tables of the species of the test scene.
const TABLE: Input = Input::Below(6);
const SPECIES: Input = Input::Below(2);
/// Species of the test scenes, of which the last two of one wind down on cone spirals.
const WINDING: Input = Input::Below(5);
/// Ages on a cone spiral, of which about half are of a spiral that still opens.
const AGE: Input = Input::Below(20_000_000);
const SOURCE: Input = Input::Below(3);

functions! {
    LEAF_FUNCTIONS;

    place_bits in "leaf/record" (
        Input::Below(4), Input::Below(64), Input::Below(8), Input::Below(32), ANY
    ) tolerance None;
    wgsl "let bits = place_bits(a.x, a.y, a.z, a.w, b.x);
        let other = with_primitive(with_state(with_blend(bits, b.x & 63u), b.x & 3u), b.x & 7u);
        r = vec4<u32>(bits, other, leaf_state(bits), blend_steps_left(bits));
        s = vec4<u32>(leaf_primitive(bits), motion_table(bits), leaf_species(bits), spin_angle(bits));
        answer[2] = vec4<u32>(leaf_regime(bits), with_regime(bits, b.x & 7u), turn_spin(bits, b.x), u32(flies(bits)));
        answer[3].x = count_down_blend(bits, a.y != 0u);";
    rust |_cx, w| {
        let bits = place_bits(w[0], w[1], w[2], w[3], w[4]);
        let other = with_primitive(with_state(with_blend(bits, w[4] & 63), w[4] & 3), w[4] & 7);
        integers([
            bits, other, leaf_state(bits), blend_steps_left(bits),
            leaf_primitive(bits), motion_table(bits), leaf_species(bits), spin_angle(bits),
            leaf_regime(bits), with_regime(bits, w[4] & 7), turn_spin(bits, w[4]), u32::from(flies(bits)),
            count_down_blend(bits, w[1] != 0),
        ])
    };

    leaf_appearance in "leaf/record" (ANY, ANY, Input::Below(32), Input::Below(8)) tolerance None;
    wgsl "let look = with_stage(leaf_appearance(a.x, a.y, a.z), a.w);
        r = vec4<u32>(look, leaf_tint(look), leaf_variant(look), leaf_source(look)); s.x = leaf_stage(look);";
    rust |_cx, w| {
        let look = with_stage(leaf_appearance(w[0], w[1], w[2]), w[3]);
        integers([look, leaf_tint(look), leaf_variant(look), leaf_source(look), leaf_stage(look)])
    };

    twig_sizes in "leaf/record" (Input::Below(65536), Input::Below(65536), ANY, ANY) tolerance None;
    wgsl "let size = twig_sizes(a.x, a.y); let heading = heading_word(a.z, a.w);
        r = vec4<u32>(size, own_size(size), drawn_size(size), with_asymmetry(size, a.x));
        s = vec4<u32>(heading, heading_angle(heading), spin_rate(heading), ground_steps(a.z) ^ regime_state(a.w));";
    rust |_cx, w| {
        let (size, heading) = (twig_sizes(w[0], w[1]), heading_word(w[2], w[3]));
        integers([
            size, own_size(size), drawn_size(size), with_asymmetry(size, w[0]),
            heading, heading_angle(heading), spin_rate(heading), ground_steps(w[2]) ^ regime_state(w[3]),
        ])
    };

    body_spin in "leaf/record" (SPEED, SPEED, SPEED, SPEED, ANY) tolerance Some(1e-6);
    wgsl "r = vec4<u32>(body_spin_words(body_spin(a.x, a.y, a.z)), smoothed_air_speed_word(smoothed_air_speed(a.w)));
        s = bitcast<vec4<u32>>(vec4<f32>(asymmetry(b.x, 0u), asymmetry(b.x, 1u), asymmetry(b.x, 3u), size_ratio(b.x)));";
    rust |_cx, w| {
        let [x, y, z] = body_spin_words(body_spin(w[0], w[1], w[2])).map(f32::from_bits);
        let size = w[4];
        floats([
            x, y, z, smoothed_air_speed(w[3]),
            asymmetry(size, 0), asymmetry(size, 1), asymmetry(size, 3), size_ratio(size),
        ])
    };

    mul_high in "arith/rng" (ANY, ANY) tolerance None;
    wgsl "r.x = mul_high(a.x, a.y);";
    rust |_cx, w| integers([mul_high(w[0], w[1])]);

    mul_q16 in "arith/rng" (ANY, Input::Below(65537)) tolerance None;
    wgsl "r.x = mul_q16(a.x, a.y);";
    rust |_cx, w| integers([mul_q16(w[0], w[1])]);

    philox in "arith/rng" (ANY, ANY, ANY, ANY, ANY, ANY) tolerance None;
    wgsl "r = philox(a.xy, vec4<u32>(a.zw, b.xy));";
    rust |_cx, w| integers(philox(seed(w), [w[2], w[3], w[4], w[5]]));

    below in "arith/rng" (ANY, ANY) tolerance None;
    wgsl "r.x = below(a.x, a.y); r.y = bitcast<u32>(triangular(a.x));";
    rust |_cx, w| integers([below(w[0], w[1]), triangular(w[0]) as u32]);

    unit_float in "arith/rng" (ANY) tolerance Some(0.0);
    wgsl "r.x = bitcast<u32>(unit_float(a.x));";
    rust |_cx, w| floats([unit_float(w[0])]);

    sin_cos_turns in "arith/math" (ANY) tolerance Some(2e-7);
    wgsl "let t = sin_cos_turns(a.x); r = vec4<u32>(bitcast<vec2<u32>>(t), 0u, 0u);";
    rust |_cx, w| { let (s, c) = sin_cos_turns(w[0]); floats([s, c]) };

    sin_cos_half in "arith/math" (ANY) tolerance Some(4e-7);
    wgsl "let t = sin_cos_half(a.x); r = vec4<u32>(bitcast<vec2<u32>>(t), 0u, 0u);";
    rust |_cx, w| { let (s, c) = sin_cos_half(w[0]); floats([s, c]) };

    sin_cos in "arith/math" (Input::Float(-1000.0, 1000.0)) tolerance Some(3e-7);
    wgsl "let t = sin_cos(bitcast<f32>(a.x)); r = vec4<u32>(bitcast<vec2<u32>>(t), 0u, 0u);";
    rust |_cx, w| { let (s, c) = sin_cos(float(w[0])); floats([s, c]) };

    exponential in "arith/math" (Input::Float(-80.0, 1.0)) tolerance Some(3e-7);
    wgsl "r.x = bitcast<u32>(exponential(bitcast<f32>(a.x)));";
    rust |_cx, w| floats([exponential(float(w[0]))]);

    reciprocal in "arith/math" (Input::Scale(-10.0, 10.0), Input::Below(2)) tolerance Some(3e-7);
    wgsl "r.x = bitcast<u32>(reciprocal(bitcast<f32>(a.x | (a.y << 31u))));";
    rust |_cx, w| floats([reciprocal(float(w[0] | (w[1] << 31)))]);

    inverse_sqrt in "arith/math" (Input::Scale(-12.0, 12.0)) tolerance Some(5e-7);
    wgsl "r.x = bitcast<u32>(inverse_sqrt(bitcast<f32>(a.x)));";
    rust |_cx, w| floats([inverse_sqrt(float(w[0]))]);

    inverse_cube_root in "arith/math" (Input::Scale(-12.0, 12.0)) tolerance Some(5e-7);
    wgsl "r.x = bitcast<u32>(inverse_cube_root(bitcast<f32>(a.x)));";
    rust |_cx, w| floats([inverse_cube_root(float(w[0]))]);

    arctangent2 in "arith/math" (SPEED, SPEED) tolerance Some(5e-7);
    wgsl "r.x = bitcast<u32>(arctangent2(bitcast<f32>(a.x), bitcast<f32>(a.y)));";
    rust |_cx, w| floats([arctangent2(float(w[0]), float(w[1]))]);

    vec3_products in "arith/vector" (SPEED, SPEED, SPEED, Input::Below(1), SPEED, SPEED, SPEED) tolerance Some(1e-4);
    wgsl "let u = bitcast<vec3<f32>>(a.xyz); let v = bitcast<vec3<f32>>(b.xyz);
        r = vec4<u32>(bitcast<vec3<u32>>(vec3_cross(u, v)), bitcast<u32>(vec3_dot(u, v)));
        s.x = bitcast<u32>(vec3_length(u));";
    rust |_cx, w| {
        let (u, v) = (vector(w, 0), vector(w, 4));
        let c = vec3_cross(u, v);
        floats([c.x, c.y, c.z, vec3_dot(u, v), vec3_length(u)])
    };

    vec3_lerp in "arith/vector" (SPEED, SPEED, SPEED, Input::Float(0.0, 1.0), SPEED, SPEED, SPEED) tolerance Some(3e-7);
    wgsl "r = vec4<u32>(bitcast<vec3<u32>>(
        vec3_lerp(bitcast<vec3<f32>>(a.xyz), bitcast<vec3<f32>>(b.xyz), bitcast<f32>(a.w))), 0u);";
    rust |_cx, w| floats(vec3_lerp(vector(w, 0), vector(w, 4), float(w[3])).to_array());

    quat_multiply in "arith/quaternion" (UNIT, UNIT, UNIT, UNIT, UNIT, UNIT, UNIT, UNIT) tolerance Some(1e-6);
    wgsl "let p = bitcast<vec4<f32>>(a); let q = bitcast<vec4<f32>>(b);
        r = bitcast<vec4<u32>>(quat_multiply(p, q)); s = bitcast<vec4<u32>>(quat_normalize(p));";
    rust |_cx, w| {
        let (p, q) = (quaternion(w, 0), quaternion(w, 4));
        let (r, s) = (quat_multiply(p, q).to_array(), quat_normalize(p).to_array());
        floats([r[0], r[1], r[2], r[3], s[0], s[1], s[2], s[3]])
    };

    quat_turns in "arith/quaternion" (UNIT, UNIT, UNIT, UNIT, UNIT, UNIT) tolerance Some(4e-7);
    wgsl "let q = bitcast<vec4<f32>>(a); let t = bitcast<vec2<f32>>(b.xy);
        r = bitcast<vec4<u32>>(quat_turn_after(q, t.x, t.y)); s = bitcast<vec4<u32>>(quat_turn_before(q, t.x, t.y));";
    rust |_cx, w| {
        let (q, sine, cosine) = (quaternion(w, 0), float(w[4]), float(w[5]));
        let (r, s) = (quat_turn_after(q, sine, cosine), quat_turn_before(q, sine, cosine));
        floats([r.x, r.y, r.z, r.w, s.x, s.y, s.z, s.w])
    };

    quat_rotate in "arith/quaternion" (UNIT, UNIT, UNIT, UNIT, SPEED, SPEED, SPEED) tolerance Some(4e-6);
    wgsl "let q = bitcast<vec4<f32>>(a);
        r = vec4<u32>(bitcast<vec3<u32>>(quat_rotate(q, bitcast<vec3<f32>>(b.xyz))), 0u);
        s = bitcast<vec4<u32>>(quat_renormalize(q));";
    rust |_cx, w| {
        let q = quaternion(w, 0);
        let (v, n) = (quat_rotate(q, vector(w, 4)), quat_renormalize(q));
        floats([v.x, v.y, v.z, 0.0, n.x, n.y, n.z, n.w])
    };

    quat_blend in "arith/quaternion" (UNIT, UNIT, UNIT, UNIT, UNIT, UNIT, UNIT, UNIT) tolerance Some(1e-4);
    wgsl "r = bitcast<vec4<u32>>(quat_blend(bitcast<vec4<f32>>(a), bitcast<vec4<f32>>(b), 0.25));";
    rust |_cx, w| floats(quat_blend(quaternion(w, 0), quaternion(w, 4), 0.25).to_array());

    motion_displacement in "motion/lookup" (TABLE, ANY, ANY) tolerance Some(5e-7);
    wgsl "r = vec4<u32>(bitcast<vec3<u32>>(motion_displacement(a.x, a.y)), 0u);
        s = vec4<u32>(bitcast<vec3<u32>>(motion_period(a.x)), 0u);";
    rust |cx, w| {
        let d = motion_displacement(&cx.motion, w[0], w[1]);
        let m = motion_period(&cx.motion, w[0]);
        floats([d.x, d.y, d.z, 0.0, m.x, m.y, m.z])
    };

    motion_state in "motion/lookup" (TABLE, ANY) tolerance Some(1e-6);
    wgsl "let m = motion_state(a.x, a.y); r = bitcast<vec4<u32>>(m.orientation); s.w = bitcast<u32>(m.displacement.y);
        s = vec4<u32>(bitcast<vec3<u32>>(motion_velocity(a.x, a.y)), s.w);";
    rust |cx, w| {
        let (d, q) = motion_state(&cx.motion, w[0], w[1]);
        let v = motion_velocity(&cx.motion, w[0], w[1]);
        floats([q.x, q.y, q.z, q.w, v.x, v.y, v.z, d.y])
    };

    stage_end in "motion/feature" (ANY, ANY, ANY, ANY, Input::Below(4)) tolerance None;
    wgsl "r.x = stage_end(a.xy, a.z, a.w, b.x); s = stage_words(a.xy, a.z, b.x);";
    rust |_cx, w| {
        let s = stage_words(seed(w), w[2], w[4]);
        integers([stage_end(seed(w), w[2], w[3], w[4]), 0, 0, 0, s[0], s[1], s[2], s[3]])
    };

    transition_next in "motion/feature" (SPECIES, Input::Below(6), ANY) tolerance None;
    wgsl "r.x = transition_next(a.x, a.y, a.z);";
    rust |cx, w| integers([transition_next(&cx.scene.species[w[0] as usize], w[1], w[2])]);

    release_place in "leaf/release" (ANY, ANY, ANY, SOURCE, ANY) tolerance None;
    wgsl "let p = release_place(a.w, a.xy, a.z); r = vec4<u32>(bitcast<vec3<u32>>(p), release_species(a.w, b.x));";
    rust |cx, w| {
        let source = &cx.scene.sources[w[3] as usize];
        let p = release_place(source, seed(w), w[2]);
        integers([p[0] as u32, p[1] as u32, p[2] as u32, release_species(source, w[4])])
    };

    release_size_speed in "leaf/release" (SPECIES, ANY, ANY, Input::Below(6), Input::Below(8_000_000)) tolerance None;
    wgsl "let z = release_size_speed(a.x, a); let q = release_ratio(z);
        r = vec4<u32>(z.size, z.speed, q, release_rate(a.x, a.w, q));
        s.x = release_fall_time(a.x, i32(b.x), z.speed);";
    rust |cx, w| {
        let species = &cx.scene.species[w[0] as usize];
        let z = release_size_speed(species, [w[0], w[1], w[2], w[3]]);
        let q = release_ratio(z);
        let fall_time = release_fall_time(species, w[4] as i32, z.speed);
        integers([z.size, z.speed, q, release_rate(species, w[3], q), fall_time])
    };

    next_event in "leaf/release" (ANY, Input::Below(1_000_000), Input::Below(60_000_000), Input::Below(5), SOURCE) tolerance None;
    wgsl "r.x = next_event(a.x, a.y, a.z, a.w, b.x);";
    rust |cx, w| integers([next_event(cx, w[0], w[1], w[2], w[3], w[4])]);

    own_velocity in "leaf/own" (TABLE, ANY, Input::Below(100_000_000), Input::Below(30_000), ANY) tolerance Some(2e-6);
    wgsl "r = vec4<u32>(bitcast<vec3<u32>>(
        own_velocity(a.x << TABLE_SHIFT, a.y, motion_params(Schedule(0u, a.z, a.w, b.x)))), 0u);";
    rust |cx, w| {
        let schedule = Schedule { event: 0, rate: w[2], size: w[3], heading: w[4] };
        floats(own_velocity(cx, w[0] << 8, w[1], motion_params(schedule)).to_array())
    };

    cone_offset in "leaf/cone_spiral" (WINDING, AGE, ANY, ANY) tolerance Some(2e-6);
    wgsl "let bits = (CONE_SPIRAL << TABLE_SHIFT) | (min(a.x, scene.species_count - 1u) << SPECIES_SHIFT);
        r = vec4<u32>(bitcast<vec3<u32>>(cone_offset(bits, a.y, a.z)), cone_angle(bits, a.y, a.z));
        s = vec4<u32>(cone_table_phase(bits, a.y, a.z), cone_of(bits).start_age, landed_bits(a.w), 0u);";
    rust |cx, w| {
        let bits = (CONE_SPIRAL << 8) | (w[0].min(cx.scene.species_count - 1) << SPECIES_SHIFT);
        let d = cone_offset(cx, bits, w[1], w[2]).to_array().map(f32::to_bits);
        let (angle, phase) = (cone_angle(cx, bits, w[1], w[2]), cone_table_phase(cx, bits, w[1], w[2]));
        integers([d[0], d[1], d[2], angle, phase, cone_of(cx, bits).start_age, landed_bits(w[3])])
    };

    cone_velocity in "leaf/cone_spiral" (WINDING, AGE, ANY, ANY) tolerance Some(4e-6);
    wgsl "let bits = (CONE_SPIRAL << TABLE_SHIFT) | (min(a.x, scene.species_count - 1u) << SPECIES_SHIFT);
        r = vec4<u32>(bitcast<vec3<u32>>(cone_velocity(bits, a.y, a.z)), 0u);
        let swing = motion_state(motion_table(bits), cone_table_phase(bits, a.y, a.z)).orientation;
        s = bitcast<vec4<u32>>(cone_orientation(bits, a.y, a.z, swing, a.w));";
    rust |cx, w| {
        let bits = (CONE_SPIRAL << 8) | (w[0].min(cx.scene.species_count - 1) << SPECIES_SHIFT);
        let v = cone_velocity(cx, bits, w[1], w[2]);
        let (_, swing) = motion_state(&cx.motion, motion_table(bits), cone_table_phase(cx, bits, w[1], w[2]));
        let q = cone_orientation(cx, bits, w[1], w[2], swing, w[3]);
        floats([v.x, v.y, v.z, 0.0, q.x, q.y, q.z, q.w])
    };

    // One in two pairs of ages begins anew on the way.
    table_phase in "leaf/own" (WINDING, AGE, AGE, Input::Below(30_000), ANY, ANY) tolerance Some(1.6e-5);
    wgsl "let bits = (CONE_SPIRAL << TABLE_SHIFT) | (min(a.x, scene.species_count - 1u) << SPECIES_SHIFT);
        let way = own_advance(bits, MotionParams(0u, a.w, b.x), a.y, a.z);
        r = vec4<u32>(bitcast<vec3<u32>>(way), bitcast<u32>(1f));
        s = bitcast<vec4<u32>>(own_orientation(bits | (b.y << SPIN_SHIFT), a.y, b.x));
        answer[2].x = first_phase(bits, a.y);";
    rust |cx, w| {
        let bits = (CONE_SPIRAL << 8) | (w[0].min(cx.scene.species_count - 1) << SPECIES_SHIFT);
        let d = own_advance(cx, bits, MotionParams { rate: 0, size: w[3], heading: w[4] }, w[1], w[2]);
        let q = own_orientation(cx, bits | (w[5] << 16), w[1], w[4]);
        let first = f32::from_bits(first_phase(cx, bits, w[1]));
        floats([d.x, d.y, d.z, 1.0, q.x, q.y, q.z, q.w, first])
    };

    // A rounding that falls the other way is a grid unit of 4e-6 m; the one keeps it small against the whole case.
    own_advance in "leaf/own" (TABLE, ANY, ANY, Input::Below(30_000), ANY) tolerance Some(1.6e-5);
    wgsl "r = vec4<u32>(bitcast<vec3<u32>>(
        own_advance(a.x << TABLE_SHIFT, MotionParams(0u, a.w, b.x), a.y, a.z)), bitcast<u32>(1f));";
    rust |cx, w| {
        let params = MotionParams { rate: 0, size: w[3], heading: w[4] };
        let d = own_advance(cx, w[0] << 8, params, w[1], w[2]);
        floats([d.x, d.y, d.z, 1.0])
    };

    own_orientation in "leaf/own" (TABLE, ANY, ANY, ANY) tolerance Some(2e-6);
    wgsl "r = bitcast<vec4<u32>>(own_orientation((a.x << TABLE_SHIFT) | (a.w << SPIN_SHIFT), a.y, a.z));
        s = vec4<u32>(bitcast<vec3<u32>>(turn_to_heading(vec3<f32>(1.0, 2.0, 3.0), a.w >> 16u)), 0u);";
    rust |cx, w| {
        let q = own_orientation(cx, (w[0] << 8) | (w[3] << 16), w[1], w[2]);
        let v = turn_to_heading(Vec3::new(1.0, 2.0, 3.0), w[3] >> 16);
        floats([q.x, q.y, q.z, q.w, v.x, v.y, v.z])
    };

    glide_of in "leaf/fall" (SPEED, SPEED, SPEED, SPEED, SPEED, SPEED, Input::Below(1 << 30)) tolerance Some(0.0);
    wgsl "let glide = glide_of(Place(in_vec3(0u), 0u), Drift(in_vec3(3u), in_word(6u)));
        out_vec3(0u, glide.position); out_vec3(3u, glide.drift); out_float(6u, f32(glide.phase));";
    rust |_cx, w| {
        let place = Place { position: vector(w, 0).to_array(), bits: 0 };
        let glide = glide_of(&place, &Drift { velocity: vector(w, 3).to_array(), phase: w[6] });
        let (p, d) = (glide.position, glide.drift);
        floats([p.x, p.y, p.z, d.x, d.y, d.z, glide.phase as f32])
    };

    spin_advance in "leaf/fall" (ANY, ANY, Input::Below(65536)) tolerance None;
    wgsl "r.x = spin_advance(a.x, a.y, f32(a.z));";
    rust |_cx, w| integers([spin_advance(w[0], w[1], w[2] as f32)]);

    part_of_step in "leaf/join" (ANY, Input::Below(65537)) tolerance Some(4e-7);
    wgsl "let p = part_of_step(response_of((a.x & 1u) << SPECIES_SHIFT), a.y);
        r = vec4<u32>(bitcast<u32>(p.decay), bitcast<u32>(p.tau), p.length, 0u);";
    rust |cx, w| {
        let p = part_of_step(cx, response_of(cx, (w[0] & 1) << SPECIES_SHIFT), w[1]);
        integers([p.decay.to_bits(), p.tau.to_bits(), p.length])
    };

    slide in "leaf/settle" (SPEED, SPEED, SPEED, Input::Float(0.0, 0.05), METRES, METRES) tolerance Some(1e-5);
    wgsl "let p = bitcast<vec2<f32>>(b.xy);
        let g = slide(bitcast<vec3<f32>>(a.xyz), bitcast<f32>(a.w), ground_slope(p.x, p.y), ground_friction());
        r = vec4<u32>(bitcast<vec3<u32>>(g.way), 0u); s = vec4<u32>(bitcast<vec3<u32>>(g.velocity), 0u);";
    rust |cx, w| {
        let slope = ground_slope(cx, float(w[4]), float(w[5]));
        let (d, v) = slide(cx, vector(w, 0), float(w[3]), slope, ground_friction(cx));
        floats([d.x, d.y, d.z, 0.0, v.x, v.y, v.z])
    };

    flatten in "leaf/settle" (UNIT, UNIT, UNIT, UNIT) tolerance Some(2e-6);
    wgsl "r = bitcast<vec4<u32>>(flatten(bitcast<vec4<f32>>(a), 0.6));";
    rust |_cx, w| floats(flatten(quaternion(w, 0), 0.6).to_array());

    flatten_on in "leaf/settle" (UNIT, UNIT, UNIT, UNIT, METRES, METRES) tolerance Some(4e-6);
    wgsl "let p = bitcast<vec2<f32>>(b.xy);
        r = bitcast<vec4<u32>>(flatten_on(ground_slope(p.x, p.y), bitcast<vec4<f32>>(a), 0.6));";
    rust |cx, w| {
        let slope = ground_slope(cx, float(w[4]), float(w[5]));
        floats(flatten_on(slope, quaternion(w, 0), 0.6).to_array())
    };

    ground_relief in "terrain/ground" (METRES, METRES) tolerance Some(1e-6);
    wgsl "let p = bitcast<vec2<f32>>(a.xy);
        r.x = bitcast<u32>(ground_relief(p.x, p.y)); r.y = bitcast<u32>(ground_rest(p.x, p.y));";
    rust |cx, w| {
        let [x, z] = [float(w[0]), float(w[1])];
        floats([ground_relief(cx, x, z), ground_rest(cx, x, z)])
    };

    ground_met in "terrain/ground" (METRES, Input::Float(-1.0, 11.0), METRES) tolerance None;
    wgsl "r.x = u32(ground_met(bitcast<vec3<f32>>(a.xyz)));";
    rust |cx, w| integers([u32::from(ground_met(cx, vector(w, 0)))]);

    ground_slope in "terrain/ground" (METRES, METRES) tolerance Some(1e-5);
    wgsl "let g = ground_slope(bitcast<f32>(a.x), bitcast<f32>(a.y));
        r = bitcast<vec4<u32>>(vec4<f32>(g.x, g.z, g.gain, g.inv_gain));";
    rust |cx, w| {
        let slope = ground_slope(cx, float(w[0]), float(w[1]));
        floats([slope.x, slope.z, slope.gain, slope.inv_gain])
    };

    wind_profile in "wind/profile" (Input::Float(-5.0, 90.0)) tolerance Some(1e-6);
    wgsl "let height = bitcast<f32>(a.x); let profile = wind_profile(height);
        r.x = bitcast<u32>(profile.x); r.y = bitcast<u32>(profile.y); r.z = bitcast<u32>(wind_vertical(height));";
    rust |cx, w| {
        let [mean, level] = wind_profile(cx, float(w[0]));
        floats([mean, level, wind_vertical(cx, float(w[0]))])
    };

    wind_gust in "wind/gust" (METRES) tolerance Some(1e-6);
    wgsl "r.x = bitcast<u32>(wind_gust(MOMENT_NOW, bitcast<f32>(a.x)));";
    rust |cx, w| floats([wind_gust(cx, &cx.step.moments[0], float(w[0]))]);

    wind_shelter in "wind/shelter" (METRES, Input::Float(-5.0, 40.0), METRES) tolerance Some(1e-6);
    wgsl "r.x = bitcast<u32>(wind_shelter(bitcast<f32>(a.x), bitcast<f32>(a.y), bitcast<f32>(a.z)));";
    rust |cx, w| floats([wind_shelter(cx, float(w[0]), float(w[1]), float(w[2]))]);

    wind_turbulence in "wind/turbulence" (METRES, METRES, METRES) tolerance Some(2e-5);
    wgsl "r = vec4<u32>(bitcast<vec3<u32>>(wind_turbulence(MOMENT_NOW, bitcast<vec3<f32>>(a.xyz))), 0u);";
    rust |cx, w| floats(wind_turbulence(cx, &cx.step.moments[0], vector(w, 0)).to_array());

    wind_vortex in "wind/vortex" (METRES, METRES, METRES) tolerance Some(2e-5);
    wgsl "r = vec4<u32>(bitcast<vec3<u32>>(wind_vortex(MOMENT_NOW, 0u, bitcast<vec3<f32>>(a.xyz))), 0u);";
    rust |cx, w| floats(wind_vortex(&cx.step.moments[0].vortices[0], vector(w, 0)).to_array());

    wind_jet in "wind/jet" (METRES, Input::Float(-1.0, 9.0), METRES, Input::Float(0.0, 1.2)) tolerance Some(1e-4);
    wgsl "r = vec4<u32>(bitcast<vec3<u32>>(wind_jet(MOMENT_NOW, 0u, bitcast<vec3<f32>>(a.xyz), bitcast<f32>(a.w))), 0u);";
    rust |cx, w| floats(wind_jet(cx, &cx.step.moments[0].jets[0], vector(w, 0), float(w[3])).to_array());

    plume_puff in "wind/plume" (Input::Float(0.0, 0.8), Input::Float(0.0, 1.0), Input::Float(0.1, 40.0)) tolerance Some(2e-4);
    wgsl "let p = plume_puff(bitcast<f32>(a.x), bitcast<f32>(a.y), bitcast<f32>(a.z)); r = vec4<u32>(bitcast<u32>(p.speed), bitcast<u32>(p.growth), 0u, 0u);";
    rust |_cx, w| { let p = plume_puff(float(w[0]), float(w[1]), float(w[2])); floats([p.speed, p.growth]) };

    wind_plume in "wind/plume" (METRES, Input::Float(-0.5, 9.0), METRES, Input::Float(0.0, 1.0)) tolerance Some(1e-4);
    wgsl "r = vec4<u32>(bitcast<vec3<u32>>(wind_plume(MOMENT_NOW, 0u, bitcast<vec3<f32>>(a.xyz), bitcast<f32>(a.w))), 0u);";
    rust |cx, w| floats(wind_plume(cx, &cx.step.moments[0].plumes[0], vector(w, 0), float(w[3])).to_array());

    wind_slipstream in "wind/slipstream" (Input::Floats(3, -6.0, 6.0)) tolerance Some(1e-4);
    wgsl "if (step_block.slipstream_count != 0u) {
            r = vec4<u32>(bitcast<vec3<u32>>(wind_slipstream(MOMENT_NOW, 0u, bitcast<vec3<f32>>(a.xyz))), 0u);
        }";
    rust |cx, w| {
        if cx.step.slipstream_count == 0 {
            return floats([0.0; 3]);
        }
        floats(wind_slipstream(&cx.step.moments[0].slipstreams[0], vector(w, 0)).to_array())
    };

    wind_pack in "wind/packed" (SPEED, SPEED, SPEED) tolerance None;
    wgsl "r = vec4<u32>(wind_pack(bitcast<vec3<f32>>(a.xyz)), 0u, 0u);";
    rust |_cx, w| integers(wind_pack(vector(w, 0)));

    wind_unpack in "wind/packed" (SPEED, SPEED, SPEED) tolerance None;
    wgsl "r = vec4<u32>(bitcast<vec3<u32>>(wind_unpack(wind_pack(bitcast<vec3<f32>>(a.xyz)))), 0u);";
    rust |_cx, w| floats(wind_unpack(wind_pack(vector(w, 0))).to_array());

    felt_drift in "leaf/fall" (Input::Scale(-30.0, 2.0), Input::Scale(-22.0, -18.0), SPEED) tolerance None;
    wgsl "r = vec4<u32>(bitcast<vec3<u32>>(felt_drift(bitcast<vec3<f32>>(a.xyz))), 0u);";
    rust |_cx, w| floats(felt_drift(vector(w, 0)).to_array());

    air_sample in "leaf/air" (METRES, METRES, METRES, UNIT, UNIT, UNIT) tolerance Some(3e-4);
    wgsl "let p = bitcast<vec3<f32>>(a.xyz);
        let drift = bitcast<vec3<f32>>(vec3<u32>(a.w, b.xy));
        r = vec4<u32>(bitcast<vec3<u32>>(wind_unpack(air_sample(p, drift, 0.1))), 0u);";
    rust |cx, w| floats(wind_unpack(air_sample(cx, vector(w, 0), vector(w, 3), 0.1)).to_array());

    wind_at in "wind/sample" (METRES, METRES, METRES) tolerance Some(3e-5);
    wgsl "r = vec4<u32>(bitcast<vec3<u32>>(wind_at(bitcast<vec3<f32>>(a.xyz))), 0u);";
    rust |cx, w| floats(wind_at(cx, vector(w, 0)).to_array());
}
