// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Tier 0: petioles break as often as the model says, and where a leaf comes off nothing jumps.

#![expect(clippy::cast_possible_truncation, reason = "numbers of a test, small")]

use crate::common::GRAVITY;
use std::time::Instant;

use glam::{Quat, Vec3};
use windfall_core::Simulator;
use windfall_core::World;
use windfall_core::device::leaf::carry::shed_chance;
use windfall_core::device::leaf::fall::response_of;
use windfall_core::device::leaf::petiole::{SHED_INTERVAL, petiole_of, petiole_strength};
use windfall_core::device::leaf::record::size_ratio;
use windfall_core::device::wind::sample::wind_at;
use windfall_core::leaf::{LEAF_BYTES, LeafState, Petiole};
use windfall_core::scene::{Gusts, MeanSpeed, Profile, STANDARD_GRAVITY_M_S2, Scene, Tree, Turbulence};
use windfall_core::tree::record::NO_SEGMENT;
use windfall_cpu::{CpuOptions, CpuSimulator};

/// Twigs in a steady wind hardly move, and rates are per second, so that long steps shed as short ones do.
const LONG_STEP_S: f32 = 1.0 / 20.0;
/// Middles of four equal shares of the normal distribution: its quantiles at 1/8, 3/8, 5/8 and 7/8.
const OCTILES: [f64; 4] = [-1.1503, -0.3186, 0.3186, 1.1503];

/// A tree in a wind that is the same everywhere and always.
fn scene(kind: &str, leaves: u32, autumn: f32, speed_m_s: f32) -> Scene {
    let mut scene = Scene {
        dt_s: LONG_STEP_S,
        trees: vec![Tree { kind: kind.into(), leaves, ..Tree::default() }],
        autumn,
        ..Scene::default()
    };
    scene.sources.clear();
    scene.wind.speed = MeanSpeed::MetresPerSecond(speed_m_s);
    scene.wind.profile = Profile::Uniform;
    scene.wind.gusts = Gusts { strength: 0.0, interval_s: 8.0 };
    scene.wind.turbulence = Turbulence { intensity: 0.0, ..Turbulence::default() };
    scene
}

fn world(scene: &Scene) -> World {
    World::build(scene).expect("a valid scene")
}

fn attached(world: &World) -> usize {
    world.leaves.place.iter().filter(|place| place.state() == LeafState::Attached).count()
}

/// The state after so many steps.
fn stepped(world: &World, steps: u32) -> World {
    let mut after = world.clone();
    let mut simulator = CpuSimulator::new(world, CpuOptions::default()).expect("threads start");
    simulator.step(steps).expect("the CPU steps");
    simulator.read_state(&mut after).expect("same size");
    after
}

/// Leaves that come off in so many seconds.
fn shed(scene: &Scene, seconds: f64) -> usize {
    let before = world(scene);
    let after = stepped(&before, (seconds / f64::from(scene.dt_s)).round() as u32);
    attached(&before) - attached(&after)
}

fn petioles(world: &World) -> Vec<Petiole> {
    let block = world.compiled.step_block(&world.clock);
    let cx = world.compiled.context(&block);
    (0..world.compiled.scene().tree_leaf_count()).map(|slot| petiole_of(&cx, slot)).collect()
}

/// The model, written down once more: rate per second at which the petioles of a class break in air of that speed.
fn model_rate_per_s(scene: &Scene, class: u32, speed_m_s: f64) -> f64 {
    let kind = scene.tree_kind(&scene.trees[0].kind).expect("a preset");
    let (foliage, species) = (&kind.foliage, &scene.species[0]);
    let share = (f64::from(class / 4) + 0.5) / 16.0;
    let turned = 0.5 + 0.1 * (share / (1.0 - share)).ln();
    let weakened = 6.0 / (1.0 + (-(f64::from(scene.autumn) - turned) / 0.05).exp());
    let spread = 0.5 * OCTILES[class as usize % 4];
    let strength = f64::from(foliage.strength_n) * (spread - weakened).exp();
    let radius = 0.5 * f64::from(species.size_m);
    let area = std::f64::consts::PI * radius * radius;
    let weight = area * f64::from(species.areal_density_kg_m2) * GRAVITY;
    let drag = 0.5 * 1.2 * f64::from(foliage.drag) * area * speed_m_s * speed_m_s
        / (1.0 + speed_m_s / f64::from(foliage.yield_m_s));
    let load = weight + drag;
    (weakened - 4.0).exp() / 86_400.0 * ((load / strength - 1.0) / 0.15).exp()
}

