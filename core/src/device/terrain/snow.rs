// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! twin: backend-wgpu/src/shaders/terrain/snow.wgsl
//!
//! Snow that lies: water and depth in a grid of cells, both integers, so that nothing is lost in any order of additions.
//!
//! # Model
//! A flake that lands spreads its water over 5 x 5 cells with binomial weights, as deep as fresh snow of the air's temperature is. What lies settles towards old snow, and melts by degree-hours: 3.5 mm of water a day per °C in the open and 2.4 in woods
//! (Kuusisto 1980), rounded at random, so that slow melt is right on average. Where it is steeper than loose snow stands, it slides: cells
//! exchange snow in pairs, every cell with one of its eight neighbours at a time, so that no two pairs share a cell and what one loses
//! the other gains. A step in what it lies on, as at the top of a wall, is no slope: there it only slides as if both lay level.
//!
//! Wind above a threshold takes it along the ground, 0.68 ρ u*t (u*² - u*t²) / (g u*) per second and metre of width (Pomeroy and Gray 1990), u*
//! being the friction velocity that shelter leaves over the snow of the cell and u*t the threshold: what goes over an edge is that of the cell
//! upwind, so that it gathers where the wind slackens, until it reaches up into the wind. The edges of the rectangle are joined, as for
//! the flakes that fall on it. What has drifted is packed as old snow is.

use crate::arith::lane::{Mask, Real, Word};
use crate::arith::math::reciprocal;
use crate::arith::rng::{philox, unit_float};
use crate::blocks::{NEVER, SnowBlock};
use crate::context::Context;

crate::shared_constants! {
    /// Cells of snow per metre.
    pub const SNOW_CELLS_PER_M: f32 = 8.0;
    /// Metres of depth per unit.
    pub const SNOW_DEPTH_M: f32 = 1.0 / 262_144.0;
    /// Millimetres of water per unit: over a cell, 3.8 mg.
    pub const SNOW_WATER_MM: f32 = 1.0 / 4096.0;
    /// Kilograms of a unit of water: 1/4096 mm over a cell.
    pub const SNOW_UNIT_KG: f32 = 1.0 / 262_144.0;
    /// Words of a cell, each in a plane of its own: water, depth, what has melted and what has landed.
    pub const SNOW_WORDS: u32 = 4;
    /// Plane of the water.
    pub const SNOW_WATER: u32 = 0;
    /// Plane of the depth.
    pub const SNOW_DEPTH: u32 = 1;
    /// Plane of the water that has melted.
    pub const SNOW_MELTED: u32 = 2;
    /// Plane of the water that has landed.
    pub const SNOW_LANDED: u32 = 3;
    /// Cells along each edge of the square over which a flake spreads.
    pub const FLAKE_CELLS: u32 = 5;
    /// Steps from one exchange between cells to the next.
    pub const SNOW_INTERVAL: u32 = 4;
    /// Exchanges of a round, in which a cell meets each of its neighbours, and the time at which it settles and melts.
    pub const SNOW_TURNS: u32 = 9;
    /// Turn in which snow settles and melts.
    pub const SNOW_AGES: u32 = 8;
    /// Height in m of a step in what snow lies on, from one cell to the next, that is no slope.
    pub const SNOW_STEP_M: f32 = 0.2;
    /// Share of what is too steep that slides in an exchange.
    pub const SNOW_SLIDES: f32 = 0.25;
    /// Slope at which fresh snow stands: 50°.
    pub const FRESH_SLOPE: f32 = 1.19;
    /// Slope at which old snow stands: 38°.
    pub const OLD_SLOPE: f32 = 0.78;
    /// Units of depth per unit of water of fresh snow of 68 kg/m³.
    pub const FRESH_DEPTH: f32 = 0.941_25;
    /// Units of depth per unit of water of old snow of 250 kg/m³.
    pub const OLD_DEPTH: f32 = 0.256;
    /// Unit of the share of open sky, in the lower half of the second word of a floor.
    pub const FLOOR_OPEN: f32 = 1.0 / 32_768.0;
    /// That half on water, in which snow melts at once.
    pub const FLOOR_ON_WATER: u32 = 0xffff;
    /// Unit in m of the depth that fills a lee, in the upper half.
    pub const FLOOR_LEE_M: f32 = 1.0 / 256.0;
    /// Depth in m of a lee from which on it is one in full: shallower ones count for less, so that the wind does not jump where one begins.
    pub const FULL_LEE_M: f32 = 0.05;
    /// Way to a neighbour that touches at a corner over that to another.
    pub const ROOT_TWO: f32 = std::f32::consts::SQRT_2;
    /// Turn in which the last line meets the first.
    pub const AROUND_TURN: u32 = 6;
    /// Rounds of which one takes drifting snow along.
    pub const DRIFT_ROUNDS: u32 = 4;
    /// Most units of water that drift over an edge at once.
    pub const MOST_DRIFT: f32 = 1_048_576.0;
    /// Greatest depth in m that leaves and wind meet.
    pub const SNOW_HIGHEST_M: f32 = 4.0;
    /// Random words of melting and settling.
    pub const STREAM_SNOW: u32 = 0x8000_0001;
}

