// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Drifting snow against the law of saltation, the winds at which it was observed, and the drifts at a wall.

use glam::{Vec2, Vec3};
use windfall_core::device::terrain::snow::{
    DRIFT_ROUNDS, SNOW_AGES, SNOW_CELLS_PER_M, SNOW_DEPTH_M, SNOW_INTERVAL, SNOW_TURNS, SNOW_WATER_MM,
};
use windfall_core::scene::{Litter, MeanSpeed, Object, ObjectShape, Profile, Scene, Weather, WindParameters};
use windfall_core::{Clock, World};

use crate::common::{steady_wind, still_scene, uniform_species};

/// Edge of a cell in m.
const CELL_M: f64 = 1.0 / SNOW_CELLS_PER_M as f64;

/// Snow on a strip along x, in a steady wind along it of so many m/s ten metres up.
fn strip(wind_m_s: f32, lying_mm: f32, length_m: f32) -> Scene {
    let weather = Weather {
        size_m: Vec2::new(length_m, 1.0),
        snow_mm_h: vec![(0.0, 0.0)],
        air_c: vec![(0.0, -5.0)],
        lying_mm,
        ..Weather::default()
    };
    let wind = WindParameters {
        speed: MeanSpeed::MetresPerSecond(wind_m_s),
        reference_height_m: 10.0,
        profile: Profile::Power { exponent: 0.15 },
        ..steady_wind(wind_m_s)
    };
    Scene { weather: Some(weather), wind, ..still_scene(uniform_species(), 1, 2.0) }
}

/// Takes the snow of a world through so many rounds in which wind takes it along, in the wind of time zero.
fn drift(world: &mut World, rounds: u32) {
    let compiled = world.compiled.clone();
    let step = compiled.step_block(&world.clock);
    let cx = compiled.context(&step);
    for _ in 0..rounds {
        let mut snow = world.bed.snow_mut(compiled.block());
        for turn in 0..SNOW_AGES {
            snow.exchange_around(&cx, turn);
            snow.exchange(&cx, turn);
        }
    }
}

/// Hours for which a round of drifting stands.
fn hours_per_round(scene: &Scene) -> f64 {
    f64::from(SNOW_INTERVAL * SNOW_TURNS * DRIFT_ROUNDS) * f64::from(scene.dt_s) / 3600.0
}

fn water(world: &World) -> u64 {
    world.bed.snow(world.compiled.block()).water.iter().copied().map(u64::from).sum()
}

