// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Snow of a world: its cells, landings of flakes, exchanges between cells, and prints in it.

use std::ops::Range;

use crate::arith::lane::Word;
use crate::blocks::{NEVER, SceneBlock, SnowBlock};
use crate::context::Context;
use crate::convert::{len32, word};
use crate::device::particle::record::{PARTICLE_DIED, PARTICLE_HIT, POPULATION_BRANCH_SNOW, POPULATION_SNOW};
use crate::device::solid::shape::solid_at;
use crate::device::terrain::snow::{
    AROUND_TURN, FLAKE_CELLS, ROOT_TWO, SNOW_AGES, SNOW_CELLS_PER_M, SNOW_DEPTH_M, SNOW_WATER_MM, SNOW_WORDS,
    SnowCell, SnowFloor, drifted_depth, flake_cell, flake_share, fresh_depth, left_over_snow, snow_age,
    snow_cell, snow_center, snow_drift, snow_drifts, snow_floor, snow_pair, snow_slide, snow_turn,
};
use crate::device::terrain::snow_print::{may_press, snow_is_pressed, snow_pressed};
use crate::device::tree::branch_snow::CROWN_TURN;
use crate::device::wind::shelter::wind_shelter;
use crate::layout::Uint4;
use crate::particle::{ParticlePlace, ParticleStore};
use crate::tree::Branches;

use super::Bed;

/// The four planes of the snow of a world, each cell's word in the place of its number; empty without snow.
#[derive(Clone, Copy, Debug)]
pub struct Snow<'a> {
    /// Units of water ([`SNOW_WATER_MM`]).
    pub water: &'a [u32],
    /// Units of depth ([`SNOW_DEPTH_M`]).
    pub depth: &'a [u32],
    /// Units of water that have melted there.
    pub melted: &'a [u32],
    /// Units of water that have landed there.
    pub landed: &'a [u32],
}

/// The same of cells from one on, to be changed.
#[derive(Debug)]
pub struct SnowMut<'a> {
    /// Number of the first cell.
    pub first: u32,
    /// Units of water.
    pub water: &'a mut [u32],
    /// Units of depth.
    pub depth: &'a mut [u32],
    /// Units of water that have melted there.
    pub melted: &'a mut [u32],
    /// Units of water that have landed there.
    pub landed: &'a mut [u32],
}

/// Number of cells of the snow of a scene.
fn cell_count(snow: &SnowBlock) -> usize {
    snow.columns as usize * snow.lines as usize
}

impl Bed {
    /// Number of words of the snow of a scene.
    pub(super) fn snow_words(snow: &SnowBlock) -> usize {
        SNOW_WORDS as usize * cell_count(snow)
    }

    /// The snow.
    pub fn snow(&self, scene: &SceneBlock) -> Snow<'_> {
        let cells = cell_count(&scene.snow);
        let words = if cells == 0 { &[][..] } else { &self.words[scene.snow.first_word as usize..] };
        let (water, words) = words.split_at(cells);
        let (depth, words) = words.split_at(cells);
        let (melted, landed) = words.split_at(cells);
        Snow { water, depth, melted, landed: &landed[..cells] }
    }

    /// The snow, to be changed.
    pub fn snow_mut(&mut self, scene: &SceneBlock) -> SnowMut<'_> {
        self.all_snow_mut(scene).0
    }

    /// The snow, and the words behind it, to be changed.
    pub(super) fn all_snow_mut(&mut self, scene: &SceneBlock) -> (SnowMut<'_>, &mut [u32]) {
        let cells = cell_count(&scene.snow);
        let words = if cells == 0 { &mut [][..] } else { &mut self.words[scene.snow.first_word as usize..] };
        let (water, words) = words.split_at_mut(cells);
        let (depth, words) = words.split_at_mut(cells);
        let (melted, words) = words.split_at_mut(cells);
        let (landed, words) = words.split_at_mut(cells);
        (SnowMut { first: 0, water, depth, melted, landed }, words)
    }
}

