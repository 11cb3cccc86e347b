// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Cells of snow as they are drawn: on the ground, on water, or on a thing, which bears a cap.

use glam::DVec2;
use windfall_core::device::terrain::snow::{FLOOR_ON_WATER, SNOW_CELLS_PER_M};
use windfall_core::solid::{Footprint, Solid};
use windfall_core::{CompiledScene, shared_struct};

/// Height in metres within which a cell's floor is that of a thing.
const SAME_M: f64 = 0.002;

shared_struct! {
    /// A cell of snow as it is drawn.
    pub(crate) struct DrawnCell {
        /// Height in metres of what snow lies on.
        floor_m: f32,
        /// Height of the ground.
        ground_m: f32,
        /// 1 on water, where none lies.
        is_water: u32,
        /// 1 on a thing, whose cap it is part of.
        has_cap: u32,
    }
}

/// Things on which snow lies: those that stand still, have an end, and let none through.
pub(super) fn bearers(compiled: &CompiledScene) -> impl Iterator<Item = (&Solid, Footprint)> {
    let still = compiled.solids().iter().filter(|solid| solid.open == 0.0);
    still.filter_map(|solid| Some((solid, solid.footprint()?)))
}

/// The cells of snow of a scene as they are drawn.
pub(super) fn drawn_cells(compiled: &CompiledScene) -> Vec<DrawnCell> {
    let snow = &compiled.block().snow;
    let cells = (snow.columns * snow.lines) as usize;
    let rows = &compiled.tables()[snow.first_row as usize..][..cells.div_ceil(2)];
    let floors: &[[u32; 2]] = bytemuck::cast_slice(rows);
    let middles = (0..cells).map(|number| middle_m(compiled, number));
    let drawn = floors.iter().zip(middles).map(|([height, packed], at)| {
        let at = at.as_vec2();
        DrawnCell {
            floor_m: f32::from_bits(*height),
            ground_m: compiled.ground_height(at.x, at.y),
            is_water: u32::from(packed & 0xffff == FLOOR_ON_WATER),
            has_cap: 0,
        }
    });
    let mut drawn: Vec<_> = drawn.collect();
    mark_things(compiled, &mut drawn);
    drawn
}

/// Middle of a cell, x and z.
fn middle_m(compiled: &CompiledScene, cell: usize) -> DVec2 {
    let snow = &compiled.block().snow;
    let width = snow.columns as usize;
    let first = [snow.first_column, snow.first_line].map(|first| f64::from(first.cast_signed()));
    let number = DVec2::new((cell % width) as f64, (cell / width) as f64);
    (DVec2::from(first) + number + 0.5) / f64::from(SNOW_CELLS_PER_M)
}

/// Marks the cells whose floor is that of a thing with a cap.
fn mark_things(compiled: &CompiledScene, cells: &mut [DrawnCell]) {
    for (solid, footprint) in bearers(compiled) {
        for number in cells_about(compiled, footprint.center_m, footprint.half_m.length()) {
            let at = middle_m(compiled, number);
            let cell = &mut cells[number];
            let is_floor = |top_m: f64| (top_m - f64::from(cell.floor_m)).abs() < SAME_M;
            let is_dry = cell.is_water == 0 && cell.ground_m < cell.floor_m;
            if is_dry && solid.top_m(at.x, at.y).is_some_and(is_floor) {
                cell.has_cap = 1;
            }
        }
    }
}

/// Cells whose middles lie in a square about a place.
fn cells_about(compiled: &CompiledScene, about_m: DVec2, reach_m: f64) -> impl Iterator<Item = usize> {
    let snow = &compiled.block().snow;
    let span = |about_m: f64, first: u32, count: u32| {
        let number = |at_m: f64| at_m * f64::from(SNOW_CELLS_PER_M) - f64::from(first.cast_signed()) - 0.5;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within the grid")]
        let limit = |number: f64| number.ceil().clamp(0.0, f64::from(count)) as usize;
        limit(number(about_m - reach_m))..limit(number(about_m + reach_m))
    };
    let columns = span(about_m.x, snow.first_column, snow.columns);
    let width = snow.columns as usize;
    span(about_m.y, snow.first_line, snow.lines)
        .flat_map(move |line| columns.clone().map(move |column| line * width + column))
}
