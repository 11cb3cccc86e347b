// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Compiles snow: its grid, what it lies on, and the weather and the wind over it in a step.

use glam::DVec2;

use super::shelter::shelter_wind;
use super::solids::bound_m;
use crate::blocks::{NEVER, SceneBlock, SnowBlock, SnowStepBlock, StepBlock};
use crate::convert::{len32, low_word, single, word};
use crate::device::terrain::snow::{
    DRIFT_ROUNDS, FLOOR_LEE_M, FLOOR_ON_WATER, FLOOR_OPEN, SNOW_CELLS_PER_M, SNOW_DEPTH_M, SNOW_INTERVAL,
    SNOW_TURNS, SNOW_UNIT_KG, SNOW_WATER_MM, snow_cell,
};
use crate::device::tree::branch_snow::CROWN_UNITS_M2;
use crate::device::wind::gust::GUST_ROWS;
use crate::device::wind::profile::profile_factor;
use crate::layout::Uint4;
use crate::litter::Bed;
use crate::scene::{ParticleShape, Particles, Scene, Weather};
use crate::solid::Solid;
use crate::tree::Forest;
use crate::tree::skeleton::AttachmentKind;
use crate::wind::ShelterGrids;

/// Melt in mm of water per day and °C above 0 °C under the open sky, and in woods (Kuusisto, Nordic Hydrology 11, 1980).
const MELT_MM_DAY_C: [f64; 2] = [3.5, 2.4];
/// Hours in which loose snow settles e-fold towards old snow in frost, and near 0 °C or above. Assumed.
const SETTLING_H: [f64; 2] = [48.0, 12.0];
/// Density of old snow in kg/m³.
const OLD_KG_M3: f64 = 250.0;
/// Density of water in kg/m³.
const WATER_KG_M3: f64 = 1000.0;
/// Wind in m/s at ten metres from which on snow drifts, dry and wet. Means of what Li and Pomeroy (Journal of Applied Meteorology 36, 1997) observed,
/// 7.7 and 9.9, are taken for snow that fell dry, and at 0 °C, where it is denser; the highest, for old snow.
const LIFTS_FRESH_M_S: [f64; 2] = [7.7, 8.2];
const LIFTS_OLD_M_S: [f64; 2] = [11.0, 14.0];
/// Height of that wind in m.
const WIND_HEIGHT_M: f64 = 10.0;
/// Roughness length of snow in m: assumed.
const SNOW_ROUGHNESS_M: f64 = 0.0003;
/// Kármán's constant.
const KARMAN: f64 = 0.4;
/// Factor of the law of saltation (Pomeroy and Gray, Water Resources Research 26, 1990).
const SALTATION: f64 = 0.68;
/// Density of air in kg/m³, and gravity in m/s², of the measurements behind it.
const AIR_KG_M3: f64 = 1.25;
const GRAVITY_M_S2: f64 = 9.81;
/// Snow in kg/m² that needles bear per area, by the density of fresh snow: 5.9 (0.27 + 46 / ρ), spruce (Hedstrom and Pomeroy, Hydrological Processes 12,
/// 1998). Taken for broad leaves and wood too, for which no number was found.
const BEARS_KG_M2: f64 = 5.9;
const BEARS_SHARE: f64 = 0.27;
const BEARS_KG_M3: f64 = 46.0;
/// Temperature in °C from which on snow falls from branches, degrees and seconds in which it does, and metres of wind that take it (Roesch et al.,
/// Climate Dynamics 17, 2001, as models of the land surface state it).
const UNLOADS_FROM_C: f64 = -3.0;
const UNLOADS_C_S: f64 = 1.87e5;
const UNLOADS_M: f64 = 1.56e5;
/// Distance in m from a leaf or twig within which there is a crown overhead.
const CROWN_REACH_M: f64 = 0.4;
/// Cells on each side over which the edge of a crown fades.
const CROWN_FADE: usize = 2;

/// Density in kg/m³ of snow that falls in air of a temperature: about the 68 ± 9 measured hour by hour (Helfricht et al., Hydrology and Earth
/// System Sciences 22, 2018), denser near 0 °C with the exponential that Hedstrom and Pomeroy (Hydrological Processes 12, 1998) use for daily snow.
fn fresh_kg_m3(air_c: f64) -> f64 {
    62.0 + 25.0 * libm::exp(air_c.min(0.0) / 2.6)
}

