// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The functions of leaves on water.

use windfall_core::arith::Vec3;
use windfall_core::device::leaf::afloat::{
    along_shore, floats_at, raft_is_ahead, sinking_speed, soaking_steps,
};
use windfall_core::device::leaf::record::{
    SPECIES_SHIFT, is_afloat, is_on_ground, is_sunk, soaked_bits, sunk_bits, with_afloat,
};
use windfall_core::device::leaf::stack::drifted;
use windfall_core::device::terrain::ground::{ground_bottom, ground_rise};

use super::{Function, Input, float, floats, functions, integers, vector};
use crate::runner::Words;

const ANY: Input = Input::Word;
/// Places in the littered rectangle of the test scene, and somewhat beyond.
const NEAR: Input = Input::Floats(2, -9.0, 9.0);
const WAY: Input = Input::Floats(3, -1.0, 1.0);

/// A place at a height of zero.
fn place(words: &Words, at: usize) -> Vec3 {
    Vec3::new(float(words[at]), 0.0, float(words[at + 1]))
}

functions! {
    AFLOAT_FUNCTIONS;

    is_afloat in "leaf/record" (ANY, Input::Below(32)) tolerance None;
    wgsl "r = vec4<u32>(u32(is_afloat(a.x)), u32(is_sunk(a.x)), u32(is_on_ground(a.x)), with_afloat(a.x));
        s = vec4<u32>(soaked_bits(a.x), sunk_bits(a.y), 0u, 0u);";
    rust |_cx, w| integers([
        u32::from(is_afloat(w[0])), u32::from(is_sunk(w[0])), u32::from(is_on_ground(w[0])), with_afloat(w[0]),
        soaked_bits(w[0]), sunk_bits(w[1]), 0, 0,
    ]);

    floats_at in "leaf/afloat" (NEAR, ANY, ANY) tolerance None;
    wgsl "r = vec4<u32>(u32(floats_at(in_float(0u), in_float(1u))), soaking_steps(a), 0u, 0u);";
    rust |cx, w| integers([
        u32::from(floats_at(cx, float(w[0]), float(w[1]))), soaking_steps(cx, [w[0], w[1], w[2], w[3]]), 0, 0,
    ]);

    along_shore in "leaf/afloat" (NEAR, WAY, ANY) tolerance Some(1e-4);
    wgsl "let place = vec3<f32>(in_float(0u), 0.0, in_float(1u)); let way = in_vec3(2u);
        out_vec3(0u, along_shore(place, way)); out_vec3(3u, drifted(place, way));
        out_float(6u, sinking_speed(vec4<u32>(0u, 0u, 0u, in_word(5u))));
        out_float(7u, ground_bottom(place.x, place.z));
        let rise = ground_rise(place.x, place.z); out_float(8u, rise.x); out_float(9u, rise.y);";
    rust |cx, w| {
        let (place, way) = (place(w, 0), vector(w, 2));
        let (along, next) = (along_shore(cx, place, way), drifted(cx, place, way));
        let [rise_x, rise_z] = ground_rise(cx, place.x, place.z);
        floats([
            along.x, along.y, along.z, next.x, next.y, next.z, sinking_speed([0, 0, 0, w[5]]),
            ground_bottom(cx, place.x, place.z), rise_x, rise_z,
        ])
    };

    raft_is_ahead in "leaf/afloat" (NEAR, WAY, Input::Below(2)) tolerance Some(1.0);
    wgsl "let place = vec3<f32>(in_float(0u), 0.0, in_float(1u));
        out_float(0u, f32(raft_is_ahead(in_word(5u) << SPECIES_SHIFT, place, in_vec3(2u))));";
    rust |cx, w| floats([f32::from(u8::from(raft_is_ahead(cx, w[5] << SPECIES_SHIFT, place(w, 0), vector(w, 2))))]);
}
