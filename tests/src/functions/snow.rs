// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The functions of snow that lies.

use windfall_core::device::solid::shape::solid_at;
use windfall_core::device::terrain::snow::{
    SnowCell, drifted_depth, flake_cell, flake_share, flake_weight, fresh_depth, left_over_snow,
    round_at_random, snow_age, snow_cell, snow_center, snow_drift, snow_drifts, snow_floor, snow_freshness,
    snow_height, snow_inside, snow_pair, snow_part, snow_repose, snow_slide, snow_taken, snow_turn,
};
use windfall_core::device::terrain::snow_print::{may_press, snow_is_pressed, snow_pressed, underside};

use super::{Function, Input, float, floats, functions, integers};

const METRES: Input = Input::Float(-9.0, 9.0);
const WATER: Input = Input::Below(400_000);
const DEPTH: Input = Input::Below(300_000);
const CELL: Input = Input::Below(2500);
const SHARE: Input = Input::Float(0.0, 1.0);

/// Units of water or depth over the most that cases have: one unit more or less is rounding.
#[expect(clippy::cast_precision_loss, reason = "as in WGSL")]
fn of_most(units: u32) -> f32 {
    units as f32 * 2.5e-6
}

fn cell(w: &[u32], at: usize) -> SnowCell {
    SnowCell { water: w[at], depth: w[at + 1] }
}