/// Hours in which loose snow settles e-fold in air of a temperature.
fn settling_h(air_c: f64) -> f64 {
    let warm = ((air_c + 2.0) / 2.0).clamp(0.0, 1.0);
    SETTLING_H[0] + (SETTLING_H[1] - SETTLING_H[0]) * warm
}

/// Millimetres of water over a square metre in the units of all cells on it.
fn units_per_mm_m2() -> f64 {
    f64::from(SNOW_CELLS_PER_M) * f64::from(SNOW_CELLS_PER_M) / f64::from(SNOW_WATER_MM)
}

/// Area in m² over which the flakes of a population fall.
fn falls_over_m2(particles: &Particles) -> f64 {
    let ParticleShape::Box { half_extent_m, .. } = particles.from else { return 0.0 };
    4.0 * f64::from(half_extent_m.x) * f64::from(half_extent_m.z)
}

/// Units of water of each flake: so many that the slots suffice for the heaviest snowfall.
pub(super) fn flake_water(scene: &Scene) -> u32 {
    let Some((weather, flakes)) = scene.snowfall() else { return 0 };
    let life_s = flakes.life_s.map_or(1.0, |life_s| f64::from(life_s.highest())) + f64::from(scene.dt_s);
    let most_per_s = f64::from(flakes.count) / life_s;
    let units_per_s = weather.most_mm_h() / 3600.0 * falls_over_m2(flakes) * units_per_mm_m2();
    word(libm::ceil(units_per_s / most_per_s).max(1.0))
}

/// Flakes of so much water that make a millimetre of it.
pub(super) fn flakes_per_mm(scene: &Scene, water: u32) -> f64 {
    let Some((_, flakes)) = scene.snowfall() else { return 0.0 };
    falls_over_m2(flakes) * units_per_mm_m2() / f64::from(water)
}

/// Share of the open sky of cells on water.
const ON_WATER: f32 = -1.0;

/// The grid of the snow of a scene, and from a row of the tables on the floors of its cells, two to a row.
pub(super) fn snow_block(
    scene: &Scene,
    block: &SceneBlock,
    solids: &[Solid],
    forest: &Forest,
    shelter: Option<&ShelterGrids>,
    first_row: u32,
    ground: impl Fn(f32, f32) -> Option<f32>,
) -> (SnowBlock, Vec<Uint4>) {
    let mut snow: SnowBlock = bytemuck::Zeroable::zeroed();
    let Some(weather) = &scene.weather else { return (snow, Vec::new()) };
    (snow.first_column, snow.columns) = grid_span(weather.center_m.x, weather.size_m.x);
    (snow.first_line, snow.lines) = grid_span(weather.center_m.y, weather.size_m.y);
    snow.first_word = Bed::first_snow(block);
    snow.first_row = first_row;
    snow.flake_water = flake_water(scene);
    let place = |cell: usize| {
        let (column, line) = (cell % snow.columns as usize, cell / snow.columns as usize);
        let at =
            |first: u32, number: usize| (f64::from(first.cast_signed()) + number as f64 + 0.5) * cell_m();
        DVec2::new(at(snow.first_column, column), at(snow.first_line, line))
    };
    let cells = snow.columns as usize * snow.lines as usize;
    let mut base: Vec<(f32, f32)> = (0..cells)
        .map(|cell| {
            let at = place(cell).as_vec2();
            ground(at.x, at.y).map_or((0.0, ON_WATER), |height_m| (height_m, 1.0))
        })
        .collect();
    shade(&snow, forest, &mut base);
    // Snow blows through what is open.
    for solid in solids.iter().filter(|solid| !solid.moves() && solid.open == 0.0) {
        let pose = solid.pose_at(0.0, |_, _| 0.0);
        let reach_m = bound_m(solid);
        for cell in cells_within(&snow, DVec2::new(pose.center_m.x, pose.center_m.z), reach_m) {
            let at = place(cell);
            if let Some(top_m) = solid.top_m(at.x, at.y) {
                base[cell].0 = base[cell].0.max(single(top_m));
            }
        }
    }
    let lees_m = shelter.map(|grids| {
        let ground_m = |x_m, z_m| ground(single(x_m), single(z_m)).unwrap_or(block.surface_height_m).into();
        grids.filled_m(solids, &shelter_wind(scene), ground_m, (0..cells).map(|cell| place(cell).to_array()))
    });
    let lees_m = lees_m.into_iter().flatten().chain(std::iter::repeat(0.0));
    let words: Vec<u32> =
        base.iter().zip(lees_m).flat_map(|(&base, lee_m)| floor_words(base, lee_m)).collect();
    let rows = words.chunks(4).map(|row| {
        let mut full = [0; 4];
        full[..row.len()].copy_from_slice(row);
        Uint4(full)
    });
    let mut rows: Vec<Uint4> = rows.collect();
    snow.fall_slots = scene.particles.iter().find(|one| one.is_branch_snow()).map_or(0, |falls| falls.count);
    let branch_rows = branch_rows(&mut snow, forest);
    snow.first_branch_row = first_row + len32(rows.len());
    rows.extend(branch_rows);
    (snow, rows)
}

