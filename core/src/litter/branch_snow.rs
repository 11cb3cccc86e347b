// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Snow on the branches of a world, and what has come down over its crowns and waits to be caught.

use crate::arith::Vec3;
use crate::arith::quaternion::quat_axis_y;
use crate::arith::vector::vec3_dot;
use crate::blocks::{NEVER, SceneBlock, SnowBlock};
use crate::context::Context;
use crate::convert::word;
use crate::device::terrain::snow::{SNOW_WATER_MM, fresh_depth, snow_cell, snow_inside};
use crate::device::tree::branch_fall::{fall_word, falls_as_particle};
use crate::device::tree::branch_snow::{
    CROWN_CELLS, CROWN_POOL, CROWN_WORDS, branch_catch, branch_offer, branch_room, branch_round, branch_word,
    crown_cell, crown_columns, crown_part, crown_pool, crown_square, crown_squares, flake_is_caught,
};
use crate::tree::Branches;
use crate::tree::forest::first_three;

use super::Bed;
use super::snow::lies_on;

/// Cells over which what hangs at time zero fades out towards squares over which nothing hangs.
const RIM_CELLS: u32 = 4;

/// Snow on branches, and over the squares of the crowns; empty where no tree stands around the snow.
#[derive(Debug)]
pub struct BranchSnowMut<'a> {
    /// Units of water on each segment.
    pub held: &'a mut [u32],
    /// The words of the squares, one after another for all of them.
    pub crowns: &'a mut [u32],
    /// Units of water that fall from each segment as particles; empty where snow comes down at once.
    pub falls: &'a mut [u32],
}

impl Bed {
    /// Number of words of the snow on branches.
    pub(super) fn branch_snow_words(snow: &SnowBlock) -> usize {
        if snow.branches == 0 {
            return 0;
        }
        let falls = if snow.fall_slots == 0 { 0 } else { snow.branches };
        (snow.branches + CROWN_WORDS * crown_squares(snow) + falls) as usize
    }

    /// Range of its words.
    fn branch_snow_range(scene: &SceneBlock) -> std::ops::Range<usize> {
        let snow = &scene.snow;
        let first = branch_word(snow, 0) as usize;
        first..first + Self::branch_snow_words(snow)
    }

    /// Units of water on each segment; empty where no tree stands around the snow.
    pub fn branch_snow(&self, scene: &SceneBlock) -> &[u32] {
        &self.words[Self::branch_snow_range(scene)][..scene.snow.branches as usize]
    }

    /// Units of water that crowns have caught and not yet taken, before a step.
    pub(super) fn in_crowns(&self, scene: &SceneBlock, step: u32) -> &[u32] {
        if scene.snow.branches == 0 {
            return &[];
        }
        let squares = crown_squares(&scene.snow) as usize;
        let crowns = &self.words[Self::branch_snow_range(scene)][scene.snow.branches as usize..];
        &crowns[(crown_pool(step) as usize + 1) * squares..][..squares]
    }

    /// Units of water that fall from segments as particles; empty where snow comes down at once.
    pub(super) fn branch_falls(&self, scene: &SceneBlock) -> &[u32] {
        if scene.snow.branches == 0 || scene.snow.fall_slots == 0 {
            return &[];
        }
        &self.words[fall_word(&scene.snow, 0) as usize..][..scene.snow.branches as usize]
    }

