// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The functions of burning leaves.

use windfall_core::arith::math::inverse_fifth_root;
use windfall_core::device::leaf::burn::{
    BurnCell, BurnSums, UNLIT, burn_cell, burn_power, burn_sums, burn_way, cell_power, feeds_plume,
    fire_words, flame_warmth, heated_cell, ignition_rise, leaf_heat_release, leaf_rise, scene_species,
};
use windfall_core::device::leaf::record::{SIZE_ONE, SPECIES_SHIFT, STATE_FALLING, with_species};
use windfall_core::device::wind::plume::{plume_axis_warmth, plume_fire, plume_point, plume_warmth};
use windfall_core::leaf::Burn;

use super::{Function, Input, float, floats, functions, integers, vector};

const PLACE: Input = Input::Floats(3, -4.0, 4.0);
const ABOVE: Input = Input::Floats(3, 0.0, 4.0);
const SHARE: Input = Input::Float(0.0, 1.0);

functions! {
    BURNING_FUNCTIONS;

    inverse_fifth_root in "arith/math" (Input::Scale(-12.0, 12.0)) tolerance Some(5e-7);
    wgsl "r.x = bitcast<u32>(inverse_fifth_root(bitcast<f32>(a.x)));";
    rust |_cx, w| floats([inverse_fifth_root(float(w[0]))]);

    plume_point in "wind/plume" (PLACE) tolerance Some(1e-5);
    wgsl "let p = plume_point(MOMENT_NOW, 0u, in_vec3(0u));
        r = vec4<u32>(bitcast<u32>(p.height), bitcast<u32>(p.slope), bitcast<u32>(p.along), bitcast<u32>(p.across));
        s.x = u32(p.is_below);";
    rust |cx, w| {
        let p = plume_point(cx, &cx.step.moments[0].plumes[0], vector(w, 0));
        let [height, slope, along, across] = [p.height, p.slope, p.along, p.across].map(f32::to_bits);
        integers([height, slope, along, across, u32::from(p.is_below)])
    };

    plume_warmth in "wind/plume" (ABOVE, SHARE) tolerance Some(1e-4);
    wgsl "let fire = plume_fire(MOMENT_NOW, step_block.plume_count - 1u);
        r = vec4<u32>(
            bitcast<u32>(plume_warmth(in_vec3(0u))), bitcast<u32>(plume_axis_warmth(bitcast<f32>(a.w))),
            bitcast<u32>(fire.speed_m_s), bitcast<u32>(fire.heights_per_m),
        );";
    rust |cx, w| {
        let last = cx.step.plume_count as usize - 1;
        let fire = plume_fire(cx, &cx.step.moments[0].plumes[last]);
        floats([
            plume_warmth(cx, vector(w, 0)), plume_axis_warmth(float(w[3])), fire.speed_m_s, fire.heights_per_m,
        ])
    };

    burn_way in "leaf/burn" (Input::Below(900), Input::Below(600), Input::Float(1.0, 900.0), SHARE) tolerance Some(1e-6);
    wgsl "r.x = bitcast<u32>(burn_way(600u + a.x, Burn(0.0, bitcast<f32>(a.w), a.y, bitcast<f32>(a.z))));";
    rust |_cx, w| {
        let burn = Burn { heat: 0.0, out_way: float(w[3]), lit: w[1], steps: float(w[2]) };
        floats([burn_way(600 + w[0], &burn)])
    };

    leaf_rise in "leaf/burn" (Input::Below(2), Input::Float(0.0, 90_000.0), Input::Word, SHARE, Input::Float(0.5, 1.5)) tolerance Some(1e-5);
    wgsl "r = vec4<u32>(
            bitcast<u32>(leaf_rise(a.x, bitcast<f32>(a.y))), bitcast<u32>(ignition_rise(a.x, a.z)),
            bitcast<u32>(burn_power(a.x, bitcast<f32>(b.x), bitcast<f32>(a.w))),
            bitcast<u32>(flame_warmth(bitcast<f32>(a.y))),
        );";
    rust |cx, w| {
        let block = &cx.scene.burns[w[0] as usize];
        floats([
            leaf_rise(block, float(w[1])), ignition_rise(cx, block, w[2]), burn_power(block, float(w[4]), float(w[3])),
            flame_warmth(float(w[1])),
        ])
    };

    burn_cell in "leaf/burn" (PLACE, Input::Float(0.0, 9000.0), Input::Below(3)) tolerance None;
    wgsl "let cell = burn_cell(in_vec3(0u));
        let one = burn_sums(cell, bitcast<f32>(a.w));
        let sums = BurnSums(one.count + b.x, one.key + cell.key * b.x, one.power, 0u);
        r = vec4<u32>(cell.index, cell.key, one.count, one.power);
        s = vec4<u32>(
            bitcast<u32>(cell_power(cell, sums)),
            bitcast<u32>(cell_power(BurnCell(cell.index, cell.key + b.x), one)), one.key, u32(feeds_plume(0u, in_vec3(0u))),
        );";
    rust |cx, w| {
        let cell = burn_cell(cx, vector(w, 0));
        let one = burn_sums(&cell, float(w[3]));
        let sums = BurnSums {
            count: one.count + w[4],
            key: one.key.wrapping_add(cell.key.wrapping_mul(w[4])),
            ..one
        };
        let other = BurnCell { key: cell.key.wrapping_add(w[4]), ..cell };
        let feeds = feeds_plume(&cx.step.moments[0].plumes[0], vector(w, 0));
        integers([
            cell.index, cell.key, one.count, one.power, cell_power(&cell, &sums).to_bits(),
            cell_power(&other, &one).to_bits(), one.key, u32::from(feeds),
        ])
    };

    leaf_heat_release in "leaf/burn" (Input::Below(8), Input::Below(90), PLACE) tolerance None;
    wgsl "let burn = Burn(0.0, 0.0, a.y, 500.0);
        let bits = STATE_FALLING | (a.x << SPECIES_SHIFT);
        let heat = leaf_heat_release(in_vec3(2u), bits, SIZE_ONE, burn);
        let cell = heated_cell(in_vec3(2u));
        r = vec4<u32>(heat.index, heat.sums.count, heat.sums.key, heat.sums.power);
        s = vec4<u32>(cell.index, scene_species(bits), with_species(bits, a.y & 7u), 0u);";
    rust |cx, w| {
        let burn = Burn { heat: 0.0, out_way: 0.0, lit: w[1], steps: 500.0 };
        let bits = STATE_FALLING | (w[0] << SPECIES_SHIFT);
        let heat = leaf_heat_release(cx, vector(w, 2), bits, SIZE_ONE, &burn);
        let cell = heated_cell(cx, vector(w, 2));
        assert!(w[1] != UNLIT || heat.sums.count == 0, "what has not caught releases no heat");
        integers([
            heat.index, heat.sums.count, heat.sums.key, heat.sums.power, cell.index, scene_species(cx, bits),
            with_species(bits, w[1] & 7),
        ])
    };

    fire_words in "leaf/burn" (Input::Below(9_000_000), Input::Below(9_000_000)) tolerance Some(1e-6);
    wgsl "r = fire_words(a.x, a.y);";
    rust |_cx, w| integers(fire_words(w[0], w[1]));
}