/// Snow of a cell, or that goes from one to another.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SnowCell {
    /// Units of water.
    pub water: u32,
    /// Units of depth.
    pub depth: u32,
}

/// Ground, water or solid thing that a cell of snow lies on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SnowFloor {
    /// Height in m.
    pub height_m: f32,
    /// Share of the sky that is open above it; below zero on water.
    pub open: f32,
    /// Depth of snow in m that fills the lee in which it lies; zero where there is none.
    pub lee_m: f32,
}

/// Two cells that exchange snow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SnowPair {
    /// The other one; [`NEVER`] if there is none.
    pub other: u32,
    /// True if they touch at a corner.
    pub is_diagonal: bool,
    /// True if they lie on opposite edges of the grid.
    pub is_around: bool,
}

/// Snow between the centres of four cells.
#[derive(Clone, Copy, Debug)]
pub struct SnowBetween<R: Real = f32> {
    /// Depths in m: along x, then along z; zero outside.
    pub depths_m: [R; 4],
    /// Share of the way along x.
    pub x: R,
    /// Share of the way along z.
    pub z: R,
}

/// A floor of two words of the tables.
#[inline(always)]
pub fn snow_floor(height: u32, word: u32) -> SnowFloor {
    let open = word & 0xffff;
    SnowFloor {
        height_m: f32::from_bits(height),
        open: if open == FLOOR_ON_WATER { -1.0 } else { open.to_real() * FLOOR_OPEN },
        lee_m: (word >> 16).to_real() * FLOOR_LEE_M,
    }
}

/// Depth in m over the cell of a number, as far as leaves and wind meet it.
#[inline(always)]
fn snow_depth_m<W: Word>(cx: &Context<'_>, cell: W) -> W::Real {
    let snow = &cx.scene.snow;
    let place = cell.plus(cell.all(snow.first_word + SNOW_DEPTH * (snow.columns * snow.lines)));
    let depth_m = place.look_up_word(cx.litter).to_real() * SNOW_DEPTH_M;
    depth_m.min(depth_m.all(SNOW_HIGHEST_M))
}