#[test]
fn the_table_of_chances_is_the_model() {
    for autumn in [0.3, 0.5, 0.7, 0.9] {
        let scene = scene("maple", 1500, autumn, 0.0);
        let world = world(&scene);
        let block = world.compiled.step_block(&world.clock);
        let cx = world.compiled.context(&block);
        let interval_s = f64::from(SHED_INTERVAL) * f64::from(scene.dt_s);
        let mut checked = 0;
        for petiole in petioles(&world) {
            let class = petiole_strength(petiole.bits);
            for speed in [0.0, 3.0, 7.0, 12.0, 20.0, 31.0] {
                let chance = f64::from(shed_chance(&cx, petiole.bits, speed as f32)) / 2f64.powi(32);
                let rate = -(1.0 - chance).ln() / interval_s;
                let model = model_rate_per_s(&scene, class, speed);
                // Rates below the resolution of a word, and above those of a break at the next sample, are cut off.
                if (1e-7..10.0).contains(&model) {
                    assert!((rate / model - 1.0).abs() < 0.02, "{class}, {speed} m/s: {rate}, {model}");
                    checked += 1;
                }
            }
        }
        assert!(checked > 300, "autumn {autumn}: {checked} rates compared");
    }
}

#[test]
fn counts_agree_with_the_rates_within_the_error_of_counting() {
    let mut counted = 0;
    for (autumn, speed_m_s) in [(0.55, 4.5), (0.6, 8.5), (0.5, 12.5), (0.45, 16.5), (0.65, 5.5)] {
        let scene = scene("bush", 20_000, autumn, speed_m_s);
        // The tree bends into the wind first.
        let before = stepped(&world(&scene), 500);
        let seconds = 90.0;
        let after = stepped(&before, (seconds / LONG_STEP_S) as u32);
        let block = before.compiled.step_block(&before.clock);
        let cx = before.compiled.context(&block);
        let looks = f64::from(seconds / LONG_STEP_S) / f64::from(SHED_INTERVAL);
        let hanging = before.leaves.place.iter().zip(petioles(&before));
        let hanging = hanging.filter(|(place, _)| place.state() == LeafState::Attached);
        let gone: Vec<f64> = hanging
            .map(|(_, petiole)| {
                let chance = f64::from(shed_chance(&cx, petiole.bits, speed_m_s)) / 2f64.powi(32);
                1.0 - (1.0 - chance).powf(looks)
            })
            .collect();
        let expected: f64 = gone.iter().sum();
        let deviation = gone.iter().map(|share| share * (1.0 - share)).sum::<f64>().sqrt();
        let found = attached(&before) as f64 - attached(&after) as f64;
        println!("autumn {autumn}, {speed_m_s} m/s: {found} of {expected:.1} ± {deviation:.1}");
        assert!(
            (found - expected).abs() < 4.0 * deviation + 1.0,
            "autumn {autumn}, {speed_m_s} m/s: {found} leaves, {expected} ± {deviation} expected"
        );
        counted += found as usize;
    }
    assert!(counted > 150, "leaves have come off: {counted}");
}

#[test]
fn summer_leaves_stay_in_still_air() {
    let still = scene("berry-bush", 3000, 0.0, 0.0);
    let before = world(&still);
    assert!(attached(&before) > 1000, "leaves hang: {}", attached(&before));
    assert_eq!(shed(&still, 3600.0), 0, "an hour");
}

#[test]
fn later_in_the_year_and_in_stronger_wind_more_come_off() {
    let share = |autumn, speed_m_s| {
        let scene = scene("bush", 3000, autumn, speed_m_s);
        shed(&scene, 60.0) as f64 / attached(&world(&scene)) as f64
    };
    for speed_m_s in [5.5, 14.5] {
        let season = [0.0, 0.35, 0.55, 0.75].map(|autumn| share(autumn, speed_m_s));
        println!("{speed_m_s} m/s by season: {season:?}");
        assert!(season.is_sorted() && season[0] == 0.0 && season[3] > 0.03, "{speed_m_s} m/s: {season:?}");
    }
    for autumn in [0.45, 0.6] {
        let wind = [0.0, 5.5, 10.5, 15.5, 22.5].map(|speed_m_s| share(autumn, speed_m_s));
        println!("autumn {autumn} by wind: {wind:?}");
        assert!(wind.is_sorted() && wind[4] > wind[1] + 0.02, "autumn {autumn}: {wind:?}");
    }
}