/// Words of a floor (see [`snow_floor`](crate::device::terrain::snow::snow_floor)).
fn floor_words((height_m, open): (f32, f32), lee_m: f64) -> [u32; 2] {
    let open = if open < 0.0 { FLOOR_ON_WATER } else { word(f64::from(open) / f64::from(FLOOR_OPEN)) };
    let lee = word((lee_m / f64::from(FLOOR_LEE_M)).min(f64::from(u16::MAX)));
    [height_m.to_bits(), open | lee << 16]
}

/// Areas with which the segments of a forest catch snow (see [`branch_catch`](crate::device::tree::branch_snow::branch_catch)), row by row, and behind
/// them, if it falls as particles, their middles; nothing if none of them is above the snow.
fn branch_rows(snow: &mut SnowBlock, forest: &Forest) -> Vec<Uint4> {
    let mut rows = vec![Uint4([NEVER, 0, 0, 0]); forest.len()];
    let mut middles = vec![Uint4([0; 4]); if snow.fall_slots == 0 { 0 } else { forest.len() }];
    let mut is_any = false;
    for tree in forest.trees() {
        let mut leaves = vec![0.0_f64; tree.skeleton.segments.len()];
        for leaf in tree.skeleton.attachments.iter().filter(|at| at.kind == AttachmentKind::Leaf) {
            leaves[leaf.segment as usize] += 1.0;
        }
        for ((segment, &row), leaves) in tree.skeleton.segments.iter().zip(&tree.rows).zip(leaves) {
            let middle_m = tree.foot_m + 0.5 * (segment.start_m + segment.end_m);
            if let Some(middle) = middles.get_mut(row as usize) {
                *middle = Uint4(middle_m.extend(0.0).to_array().map(f32::to_bits));
            }
            let cell = snow_cell(snow, middle_m.x, middle_m.z);
            if cell == NEVER {
                continue;
            }
            let along = (segment.end_m - segment.start_m).as_dvec3();
            let up = along.normalize_or_zero().y;
            let wood_m2 = along.length() * f64::from(segment.start_radius_m + segment.end_radius_m);
            let area_m2 = wood_m2 * (1.0 - up * up) + tree.facts.leaf_m2 * leaves;
            let area = word(area_m2 * f64::from(CROWN_UNITS_M2));
            let [wood_m2, leaf_m2] = [wood_m2, tree.facts.leaf_m2].map(|area_m2| single(area_m2).to_bits());
            rows[row as usize] = Uint4([cell, area, wood_m2, leaf_m2]);
            is_any = true;
        }
    }
    if !is_any {
        return Vec::new();
    }
    snow.branches = len32(forest.len());
    rows.extend(middles);
    rows
}

/// First of the cells that a rectangle covers along one axis, two's complement, and their number.
fn grid_span(center_m: f32, size_m: f32) -> (u32, u32) {
    let cells = f64::from(SNOW_CELLS_PER_M);
    let first = libm::floor((f64::from(center_m) - 0.5 * f64::from(size_m)) * cells + 0.5);
    #[expect(clippy::cast_possible_truncation, reason = "validated to stay within 4096 m and a few")]
    let first = first as i64;
    // Cells exchange snow in pairs, around the edges too.
    (low_word(first), 2 * word(libm::floor(0.5 * f64::from(size_m) * cells + 0.5)))
}

/// Edge of a cell in m.
fn cell_m() -> f64 {
    1.0 / f64::from(SNOW_CELLS_PER_M)
}

