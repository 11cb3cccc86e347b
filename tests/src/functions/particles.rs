// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The functions of particles: draws, shapes, drag, forces, flight and contacts.

use windfall_core::Context;
use windfall_core::arith::Vec3;
use windfall_core::blocks::{NestBlock, PopulationBlock};
use windfall_core::device::particle::air::{air_numbers, lost_share};
use windfall_core::device::particle::birth::{
    birth_number, cap_direction, foot_point, shape_point, trait_word,
};
use windfall_core::device::particle::draw::{particle_words, spread_draw};
use windfall_core::device::particle::fly::{
    ParticleFlight, interval_share, particle_coasts, particle_fly, particle_free_step,
};
use windfall_core::device::particle::force::{force_pull, force_swirl, force_turn};
use windfall_core::device::particle::history::{history_counts, history_is_due, history_row, history_sample};
use windfall_core::device::particle::local_space::{
    ParticleFrame, carried_flight, frame_turn, in_frame, parent_frame, rest_frame,
};
use windfall_core::device::particle::mutual::{mutual_pull, mutual_source};
use windfall_core::device::particle::nest::{nest_events, nest_id, nest_place, nest_rest, nest_start};
use windfall_core::device::particle::record::{
    MEETS_NOTHING, life_size_word, particle_bits, particle_hits, particle_life, particle_population,
    particle_size, particle_state, particle_struck, with_more_hits, with_particle_state,
};
use windfall_core::device::particle::step::{
    is_outside, is_unborn, life_is_over, may_be_struck, rest_is_checked, rest_wakes, through_sides,
};
use windfall_core::device::particle::strike::{
    bent_share, ground_strike, particle_contact, particle_push, struck_velocity, wedged_velocity,
};
use windfall_core::device::wind::vortex::swirl_profile;
use windfall_core::particle::{HistoryRun, ParticleMotion, ParticlePlace, ParticleStart};

use super::{Function, Input, float, floats, functions, integers, vector};
use crate::runner::Words;

const ANY: Input = Input::Word;
/// Populations of the test scene.
const POPULATION: Input = Input::Below(7);
/// Populations that are born of others, from the tenth on.
const NEST: Input = Input::Below(5);
/// Places among the objects of the test scene, and above them.
const PLACE: Input = Input::Floats(3, -4.0, 4.0);
const FLOW: Input = Input::Floats(3, -8.0, 8.0);
const NORMAL: Input = Input::Floats(3, -0.6, 0.6);
const SHARE: Input = Input::Float(0.0, 1.0);

fn population<'a>(cx: &Context<'a>, words: &Words) -> &'a PopulationBlock {
    &cx.scene.populations[words[0] as usize]
}

fn nest<'a>(cx: &Context<'a>, words: &Words) -> &'a NestBlock {
    &cx.scene.populations[words[0] as usize + 9].nest
}