functions! {
    SNOW_FUNCTIONS;

    snow_cell in "terrain/snow" (METRES, METRES, CELL, Input::Below(25), Input::Below(9000)) tolerance None;
    wgsl "let water = in_word(4u);
        r = vec4<u32>(snow_cell(bitcast<f32>(a.x), bitcast<f32>(a.y)), flake_cell(a.z, a.w), flake_share(water, a.w), fresh_depth(water));
        s = vec4<u32>(flake_weight(a.w % 5u), snow_turn(water), u32(snow_drifts()), 0u);";
    rust |cx, w| {
        let snow = &cx.scene.snow;
        integers([
            snow_cell(snow, float(w[0]), float(w[1])), flake_cell(snow, w[2], w[3]), flake_share(w[4], w[3]),
            fresh_depth(cx, w[4]), flake_weight(w[3] % 5), snow_turn(w[4]), u32::from(snow_drifts(cx)),
        ])
    };

    snow_pair in "terrain/snow" (CELL, Input::Below(8)) tolerance None;
    wgsl "let pair = snow_pair(a.x, a.y);
        r = vec4<u32>(pair.other, u32(pair.is_diagonal), u32(pair.is_around), 0u);";
    rust |cx, w| {
        let pair = snow_pair(&cx.scene.snow, w[0], w[1]);
        integers([pair.other, u32::from(pair.is_diagonal), u32::from(pair.is_around)])
    };

    snow_height in "terrain/snow" (METRES, METRES, CELL) tolerance Some(1e-5);
    wgsl "out_float(0u, snow_height(bitcast<f32>(a.x), bitcast<f32>(a.y)));
        let center = snow_center(a.z); out_float(1u, center.x); out_float(2u, center.y);";
    rust |cx, w| {
        let [x, z] = snow_center(&cx.scene.snow, w[2]);
        floats([snow_height(cx, float(w[0]), float(w[1])), x, z])
    };

    snow_floor in "terrain/snow" (Input::Word, Input::Word, METRES, METRES) tolerance None;
    wgsl "let on = snow_floor(a.x, a.y); let inside = snow_inside(bitcast<f32>(a.z), bitcast<f32>(a.w));
        r = vec4<u32>(bitcast<u32>(on.height_m), bitcast<u32>(on.open), bitcast<u32>(on.lee_m), 0u);
        s = vec4<u32>(bitcast<u32>(inside.x), bitcast<u32>(inside.y), 0u, 0u);";
    rust |cx, w| {
        let on = snow_floor(w[0], w[1]);
        let [x, z] = snow_inside(&cx.scene.snow, float(w[2]), float(w[3]));
        integers([on.height_m.to_bits(), on.open.to_bits(), on.lee_m.to_bits(), 0, x.to_bits(), z.to_bits()])
    };

    left_over_snow in "terrain/snow" (Input::Float(-1.0, 1.0), Input::Float(0.0, 2.0), Input::Float(-0.2, 2.0)) tolerance Some(1e-5);
    wgsl "out_float(0u, left_over_snow(bitcast<f32>(a.x), bitcast<f32>(a.y), bitcast<f32>(a.z)));
        out_float(1u, f32(u32(scene.snow.columns != 0u)));";
    rust |cx, w| floats([left_over_snow(float(w[0]), float(w[1]), float(w[2])), f32::from(u8::from(cx.has_snow()))]);

    snow_pressed in "terrain/snow_print" (
        Input::Word, Input::Float(-0.4, 0.4), Input::Float(-0.4, 0.4), Input::Float(-0.6, 0.2), WATER, DEPTH, Input::Below(40)
    ) tolerance Some(1e-3);
    wgsl "if (scene.solids.count != 0u) {
        let solid = solid_at(a.x % scene.solids.count, 0.0);
        let x = solid.center.x + bitcast<f32>(a.y);
        let z = solid.center.z + bitcast<f32>(a.z);
        let low = solid.center.y + bitcast<f32>(a.w);
        let after = snow_pressed(solid, x, z, low, SnowCell(in_word(4u), in_word(5u)));
        out_float(0u, f32(after.depth) * 2.5e-6); out_float(1u, f32(after.water) * 2.5e-6);
        out_float(2u, underside(solid, x, z, low, low + 0.5));
        out_float(3u, f32(u32(snow_is_pressed(in_word(6u)))));
        let mover = a.x % max(scene.solids.mover_count, 1u);
        out_float(4u, f32(u32(may_press(step_block.movers[mover], x, z)))); }";
    rust |cx, w| {
        if !cx.scene.has_solids() {
            return floats([0.0; 5]);
        }
        let solid = solid_at(cx, w[0] % cx.scene.solids.count, 0.0);
        let (x, z) = (solid.center.x + float(w[1]), solid.center.z + float(w[2]));
        let low = solid.center.y + float(w[3]);
        let after = snow_pressed(&solid, x, z, low, cell(w, 4));
        let is = |is: bool| if is { 1.0 } else { 0.0 };
        let mover = &cx.step.movers[(w[0] % cx.scene.solids.mover_count.max(1)) as usize];
        floats([
            of_most(after.depth), of_most(after.water), underside(&solid, x, z, low, low + 0.5),
            is(snow_is_pressed(w[6])), is(may_press(mover, x, z)),
        ])
    };

    snow_drift in "terrain/snow" (WATER, DEPTH, Input::Float(-0.3, 0.3), Input::Float(-6.0, 6.0), Input::Float(-1.0, 1.0)) tolerance Some(1e-5);
    wgsl "let taken = snow_drift(SnowCell(a.x, a.y), bitcast<f32>(a.z), bitcast<f32>(a.w), bitcast<f32>(in_word(4u)));
        out_float(0u, f32(taken.water) * 2.5e-6); out_float(1u, f32(taken.depth) * 2.5e-6);
        out_float(2u, f32(drifted_depth(taken)) * 2.5e-6); out_float(3u, snow_freshness(SnowCell(a.x, a.y)));
        out_float(4u, f32(snow_taken(SnowCell(a.x, a.y), a.x / 3u).depth) * 2.5e-6);";
    rust |cx, w| {
        let from = cell(w, 0);
        let taken = snow_drift(cx, from, float(w[2]), float(w[3]), float(w[4]));
        let part = snow_taken(from, w[0] / 3);
        let [water, depth, drifted, part] =
            [taken.water, taken.depth, drifted_depth(taken), part.depth].map(of_most);
        floats([water, depth, drifted, snow_freshness(from), part])
    };

    snow_slide in "terrain/snow" (WATER, DEPTH, WATER, DEPTH, Input::Float(-0.4, 0.4), SHARE) tolerance Some(1e-5);
    wgsl "let from_cell = SnowCell(a.x, a.y);
        let moved = snow_slide(from_cell, SnowCell(a.z, a.w), bitcast<f32>(in_word(4u)), 0.125);
        let part = snow_part(from_cell, a.w);
        r = vec4<u32>(bitcast<u32>(f32(moved.water) * 2.5e-6), bitcast<u32>(f32(moved.depth) * 2.5e-6),
            bitcast<u32>(f32(part.water) * 2.5e-6), bitcast<u32>(f32(part.depth) * 2.5e-6));
        s = vec4<u32>(
            bitcast<u32>(snow_repose(from_cell)), bitcast<u32>(f32(round_at_random(bitcast<f32>(in_word(5u)) * 40.0, a.x * 77u)) * 2.5e-6), 0u, 0u,
        );";
    rust |_cx, w| {
        let from = cell(w, 0);
        let moved = snow_slide(from, cell(w, 2), float(w[4]), 0.125);
        let part = snow_part(from, w[3]);
        let [a, b, c, d] = [moved.water, moved.depth, part.water, part.depth].map(of_most);
        let rounded = of_most(round_at_random(float(w[5]) * 40.0, w[0].wrapping_mul(77)));
        floats([a, b, c, d, snow_repose(from), rounded])
    };

    snow_age in "terrain/snow" (CELL, WATER, DEPTH, SHARE) tolerance Some(1e-5);
    wgsl "let after = snow_age(a.x, SnowCell(a.y, a.z), bitcast<f32>(a.w));
        r = vec4<u32>(bitcast<u32>(f32(after.water) * 2.5e-6), bitcast<u32>(f32(after.depth) * 2.5e-6), 0u, 0u);";
    rust |cx, w| {
        floats(snow_age(cx, w[0], w[1], w[2], float(w[3])).map(of_most))
    };
}
