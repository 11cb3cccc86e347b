// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The CPU backend gives the same bits for any number of threads, for a plain loop, today and tomorrow.

mod common;

use common::{build, many_species, step};
use glam::{Vec2, Vec3};
use windfall_core::leaf::LeafState;
use windfall_core::motion::JOINED_COUNT;
use windfall_core::scene::{
    Air, Bounds, MeanSpeed, Meets, ParticleRelease, ParticleShape, Particles, Profile, Release, Scene,
    Source, SourceShape, Spread, Vortex, VortexProfile, Weather,
};
use windfall_core::store::Store;
use windfall_core::{Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator, Simd};
use windfall_tests::strategies::{pond_scene, winding_scene, wooded_scene};

/// State hash of [`small_scene`] after [`GOLDEN_STEPS`] steps.
///
/// A change of this number means that the same scene gives other bits than before: on purpose when the physics, the
/// tables or the random draws changed, by accident otherwise. After a change on purpose run
/// `cargo test -p windfall-tests --test determinism`, copy the number that the failing test prints, and say in the
/// changelog that recordings and checkpoints of earlier versions go on differently.
const GOLDEN: u64 = 0x3ea8_13a3_f261_f364;
const GOLDEN_STEPS: u32 = 240;
/// The same of [`wooded_scene`] with three hundred leaves besides those on its trees.
const WOODED_GOLDEN: u64 = 0x2207_930a_4e90_8931;
/// The same of [`pond_scene`] with fifteen hundred leaves besides those of its bed, after [`LITTER_STEPS`] steps.
const LITTER_GOLDEN: u64 = 0x275a_89da_bfae_227f;
const LITTER_STEPS: u32 = 600;

/// Twenty thousand leaves in a storm: every state, join, vortex and source shape within a few seconds.
fn storm() -> Scene {
    let mut scene = Scene::preset("storm").expect("a preset");
    scene.seed = 0x5eed_0000_0000_0001;
    // Falls of one to three seconds, so that leaves land, rest and start again within the run.
    for source in &mut scene.sources {
        if let SourceShape::Box { center_m, half_extent_m } = &mut source.shape {
            (center_m.y, half_extent_m.y) = (2.5, 1.5);
        }
        let per_s = f32::from(u16::try_from(source.count / 4).expect("some thousands"));
        source.release = Release::Rate { per_s, from_s: -3.0 };
        source.recycle_after_s = Some(4.0);
    }
    scene
}

/// A few leaves that meet everything.
fn small_scene() -> Scene {
    let mut scene = storm();
    scene.species = many_species();
    scene.wind.speed = MeanSpeed::MetresPerSecond(4.0);
    scene.wind.profile = Profile::Power { exponent: 0.22 };
    scene.wind.vortices = vec![Vortex {
        center_m: Vec3::new(0.5, 0.0, 0.0),
        axis: Vec3::Y,
        circulation_m2_s: 9.0,
        core_m: 0.7,
        axial_m_s: 1.0,
        drift_m_s: Vec3::new(0.1, 0.0, 0.0),
        profile: VortexProfile::Kaufmann,
        spline_m: Vec::new(),
    }];
    let shapes = [
        SourceShape::Box { center_m: Vec3::new(0.0, 3.0, 0.0), half_extent_m: Vec3::new(3.0, 1.0, 2.0) },
        SourceShape::Disc { center_m: Vec3::new(2.0, 1.0, 0.0), radius_m: 1.5 },
        SourceShape::Sphere { center_m: Vec3::new(-1.0, 4.0, 1.0), radius_m: 1.0 },
    ];
    scene.sources = shapes
        .map(|shape| Source {
            shape,
            count: 100,
            release: Release::Rate { per_s: 40.0, from_s: -1.0 },
            recycle_after_s: Some(2.5),
            species: Vec::new(),
        })
        .into();
    scene
}

/// State of a world after steps on so many threads.
fn run(world: &World, threads: usize, steps: u32) -> World {
    let mut simulator =
        CpuSimulator::new(world, CpuOptions { threads: Some(threads), ..CpuOptions::default() })
            .expect("threads can be started");
    simulator.step(steps).expect("the CPU can step");
    let mut after = world.clone();
    simulator.read_state(&mut after).expect("worlds of one size");
    after
}

#[test]
fn any_number_of_threads_and_a_plain_loop_give_the_same_bits() {
    let start = build(&storm());
    let mut plain = start.clone();
    step(&mut plain, 300);
    let stats = plain.stats();
    println!("{stats:?}");
    assert_eq!(stats.leaves.broken, 0, "no leaf is anywhere but somewhere");
    assert!(
        stats.leaves.falling > 2000 && stats.leaves.resting > 2000,
        "the run sees falls and landings: {stats:?}"
    );
    assert!(
        stats.leaves.primitives[..JOINED_COUNT].iter().all(|&count| count > 5),
        "and every joined motion: {stats:?}"
    );
    for threads in [1, 2, 3, 7] {
        let world = run(&start, threads, 300);
        assert_eq!(world.state_hash(), plain.state_hash(), "{threads} threads against a plain loop");
        assert!(world.leaves == plain.leaves, "{threads} threads: leaves against a plain loop");
    }
}