#[test]
fn gusts_take_what_lulls_leave() {
    let steady = scene("bush", 3000, 0.5, 9.5);
    let mut gusty = steady.clone();
    gusty.wind.gusts.strength = 0.8;
    let mut simulator = CpuSimulator::new(&world(&gusty), CpuOptions::default()).expect("threads start");
    let start = world(&gusty);
    let mut now = start.clone();
    let mut looks: Vec<(f32, usize)> = Vec::new();
    let middle = Vec3::new(0.0, 2.0, 0.0);
    let mut hanging = attached(&now);
    for _ in 0..900 {
        let block = now.compiled.step_block(&now.clock);
        let cx = now.compiled.context(&block);
        let air = wind_at(&cx, windfall_core::arith::Vec3::new(middle.x, middle.y, middle.z));
        simulator.step(2).expect("the CPU steps");
        simulator.read_state(&mut now).expect("same size");
        let left = attached(&now);
        looks.push((air.x.hypot(air.z), hanging - left));
        hanging = left;
    }
    let mean = looks.iter().map(|(speed, _)| speed).sum::<f32>() / looks.len() as f32;
    looks.sort_by(|a, b| a.0.total_cmp(&b.0));
    let sum = |part: &[(f32, usize)]| part.iter().map(|(_, shed)| shed).sum::<usize>();
    let (lulls, gusts) = (sum(&looks[..300]), sum(&looks[600..]));
    let all = attached(&start) - attached(&now);
    let even = shed(&steady, 90.0);
    println!("mean {mean} m/s: {lulls} in lulls, {gusts} in gusts, {all} in all, {even} in a steady wind");
    assert!((mean / 9.5 - 1.0).abs() < 0.12, "gusts leave the mean as it is: {mean} m/s");
    assert!(gusts > 2 * lulls && gusts > 30, "{gusts} in the upper third, {lulls} in the lower");
    assert!(all > even, "{all} in gusts, {even} in a steady wind of the same mean");
}

#[test]
fn nothing_jumps_where_a_leaf_comes_off() {
    let mut scene = scene("maple", 3000, 0.7, 9.0);
    scene.dt_s = 1.0 / 60.0;
    scene.wind.gusts.strength = 0.5;
    scene.wind.turbulence.intensity = 0.2;
    let dt = scene.dt_s;
    let mut before = world(&scene);
    let mut simulator = CpuSimulator::new(&before, CpuOptions::default()).expect("threads start");
    let (mut breaks, mut worst, mut turned) = (0, 0f32, 0f32);
    for _ in 0..600 {
        let mut after = before.clone();
        simulator.step(1).expect("the CPU steps");
        simulator.read_state(&mut after).expect("same size");
        let block = before.compiled.step_block(&before.clock);
        let cx = before.compiled.context(&block);
        for (slot, place) in before.leaves.place.iter().enumerate() {
            let next = &after.leaves.place[slot];
            if place.state() != LeafState::Attached || next.state() != LeafState::Falling {
                continue;
            }
            breaks += 1;
            let carried = Vec3::from(before.leaves.drift[slot].velocity);
            let moved = (Vec3::from(next.position) - Vec3::from(place.position)) / dt;
            let at = windfall_core::arith::Vec3::from(place.position);
            let air = wind_at(&cx, at);
            let air = Vec3::new(air.x, air.y, air.z);
            let response_s = response_of(&cx, place.bits).time_constant_s;
            // The wind takes hold at once with its drag, and the leaf begins to swing as fast as it falls.
            let pull = ((air - carried).length() + 2.0) / response_s * dt + STANDARD_GRAVITY_M_S2 * dt;
            let change = (moved - carried).length();
            worst = worst.max(change / pull);
            assert!(change <= pull, "slot {slot}: {carried} m/s before, {moved} m/s after");
            let poses =
                [&before, &after].map(|world| Quat::from_array(world.leaves.attitude[slot].quaternion));
            turned = turned.max(poses[0].angle_between(poses[1]));
        }
        before = after;
    }
    println!("{breaks} breaks; {worst} of the bound on the change of velocity; turned by {turned} rad");
    assert!(breaks > 100, "leaves have come off: {breaks}");
    assert!(turned < 0.6, "turned by {turned} rad in a step");
}

#[test]
fn crowns_thin_out_from_full_to_bare() {
    for kind in ["maple", "birch"] {
        let share = |autumn| {
            let world = world(&scene(kind, 2000, autumn, 0.0));
            let sites = petioles(&world).iter().filter(|petiole| petiole.segment != NO_SEGMENT).count();
            let fallen =
                world.leaves.place.iter().filter(|place| place.state() == LeafState::Resting).count();
            assert_eq!(attached(&world) + fallen, sites, "{kind}, {autumn}: every leaf hangs or lies");
            assert!(sites > 1000, "{kind}: {sites} sites");
            attached(&world) as f64 / sites as f64
        };
        let shares = [0.0, 0.3, 0.45, 0.55, 0.62, 0.7, 0.8, 0.9, 1.0].map(share);
        println!("{kind}: {shares:?}");
        assert!(shares.is_sorted_by(|a, b| a >= b), "{kind}: {shares:?}");
        assert_eq!((shares[0], shares[8]), (1.0, 0.0), "{kind}: full in summer, bare in winter");
        assert!((0.3..0.7).contains(&shares[4]), "{kind}: thin in late autumn: {shares:?}");
    }
}