/// Cells of a square around a place.
fn cells_within(snow: &SnowBlock, middle_m: DVec2, reach_m: f64) -> impl Iterator<Item = usize> + use<> {
    let span = |at_m: f64, first: u32, count: u32| {
        let number = |at_m: f64| {
            let number = libm::floor(at_m / cell_m()) - f64::from(first.cast_signed());
            word(number.clamp(0.0, f64::from(count))) as usize
        };
        number(at_m - reach_m)..(number(at_m + reach_m) + 1).min(count as usize)
    };
    let columns = span(middle_m.x, snow.first_column, snow.columns);
    let width = snow.columns as usize;
    span(middle_m.y, snow.first_line, snow.lines)
        .flat_map(move |line| columns.clone().map(move |column| line * width + column))
}

/// Shades the cells beneath the crowns of trees; the edges of crowns fade.
fn shade(snow: &SnowBlock, forest: &Forest, base: &mut [(f32, f32)]) {
    let mut covered = vec![0.0_f32; base.len()];
    for tree in forest.trees() {
        let leaves = tree.skeleton.attachments.iter().filter(|at| at.kind == AttachmentKind::Leaf);
        for at_m in leaves.map(|leaf| (tree.foot_m + leaf.at_m).as_dvec3()) {
            for cell in cells_within(snow, DVec2::new(at_m.x, at_m.z), CROWN_REACH_M) {
                covered[cell] = 1.0;
            }
        }
    }
    if covered.iter().all(|covered| *covered == 0.0) {
        return;
    }
    let (columns, lines) = (snow.columns as usize, snow.lines as usize);
    for (cell, (_, open)) in base.iter_mut().enumerate().filter(|(_, (_, open))| *open >= 0.0) {
        let (column, line) = (cell % columns, cell / columns);
        let around =
            |at: usize, count: usize| at.saturating_sub(CROWN_FADE)..(at + CROWN_FADE + 1).min(count);
        let (mut sum, mut number) = (0.0, 0.0);
        for line in around(line, lines) {
            for column in around(column, columns) {
                sum += covered[line * columns + column];
                number += 1.0;
            }
        }
        *open = 1.0 - sum / number;
    }
}

/// The weather of a step, at a time, without its wind.
pub(super) fn snow_step(weather: Option<&Weather>, dt_s: f64, time_s: f64) -> SnowStepBlock {
    let mut step: SnowStepBlock = bytemuck::Zeroable::zeroed();
    let Some(weather) = weather else { return step };
    let air_c = weather.air_c_at(time_s);
    let round_s = f64::from(SNOW_INTERVAL * SNOW_TURNS) * dt_s;
    let melts =
        |mm_day_c: f64| single(mm_day_c * air_c.max(0.0) * (round_s / 86_400.0) / f64::from(SNOW_WATER_MM));
    [step.melt_open, step.melt_woods] = MELT_MM_DAY_C.map(melts);
    step.settled = single(round_s / (3600.0 * settling_h(air_c)));
    let depth_m = f64::from(SNOW_WATER_MM) / 1000.0 * WATER_KG_M3 / fresh_kg_m3(air_c);
    let wet = (air_c + 1.0).clamp(0.0, 1.0);
    let lift = |[dry, wet_m_s]: [f64; 2]| single((dry + (wet_m_s - dry) * wet) * friction_per_wind());
    (step.lifts_fresh_m_s, step.lifts_old_m_s) = (lift(LIFTS_FRESH_M_S), lift(LIFTS_OLD_M_S));
    let exchange_s = round_s * f64::from(DRIFT_ROUNDS);
    let per_m = SALTATION * AIR_KG_M3 / GRAVITY_M_S2;
    let bears_kg_m2 = BEARS_KG_M2 * (BEARS_SHARE + BEARS_KG_M3 / fresh_kg_m3(air_c));
    step.branch_units_m2 = single(bears_kg_m2 / f64::from(SNOW_UNIT_KG));
    let warmth = (air_c - UNLOADS_FROM_C).max(0.0) / UNLOADS_C_S;
    step.branch_sheds = single(round_s * warmth);
    step.drift_units = single(per_m * exchange_s / cell_m() / f64::from(SNOW_WATER_MM));
    step.fresh_depth_q12 = word(libm::floor(depth_m / f64::from(SNOW_DEPTH_M) * 4096.0 + 0.5));
    step
}

/// Adds the wind over the snow to the weather of a step, by its friction velocity.
pub(super) fn blow_over(step: &mut SnowStepBlock, dt_s: f64, friction_m_s: f32) {
    let round_s = f64::from(SNOW_INTERVAL * SNOW_TURNS) * dt_s;
    step.drift_m_s = friction_m_s;
    step.branch_sheds += single(round_s * f64::from(friction_m_s) / friction_per_wind() / UNLOADS_M);
}