impl SnowMut<'_> {
    /// The first so many cells, and the others.
    pub fn split_at(self, cells: usize) -> (Self, Self) {
        let (water, waters) = self.water.split_at_mut(cells);
        let (depth, depths) = self.depth.split_at_mut(cells);
        let (melted, melts) = self.melted.split_at_mut(cells);
        let (landed, lands) = self.landed.split_at_mut(cells);
        #[expect(clippy::cast_possible_truncation, reason = "far fewer than 2^32 cells")]
        let next = self.first + cells as u32;
        let front = SnowMut { first: self.first, water, depth, melted, landed };
        (front, SnowMut { first: next, water: waters, depth: depths, melted: melts, landed: lands })
    }

    /// The cells from one on.
    pub fn rest(&mut self, from: usize) -> SnowMut<'_> {
        let Self { first, water, depth, melted, landed } = self;
        SnowMut { first: *first, water, depth, melted, landed }.split_at(from).1
    }

    fn cell(&self, at: usize) -> SnowCell {
        SnowCell { water: self.water[at], depth: self.depth[at] }
    }

    /// Adds to these cells the water of what lands at a place; on water it melts at once.
    pub fn land(&mut self, cx: &Context<'_>, x_m: f32, z_m: f32, water: u32) {
        let snow = &cx.scene.snow;
        let middle = snow_cell(snow, x_m, z_m);
        let reach = (FLAKE_CELLS / 2) * (snow.columns + 1);
        if middle == NEVER
            || middle + reach < self.first
            || middle >= self.first + reach + len32(self.water.len())
        {
            return;
        }
        let mut left = water;
        for part in 0..FLAKE_CELLS * FLAKE_CELLS {
            let cell = flake_cell(snow, middle, part);
            if cell != NEVER && cell != middle {
                let share = flake_share(water, part);
                self.fall(cx, cell, share);
                left -= share;
            }
        }
        self.fall(cx, middle, left);
    }

    /// Adds water that comes down to a cell of this number, if it is one of these; on water it melts at once.
    pub(super) fn fall(&mut self, cx: &Context<'_>, cell: u32, water: u32) {
        let Some(at) = cell.checked_sub(self.first).map(|at| at as usize) else { return };
        if at >= self.water.len() {
            return;
        }
        if lies_on(cx, cell).open >= 0.0 {
            self.add(cx, at, water);
        } else {
            self.melted[at] = self.melted[at].wrapping_add(water);
            self.landed[at] = self.landed[at].wrapping_add(water);
        }
    }

    /// Takes snow back from a cell of this number, on which it has never been.
    pub(super) fn take(&mut self, cell: u32, water: u32, depth: u32) {
        let at = (cell - self.first) as usize;
        self.water[at] -= water;
        self.depth[at] = self.depth[at].saturating_sub(depth);
        self.landed[at] -= water;
    }

    /// Adds fresh snow to a cell.
    fn add(&mut self, cx: &Context<'_>, cell: usize, water: u32) {
        self.water[cell] = self.water[cell].wrapping_add(water);
        self.depth[cell] = self.depth[cell].wrapping_add(fresh_depth(cx, water));
        self.landed[cell] = self.landed[cell].wrapping_add(water);
    }

    /// Lets the cells exchange snow with each other, as the first and the second of pairs.
    pub fn exchange(&mut self, cx: &Context<'_>, turn: u32) {
        let all = 0..self.water.len();
        self.exchange_from(cx, turn, all);
    }

    /// Lets the last line exchange snow with the first in the turn in which they meet. Only on all cells.
    pub fn exchange_around(&mut self, cx: &Context<'_>, turn: u32) {
        let (all, line) = (self.water.len(), cx.scene.snow.columns as usize);
        if turn == AROUND_TURN {
            self.exchange_from(cx, turn, all - line..all);
        }
    }

    /// The same of pairs whose first cells are among some, and both among these.
    pub fn exchange_from(&mut self, cx: &Context<'_>, turn: u32, cells: Range<usize>) {
        let drifts = snow_drifts(cx);
        for at in cells {
            #[expect(clippy::cast_possible_truncation, reason = "far fewer than 2^32 cells")]
            let cell = self.first + at as u32;
            let pair = snow_pair(&cx.scene.snow, cell, turn);
            let Some(other) = pair.other.checked_sub(self.first).map(|other| other as usize) else {
                continue;
            };
            if pair.other == NEVER || other >= self.water.len() || (pair.is_around && !drifts) {
                continue;
            }
            let [one, two] = [self.cell(at), self.cell(other)];
            if one.depth == 0 && two.depth == 0 {
                continue;
            }
            let [on, other_on] = [lies_on(cx, cell), lies_on(cx, pair.other)];
            // Water has no snow to lie on.
            if on.open < 0.0 || other_on.open < 0.0 {
                continue;
            }
            let way_m = (if pair.is_diagonal { ROOT_TWO } else { 1.0 }) * (1.0 / SNOW_CELLS_PER_M);
            let (mut to, mut fro) = (SnowCell::default(), SnowCell::default());
            if !pair.is_around {
                to = snow_slide(one, two, on.height_m - other_on.height_m, way_m);
                fro = snow_slide(two, one, other_on.height_m - on.height_m, way_m);
            }
            let mut here = moved(one, to, fro);
            let mut there = moved(two, fro, to);
            if drifts && !pair.is_diagonal {
                let rise_m = (other_on.height_m + there.depth.to_real() * SNOW_DEPTH_M)
                    - (on.height_m + here.depth.to_real() * SNOW_DEPTH_M);
                let wind = &cx.scene.wind;
                let toward = if (turn & 3) == 0 { wind.direction_x } else { wind.direction_z };
                let to = snow_drift(cx, here, rise_m, wind_left(cx, cell, here, on.lee_m), toward);
                let fro =
                    snow_drift(cx, there, -rise_m, wind_left(cx, pair.other, there, other_on.lee_m), -toward);
                here = moved(here, to, SnowCell { water: fro.water, depth: drifted_depth(fro) });
                there = moved(there, fro, SnowCell { water: to.water, depth: drifted_depth(to) });
            }
            (self.water[at], self.depth[at]) = (here.water, here.depth);
            (self.water[other], self.depth[other]) = (there.water, there.depth);
        }
    }

    /// Lets the snow settle and melt.
    pub fn age(&mut self, cx: &Context<'_>) {
        for at in 0..self.water.len() {
            let before = self.cell(at);
            if before.water == 0 {
                continue;
            }
            #[expect(clippy::cast_possible_truncation, reason = "far fewer than 2^32 cells")]
            let cell = self.first + at as u32;
            let [water, depth] = snow_age(cx, cell, before.water, before.depth, lies_on(cx, cell).open);
            (self.water[at], self.depth[at]) = (water, depth);
            self.melted[at] = self.melted[at].wrapping_add(before.water - water);
        }
    }

    /// Lets things that move press the snow beneath them. Only on all cells.
    pub fn press(&mut self, cx: &Context<'_>) {
        let snow = &cx.scene.snow;
        let near = |at_m: f32, reach_m: f32, first: u32, count: u32| {
            let number = |at_m: f32| {
                let column = (at_m * SNOW_CELLS_PER_M).floor() - first.cast_signed() as f32;
                word(f64::from(column.clamp(0.0, count as f32)))
            };
            number(at_m - reach_m)..(number(at_m + reach_m) + 1).min(count)
        };
        for number in 0..cx.scene.solids.mover_count {
            let mover = &cx.step.movers[number as usize];
            let ([x_m, _, z_m], reach_m) = (mover.center_m, mover.bound_m);
            let solid = solid_at(cx, number, 0.0);
            for line in near(z_m, reach_m, snow.first_line, snow.lines) {
                for column in near(x_m, reach_m, snow.first_column, snow.columns) {
                    let cell = line * snow.columns + column;
                    let before = self.cell(cell as usize);
                    let [x, z] = snow_center(snow, cell);
                    if before.depth != 0 && may_press(mover, x, z) {
                        let floor_m = lies_on(cx, cell).height_m;
                        self.depth[cell as usize] = snow_pressed(&solid, x, z, floor_m, before).depth;
                    }
                }
            }
        }
    }

    /// Covers the cells with fresh snow of so much water in mm, as before the first step.
    pub(crate) fn cover(&mut self, cx: &Context<'_>, mm: f32) {
        let water = word(f64::from(mm) / f64::from(SNOW_WATER_MM));
        for at in 0..self.water.len() {
            #[expect(clippy::cast_possible_truncation, reason = "far fewer than 2^32 cells")]
            if lies_on(cx, self.first + at as u32).open >= 0.0 {
                self.add(cx, at, water);
            }
        }
    }
}