    /// The snow on branches, to be changed.
    pub fn branch_snow_mut(&mut self, scene: &SceneBlock) -> BranchSnowMut<'_> {
        let words = &mut self.words[Self::branch_snow_range(scene)];
        let (held, words) = words.split_at_mut(scene.snow.branches as usize);
        let crowns = if scene.snow.branches == 0 { 0 } else { CROWN_WORDS * crown_squares(&scene.snow) };
        let (crowns, falls) = words.split_at_mut(crowns as usize);
        BranchSnowMut { held, crowns, falls }
    }

    /// Lets a flake land, on the cells or in a crown above them.
    pub fn land_flake(&mut self, cx: &Context<'_>, x_m: f32, z_m: f32) {
        if !self.catch_flake(cx, x_m, z_m) {
            self.snow_mut(cx.scene).land(cx, x_m, z_m, cx.scene.snow.flake_water);
        }
    }

    /// Lets a crown catch a flake that lands beneath it, if it does. Returns true if so.
    pub fn catch_flake(&mut self, cx: &Context<'_>, x_m: f32, z_m: f32) -> bool {
        let snow = &cx.scene.snow;
        let cell = snow_cell(snow, x_m, z_m);
        if cell == NEVER || !flake_is_caught(cx, x_m, z_m, lies_on(cx, cell).open) {
            return false;
        }
        let [fresh, left, _] = crown_places(cx, cell);
        let crowns = self.branch_snow_mut(cx.scene).crowns;
        for place in [fresh, left] {
            crowns[place] = crowns[place].wrapping_add(snow.flake_water);
        }
        true
    }

    /// Lets the snow land that has fallen from the segment in a row as a particle; beyond the rectangle it counts at its edge.
    pub fn land_fall(&mut self, cx: &Context<'_>, row: u32, x_m: f32, z_m: f32) {
        let snow = &cx.scene.snow;
        let water = std::mem::take(&mut self.branch_snow_mut(cx.scene).falls[row as usize]);
        let [x_m, z_m] = snow_inside(snow, x_m, z_m);
        self.snow_mut(cx.scene).land(cx, x_m, z_m, water);
    }

    /// Adds up the areas of the segments over each square, in the middle of a round.
    pub fn add_branches(&mut self, cx: &Context<'_>) {
        let crowns = self.branch_snow_mut(cx.scene).crowns;
        for catch in (0..cx.scene.snow.branches).map(|row| branch_catch(cx, row)) {
            if catch.cell != NEVER {
                let [.., area] = crown_places(cx, catch.cell);
                crowns[area] = crowns[area].wrapping_add(catch.area);
            }
        }
    }

    /// Lets the segments of all trees take, in the last exchange of a round, what has come down over their squares, and lose what falls from them.
    pub fn step_branch_snow(&mut self, cx: &Context<'_>, branches: &Branches) {
        let snow = &cx.scene.snow;
        let BranchSnowMut { held, crowns, falls } = self.branch_snow_mut(cx.scene);
        for (row, held) in (0..).zip(held) {
            let catch = branch_catch(cx, row);
            if catch.cell == NEVER {
                continue;
            }
            let [fresh, left, area] = crown_places(cx, catch.cell);
            let at = row as usize;
            let spin: Vec3 = first_three(branches.spin[at]);
            #[expect(clippy::cast_precision_loss, reason = "as in WGSL")]
            let leaf_count = branches.leaf_count[at] as f32;
            let room = branch_room(cx, catch, leaf_count, quat_axis_y(branches.pose[at].into()).y);
            let offered = branch_offer(catch, crowns[fresh], crowns[area]);
            let after = branch_round(cx, row, room, *held, offered, vec3_dot(spin, spin));
            *held = after.held;
            let mut given = after.lost.wrapping_sub(after.caught);
            if let Some(falling) = falls.get_mut(at)
                && falls_as_particle(snow, after.lost, *falling)
            {
                *falling = after.lost;
                given = given.wrapping_sub(after.lost);
            }
            crowns[left] = crowns[left].wrapping_add(given);
        }
    }

    /// Lets what segments have not taken fall on to the cells, which is what the squares hold from one exchange to the next.
    pub fn fall_through_crowns(&mut self, cx: &Context<'_>) {
        let snow = &cx.scene.snow;
        if snow.branches == 0 {
            return;
        }
        let (mut cells, words) = self.all_snow_mut(cx.scene);
        let first = snow.branches + (crown_pool(cx.step.index) + 1) * crown_squares(snow);
        let left = &words[first as usize..][..crown_squares(snow) as usize];
        if left.iter().all(|units| *units == 0) {
            return;
        }
        for cell in 0..snow.columns * snow.lines {
            let shifted = crown_cell(cx, cell);
            let units = left[crown_square(snow, shifted) as usize];
            if units != 0 {
                cells.fall(cx, cell, crown_part(snow, shifted, units));
            }
        }
    }

    /// Empties the squares of the round before.
    pub fn clear_crowns(&mut self, cx: &Context<'_>) {
        if cx.scene.snow.branches != 0 {
            let squares = crown_squares(&cx.scene.snow) as usize;
            let first = (CROWN_POOL - crown_pool(cx.step.index)) as usize * squares;
            self.branch_snow_mut(cx.scene).crowns[first..][..CROWN_POOL as usize * squares].fill(0);
        }
    }

    /// Lays on the branches what they hold of fresh snow of so much water in mm that has fallen before time zero and has lain for so many hours, and takes
    /// it from the cells beneath.
    pub(crate) fn hang_snow(&mut self, cx: &Context<'_>, branches: &Branches, mm: f32, rounds: f64) {
        let snow = &cx.scene.snow;
        if snow.branches == 0 || mm <= 0.0 {
            return;
        }
        let cells = snow.columns * snow.lines;
        let covered = |cell: u32| f64::from((1.0 - lies_on(cx, cell).open).clamp(0.0, 1.0));
        let units = f64::from(mm) / f64::from(SNOW_WATER_MM);
        let mut fallen = vec![0.0_f64; crown_squares(snow) as usize];
        for cell in 0..cells {
            fallen[crown_square(snow, cell) as usize] += units * covered(cell);
        }
        let stays = libm::pow((1.0 - f64::from(cx.step.snow.branch_sheds)).max(0.0), rounds);
        let catches: Vec<_> = (0..snow.branches).map(|row| branch_catch(cx, row)).collect();
        let over = || catches.iter().enumerate().filter(|(_, catch)| catch.cell != NEVER);
        let mut areas = vec![0.0_f64; fallen.len()];
        for (_, catch) in over() {
            areas[crown_square(snow, catch.cell) as usize] += f64::from(catch.area);
        }
        let mut sums = vec![0.0_f64; fallen.len()];
        let mut caught = vec![0.0_f64; catches.len()];
        for (at, catch) in over() {
            #[expect(clippy::cast_precision_loss, reason = "as in WGSL")]
            let leaf_count = branches.leaf_count[at] as f32;
            let axis = quat_axis_y(branches.pose[at].into());
            let room = f64::from(branch_room(cx, *catch, leaf_count, axis.y)).max(1e-3);
            let square = crown_square(snow, catch.cell) as usize;
            let fallen = fallen[square] * f64::from(catch.area) / areas[square].max(1.0);
            caught[at] = room * -libm::expm1(-fallen / room);
            sums[square] += caught[at];
        }
        // What cells give changes evenly from square to square, so that no seams show.
        let shares: Vec<f64> = sums.iter().zip(&fallen).map(|(sum, fallen)| sum / fallen.max(1.0)).collect();
        let mut given = vec![0_u32; fallen.len()];
        let mut ground = self.snow_mut(cx.scene);
        for cell in 0..cells {
            let square = crown_square(snow, cell) as usize;
            if sums[square] > 0.0 && covered(cell) > 0.0 {
                let share = stays * covered(cell) * between_squares(snow, &shares, cell).min(1.0);
                let share = share * rim_share(snow, &sums, cell);
                let part = word(units * share).min(ground.water[cell as usize]);
                ground.take(cell, part, fresh_depth(cx, part));
                given[square] += part;
            }
        }
        let held = self.branch_snow_mut(cx.scene).held;
        let mut left = given.clone();
        for (at, catch) in over() {
            let square = crown_square(snow, catch.cell) as usize;
            let share = caught[at] / sums[square].max(1e-9);
            held[at] = word(f64::from(given[square]) * share).min(left[square]);
            left[square] -= held[at];
        }
        // Rounded down, parts leave a few units.
        for (at, catch) in over() {
            held[at] += std::mem::take(&mut left[crown_square(snow, catch.cell) as usize]);
        }
    }
}