/// Friction velocity over snow per wind ten metres above it.
fn friction_per_wind() -> f64 {
    KARMAN / libm::log(WIND_HEIGHT_M / SNOW_ROUGHNESS_M)
}

/// Friction velocity in m/s over snow in the open, in a wind whose gusts are at so many times their strength.
pub(super) fn snow_friction(scene: &Scene, block: &SceneBlock, gust: f32) -> f32 {
    let wind = &block.wind;
    let grown = profile_factor(scene.wind.profile, WIND_HEIGHT_M, scene.wind.reference_height_m.into());
    let gusts = 1.0 + f64::from(gust) * f64::from(wind.gust_strength);
    single(f64::from(wind.mean_speed_m_s) * grown * gusts * friction_per_wind())
}

/// Snow in the open, where neither trees nor wind nor slopes take any of it away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OpenSnow {
    /// Water in mm.
    pub water_mm: f64,
    /// Depth in m.
    pub depth_m: f64,
}

/// Longest step in s in which it is followed.
const OPEN_STEP_S: f64 = 60.0;

/// Rows of the table of gusts from one round in which snow lies to the next: odd, so that rounds meet all of them in turn.
const LYING_GUST_ROWS: u32 = 37;

/// A step that stands for so many seconds of the wind, with the gusts of a row of their table, and the air of another, and of an exchange of drifting
/// snow: one of many rounds in which snow lies before time zero.
pub(super) fn lying_step(
    scene: &Scene,
    block: &SceneBlock,
    tables: &[Uint4],
    of: &StepBlock,
    round: u32,
    seconds: f64,
) -> StepBlock {
    let mut step = *of;
    let (exchange, turns) = (DRIFT_ROUNDS, SNOW_INTERVAL * SNOW_TURNS);
    let rounds = single(seconds / (f64::from(turns) * f64::from(scene.dt_s)));
    step.index = round * turns * exchange;
    for number in [&mut step.snow.melt_open, &mut step.snow.melt_woods, &mut step.snow.settled] {
        *number *= rounds;
    }
    step.snow.drift_units *= rounds / exchange as f32;
    let row = block.wind.first_gust_row + (round.wrapping_mul(LYING_GUST_ROWS) & (GUST_ROWS - 1));
    let Uint4([gust, ..]) = tables[row as usize];
    step.snow.drift_m_s = snow_friction(scene, block, f32::from_bits(gust));
    step
}

/// Snow that the weather alone leaves in the open at a time.
pub(super) fn open_snow(weather: &Weather, time_s: f64) -> OpenSnow {
    let depth_of = |water_mm: f64, kg_m3: f64| water_mm / kg_m3;
    let first_mm = f64::from(weather.lying_mm);
    let mut snow =
        OpenSnow { water_mm: first_mm, depth_m: depth_of(first_mm, fresh_kg_m3(weather.air_c_at(0.0))) };
    let mut now_s = -3600.0 * f64::from(weather.lying_h);
    while now_s < time_s {
        let until_s = if now_s < 0.0 { time_s.min(0.0) } else { time_s };
        let step_s = (until_s - now_s).min(OPEN_STEP_S);
        let air_c = weather.air_c_at(now_s + 0.5 * step_s);
        let falling_mm_h = if now_s < 0.0 { 0.0 } else { weather.snow_mm_h_at(now_s + 0.5 * step_s) };
        let fallen_mm = falling_mm_h * step_s / 3600.0;
        let melted_mm = (MELT_MM_DAY_C[0] * air_c.max(0.0) * step_s / 86_400.0).min(snow.water_mm);
        snow.depth_m *= 1.0 - if snow.water_mm > 0.0 { melted_mm / snow.water_mm } else { 0.0 };
        snow.water_mm -= melted_mm;
        let loose_m = (snow.depth_m - depth_of(snow.water_mm, OLD_KG_M3)).max(0.0);
        snow.depth_m -= loose_m * (1.0 - libm::exp(-step_s / (3600.0 * settling_h(air_c))));
        snow.water_mm += fallen_mm;
        snow.depth_m += depth_of(fallen_mm, fresh_kg_m3(air_c));
        now_s += step_s;
    }
    snow
}
