// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Snow on branches: against the law of interception, books to the unit, and limbs that bend beneath it.

use glam::{Vec2, Vec3};
use windfall_core::blocks::NEVER;
use windfall_core::device::particle::record::{PARTICLE_ALIVE, particle_state};
use windfall_core::device::terrain::snow::{
    SNOW_AGES, SNOW_INTERVAL, SNOW_TURNS, SNOW_UNIT_KG, SNOW_WATER_MM,
};
use windfall_core::device::tree::branch_snow::{CROWN_TURN, branch_catch};
use windfall_core::litter::{flakes_of, has_landed, lies_on};
use windfall_core::scene::{
    Air, Foliage, Meets, ParticleRelease, Particles, Scene, Spread, Tree, TreeForm, TreeKind, TreePreset,
};
use windfall_core::{Clock, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};

use super::snow::snowy;
use crate::common::steady_wind;

/// Edge in m of the square on which snow lies, around the tree.
const EDGE_M: f32 = 16.0;

/// Snowfall on an oak in leaf, and all around it.
fn oak_in_snow(mm_h: f32, air_c: f32, leaf_area_index: f32) -> Scene {
    let mut scene = snowy(mm_h, air_c, EDGE_M, 6000);
    let foliage = Foliage { species: Some("maple".into()), leaf_area_index, ..Foliage::default() };
    scene.tree_kinds = vec![TreeKind {
        name: "oak".into(),
        form: TreeForm::Preset(TreePreset::Oak),
        foliage,
        ..TreeKind::default()
    }];
    scene.trees = vec![Tree { kind: "oak".into(), age: 0.5, leaves: 1500, ..Tree::default() }];
    scene.autumn = 0.0;
    scene
}

fn sum(words: &[u32]) -> u64 {
    words.iter().copied().map(u64::from).sum()
}

/// Lets so much snow in mm come down evenly, over so many rounds, on branches at rest.
fn snow_down(world: &mut World, fallen_mm: f64, rounds: u32) {
    let compiled = world.compiled.clone();
    let mut step = compiled.step_block(&Clock::new(compiled.scene().dt_s));
    let block = *compiled.block();
    let units = fallen_mm / f64::from(SNOW_WATER_MM) * f64::from(block.snow.columns * block.snow.lines);
    let flakes = units / f64::from(block.snow.flake_water);
    let mut number = 0_u32;
    for round in 0..rounds {
        step.index = round * SNOW_INTERVAL * SNOW_TURNS;
        while f64::from(number) < flakes * f64::from(round + 1) / f64::from(rounds) {
            // Places of low discrepancy (the additive sequence of the plastic number).
            #[expect(clippy::cast_possible_truncation, reason = "a place on the square")]
            let at = |share: f64| ((f64::from(number) * share).fract() as f32 - 0.5) * EDGE_M;
            world.bed.land_flake(&compiled.context(&step), at(0.754_877_666_2), at(0.569_840_291_0));
            number += 1;
        }
        step.index += SNOW_INTERVAL * CROWN_TURN;
        world.bed.add_branches(&compiled.context(&step));
        step.index += SNOW_INTERVAL * (SNOW_AGES - CROWN_TURN);
        let cx = compiled.context(&step);
        world.bed.step_branch_snow(&cx, &world.branches);
        world.bed.fall_through_crowns(&cx);
        step.index += SNOW_INTERVAL;
        world.bed.clear_crowns(&compiled.context(&step));
    }
}