#[test]
fn all_instruction_sets_give_the_same_bits() {
    let sets = Simd::available();
    assert!(sets.len() > 1, "at least one set with lanes besides the scalar one: {sets:?}");
    for start in [storm(), winding_scene(storm())].map(|scene| build(&scene)) {
        let mut plain = start.clone();
        step(&mut plain, 300);
        for &simd in &sets {
            let options = CpuOptions { simd: Some(simd), ..CpuOptions::default() };
            let mut simulator = CpuSimulator::new(&start, options).expect("threads can be started");
            simulator.step(300).expect("the CPU can step");
            let mut world = start.clone();
            simulator.read_state(&mut world).expect("worlds of one size");
            assert_eq!(world.state_hash(), plain.state_hash(), "{simd:?} against a plain loop");
        }
    }
}

#[test]
fn steps_may_be_asked_for_in_any_portions() {
    let start = build(&storm());
    let mut simulator = CpuSimulator::new(&start, CpuOptions { threads: Some(2), ..CpuOptions::default() })
        .expect("threads can be started");
    for portion in [1, 0, 7, 2, 30] {
        simulator.step(portion).expect("the CPU can step");
        simulator.stats().expect("the CPU can count");
    }
    let mut world = start.clone();
    simulator.read_state(&mut world).expect("worlds of one size");
    assert_eq!(world.state_hash(), run(&start, 3, 40).state_hash(), "40 steps in portions and at once");
}

/// Flakes go through several steps before others do; what lands in each becomes snow in that one, which slides and drifts between them.
#[test]
fn snow_takes_what_lands_step_by_step() {
    let mut scene = small_scene();
    let (center_m, half_m) = (Vec3::Y * 2.0, 6.0);
    let flakes = Particles {
        count: 4000,
        release: ParticleRelease::Snowfall,
        from: ParticleShape::Box { center_m: Vec3::Y * 4.0, half_extent_m: Vec3::new(half_m, 0.5, half_m) },
        life_s: Some(Spread::Constant(5.0)),
        air: Air::Settling { m_s: Spread::Normal(1.5, 0.2) },
        meets: Meets::Die,
        dies: Some(Bounds::Through { center_m, half_extent_m: Vec3::new(half_m, 5.0, half_m) }),
        ..Particles::default()
    };
    scene.particles = vec![flakes];
    scene.weather = Some(Weather {
        size_m: Vec2::splat(10.0),
        snow_mm_h: vec![(0.0, 50.0)],
        air_c: vec![(0.0, -8.0), (2.0, 6.0)],
        ..Weather::default()
    });
    let start = build(&scene);
    let mut plain = start.clone();
    step(&mut plain, 300);
    let units = |world: &World| {
        world.bed.snow(world.compiled.block()).water.iter().map(|&cell| u64::from(cell)).sum::<u64>()
    };
    let [before, after] = [&start, &plain].map(units);
    assert!(before + 1000 < after, "flakes land: {before} units of water, then {after}");
    for simd in Simd::available() {
        let options = CpuOptions { threads: Some(3), simd: Some(simd) };
        let mut simulator = CpuSimulator::new(&start, options).expect("threads can be started");
        for portion in [5, 1, 200, 94] {
            simulator.step(portion).expect("the CPU can step");
        }
        let mut world = start.clone();
        simulator.read_state(&mut world).expect("worlds of one size");
        assert_eq!(world.state_hash(), plain.state_hash(), "{simd:?} against a plain loop");
    }
}

/// Units of slots to which nothing happens are passed by; a plain loop steps every leaf.
#[test]
fn leaves_at_rest_wake_when_their_time_has_come() {
    let mut scene = storm();
    for (source, after_s) in scene.sources.iter_mut().zip([60.0, 61.0, 60.5, 62.0].into_iter().cycle()) {
        source.release = Release::Rate { per_s: 1e5, from_s: -59.0 };
        source.recycle_after_s = Some(after_s);
    }
    let start = build(&scene);
    let resting = start.stats().leaves.resting as usize;
    assert!(resting > start.leaves.len() / 2, "{resting} leaves lie on the ground");
    for simd in Simd::available() {
        let options = CpuOptions { threads: Some(2), simd: Some(simd) };
        let mut simulator = CpuSimulator::new(&start, options).expect("threads can be started");
        let mut plain = start.clone();
        for (round, portion) in [1, 50, 3, 90, 1, 60].into_iter().enumerate() {
            if round == 3 {
                scene.ground.friction *= 0.5;
                plain.compiled.retune(&scene);
                simulator.set_scene(&plain.compiled).expect("the same sizes");
            }
            simulator.step(portion).expect("the CPU can step");
            step(&mut plain, portion);
            let mut world = start.clone();
            simulator.read_state(&mut world).expect("worlds of one size");
            assert_eq!(world.state_hash(), plain.state_hash(), "{simd:?}, round {round}");
        }
        let falling = plain.stats().leaves.falling as usize;
        assert!(falling > start.leaves.len() / 4, "{falling} leaves fall again");
    }
}