/// Snow around a place. Only where there is snow.
#[inline(always)]
pub fn snow_between<R: Real>(cx: &Context<'_>, x: R, z: R) -> SnowBetween<R> {
    let snow = &cx.scene.snow;
    let u = x * SNOW_CELLS_PER_M - 0.5;
    let v = z * SNOW_CELLS_PER_M - 0.5;
    let ku = u.floor();
    let kv = v.floor();
    let column = ku.to_whole();
    let line = kv.to_whole();
    let column = column.minus(column.all(snow.first_column));
    let line = line.minus(line.all(snow.first_line));
    let is_inside = column.less_than(column.all(snow.columns - 1)) & line.less_than(line.all(snow.lines - 1));
    let cell = is_inside.select(line.times(line.all(snow.columns)).plus(column), column.all(0));
    let next = cell.all(1);
    let far = cell.plus(cell.all(snow.columns));
    let none = x.all(0.0);
    let depth = |cell: R::Word| is_inside.select_real(snow_depth_m(cx, cell), none);
    let depths_m = [depth(cell), depth(cell.plus(next)), depth(far), depth(far.plus(next))];
    SnowBetween { depths_m, x: u - ku, z: v - kv }
}

/// Depth of snow at a place in m; zero without snow.
#[inline(always)]
pub fn snow_height<R: Real>(cx: &Context<'_>, x: R, z: R) -> R {
    if !cx.has_snow() {
        return x.all(0.0);
    }
    let SnowBetween { depths_m: [a, b, c, d], x, z } = snow_between(cx, x, z);
    let near = a + x * (b - a);
    let far = c + x * (d - c);
    near + z * (far - near)
}

/// Number of the cell at a place; [`NEVER`] outside.
#[inline(always)]
pub fn snow_cell(snow: &SnowBlock, x: f32, z: f32) -> u32 {
    let column = (x * SNOW_CELLS_PER_M).floor().to_whole().wrapping_sub(snow.first_column);
    let line = (z * SNOW_CELLS_PER_M).floor().to_whole().wrapping_sub(snow.first_line);
    if column < snow.columns && line < snow.lines { line * snow.columns + column } else { NEVER }
}

/// Place within the grid that is next to a place.
#[inline(always)]
pub fn snow_inside(snow: &SnowBlock, x: f32, z: f32) -> [f32; 2] {
    let within = |at: f32, first: u32, count: u32| {
        let low = (first.cast_signed() as f32 + 0.5) * (1.0 / SNOW_CELLS_PER_M);
        let high = low + (count - 1).to_real() * (1.0 / SNOW_CELLS_PER_M);
        at.max(low).min(high)
    };
    [within(x, snow.first_column, snow.columns), within(z, snow.first_line, snow.lines)]
}

/// Centre x, z of a cell in m.
#[inline(always)]
pub fn snow_center(snow: &SnowBlock, cell: u32) -> [f32; 2] {
    let at = |number: u32| (number.to_real() + 0.5) * (1.0 / SNOW_CELLS_PER_M);
    [
        at(snow.first_column.wrapping_add(cell % snow.columns)),
        at(snow.first_line.wrapping_add(cell / snow.columns)),
    ]
}

/// Weight in sixteenths of one of five cells in a row over which a flake spreads: 1, 4, 6, 4, 1.
#[inline(always)]
pub fn flake_weight(number: u32) -> u32 {
    let inner = number * (FLAKE_CELLS - 1 - number);
    inner + u32::from(inner == 0) + u32::from(inner != 0) + u32::from(inner == 4)
}

/// One of the 25 cells around that in which a flake lands; [`NEVER`] outside.
#[inline(always)]
pub fn flake_cell(snow: &SnowBlock, cell: u32, part: u32) -> u32 {
    let column = (cell % snow.columns).wrapping_add(part % FLAKE_CELLS).wrapping_sub(2);
    let line = (cell / snow.columns).wrapping_add(part / FLAKE_CELLS).wrapping_sub(2);
    if column < snow.columns && line < snow.lines { line * snow.columns + column } else { NEVER }
}

/// Water that a flake gives to one of the 25 cells; that in the middle keeps what the others do not take.
#[inline(always)]
pub fn flake_share(water: u32, part: u32) -> u32 {
    (water * flake_weight(part % FLAKE_CELLS) * flake_weight(part / FLAKE_CELLS)) >> 8
}

