// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The functions that hold leaves on trees.

use windfall_core::device::leaf::carry::{
    Hang, Stalk, leaf_hang, leaf_hangs, leaf_next_sample, leaf_sample_air, leaf_size_on_twig, petiole_of,
    shed_chance,
};
use windfall_core::leaf::petiole::{PETIOLE_CLASS_SHIFT, PETIOLE_KIND_SHIFT, PETIOLE_REACH_SHIFT};

use super::bodies::{DIRECTION, PLACE, QUATERNION, Results, VELOCITY, body};
use super::{Function, Input, float, functions, integers, quaternion, vector};
use crate::runner::Words;

/// A petiole of one of the kinds of trees of the test scene.
fn stalk(words: &Words, at: usize) -> Stalk {
    let facts = (words[at + 7] << PETIOLE_KIND_SHIFT)
        | (words[at + 8] << PETIOLE_CLASS_SHIFT)
        | (words[at + 9] << PETIOLE_REACH_SHIFT);
    Stalk { at: vector(words, at), rest: quaternion(words, at + 3), facts }
}

const KIND: Input = Input::Below(6);
const CLASS: Input = Input::Below(64);
const REACH: Input = Input::Below(256);
/// Smoothed speed of the air in m/s.
const AIR_SPEED: Input = Input::Float(0.0, 40.0);

functions! {
    CARRY_FUNCTIONS;

    petiole_of in "leaf/carry" (Input::Below(2000)) tolerance Some(0.0);
    wgsl "let p = petiole_of(a.x); out_vec3(0u, p.at); out_vec4(3u, p.rest);
        answer[2] = vec4<u32>(p.segment, p.facts, 0u, 0u);";
    rust |cx, w| {
        let p = petiole_of(cx, w[0]);
        let mut results = Results::new().floats(&p.at).floats(&p.rest).0;
        (results[8], results[9]) = (p.segment, p.facts);
        results
    };

    leaf_size_on_twig in "leaf/carry" (Input::Below(65536), Input::Word) tolerance None;
    wgsl "r.x = leaf_size_on_twig(a.x, a.y);";
    rust |_cx, w| integers([leaf_size_on_twig(w[0], w[1])]);

    // Speeds beyond the table's end.
    shed_chance in "leaf/carry" (KIND, CLASS, Input::Float(0.0, 90.0)) tolerance None;
    wgsl "r.x = shed_chance((a.x << PETIOLE_KIND_SHIFT) | (a.y << PETIOLE_CLASS_SHIFT), bitcast<f32>(a.z));";
    rust |cx, w| {
        let facts = (w[0] << PETIOLE_KIND_SHIFT) | (w[1] << PETIOLE_CLASS_SHIFT);
        integers([shed_chance(cx, facts, float(w[2]))])
    };

    leaf_hang in "leaf/carry" (
        AIR_SPEED, Input::Word, DIRECTION, QUATERNION, KIND, CLASS, REACH, PLACE, QUATERNION, VELOCITY, VELOCITY
    ) tolerance Some(1e-5);
    wgsl "let h = leaf_hang(in_float(0u), in_word(1u), in_petiole(2u), in_body(12u));
        out_vec3(0u, h.position); out_vec4(3u, h.attitude); out_vec3(7u, h.velocity);";
    rust |cx, w| {
        let Hang { position, attitude, velocity } = leaf_hang(cx, float(w[0]), w[1], &stalk(w, 2), &body(w, 12));
        Results::new().vec3(position).quat(attitude).vec3(velocity).0
    };

    // Around the step at which the test world stands.
    leaf_hangs in "leaf/carry" (Input::Word, Input::Below(200), Input::Word) tolerance None;
    wgsl "r.x = u32(leaf_hangs(a.x, a.y)); r.y = leaf_next_sample(a.z);";
    rust |cx, w| integers([u32::from(leaf_hangs(cx, w[0], w[1])), leaf_next_sample(cx, w[2])]);

    leaf_sample_air in "leaf/carry" (
        AIR_SPEED, Input::Word, DIRECTION, QUATERNION, KIND, CLASS, REACH, PLACE, QUATERNION, VELOCITY, VELOCITY
    ) tolerance Some(1e-5);
    wgsl "let sample = leaf_sample_air(in_float(0u), in_word(1u), in_petiole(2u), in_body(12u));
        out_float(0u, sample.air_speed); out_float(1u, f32(sample.breaks));";
    rust |cx, w| {
        let (air_speed, breaks) = leaf_sample_air(cx, float(w[0]), w[1], &stalk(w, 2), &body(w, 12));
        Results::new().floats(&[air_speed, f32::from(u8::from(breaks))]).0
    };
}