/// Transport is 0.68 ρ u*t (u*² - u*t²) / (g u*) (Pomeroy and Gray 1990): what crosses the edge from a covered column to a bare one.
#[test]
fn snow_drifts_by_the_law_of_saltation() {
    for (wind_m_s, direction_deg) in [(9.0f32, 0.0f32), (14.0, 0.0), (14.0, 180.0), (14.0, 60.0)] {
        let mut scene = strip(wind_m_s, 200.0, 4.0);
        scene.wind.direction_deg = direction_deg;
        let mut world = World::build(&scene).expect("valid");
        let block = world.compiled.block();
        let (columns, lines) = (block.snow.columns as usize, block.snow.lines as usize);
        let covered = columns / 2;
        {
            let snow = world.bed.snow_mut(world.compiled.block());
            for cell in 0..columns * lines {
                if cell % columns != covered {
                    (snow.water[cell], snow.depth[cell]) = (0, 0);
                } else {
                    // As high as a cell may be without sliding.
                    snow.depth[cell] = snow.depth[cell].min(20_000);
                }
            }
        }
        let before = water(&world);
        let step = world.compiled.step_block(&world.clock);
        drift(&mut world, 1);
        assert_eq!(water(&world), before, "no water is lost");
        let snow = world.bed.snow(world.compiled.block());
        let of_column = |column: usize| {
            (0..lines).map(|line| u64::from(snow.water[line * columns + column])).sum::<u64>()
        };
        // What has left the column may have gone on.
        let beside = |side: std::ops::Range<usize>| side.map(of_column).sum::<u64>();
        let (ahead, behind) = (beside(covered + 1..columns), beside(0..covered));
        let (to, fro) = if direction_deg == 180.0 { (behind, ahead) } else { (ahead, behind) };
        assert_eq!((fro, to + of_column(covered)), (0, before), "none goes against the wind");
        let (speed, lifts) =
            (0.4 * f64::from(wind_m_s) / (10.0f64 / 0.0003).ln(), f64::from(step.snow.lifts_fresh_m_s));
        // The covered column is packed: fresh snow of less depth.
        let lifts = lifts.max(f64::from(step.snow.lifts_old_m_s));
        let kg_m_s = 0.68 * 1.25 / 9.81 * lifts * (speed * speed - lifts * lifts).max(0.0) / speed;
        let seconds = hours_per_round(&scene) * 3600.0;
        let along = f64::from(direction_deg).to_radians().cos().abs();
        let expected_mm = kg_m_s * along * seconds / CELL_M;
        let found_mm = to as f64 * f64::from(SNOW_WATER_MM) / lines as f64;
        assert!(
            (found_mm - expected_mm).abs() < 0.01 * expected_mm + 3e-4,
            "{wind_m_s} m/s: {found_mm} mm, {expected_mm} expected"
        );
        assert!(wind_m_s < 12.0 || found_mm > 0.02, "a gale takes it along");
    }
}

/// Dry snow drifts from 7.7 m/s on, wet snow from 9.9 (Li and Pomeroy 1997, means); level snow in the open loses as much as it gets.
#[test]
fn snow_drifts_from_the_winds_observed() {
    for (wind_m_s, air_c, drifts) in
        [(7.5f32, -5.0f32, false), (8.0, -5.0, true), (9.5, 1.0, false), (10.3, 1.0, true)]
    {
        let mut scene = strip(wind_m_s, 5.0, 4.0);
        scene.weather.as_mut().expect("stated").air_c = vec![(0.0, air_c)];
        let mut world = World::build(&scene).expect("valid");
        // A gap, into which it drifts.
        let columns = world.compiled.block().snow.columns as usize;
        {
            let snow = world.bed.snow_mut(world.compiled.block());
            for cell in (0..snow.water.len()).filter(|cell| cell % columns == 9) {
                (snow.water[cell], snow.depth[cell]) = (snow.water[cell] / 2, snow.depth[cell] / 2);
            }
        }
        let before: Vec<u32> = world.bed.snow(world.compiled.block()).water.to_vec();
        drift(&mut world, 20);
        let after = world.bed.snow(world.compiled.block()).water;
        assert_eq!(after != before, drifts, "{wind_m_s} m/s at {air_c} °C");
    }
    let mut world = World::build(&strip(15.0, 5.0, 6.0)).expect("valid");
    let before: Vec<u32> = world.bed.snow(world.compiled.block()).water.to_vec();
    drift(&mut world, 50);
    let after = world.bed.snow(world.compiled.block()).water;
    let worst = before.iter().zip(after).map(|(before, after)| before.abs_diff(*after)).max();
    assert!(worst < Some(before[0] / 50), "level snow stays level: {worst:?} of {}", before[0]);
}