#[test]
fn the_same_scene_gives_the_same_world_and_another_seed_another() {
    let scene = storm();
    let (one, two) = (build(&scene), build(&scene));
    assert_eq!(one.state_hash(), two.state_hash(), "the same scene built twice");
    assert!(one.leaves == two.leaves, "the same scene built twice");
    for seed in [0x5eed_0000_0000_0002, 0x5eed_0000_0000_0000, 0x5eed_0001_0000_0001] {
        let other = build(&Scene { seed, ..scene.clone() });
        assert_ne!(one.state_hash(), other.state_hash(), "seed {seed:x}");
        let awake = |slot: &usize| one.leaves.place[*slot].state() != LeafState::Dormant;
        let same = (0..one.leaves.len()).filter(awake);
        let same = same.filter(|&slot| one.leaves.place[slot] == other.leaves.place[slot]);
        assert!(same.count() < 10, "seed {seed:x} leaves many leaves where they were");
    }
}

#[test]
fn a_hash_sees_every_bit() {
    let world = build(&small_scene());
    let hash = world.state_hash();
    for (column, bytes) in world.leaves.columns().into_iter().map(<[u8]>::len).enumerate() {
        for byte in [0, 17, bytes - 5] {
            let mut other = world.clone();
            other.leaves.columns_mut()[column][byte] ^= 4;
            assert_ne!(other.state_hash(), hash, "column {column}, byte {byte}");
        }
    }
    let mut other = world.clone();
    world.compiled.advance(&mut other.clock);
    assert_ne!(other.state_hash(), hash, "the clock");
    let mut other = world.clone();
    other.leaves.place.swap(3, 4);
    assert_ne!(other.state_hash(), hash, "two leaves that changed places");
}

#[test]
fn the_small_scene_still_gives_the_golden_bits() {
    let world = run(&build(&small_scene()), 2, GOLDEN_STEPS);
    let stats = world.stats();
    assert!(
        stats.leaves.falling > 20 && stats.leaves.resting > 20,
        "the small scene sees falls and landings: {stats:?}"
    );
    let hash = world.state_hash();
    assert_eq!(hash, GOLDEN, "the state hash is 0x{hash:016x}, see GOLDEN for what that means");
}

#[test]
fn trees_still_give_the_golden_bits() {
    let start = build(&wooded_scene(3, 300, 9.0, 1.0 / 60.0));
    let world = run(&start, 2, GOLDEN_STEPS);
    let stats = world.stats();
    assert!(
        stats.leaves.attached > 300 && stats.leaves.attached + 20 < start.stats().leaves.attached,
        "leaves come off: {stats:?}"
    );
    assert!(world.branches != start.branches, "trees sway");
    let hash = world.state_hash();
    assert_eq!(hash, WOODED_GOLDEN, "the state hash is 0x{hash:016x}, see GOLDEN for what that means");
}

/// Wind, a jet, a walker, things that stand and that move, and a pond.
#[test]
fn living_litter_still_gives_the_golden_bits() {
    let world = run(&build(&pond_scene(4, 1500, 2.0, 1.0 / 60.0)), 2, LITTER_STEPS);
    let stats = world.litter_stats().expect("there is litter");
    let counts = [stats.lying, stats.awake, stats.held, stats.afloat, stats.sunk];
    assert!(counts.iter().all(|&count| count > 10) && stats.woken > 100, "{stats:?}");
    let hash = world.state_hash();
    assert_eq!(hash, LITTER_GOLDEN, "the state hash is 0x{hash:016x}, see GOLDEN for what that means");
}

/// The table is what every way to use the engine is compared with: the command, C, Python, WebAssembly in Node and in a browser.
#[test]
fn presets_have_the_hashes_that_every_way_to_use_them_gives() {
    let table = include_str!("../state_hashes.csv");
    let found = table.lines().skip(1).map(|line| {
        let mut words = line.split(',');
        let mut word = || words.next().expect("three columns");
        let (preset, steps) = (word(), word().parse().expect("a number of steps"));
        let world = build(&Scene::preset(preset).expect("a preset"));
        let mut simulator = CpuSimulator::new(&world, CpuOptions::default()).expect("threads start");
        simulator.step(steps).expect("it steps");
        format!("{preset},{steps},{:016x}\n", simulator.world().state_hash())
    });
    assert_eq!(format!("scene,steps,state_hash\n{}", found.collect::<String>()), table, "state_hashes.csv");
}
