// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The functions that hold leaves on trees.

use windfall_core::device::leaf::carry::{
    PetioleLanes, TwigPose, leaf_hangs, leaf_next_sample, leaf_sample_air, leaf_size_on_twig, leaf_twig_pose,
    shed_chance,
};
use windfall_core::device::leaf::petiole::{
    PETIOLE_KIND_SHIFT, PETIOLE_LENGTH_SHIFT, PETIOLE_STRENGTH_SHIFT, petiole_of,
};

use super::bodies::{DIRECTION, PLACE, QUATERNION, Results, VELOCITY, body};
use super::{Function, Input, float, functions, integers, quaternion, vector};
use crate::runner::Words;

/// A petiole of one of the kinds of trees of the test scene.
fn petiole(words: &Words, at: usize) -> PetioleLanes {
    let bits = (words[at + 7] << PETIOLE_KIND_SHIFT)
        | (words[at + 8] << PETIOLE_STRENGTH_SHIFT)
        | (words[at + 9] << PETIOLE_LENGTH_SHIFT);
    PetioleLanes { base: vector(words, at), rest: quaternion(words, at + 3), bits }
}

const KIND: Input = Input::Below(6);
const STRENGTH: Input = Input::Below(64);
const LENGTH: Input = Input::Below(256);
/// Smoothed speed of the air in m/s.
const AIR_SPEED: Input = Input::Float(0.0, 40.0);

functions! {
    CARRY_FUNCTIONS;

    petiole_of in "leaf/petiole" (Input::Below(2000)) tolerance Some(0.0);
    wgsl "let p = petiole_of(a.x); out_vec3(0u, p.base); out_vec4(3u, p.rest_quaternion);
        answer[2] = vec4<u32>(p.segment, p.bits, 0u, 0u);";
    rust |cx, w| {
        let p = petiole_of(cx, w[0]);
        let mut results = Results::new().floats(&p.base).floats(&p.rest_quaternion).0;
        (results[8], results[9]) = (p.segment, p.bits);
        results
    };

    leaf_size_on_twig in "leaf/carry" (Input::Below(65536), Input::Word) tolerance None;
    wgsl "r.x = leaf_size_on_twig(a.x, a.y);";
    rust |_cx, w| integers([leaf_size_on_twig(w[0], w[1])]);

    // Speeds beyond the table's end.
    shed_chance in "leaf/carry" (KIND, STRENGTH, Input::Float(0.0, 90.0)) tolerance None;
    wgsl "r.x = shed_chance((a.x << PETIOLE_KIND_SHIFT) | (a.y << PETIOLE_STRENGTH_SHIFT), bitcast<f32>(a.z));";
    rust |cx, w| {
        let bits = (w[0] << PETIOLE_KIND_SHIFT) | (w[1] << PETIOLE_STRENGTH_SHIFT);
        integers([shed_chance(cx, bits, float(w[2]))])
    };

    leaf_twig_pose in "leaf/carry" (
        AIR_SPEED, Input::Word, DIRECTION, QUATERNION, KIND, STRENGTH, LENGTH, PLACE, QUATERNION, VELOCITY, VELOCITY
    ) tolerance Some(1e-5);
    wgsl "let h = leaf_twig_pose(in_float(0u), in_word(1u), in_petiole(2u), in_body(12u));
        out_vec3(0u, h.position); out_vec4(3u, h.attitude); out_vec3(7u, h.velocity);";
    rust |cx, w| {
        let TwigPose { position, attitude, velocity } = leaf_twig_pose(cx, float(w[0]), w[1], &petiole(w, 2), &body(w, 12));
        Results::new().vec3(position).quat(attitude).vec3(velocity).0
    };

    // Around the step at which the test world stands.
    leaf_hangs in "leaf/carry" (Input::Word, Input::Below(200), Input::Word) tolerance None;
    wgsl "r.x = u32(leaf_hangs(a.x, a.y)); r.y = leaf_next_sample(a.z);";
    rust |cx, w| integers([u32::from(leaf_hangs(cx, w[0], w[1])), leaf_next_sample(cx, w[2])]);

    leaf_sample_air in "leaf/carry" (
        AIR_SPEED, Input::Word, DIRECTION, QUATERNION, KIND, STRENGTH, LENGTH, PLACE, QUATERNION, VELOCITY, VELOCITY
    ) tolerance Some(1e-5);
    wgsl "let sample = leaf_sample_air(in_float(0u), in_word(1u), in_petiole(2u), in_body(12u));
        out_float(0u, sample.air_speed); out_float(1u, f32(sample.breaks));";
    rust |cx, w| {
        let (air_speed, breaks) = leaf_sample_air(cx, float(w[0]), w[1], &petiole(w, 2), &body(w, 12));
        Results::new().floats(&[air_speed, f32::from(u8::from(breaks))]).0
    };
}