/// Crowns catch `I* (1 - exp(-C P/I*))` of a fall P (Hedstrom and Pomeroy 1998), C being the share of the sky that they cover and I* what their leaves and
/// wood bear, 5.9 (0.27 + 46/ρ) kg/m²: with a leaf area index of 4 most of 10 mm, less of what comes later, and less where fewer leaves hang.
#[test]
fn crowns_hold_what_the_law_of_interception_says() {
    let mut held_before = 0.0;
    for (leaf_area_index, fallen_mm) in [(4.0, 10.0), (4.0, 40.0), (1.5, 10.0)] {
        let mut world = World::build(&oak_in_snow(5.0, -10.0, leaf_area_index)).expect("valid");
        let block = *world.compiled.block();
        let (start, cells) = (world.compiled.step_block(&world.clock), block.snow.columns * block.snow.lines);
        snow_down(&mut world, fallen_mm, 200);
        let held_kg = sum(world.bed.branch_snow(&block)) as f64 * f64::from(SNOW_UNIT_KG);

        // The law, square metre by square metre.
        let cx = world.compiled.context(&start);
        let squares = (block.snow.columns / 8 * (block.snow.lines / 8)) as usize;
        let square_of = |cell: u32| {
            let (column, line) = (cell % block.snow.columns, cell / block.snow.columns);
            (line / 8 * (block.snow.columns / 8) + column / 8) as usize
        };
        let (mut room_kg, mut covered_m2) = (vec![0.0; squares], vec![0.0; squares]);
        for row in 0..block.snow.branches {
            let catch = branch_catch(&cx, row);
            let axis = glam::Quat::from_array(world.branches.pose[row as usize]) * Vec3::Y;
            let area_m2 = f64::from(catch.wood_m2 * (1.0 - axis.y * axis.y))
                + f64::from(catch.leaf_m2) * f64::from(world.branches.leaf_count[row as usize]);
            let fresh_kg_m3 = 62.0 + 25.0 * (-10.0_f64 / 2.6).exp();
            room_kg[square_of(catch.cell)] += 5.9 * (0.27 + 46.0 / fresh_kg_m3) * area_m2;
        }
        for cell in 0..cells {
            let open = lies_on(&cx, cell).open;
            covered_m2[square_of(cell)] += f64::from(1.0 - open) / 64.0;
        }
        // Squares that are shifted share what falls with their neighbours: more than each by itself, less than one for all.
        let caught =
            |room_kg: f64, covered_m2: f64| room_kg * (1.0 - (-covered_m2 * fallen_mm / room_kg).exp());
        let apart: f64 = (room_kg.iter().zip(&covered_m2))
            .filter(|(room_kg, _)| **room_kg > 0.0)
            .map(|(room_kg, covered_m2)| caught(*room_kg, *covered_m2))
            .sum();
        let as_one = caught(room_kg.iter().sum(), covered_m2.iter().sum());
        println!("{held_kg:.1} kg; by the law {apart:.1} to {as_one:.1} kg");
        assert!(
            as_one < 1.25 * apart && (0.98 * apart..1.02 * as_one).contains(&held_kg),
            "LAI {leaf_area_index}, {fallen_mm} mm: {held_kg} kg for {apart} to {as_one}"
        );
        let below: f64 = covered_m2.iter().sum::<f64>() * fallen_mm;
        let share = held_kg / below;
        println!("LAI {leaf_area_index}, {fallen_mm} mm: {held_kg:.1} kg of {below:.1}: {share:.3}");
        match (leaf_area_index, fallen_mm) {
            (4.0, 10.0) => assert!((0.6..0.9).contains(&share), "of 10 mm: {share}"),
            (4.0, _) => assert!(share < 0.6 && held_kg > held_before, "of what comes later less: {share}"),
            _ => assert!(held_kg < 0.85 * held_before, "fewer leaves hold less: {share}"),
        }
        held_before = if fallen_mm > 20.0 { held_before } else { held_before.max(held_kg) };
    }
}

/// In a storm over a tree, warm enough for snow to fall from its branches, all water is that on the ground, on branches and in crowns, to the unit,
/// whether it comes down from there at once or as particles.
#[test]
fn no_water_is_lost_in_crowns() {
    let mut scene = oak_in_snow(30.0, 1.5, 4.0);
    scene.wind = steady_wind(9.0);
    water_is_kept(&scene);
    scene.particles.push(falls(500));
    let fallen = water_is_kept(&scene);
    let stats = &fallen.particle_stats()[1];
    assert!(stats.born > 8 && stats.died > 8, "snow falls from branches: {stats:?}");
}