/// A solid wall across the wind has a drift in front of it and one behind that fills its lee from the wall on, to its height and not above; farther behind
/// the ground is swept. What leaves the strip comes in again, and no water is lost.
#[test]
fn walls_have_drifts_before_and_behind_them() {
    let high_m = 0.5;
    let mut scene = strip(16.0, 40.0, 40.0);
    scene.dt_s = 0.05;
    scene.weather.as_mut().expect("stated").center_m = Vec2::new(6.0, 0.0);
    let shape = ObjectShape::Box { size_m: Vec3::new(0.05, high_m, 40.0) };
    scene.objects = vec![Object { shape, at_m: Vec3::Y * (0.5 * high_m), ..Object::default() }];
    scene.ground.litter = Some(Litter { size_m: Vec2::splat(2.0), ..Litter::default() });
    let mut world = World::build(&scene).expect("valid");
    let before = water(&world);
    let mut rounds = 0;
    while f64::from(rounds) * hours_per_round(&scene) < 5.0 {
        drift(&mut world, 100);
        rounds += 100;
    }
    assert_eq!(water(&world), before, "no water is lost");
    let block = world.compiled.block();
    let snow = world.bed.snow(block);
    let columns = block.snow.columns as usize;
    // Depth in heights of the wall, so many of them behind it, in the middle line.
    let depth = |heights: f64| {
        let column = ((heights * f64::from(high_m) - (6.0 - 20.0)) / CELL_M).floor();
        let cell = (0..columns).find(|cell| *cell as f64 >= column).expect("on the strip") + 4 * columns;
        f64::from(snow.depth[cell]) * f64::from(SNOW_DEPTH_M) / f64::from(high_m)
    };
    let open = depth(-20.0);
    assert!((0.25..0.4).contains(&open), "40 mm at -5 °C: {open}");
    assert!(depth(-1.0) > 2.0 * open, "a drift before the wall: {}", depth(-1.0));
    let lee: Vec<f64> = (1..=30u8).map(|heights| depth(heights.into())).collect();
    let deepest = lee.iter().copied().fold(0.0, f64::max);
    assert!((0.85..1.05).contains(&deepest), "the lee is filled: {lee:.2?}");
    let length = lee.iter().take_while(|depth| **depth > 1.5 * open).count();
    assert!((4..=8).contains(&length), "over {length} heights: {lee:.2?}");
    let swept = lee.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(swept < 0.3 * open, "beyond it is swept: {lee:.2?}");
}

/// Behind a fence of which half is open a drift grows until it has filled the lee: 20 to 35 heights long, at most 1.2 deep, with a section of 14 to
/// 24 heights squared, as Tabler (1980) measured of 50 % fences, 30, 1.2 and 19.3.
#[test]
fn fences_fill_as_tabler_measured() {
    let high_m = 0.4;
    let (wind_m_s, middle_m, length_m) = (22.0, 5.0, 60.0);
    let mut scene = strip(wind_m_s, 24.0, length_m);
    scene.dt_s = 0.05;
    scene.weather.as_mut().expect("stated").center_m = Vec2::new(middle_m, 0.0);
    let shape = ObjectShape::Box { size_m: Vec3::new(0.05, high_m, 40.0) };
    scene.objects = vec![Object { shape, at_m: Vec3::Y * (0.5 * high_m), open: 0.5, ..Object::default() }];
    scene.ground.litter = Some(Litter { size_m: Vec2::splat(2.0), ..Litter::default() });
    let mut world = World::build(&scene).expect("valid");
    let before = water(&world);
    // Section and length of the drift behind the fence, and its greatest depth, in heights.
    let drift_of = |world: &World| {
        let block = world.compiled.block();
        let snow = world.bed.snow(block);
        let columns = block.snow.columns as usize;
        let first_m = f64::from(middle_m) - 0.5 * f64::from(length_m);
        let lee = (0..columns).filter_map(|column| {
            let behind = (first_m + (column as f64 + 0.5) * CELL_M) / f64::from(high_m);
            let depth =
                f64::from(snow.depth[4 * columns + column]) * f64::from(SNOW_DEPTH_M) / f64::from(high_m);
            (0.2 < behind && behind < 60.0).then_some((behind, depth))
        });
        let lee: Vec<_> = lee.collect();
        let section = lee.iter().map(|(_, depth)| depth * CELL_M / f64::from(high_m)).sum::<f64>();
        let length =
            lee.iter().filter(|(_, depth)| *depth > 0.05).map(|(behind, _)| *behind).fold(0.0, f64::max);
        (section, length, lee.iter().map(|(_, depth)| *depth).fold(0.0, f64::max))
    };
    let mut sections = Vec::new();
    for _ in 0..6 {
        drift(&mut world, 2400);
        sections.push(drift_of(&world).0);
    }
    assert_eq!(water(&world), before, "no water is lost");
    let (section, length, deepest) = drift_of(&world);
    println!(
        "{} h: {sections:.2?}, {length:.1} heights long, {deepest:.2} deep",
        5.0 * 2400.0 * hours_per_round(&scene)
    );
    assert!(
        sections[2] < 0.93 * section && section < 1.05 * sections[4],
        "it fills, and then is full: {sections:?}"
    );
    assert!((14.0..24.0).contains(&section), "section {section}");
    assert!((20.0..35.0).contains(&length) && deepest < 1.2, "{length} heights long, {deepest} deep");
}

