// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The functions of snow on branches.

use windfall_core::device::tree::branch_fall::{fall_row, fall_start, fall_word, falls_as_particle};
use windfall_core::device::tree::branch_snow::{
    BranchCatch, branch_catch, branch_offer, branch_room, branch_round, branch_snow_kg, branch_word,
    crown_cell, crown_columns, crown_part, crown_pool, crown_round, crown_square, crown_squares, crown_width,
    crown_word, flake_is_caught,
};

use super::{Function, Input, float, floats, functions, integers};

const METRES: Input = Input::Float(-9.0, 9.0);
const CELL: Input = Input::Below(2500);

/// Units of water over the most that cases have: one unit more or less is rounding.
#[expect(clippy::cast_precision_loss, reason = "as in WGSL")]
fn of_most(units: u32) -> f32 {
    units as f32 * 2.5e-6
}

/// Areas with which a segment catches snow, by the words from one on.
fn catch(w: &[u32], at: usize) -> BranchCatch {
    BranchCatch { cell: 0, area: w[at], wood_m2: float(w[at + 1]), leaf_m2: float(w[at + 2]) }
}

functions! {
    BRANCH_SNOW_FUNCTIONS;

    crown_part in "tree/branch_snow" (CELL, Input::Below(9000), Input::Below(4), METRES, METRES, Input::Float(-0.2, 1.2)) tolerance None;
    wgsl "let square = crown_square(crown_cell(a.x));
        r = vec4<u32>(crown_columns() + branch_word(a.y) + 64u * crown_round(a.y), crown_squares(), square, crown_width(a.x));
        s = vec4<u32>(crown_part(a.x, a.y), crown_pool(a.y), crown_word(square, a.z),
            u32(flake_is_caught(bitcast<f32>(a.w), bitcast<f32>(in_word(4u)), bitcast<f32>(in_word(5u)))));";
    rust |cx, w| {
        let snow = &cx.scene.snow;
        let square = crown_square(snow, crown_cell(cx, w[0]));
        let is_caught = flake_is_caught(cx, float(w[3]), float(w[4]), float(w[5]));
        integers([
            crown_columns(snow) + branch_word(snow, w[1]) + 64 * crown_round(w[1]), crown_squares(snow), square, crown_width(snow, w[0]), crown_part(snow, w[0], w[1]),
            crown_pool(w[1]), crown_word(snow, square, w[2]), u32::from(is_caught),
        ])
    };

    branch_round in "tree/branch_snow" (
        CELL, Input::Below(400_000), Input::Below(9000), Input::Below(70_000), Input::Float(0.0, 0.05), Input::Float(0.0, 0.01),
        Input::Below(60), Input::Float(-1.0, 1.0), Input::Float(0.0, 2.0), Input::Below(90_000)
    ) tolerance Some(1e-5);
    wgsl "let catch_by = BranchCatch(0u, in_word(3u), in_float(4u), in_float(5u));
        let room = branch_room(catch_by, f32(in_word(6u)), in_float(7u));
        let after = branch_round(a.x, room, a.y, branch_offer(catch_by, a.z, in_word(3u) + in_word(9u)), in_float(8u));
        out_float(0u, room * 2.5e-6); out_float(1u, f32(after.held) * 2.5e-6);
        out_float(2u, f32(after.caught) * 2.5e-6);
        out_float(3u, f32(after.lost) * 2.5e-6);";
    rust |cx, w| {
        let catch = catch(w, 3);
        #[expect(clippy::cast_precision_loss, reason = "as in WGSL")]
        let room = branch_room(cx, catch, w[6] as f32, float(w[7]));
        let after = branch_round(cx, w[0], room, w[1], branch_offer(catch, w[2], w[3] + w[9]), float(w[8]));
        floats([room * 2.5e-6, of_most(after.held), of_most(after.caught), of_most(after.lost)])
    };

    fall_row in "tree/branch_fall" (Input::Below(90), Input::Below(40), Input::Below(600), Input::Below(2)) tolerance None;
    wgsl "r = vec4<u32>(fall_row(a.x), fall_word(a.y), u32(falls_as_particle(a.z, a.w)), 0u);";
    rust |cx, w| {
        let snow = &cx.scene.snow;
        let falls = u32::from(falls_as_particle(snow, w[2], w[3]));
        integers([fall_row(cx, w[0]), fall_word(snow, w[1]), falls])
    };

    fall_start in "tree/branch_fall" (Input::Below(40)) tolerance None;
    wgsl "let start = fall_start(a.x); out_float(0u, start.x); out_float(1u, start.y); out_float(2u, start.z);";
    rust |cx, w| {
        let start = fall_start(cx, w[0]);
        floats([start.x, start.y, start.z])
    };

    branch_catch in "tree/branch_snow" (Input::Below(40)) tolerance Some(1e-5);
    wgsl "let catch_by = branch_catch(a.x);
        out_float(0u, f32(catch_by.area) * 1e-6); out_float(1u, catch_by.wood_m2); out_float(2u, catch_by.leaf_m2);
        out_float(3u, branch_snow_kg(a.x)); out_float(4u, f32(catch_by.cell % 1024u));";
    rust |cx, w| {
        let catch = branch_catch(cx, w[0]);
        #[expect(clippy::cast_precision_loss, reason = "as in WGSL")]
        let [cell, area] = [(catch.cell % 1024) as f32, catch.area as f32 * 1e-6];
        floats([area, catch.wood_m2, catch.leaf_m2, branch_snow_kg(cx, w[0]), cell])
    };
}