/// Snow of a cell that gives some away and gets some.
fn moved(cell: SnowCell, gives: SnowCell, gets: SnowCell) -> SnowCell {
    SnowCell { water: cell.water - gives.water + gets.water, depth: cell.depth - gives.depth + gets.depth }
}

/// Share of the wind that shelter leaves over the snow of a cell in a lee so deep.
fn wind_left(cx: &Context<'_>, cell: u32, snow: SnowCell, lee_m: f32) -> f32 {
    if !cx.scene.has_shelter() {
        return 1.0;
    }
    let [x, z] = snow_center(&cx.scene.snow, cell);
    let depth_m = snow.depth.to_real() * SNOW_DEPTH_M;
    left_over_snow(wind_shelter(cx, x, depth_m, z), depth_m, lee_m)
}

/// Floor that a cell lies on.
pub fn lies_on(cx: &Context<'_>, cell: u32) -> SnowFloor {
    let Uint4(row) = cx.tables[(cx.scene.snow.first_row + (cell >> 1)) as usize];
    let first = 2 * (cell as usize & 1);
    snow_floor(row[first], row[first + 1])
}

/// Returns true for flakes that landed in the step before.
pub fn has_landed(place: &ParticlePlace) -> bool {
    (place.bits & (PARTICLE_DIED | PARTICLE_HIT)) == (PARTICLE_DIED | PARTICLE_HIT)
}