/// Depth of so much fresh snow.
#[inline(always)]
pub fn fresh_depth(cx: &Context<'_>, water: u32) -> u32 {
    (water * cx.step.snow.fresh_depth_q12 + 2048) >> 12
}

/// Part of a round in which a step is, or [`NEVER`] if snow stays as it is in it.
#[inline(always)]
pub fn snow_turn(step: u32) -> u32 {
    if (step & (SNOW_INTERVAL - 1)) != 0 { NEVER } else { (step / SNOW_INTERVAL) % SNOW_TURNS }
}

/// Returns true in steps in which wind takes snow along.
#[inline(always)]
pub fn snow_drifts(cx: &Context<'_>) -> bool {
    let round = cx.step.index / (SNOW_INTERVAL * SNOW_TURNS);
    round.is_multiple_of(DRIFT_ROUNDS) && cx.step.snow.lifts_fresh_m_s < cx.step.snow.drift_m_s
}

/// Cell with which one exchanges snow in a turn as the first of the two. Along lines, columns take turns; otherwise lines do. The last ones
/// meet the first.
#[inline(always)]
pub fn snow_pair(snow: &SnowBlock, cell: u32, turn: u32) -> SnowPair {
    let none = SnowPair { other: NEVER, is_diagonal: false, is_around: false };
    let (column, line) = (cell % snow.columns, cell / snow.columns);
    let (kind, odd) = (turn & 3, turn >> 2);
    if kind == 0 {
        if (column & 1) != odd {
            return none;
        }
        let is_around = column + 1 >= snow.columns;
        return SnowPair {
            other: if is_around { cell - column } else { cell + 1 },
            is_diagonal: false,
            is_around,
        };
    }
    if (line & 1) != odd {
        return none;
    }
    if line + 1 >= snow.lines {
        if kind != 2 {
            return none;
        }
        return SnowPair { other: column, is_diagonal: false, is_around: true };
    }
    // One column to the left, the same, or one to the right.
    let across = column.wrapping_add(kind).wrapping_sub(2);
    if across >= snow.columns {
        return none;
    }
    SnowPair { other: (line + 1) * snow.columns + across, is_diagonal: kind != 2, is_around: false }
}

/// Share of the way from old to fresh snow at which that of a cell is, by its density.
#[expect(clippy::manual_clamp, reason = "written as in WGSL")]
#[inline(always)]
pub fn snow_freshness(cell: SnowCell) -> f32 {
    let per_water = cell.depth.to_real() * reciprocal(cell.water.max(1).to_real());
    ((per_water - OLD_DEPTH) * (1.0 / (FRESH_DEPTH - OLD_DEPTH))).max(0.0).min(1.0)
}

/// Slope at which snow stands, by how dense it is.
#[inline(always)]
pub fn snow_repose(cell: SnowCell) -> f32 {
    OLD_SLOPE + snow_freshness(cell) * (FRESH_SLOPE - OLD_SLOPE)
}

/// Part of the snow of a cell of so much depth.
#[inline(always)]
pub fn snow_part(cell: SnowCell, depth: u32) -> SnowCell {
    if depth >= cell.depth {
        return cell;
    }
    let share = depth.to_real() * reciprocal(cell.depth.to_real());
    SnowCell { water: (cell.water.to_real() * share).floor().to_whole().min(cell.water), depth }
}

/// Snow that slides from a cell to a neighbour, what they lie on being so many metres higher and so far away.
#[inline(always)]
pub fn snow_slide(above: SnowCell, below: SnowCell, drop_m: f32, way_m: f32) -> SnowCell {
    if above.depth == 0 || drop_m < -SNOW_STEP_M {
        return SnowCell { water: 0, depth: 0 };
    }
    let slope = if drop_m < SNOW_STEP_M { drop_m } else { 0.0 };
    let higher_m = (above.depth.to_real() - below.depth.to_real()) * SNOW_DEPTH_M + slope;
    let steep_m = higher_m - way_m * snow_repose(above);
    if steep_m <= 0.0 {
        return SnowCell { water: 0, depth: 0 };
    }
    snow_part(above, ((steep_m * SNOW_SLIDES) * (1.0 / SNOW_DEPTH_M)).floor().to_whole())
}