#[test]
fn what_has_fallen_lies_beneath_the_crown() {
    let mut scene = scene("maple", 3000, 1.0, 0.0);
    scene.trees[0].at_m = [12.0, -30.0];
    let world = world(&scene);
    let sites: Vec<Vec3> = petioles(&world)
        .iter()
        .filter(|petiole| petiole.segment != NO_SEGMENT)
        .map(|petiole| Vec3::from(petiole.blade.map(|units| units as f32 / 1024.0)))
        .collect();
    let lying: Vec<Vec3> = world
        .leaves
        .place
        .iter()
        .filter(|place| place.state() == LeafState::Resting)
        .map(|place| place.position.into())
        .collect();
    assert_eq!(lying.len(), sites.len(), "all lie");
    let middle = |points: &[Vec3]| points.iter().sum::<Vec3>() / points.len() as f32;
    let (foot, litter) = (middle(&sites), middle(&lying));
    let reach = sites.iter().map(|site| (*site - foot).with_y(0.0).length()).fold(0.0, f32::max);
    let spread: Vec<f32> = lying.iter().map(|leaf| (*leaf - foot).with_y(0.0).length()).collect();
    let outside = spread.iter().filter(|far| **far > reach + 2.0).count() as f32 / spread.len() as f32;
    println!("crown {reach} m, litter {} m off its middle, {outside} outside", (litter - foot).with_y(0.0));
    assert!((litter - foot).with_y(0.0).length() < 1.0, "beneath the crown: {litter}, {foot}");
    assert!(outside < 0.02, "{outside} of the leaves lie outside");
    assert!(lying.iter().all(|leaf| leaf.y < 0.02), "on the ground");
}

#[test]
fn drawn_leaves_cover_what_the_leaf_area_index_says() {
    for (leaves, is_capped) in [(20_000, false), (6000, false), (200, true)] {
        let scene = scene("maple", leaves, 0.0, 0.0);
        let world = world(&scene);
        let tree = &world.compiled.forest().trees()[0];
        let foliage = scene.tree_kind("maple").expect("a preset").foliage;
        let area = std::f32::consts::PI / 4.0 * scene.species[0].size_m * scene.species[0].size_m;
        let drawn: f64 = world
            .leaves
            .schedule
            .iter()
            .map(|schedule| f64::from(size_ratio(schedule.size)))
            .map(|size| size * size * f64::from(area))
            .sum();
        let full = f64::from(foliage.leaf_area_index) * tree.facts.crown_m2;
        let each = tree.facts.leaves_each;
        let due = full * (16.0 / each).min(1.0);
        println!(
            "{leaves} slots: each for {each:.1}; {drawn:.1} m² drawn, {due:.1} m² due, {full:.1} m² full"
        );
        assert_eq!(each > 16.0, is_capped, "{leaves} slots: each stands for {each}");
        assert!((0.85..1.1).contains(&(drawn / due)), "{leaves}: {drawn} m² drawn, {due} m² due");
    }
}

/// A thousand trees of 200,000 leaves each take the memory of the leaves that are asked for, not of those they have.
#[test]
fn a_forest_costs_what_it_asks_for() {
    // Of the kinds with full crowns the one with the fewest segments: a scene may have half a million of these.
    let mut scene = scene("berry-bush", 200, 0.0, 0.0);
    let mut kind = scene.tree_kind("berry-bush").expect("a preset");
    kind.foliage.leaf_area_index = 6.0;
    scene.tree_kinds = vec![kind];
    let pattern = Tree { height_m: Some(23.0), ..scene.trees[0].clone() };
    scene.trees = (0..1000u16)
        .map(|index| Tree {
            number: u32::from(index % 8),
            at_m: [f32::from(index % 40) * 14.0, f32::from(index / 40) * 14.0],
            ..pattern.clone()
        })
        .collect();
    let start = Instant::now();
    let world = world(&scene);
    let elapsed = start.elapsed();
    let trees = world.compiled.forest().trees();
    let full = trees.iter().map(|tree| tree.facts.leaves_each * 200.0).sum::<f64>() / 1000.0;
    let bytes = size_of::<Petiole>() + LEAF_BYTES;
    println!("{elapsed:?} to build; {full:.0} leaves a tree; {bytes} bytes a slot");
    assert_eq!(world.leaves.len(), 200_000, "slots");
    assert!(full > 2e5, "full crowns: {full}");
    assert_eq!(bytes, 136, "bytes of a slot");
    assert!(elapsed.as_secs() < 120, "built in {elapsed:?}");
}