/// Snow that falls from branches as so many particles.
fn falls(count: u32) -> Particles {
    Particles {
        name: "falls".into(),
        count,
        release: ParticleRelease::BranchSnow,
        life_s: Some(Spread::Constant(8.0)),
        size_m: Spread::Constant(0.03),
        density_kg_m3: 100.0,
        air: Air::Settling { m_s: Spread::Constant(4.0) },
        meets: Meets::Die,
        ..Particles::default()
    }
}

/// Steps a storm over a tree, and checks the books of its water after each step.
fn water_is_kept(scene: &Scene) -> World {
    let world = World::build(scene).expect("valid");
    let mut cpu = CpuSimulator::new(&world, CpuOptions::default()).expect("threads start");
    let mut state = world.clone();
    let half_m = 0.5 * EDGE_M;
    let (mut fallen, mut most_held, mut most_falling) = (0_u64, 0, 0.0_f64);
    for step in 0..1500_u32 {
        cpu.step(1).expect("the CPU steps");
        cpu.read_state(&mut state).expect("the same world");
        let block = state.compiled.block();
        let inside = |place: &[f32; 3]| place[0].abs() < half_m && place[2].abs() < half_m;
        let landed =
            flakes_of(block, &state.particles).iter().filter(|at| has_landed(at) && inside(&at.position));
        fallen += landed.count() as u64 * u64::from(block.snow.flake_water);
        let stats = state.snow_stats().expect("there is snow");
        let (snow, held) = (state.bed.snow(block), sum(state.bed.branch_snow(block)));
        let in_air = f64::from(stats.flakes) * f64::from(block.snow.flake_water);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "units of water")]
        let in_crowns = (stats.falling_kg / f64::from(SNOW_UNIT_KG) - in_air).round() as u64;
        assert_eq!(
            sum(snow.landed) + held + in_crowns,
            fallen,
            "step {step}: as many units as have come down"
        );
        assert_eq!(
            sum(snow.water) + sum(snow.melted),
            sum(snow.landed),
            "step {step}: it lies or has melted"
        );
        most_held = most_held.max(held);
        most_falling = most_falling.max(in_crowns as f64);
    }
    assert!(most_held > fallen / 20 && most_falling > 0.0, "much is caught: {most_held} of {fallen}");
    state
}

/// Snow that falls from a branch as a particle begins there, is as much as the branch has lost, and comes to lie where it lands.
#[test]
fn snow_falls_from_where_it_lay() {
    let mut scene = oak_in_snow(0.0, -10.0, 4.0);
    scene.particles[0].count = 1;
    scene.particles.push(falls(4000));
    let mut world = World::build(&scene).expect("valid");
    let block = *world.compiled.block();
    let compiled = world.compiled.clone();
    let cx_step = compiled.step_block(&world.clock);
    let cx = compiled.context(&cx_step);
    // Ten times what the highest segment bears: it slides off.
    let middle_m = |row: u32| {
        let [x, y, z, _] = world.branches.base[row as usize];
        0.5 * (Vec3::new(x, y, z) + end_m(&world, row as usize))
    };
    let height_m = |row: u32| middle_m(row).y;
    let rows = (0..block.snow.branches).filter(|row| branch_catch(&cx, *row).cell != NEVER);
    let row = rows.max_by(|a, b| height_m(*a).total_cmp(&height_m(*b))).expect("segments");
    let start_m = middle_m(row);
    world.bed.branch_snow_mut(&block).held[row as usize] = 100_000;
    let ground = sum(world.bed.snow(&block).landed);
    let mut state = world.clone();
    let mut cpu = CpuSimulator::new(&world, CpuOptions::default()).expect("threads start");
    let mut first = None;
    for _ in 0..400 {
        cpu.step(1).expect("the CPU steps");
        cpu.read_state(&mut state).expect("the same world");
        let slot = 1 + row as usize % 4000;
        let place = &state.particles.place[slot];
        if first.is_none() && particle_state(place.bits) == PARTICLE_ALIVE {
            let falling = state.bed.branch_snow_mut(&block).falls[row as usize];
            let held = state.bed.branch_snow_mut(&block).held[row as usize];
            assert_eq!(falling + held, 100_000, "as much as the branch has lost");
            assert!(falling > 50_000, "what it does not bear: {falling}");
            first = Some((Vec3::from_array(place.position), falling));
        }
    }
    let (begins_m, fallen) = first.expect("it falls");
    assert!(begins_m.distance(start_m) < 0.3, "{begins_m} from {start_m}");
    assert_eq!(state.particle_stats()[1].born, state.particle_stats()[1].died, "it has come down");
    let landed = sum(state.bed.snow(&block).landed) - ground;
    assert!(landed >= u64::from(fallen), "and lies: {landed} of {fallen}");
}