/// Share of what it would give that a cell gives near squares over which nothing hangs, so that no edge of theirs shows.
fn rim_share(snow: &SnowBlock, sums: &[f64], cell: u32) -> f64 {
    let (column, line) = (cell % snow.columns, cell / snow.columns);
    let within = |number: u32| (f64::from(number % CROWN_CELLS) + 0.5) / f64::from(RIM_CELLS);
    let beyond =
        |number: u32| (f64::from(CROWN_CELLS - 1 - number % CROWN_CELLS) + 0.5) / f64::from(RIM_CELLS);
    let mut share = 1.0_f64;
    for (to_line, near_z) in [(-1_i32, within(line)), (0, 0.0), (1, beyond(line))] {
        for (to_column, near_x) in [(-1_i32, within(column)), (0, 0.0), (1, beyond(column))] {
            let next = |number: u32, to: i32| (number / CROWN_CELLS).checked_add_signed(to);
            let is_bare = next(column, to_column).zip(next(line, to_line)).is_some_and(|(column, line)| {
                column < crown_columns(snow)
                    && sums.get((line * crown_columns(snow) + column) as usize).is_some_and(|sum| *sum <= 0.0)
            });
            if is_bare {
                share = share.min(libm::hypot(near_x, near_z));
            }
        }
    }
    share
}

/// Number at the middle of a cell, by those of the squares: it changes evenly between their middles.
fn between_squares(snow: &SnowBlock, of_squares: &[f64], cell: u32) -> f64 {
    let place = |number: u32, count: u32| {
        let last = f64::from(count.div_ceil(CROWN_CELLS) - 1);
        let at = ((f64::from(number) + 0.5) / f64::from(CROWN_CELLS) - 0.5).clamp(0.0, last);
        let before = libm::floor(at).min((last - 1.0).max(0.0));
        (word(before), at - before, word((before + 1.0).min(last)))
    };
    let (west, x, east) = place(cell % snow.columns, snow.columns);
    let (north, z, south) = place(cell / snow.columns, snow.lines);
    let of = |column: u32, line: u32| of_squares[(line * crown_columns(snow) + column) as usize];
    let near = of(west, north) + x * (of(east, north) - of(west, north));
    let far = of(west, south) + x * (of(east, south) - of(west, south));
    near + z * (far - near)
}

/// Places of the words of the square over a cell in a round.
fn crown_places(cx: &Context<'_>, cell: u32) -> [usize; CROWN_POOL as usize] {
    let snow = &cx.scene.snow;
    let (square, pool) = (crown_square(snow, crown_cell(cx, cell)), crown_pool(cx.step.index));
    std::array::from_fn(|word| (pool as usize + word) * crown_squares(snow) as usize + square as usize)
}