/// Snow that has lain in a gusty wind for an hour before time zero has drifted as snow does in an hour of steps.
#[test]
fn snow_that_has_lain_has_drifted() {
    let shape = ObjectShape::Box { size_m: Vec3::new(0.1, 0.5, 4.0) };
    let object = Object { shape, at_m: Vec3::Y * 0.25, ..Object::default() };
    // In 10.5 m/s packed snow drifts in gusts alone, a few of which do most of it.
    for (wind_m_s, gusts, within) in [(14.0, 0.0, 0.15), (10.5, 0.5, 0.3)] {
        let mut scene = strip(wind_m_s, 10.0, 12.0);
        scene.objects = vec![object.clone()];
        scene.ground.litter = Some(Litter { size_m: Vec2::splat(2.0), ..Litter::default() });
        let lain = |gusts: f32| {
            let mut scene = scene.clone();
            scene.wind.gusts.strength = gusts;
            scene.weather.as_mut().expect("stated").lying_h = 1.0;
            World::build(&scene).expect("valid")
        };
        let (lain, in_mean_wind) = (lain(gusts), lain(0.0));
        scene.wind.gusts.strength = gusts;
        let mut drifted = World::build(&scene).expect("valid");
        let before = water(&drifted);
        let steps_per_round = SNOW_INTERVAL * SNOW_TURNS * DRIFT_ROUNDS;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1500 rounds")]
        let rounds = (1.0 / hours_per_round(&scene)) as u32;
        for round in 0..rounds {
            let step = round * steps_per_round;
            let travel_m = f64::from(wind_m_s) * f64::from(step) * f64::from(scene.dt_s);
            drifted.clock = Clock::at(step, scene.dt_s, travel_m);
            drift(&mut drifted, 1);
        }
        assert_eq!((water(&lain), before), (before, water(&drifted)), "no water is lost");
        let mm = |world: &World| -> Vec<f64> {
            let water = world.bed.snow(world.compiled.block()).water;
            water.iter().map(|units| f64::from(*units) * f64::from(SNOW_WATER_MM)).collect()
        };
        let drifted = mm(&drifted);
        let off = |world: &World| {
            mm(world).iter().zip(&drifted).map(|(a, b)| (a - b).abs()).sum::<f64>() / drifted.len() as f64
        };
        let moved = drifted.iter().map(|mm| (mm - 10.0).abs()).sum::<f64>() / drifted.len() as f64;
        let (off, in_mean_wind) = (off(&lain), off(&in_mean_wind));
        println!(
            "{wind_m_s} m/s, gusts of {gusts}: off by {off:.3} mm of {moved:.3} mm, in the mean wind by {in_mean_wind:.3}"
        );
        assert!(moved > 1.0 && off < within * moved, "{wind_m_s} m/s: {off} mm of {moved} mm");
        assert!(
            gusts == 0.0 || off < 0.6 * in_mean_wind,
            "gusts count: {off} mm, without them {in_mean_wind} mm"
        );
    }
}