functions! {
    PARTICLE_FUNCTIONS;

    particle_words in "particle/draw" (POPULATION, ANY, Input::Below(5)) tolerance None;
    wgsl "r = particle_words(scene.seed, a.x, a.y, a.z);";
    rust |cx, w| integers(particle_words(cx.scene.seed, w[0], w[1], w[2]));

    spread_draw in "particle/draw" (POPULATION, ANY, ANY) tolerance Some(1e-6);
    wgsl "r.x = bitcast<u32>(spread_draw(scene.populations[a.x].speed_m_s, a.y, a.z));
        r.y = bitcast<u32>(spread_draw(scene.populations[a.x].life_steps, a.y, a.z));";
    rust |cx, w| {
        let block = population(cx, w);
        floats([spread_draw(block.speed_m_s, w[1], w[2]), spread_draw(block.life_steps, w[1], w[2])])
    };

    lost_share in "particle/air" (Input::Scale(1e-6, 50.0)) tolerance Some(1e-6);
    wgsl "r.x = bitcast<u32>(lost_share(bitcast<f32>(a.x)));";
    rust |_cx, w| floats([lost_share(float(w[0]))]);

    air_numbers in "particle/air" (POPULATION, Input::Below(65535), ANY, ANY) tolerance Some(2e-6);
    wgsl "let n = air_numbers(a.x, a.y + 1u, a.z, a.w); r.x = bitcast<u32>(n.x); r.y = bitcast<u32>(n.y);";
    rust |cx, w| floats(air_numbers(cx, population(cx, w), w[1] + 1, w[2], w[3]));

    foot_point in "particle/birth" (Input::Below(256), ANY) tolerance Some(1e-6);
    wgsl "out_vec3(0u, foot_point(a.x + 1u, a.y));";
    rust |_cx, w| floats(foot_point(w[0] + 1, w[1]).to_array());

    shape_point in "particle/birth" (Input::Below(7), ANY, ANY, ANY, ANY, ANY, ANY) tolerance Some(1e-5);
    wgsl "out_vec3(0u, shape_point(a.x, in_words(1u), in_words(5u)));";
    rust |_cx, w| {
        let words = |at: usize| [w[at], w[at + 1], w[at + 2], w[at + 3]];
        floats(shape_point(w[0], words(1), words(5)).to_array())
    };

    cap_direction in "particle/birth" (POPULATION, ANY, ANY) tolerance Some(1e-5);
    wgsl "out_vec3(0u, cap_direction(a.x, a.y, a.z));";
    rust |cx, w| floats(cap_direction(population(cx, w), w[1], w[2]).to_array());

    with_more_hits in "particle/record" (ANY, Input::Below(4), ANY) tolerance None;
    wgsl "r.x = with_more_hits(a.x, a.y + 1u); r.y = particle_hits(a.x); r.z = particle_life(a.z); r.w = particle_size(a.z);
        s.x = life_size_word(a.z & 0xffffu, a.x & 0xffffu); s.y = particle_struck(a.x);";
    rust |_cx, w| integers([
        with_more_hits(w[0], w[1] + 1),
        particle_hits(w[0]),
        particle_life(w[2]),
        particle_size(w[2]),
        life_size_word(w[2] & 0xffff, w[0] & 0xffff),
        particle_struck(w[0]),
    ]);

    particle_bits in "particle/record" (ANY, ANY, ANY) tolerance None;
    wgsl "r = vec4<u32>(particle_bits(a.x & 3u, a.y & 15u), particle_state(a.z), particle_population(a.z),
        with_particle_state(a.z, a.x & 3u));";
    rust |_cx, w| integers([
        particle_bits(w[0] & 3, w[1] & 15), particle_state(w[2]), particle_population(w[2]),
        with_particle_state(w[2], w[0] & 3),
    ]);

    birth_number in "particle/birth" (POPULATION, ANY, Input::Float(-2.0, 70_000.0)) tolerance None;
    wgsl "let place = a.y % scene.populations[a.x].count;
        r = vec4<u32>(birth_number(a.x, place), trait_word(bitcast<f32>(a.z)), 0u, 0u);";
    rust |cx, w| {
        let block = population(cx, w);
        let births = &cx.step.births[w[0] as usize];
        integers([birth_number(births, block.count, w[1] % block.count), trait_word(float(w[2])), 0, 0])
    };

    history_row in "particle/history" (ANY, ANY, ANY, ANY, Input::Below(70)) tolerance None;
    wgsl "var run: HistoryRun; run.first_sample = a.z & 0xffffu; run.samples = 2u + (a.z >> 26u); run.every_steps = 1u + (a.w & 63u);
        run.ahead_steps = a.w >> 6u;
        let sample = history_sample(ParticlePlace(vec3<f32>(0.5, 0.25, 2.0), a.x), a.w);
        r = vec4<u32>(history_row(run, a.y & 0xffffu, a.x), u32(history_is_due(run, a.x)),
            u32(history_counts(sample, a.w, a.w - b.x + 5u)), u32(history_counts(sample, a.x, a.w - 5u)));
        s.x = bitcast<u32>(sample.position.y); s.y = sample.time;";
    rust |_cx, w| {
        let run = HistoryRun {
            first: 0,
            count: 0,
            first_sample: w[2] & 0xffff,
            samples: 2 + (w[2] >> 26),
            every_steps: 1 + (w[3] & 63),
            ahead_steps: w[3] >> 6,
            unused: [0; 2],
        };
        let sample = history_sample(&ParticlePlace { position: [0.5, 0.25, 2.0], bits: w[0] }, w[3]);
        integers([
            history_row(&run, w[1] & 0xffff, w[0]),
            history_is_due(&run, w[0]).into(),
            history_counts(&sample, w[3], w[3].wrapping_sub(w[4]).wrapping_add(5)).into(),
            history_counts(&sample, w[0], w[3].wrapping_sub(5)).into(),
            sample.position[1].to_bits(),
            sample.time,
        ])
    };

    nest_place in "particle/nest" (NEST, ANY, ANY, ANY) tolerance None;
    wgsl "let n = a.x + 9u; let place = nest_place(n, a.y);
        r = vec4<u32>(place.parent, place.round, place.ordinal, nest_id(n, a.y, a.z, a.w));";
    rust |cx, w| {
        let place = nest_place(nest(cx, w), w[1]);
        integers([place.parent, place.round, place.ordinal, nest_id(nest(cx, w), w[1], w[2], w[3])])
    };

    nest_events in "particle/nest" (NEST, ANY, Input::Below(40), ANY, ANY) tolerance None;
    wgsl "let n = a.x + 9u; let round = b.x % scene.populations[n].nest.rounds;
        let events = nest_events(n, a.y, step_block.index - a.z, a.w, round);
        r = vec4<u32>(events.count, events.last, bitcast<u32>(nest_rest(n, a.y, 0.25)), 0u);";
    rust |cx, w| {
        let nest = nest(cx, w);
        let birth = cx.step.index.wrapping_sub(w[2]);
        let events = nest_events(cx, nest, w[1], birth, w[3], w[4] % nest.rounds);
        integers([events.count, events.last, nest_rest(nest, w[1], 0.25).to_bits(), 0])
    };

    nest_start in "particle/nest" (NEST, PLACE, FLOW, PLACE, FLOW, SHARE) tolerance Some(1e-6);
    wgsl "let start = nest_start(a.x + 9u, ParticleFlight(in_vec3(1u), in_vec3(4u)), ParticleFlight(in_vec3(7u), in_vec3(10u)),
            in_float(13u));
        out_vec3(0u, start.position); out_vec3(3u, start.velocity);";
    rust |cx, w| {
        let own = ParticleFlight { position: vector(w, 1), velocity: vector(w, 4) };
        let parent = ParticleFlight { position: vector(w, 7), velocity: vector(w, 10) };
        flight(nest_start(cx, nest(cx, w), own, parent, float(w[13])))
    };

    frame_turn in "particle/local_space" (FLOW, FLOW, FLOW) tolerance Some(1e-3);
    wgsl "let still = vec3<f32>(0.0, 0.0, 0.0);
        let frame = ParticleFrame(ParticleFlight(still, in_vec3(0u)), ParticleFlight(still, in_vec3(3u)));
        out_vec3(0u, frame_turn(frame, in_vec3(6u)));";
    rust |_cx, w| {
        let still = |velocity: Vec3| ParticleFlight { position: Vec3::ZERO, velocity };
        let frame = ParticleFrame { start: still(vector(w, 0)), end: still(vector(w, 3)) };
        floats(frame_turn(frame, vector(w, 6)).to_array())
    };

    carried_flight in "particle/local_space" (ANY, Input::Below(9), PLACE, FLOW, PLACE, FLOW, PLACE, FLOW, SHARE) tolerance Some(1e-3);
    wgsl "let start = ParticleStart(in_vec3(2u), 0.0, in_vec3(5u), 0.0);
        var frame = parent_frame(ParticlePlace(in_vec3(8u), a.x), ParticleMotion(in_vec3(11u), 4u), start, a.y);
        if (a.y == 4u) {
            frame = rest_frame(frame, in_float(20u));
        }
        let end = carried_flight(frame, in_frame(frame, ParticleFlight(in_vec3(14u), in_vec3(17u))));
        out_vec3(0u, end.position); out_vec3(3u, end.velocity);";
    rust |_cx, w| {
        let three = |at: usize| vector(w, at).to_array();
        let start = ParticleStart { position: three(2), unused: 0.0, velocity: three(5), unused_too: 0.0 };
        let place = ParticlePlace { position: three(8), bits: w[0] };
        let motion = ParticleMotion { velocity: three(11), birth: 4 };
        let mut frame = parent_frame(&place, &motion, &start, w[1]);
        if w[1] == 4 {
            frame = rest_frame(frame, float(w[20]));
        }
        let own = ParticleFlight { position: vector(w, 14), velocity: vector(w, 17) };
        flight(carried_flight(frame, in_frame(frame, own)))
    };

    is_outside in "particle/step" (POPULATION, ANY, ANY, PLACE, FLOW) tolerance None;
    wgsl "let place = in_vec3(3u);
        r = vec4<u32>(u32(is_outside(a.x, place * 4.0)), u32(may_be_struck(a.x, place, place + in_vec3(6u))),
            u32(life_is_over(a.y, a.z)), u32(is_unborn(a.y)));
        s = vec4<u32>(u32(rest_is_checked(a.y)), u32(rest_wakes(a.x, a.z)), bitcast<vec2<u32>>(through_sides(a.x, place * 4.0).xz));";
    rust |cx, w| {
        let (block, place) = (population(cx, w), vector(w, 3));
        let through = through_sides(block, place * 4.0);
        integers::<8>([
            is_outside(block, place * 4.0), may_be_struck(cx, block, place, place + vector(w, 6)),
            life_is_over(cx, w[1], w[2]), is_unborn(w[1]),
            rest_is_checked(cx, w[1]), rest_wakes(cx, block, w[2]),
        ].map(u32::from).into_iter().chain([through.x, through.z].map(f32::to_bits)).collect::<Vec<_>>().try_into().expect("eight"))
    };

    mutual_source in "particle/mutual" (POPULATION, ANY, PLACE, FLOW) tolerance Some(1e-5);
    wgsl "let source = mutual_source(a.x, ParticlePlace(in_vec3(2u), a.y), ParticleMotion(in_vec3(5u), 0u)); out_vec4(0u, source);";
    rust |cx, w| {
        let place = ParticlePlace { position: vector(w, 2).to_array(), bits: w[1] };
        let motion = ParticleMotion { velocity: vector(w, 5).to_array(), birth: 0 };
        floats(mutual_source(cx, population(cx, w), &place, &motion))
    };

    force_pull in "particle/force" (POPULATION, PLACE) tolerance Some(1e-4);
    wgsl "out_vec3(0u, force_pull(a.x, in_vec3(1u)));";
    rust |cx, w| floats(force_pull(cx, population(cx, w), vector(w, 1)).to_array());

    force_turn in "particle/force" (POPULATION, FLOW) tolerance Some(2e-6);
    wgsl "out_vec3(0u, force_turn(a.x, in_vec3(1u)));";
    rust |cx, w| floats(force_turn(cx, population(cx, w), vector(w, 1)).to_array());

    force_swirl in "particle/force" (POPULATION, PLACE) tolerance Some(1e-5);
    wgsl "out_vec3(0u, force_swirl(a.x, in_vec3(1u)));";
    rust |cx, w| floats(force_swirl(cx, population(cx, w), vector(w, 1)).to_array());

    swirl_profile in "wind/vortex" (Input::Below(4), Input::Float(-0.9, 5.0), Input::Float(0.0, 2.0)) tolerance Some(1e-4);
    wgsl "r.x = bitcast<u32>(swirl_profile(a.x, bitcast<f32>(a.y), bitcast<f32>(a.z)));";
    rust |_cx, w| floats([swirl_profile(w[0], float(w[1]), float(w[2]))]);

    mutual_pull in "particle/mutual" (POPULATION, FLOW, PLACE, PLACE, Input::Float(0.1, 2.0)) tolerance Some(1e-2);
    wgsl "out_vec3(0u, mutual_pull(a.x, in_vec3(1u), in_vec3(4u), vec4<f32>(in_vec3(7u) + 8.0, in_float(10u))));";
    rust |cx, w| {
        let [x, y, z] = vector(w, 7).to_array().map(|along| along + 8.0);
        floats(mutual_pull(population(cx, w), vector(w, 1), vector(w, 4), [x, y, z, float(w[10])]).to_array())
    };

    particle_fly in "particle/fly" (POPULATION, PLACE, FLOW, SHARE, Input::Float(0.0, 3.0), FLOW) tolerance Some(1e-2);
    wgsl "let end = particle_fly(a.x, ParticleFlight(in_vec3(1u), in_vec3(4u)), vec2<f32>(in_float(7u), in_float(8u)), in_vec3(9u));
        out_vec3(0u, end.position); out_vec3(3u, end.velocity);";
    rust |cx, w| {
        let start = ParticleFlight { position: vector(w, 1), velocity: vector(w, 4) };
        let end = particle_fly(cx, population(cx, w), start, [float(w[7]), float(w[8])], vector(w, 9));
        flight(end)
    };

    interval_share in "particle/fly" (SHARE) tolerance Some(1e-6);
    wgsl "r.x = bitcast<u32>(interval_share(in_float(0u)));";
    rust |cx, w| floats([interval_share(cx, float(w[0]))]);

    particle_coasts in "particle/fly" (POPULATION, ANY) tolerance None;
    wgsl "r.x = u32(particle_coasts(a.x, a.y));";
    rust |cx, w| integers([u32::from(particle_coasts(cx, population(cx, w), w[1]))]);

    particle_free_step in "particle/fly" (POPULATION, PLACE, FLOW, SHARE, Input::Float(0.0, 3.0), FLOW, ANY) tolerance Some(1e-2);
    wgsl "let end = particle_free_step(a.x, (in_word(12u) & 1u) == 1u, ParticleFlight(in_vec3(1u), in_vec3(4u)), vec2<f32>(in_float(7u), in_float(8u)), in_vec3(9u));
        out_vec3(0u, end.position); out_vec3(3u, end.velocity);";
    rust |cx, w| {
        let start = ParticleFlight { position: vector(w, 1), velocity: vector(w, 4) };
        let (air, mutual) = ([float(w[7]), float(w[8])], vector(w, 9));
        flight(particle_free_step(cx, population(cx, w), w[12] & 1 == 1, start, air, mutual))
    };

    ground_strike in "particle/strike" (PLACE, FLOW) tolerance Some(1e-2);
    wgsl "let hit = ground_strike(in_vec3(0u), in_vec3(3u)); r.x = hit.number & 3u; r.y = bitcast<u32>(hit.share);";
    rust |cx, w| {
        let hit = ground_strike(cx, vector(w, 0), vector(w, 3));
        integers([hit.number & 3, hit.share.to_bits()])
    };

    bent_share in "particle/strike" (SHARE, SHARE, Input::Float(-1.0, 1.0), Input::Float(-1.0, 1.0)) tolerance Some(1e-2);
    wgsl "r.x = bitcast<u32>(bent_share(in_float(0u), in_float(1u), in_float(2u), in_float(3u)));";
    rust |_cx, w| floats([bent_share(float(w[0]), float(w[1]), float(w[2]), float(w[3]))]);

    struck_velocity in "particle/strike" (POPULATION, FLOW, NORMAL, SHARE, SHARE, SHARE) tolerance Some(1e-4);
    wgsl "out_vec3(0u, struck_velocity(a.x, in_vec3(1u), in_vec3(4u), in_float(7u), in_float(8u), in_float(9u)));";
    rust |cx, w| {
        let block = population(cx, w);
        floats(
            struck_velocity(block, vector(w, 1), vector(w, 4), float(w[7]), float(w[8]), float(w[9])).to_array(),
        )
    };

    wedged_velocity in "particle/strike" (FLOW, NORMAL, NORMAL, NORMAL) tolerance Some(1e-2);
    wgsl "out_vec3(0u, wedged_velocity(in_vec3(0u), in_vec3(3u), in_vec3(6u), in_vec3(9u)));";
    rust |_cx, w| floats(wedged_velocity(vector(w, 0), vector(w, 3), vector(w, 6), vector(w, 9)).to_array());

    particle_contact in "particle/strike" (POPULATION, PLACE, FLOW, FLOW) tolerance Some(1e-2);
    wgsl "if (scene.populations[a.x].meets != MEETS_NOTHING) {
            let start = ParticleFlight(in_vec3(1u), in_vec3(4u)); let next = in_vec3(7u);
            let end = ParticleFlight(start.position + (start.velocity + next) * 0.05, next);
            let found = particle_contact(a.x, start, end, 0.0, 0.1);
            out_vec3(0u, found.flight.position); out_vec3(3u, found.flight.velocity);
            answer[1] |= vec4<u32>(0u, 0u, found.hits, found.held_by & 255u);
            answer[2] |= vec4<u32>(u32(found.is_stopped), u32(found.dies), 0u, 0u);
        }";
    rust |cx, w| {
        let block = population(cx, w);
        if block.meets == MEETS_NOTHING {
            return floats([0.0; 10]);
        }
        let start = ParticleFlight { position: vector(w, 1), velocity: vector(w, 4) };
        let next = vector(w, 7);
        let end = ParticleFlight { position: start.position + (start.velocity + next) * 0.05, velocity: next };
        let found = particle_contact(cx, block, start, end, 0.0, 0.1);
        let mut words = flight(found.flight);
        words[6..10].copy_from_slice(&[
            found.hits,
            found.held_by & 255,
            u32::from(found.is_stopped),
            u32::from(found.dies),
        ]);
        words
    };

    particle_push in "particle/strike" (PLACE) tolerance Some(1e-2);
    wgsl "out_vec3(0u, particle_push(in_vec3(0u), 0.01));";
    rust |cx, w| floats(particle_push(cx, vector(w, 0), 0.01).to_array());
}

fn flight(flight: ParticleFlight) -> Words {
    let Vec3 { x, y, z } = flight.position;
    let velocity = flight.velocity;
    floats([x, y, z, velocity.x, velocity.y, velocity.z])
}