/// Place of the end of the segment in a row.
fn end_m(world: &World, row: usize) -> Vec3 {
    let [x, y, z, _] = world.branches.base[row];
    let length = world.compiled.forest().segments()[row].length;
    Vec3::new(x, y, z) + glam::Quat::from_array(world.branches.pose[row]) * (Vec3::Y * length)
}

/// Limbs sink beneath snow, the deeper the more of it they bear, and lose it in the thaw at the rate of the law.
#[test]
fn snow_bends_limbs_until_it_falls() {
    let settled = |fallen_mm: f64, air_c: f32, seconds: f32| {
        let mut scene = oak_in_snow(0.0, air_c, 4.0);
        scene.particles[0].count = 1;
        scene.weather.as_mut().expect("stated").snow_mm_h = vec![(0.0, 0.0)];
        let mut world = World::build(&scene).expect("valid");
        // The end that reaches farthest from the trunk at rest.
        let far = |row: &usize| {
            let end = end_m(&world, *row);
            Vec2::new(end.x, end.z).length()
        };
        let tip = (0..world.branches.base.len()).max_by(|a, b| far(a).total_cmp(&far(b))).expect("segments");
        if fallen_mm > 0.0 {
            let block = *world.compiled.block();
            let start = world.compiled.step_block(&world.clock);
            let compiled = world.compiled.clone();
            let cx = compiled.context(&start);
            let held = world.bed.branch_snow_mut(&block).held;
            for (row, held) in (0..).zip(held) {
                let catch = branch_catch(&cx, row);
                let leaf_m2 = catch.leaf_m2 * world.branches.leaf_count[row as usize] as f32;
                #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "units of water")]
                let units = (f64::from(leaf_m2) * fallen_mm / f64::from(SNOW_UNIT_KG)) as u32;
                *held = units;
            }
        }
        let before = sum(world.bed.branch_snow(world.compiled.block()));
        let mut cpu = CpuSimulator::new(&world, CpuOptions::default()).expect("threads start");
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "some thousand steps")]
        let steps = (seconds / scene.dt_s) as u32;
        cpu.step(steps).expect("the CPU steps");
        cpu.read_state(&mut world).expect("the same world");
        let after = sum(world.bed.branch_snow(world.compiled.block()));
        (end_m(&world, tip).y, after as f64 / (before.max(1)) as f64)
    };
    let (bare_m, _) = settled(0.0, -10.0, 20.0);
    let (light_m, kept) = settled(0.2, -10.0, 20.0);
    let (heavy_m, _) = settled(0.6, -10.0, 20.0);
    println!("{bare_m} {light_m} {heavy_m} {kept}");
    assert!(kept > 0.95, "in frost and calm it stays: {kept}");
    let (little_m, much_m) = (bare_m - light_m, bare_m - heavy_m);
    assert!(little_m > 0.02 && much_m > 1.8 * little_m, "they sink by {little_m} and {much_m} m");
    let (_, kept) = settled(0.2, 6.0, 600.0);
    // (6 + 3) / 1.87e5 per second (Roesch et al. 2001).
    let expected = (-600.0 * 9.0 / 1.87e5_f64).exp();
    assert!((kept - expected).abs() < 0.01, "in the thaw it falls: {kept}, {expected} expected");
}