/// Places of the flakes of a world; none without snowfall.
pub fn flakes_of<'a>(scene: &SceneBlock, particles: &'a ParticleStore) -> &'a [ParticlePlace] {
    let flakes = scene.populations.iter().find(|population| (population.flags & POPULATION_SNOW) != 0);
    flakes.map_or(&[], |flakes| &particles.place[flakes.first_slot as usize..][..flakes.count as usize])
}

/// Segments of which snow has come down in the step before, and where.
pub fn fallen_snow<'a>(
    scene: &SceneBlock,
    particles: &'a ParticleStore,
) -> impl Iterator<Item = (u32, [f32; 3])> + use<'a> {
    let falls = scene.populations.iter().find(|one| (one.flags & POPULATION_BRANCH_SNOW) != 0);
    let slots =
        falls.map_or(0..0, |falls| falls.first_slot as usize..(falls.first_slot + falls.count) as usize);
    let rows = particles.place[slots.clone()].iter().zip(&particles.traits[slots]);
    rows.filter(|(place, _)| (place.bits & PARTICLE_DIED) != 0)
        .map(|(place, traits)| (traits.id, place.position))
}

/// Takes the snow of a world through a step in which some of these particles may have landed.
pub(crate) fn step_snow(cx: &Context<'_>, bed: &mut Bed, branches: &Branches, particles: &ParticleStore) {
    for place in flakes_of(cx.scene, particles).iter().filter(|place| has_landed(place)) {
        let [x_m, _, z_m] = place.position;
        bed.land_flake(cx, x_m, z_m);
    }
    for (row, [x_m, _, z_m]) in fallen_snow(cx.scene, particles) {
        bed.land_fall(cx, row, x_m, z_m);
    }
    let turn = snow_turn(cx.step.index);
    if turn == 0 {
        bed.clear_crowns(cx);
    }
    if turn == CROWN_TURN {
        bed.add_branches(cx);
    }
    if turn == SNOW_AGES {
        bed.step_branch_snow(cx, branches);
        bed.fall_through_crowns(cx);
    }
    let mut snow = bed.snow_mut(cx.scene);
    match turn {
        NEVER => {}
        SNOW_AGES => snow.age(cx),
        turn => snow.exchange(cx, turn),
    }
    if cx.scene.has_movers() && snow_is_pressed(cx.step.index) {
        snow.press(cx);
    }
}