/// Part of the snow of a cell of so much water.
#[inline(always)]
pub fn snow_taken(cell: SnowCell, water: u32) -> SnowCell {
    if water >= cell.water {
        return cell;
    }
    let share = water.to_real() * reciprocal(cell.water.to_real());
    SnowCell { water, depth: (cell.depth.to_real() * share).floor().to_whole().min(cell.depth) }
}

/// Share of the wind that is left over snow of so much depth, of that which shelter leaves there: none of it is missing where a lee is filled.
#[inline(always)]
pub fn left_over_snow(left: f32, depth_m: f32, lee_m: f32) -> f32 {
    if lee_m <= 0.0 {
        return left;
    }
    let filled = (depth_m * reciprocal(lee_m)).min(1.0) * (lee_m * (1.0 / FULL_LEE_M)).min(1.0);
    1.0 - (1.0 - left) * (1.0 - filled)
}

/// Snow that the wind takes from a cell over an edge to one whose surface is so many metres higher. `left` is the share of the wind that shelter
/// leaves there, and `toward` the part of a unit vector along the wind that leads over the edge.
#[inline(always)]
pub fn snow_drift(cx: &Context<'_>, cell: SnowCell, rise_m: f32, left: f32, toward: f32) -> SnowCell {
    let none = SnowCell { water: 0, depth: 0 };
    let now = &cx.step.snow;
    let speed = now.drift_m_s * left.max(-left);
    let lifts = now.lifts_old_m_s + snow_freshness(cell) * (now.lifts_fresh_m_s - now.lifts_old_m_s);
    if cell.water == 0 || SNOW_STEP_M < rise_m || left * toward <= 0.0 || speed <= lifts {
        return none;
    }
    let carried = (lifts * (speed * speed - lifts * lifts)) * reciprocal(speed);
    let units = carried * (toward.max(-toward) * now.drift_units);
    snow_taken(cell, units.min(MOST_DRIFT).floor().to_whole())
}

/// Depth of snow that has drifted: packed as old snow is, if it was not before.
#[inline(always)]
pub fn drifted_depth(taken: SnowCell) -> u32 {
    (taken.water.to_real() * OLD_DEPTH).floor().to_whole().min(taken.depth)
}

/// A number rounded at random, so that it is right on average.
#[inline(always)]
pub fn round_at_random<W: Word>(number: W::Real, word: W) -> W {
    (number + unit_float(word)).floor().to_whole()
}

/// Water and depth of a cell that are left after a round in which snow melts and settles, where so much of the sky is open. Only where there is water.
#[inline(always)]
pub fn snow_age<W: Word>(cx: &Context<'_>, number: W, water: W, depth: W, open: W::Real) -> [W; 2] {
    let now = &cx.step.snow;
    let counter = [number, number.all(STREAM_SNOW), number.all(cx.step.index), number.all(0)];
    let [melt, settle, shrink, _] = philox(cx.scene.seed, counter);
    let least = |a: W, b: W| a.less_than(b).select(a, b);
    let warmth = open * (now.melt_open - now.melt_woods) + now.melt_woods;
    let left = water.minus(least(round_at_random(warmth, melt), water));
    // The depth goes with the water.
    let share = left.to_real() * reciprocal(water.to_real());
    let shrunk = least(round_at_random(depth.to_real() * share, shrink), depth);
    let kept = left.less_than(water).select(shrunk, depth);
    let packed = left.to_real() * OLD_DEPTH;
    let loose = (kept.to_real() - packed).max(open.all(0.0));
    [left, kept.minus(least(round_at_random(loose * now.settled, settle), kept))]
}
