// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Living litter: the same bits on CPU and GPU, and heights that are what lies there.

use windfall_core::World;
use windfall_core::device::leaf::record::{lies, lying_volume};
use windfall_core::scene::Scene;
use windfall_cpu::{CpuOptions, Simd};
use windfall_tests::compare::difference;
use windfall_tests::strategies::{
    burning_scene, hilly_scene, littered_scene, obstructed_scene, pond_scene, wooded_scene,
};

use crate::stepped::{exact, exact_adapters, on_cpu, on_gpu};

const LEAVES: u32 = 3000;
const STEPS: u32 = 1000;

fn world() -> World {
    World::build(&littered_scene(77, LEAVES, 3.0, 1.0 / 60.0)).expect("the littered scene is valid")
}

/// Steps a world on every adapter a thousand times at once, as `expected` has been, and less often in portions.
fn same_on_devices(world: &World, expected: &World) {
    same_after(world, None, &[STEPS], expected);
    same_in_portions(world);
}

/// Steps a world on every adapter in portions of any length, with small pages.
fn same_in_portions(world: &World) {
    let portions = [1, 40, 7, 72];
    let expected = on_cpu(world, CpuOptions::default(), portions.iter().sum());
    same_after(world, Some(4096), &portions, &expected);
}

fn same_after(world: &World, page_leaves: Option<u32>, batches: &[u32], expected: &World) {
    for gpu in exact_adapters() {
        let found = on_gpu(&gpu, world, &exact(page_leaves), batches);
        let apart = difference(expected, &found);
        assert!(apart.is_none(), "{}, pages of {page_leaves:?}: {apart:?}", gpu.info().name);
        assert_eq!(expected.state_hash(), found.state_hash(), "{}", gpu.info().name);
    }
}

/// Sum of the heights, and of the volumes of the leaves that lie.
fn sums(world: &World) -> (u64, u64) {
    let heights = world.bed.heights(&world.compiled.block().litter);
    let lying = world.leaves.place.iter().filter(|place| lies(place.bits));
    (
        heights.iter().copied().map(u64::from).sum(),
        lying.map(|place| u64::from(lying_volume(place.bits))).sum(),
    )
}

#[test]
fn a_thousand_steps_of_living_litter_are_equal_to_the_bit() {
    let world = world();
    let expected = on_cpu(&world, CpuOptions::default(), STEPS);
    let stats = expected.litter_stats().expect("there is litter");
    assert!(stats.lying > 500 && stats.awake > 100 && stats.woken > 1000, "{stats:?}");
    same_on_devices(&world, &expected);
}

/// Presets of living litter, and steps after which much goes on in them: gusts, boots among leaves, a jet at work, a ball in its heap,
/// rafts.
const SHOWS: [(&str, u32); 6] =
    [("square", 480), ("drift", 300), ("walk", 150), ("blower", 240), ("heap", 90), ("pond", 300)];

#[test]
fn every_preset_of_living_litter_is_equal_to_the_bit() {
    for (preset, before) in SHOWS {
        let scene = Scene::preset(preset).expect("a preset");
        let start = World::build(&scene).expect("a preset can be built");
        let world = on_cpu(&start, CpuOptions::default(), before);
        let expected = on_cpu(&world, CpuOptions::default(), 12);
        let stats = expected.litter_stats().expect("there is litter");
        assert!(stats.awake > 20, "{preset}: {stats:?}");
        for gpu in exact_adapters() {
            let found = on_gpu(&gpu, &world, &exact(None), &[12]);
            let apart = difference(&expected, &found);
            assert!(apart.is_none(), "{} in {preset}: {apart:?}", gpu.info().name);
            assert_eq!(expected.state_hash(), found.state_hash(), "{} in {preset}", gpu.info().name);
        }
    }
}

#[test]
fn hills_and_trees_with_litter_are_equal_to_the_bit() {
    let littered = littered_scene(78, 1200, 3.5, 1.0 / 60.0);
    let mut wooded = wooded_scene(79, 600, 5.0, 1.0 / 60.0);
    wooded.ground.litter = littered.ground.litter;
    wooded.autumn = 0.8;
    let scenes: [Scene; 2] = [hilly_scene(littered), wooded];
    for scene in scenes {
        let world = World::build(&scene).expect("valid");
        let expected = on_cpu(&world, CpuOptions::default(), 400);
        let stats = expected.litter_stats().expect("there is litter");
        assert!(stats.lying > 50 && stats.woken > 100, "{stats:?}");
        for gpu in exact_adapters() {
            let apart = difference(&expected, &on_gpu(&gpu, &world, &exact(None), &[400]));
            assert!(apart.is_none(), "{} in {}: {apart:?}", gpu.info().name, scene.name);
        }
    }
}

#[test]
fn leaves_among_solid_things_are_equal_to_the_bit() {
    let world = World::build(&obstructed_scene(80, LEAVES, 0.6, 1.0 / 60.0)).expect("valid");
    let expected = on_cpu(&world, CpuOptions::default(), STEPS);
    let stats = expected.litter_stats().expect("there is litter");
    assert!(stats.held > 10 && stats.woken > 100, "{stats:?}");
    same_on_devices(&world, &expected);
}

#[test]
fn burning_leaves_are_equal_to_the_bit() {
    let world = World::build(&burning_scene(83, 600, 0.7, 1.0 / 60.0)).expect("valid");
    let expected = on_cpu(&world, CpuOptions::default(), STEPS);
    let stats = expected.burn_stats().expect("leaves burn");
    assert!(stats.burning > 30 && stats.burnt > 100, "{stats:?}");
    let [glow, embers] = [0, 1].map(|number| expected.particle_stats()[number].clone());
    assert!(glow.alive > 30 && embers.alive > 20, "{glow:?}, {embers:?}");
    let mut fed = expected.bed.clone();
    let [_, fire, ..] = fed.fires_mut(expected.compiled.block()) else { panic!("a fire for each plume") };
    assert!(fire[0] > 500, "leaves feed the second fire: {fire:?}");
    for (threads, simd) in [(Some(1), None), (Some(3), Some(Simd::Scalar))] {
        let found = on_cpu(&world, CpuOptions { threads, simd }, STEPS);
        assert_eq!(expected.state_hash(), found.state_hash(), "{threads:?} threads, {simd:?}");
    }
    // Embers would need a window from the first leaf on.
    let mut scene = world.compiled.scene().clone();
    scene.particles.truncate(1);
    let alone = World::build(&scene).expect("valid");
    same_in_portions(&alone);
    same_after(&world, None, &[STEPS], &expected);
}

#[test]
fn leaves_on_a_pond_are_equal_to_the_bit() {
    let world = World::build(&pond_scene(82, LEAVES, 3.0, 1.0 / 60.0)).expect("valid");
    let expected = on_cpu(&world, CpuOptions::default(), STEPS);
    let stats = expected.litter_stats().expect("there is litter");
    assert!(stats.afloat > 100 && stats.sunk > 100 && stats.lying > 100, "{stats:?}");
    same_on_devices(&world, &expected);
}

#[test]
fn every_instruction_set_and_number_of_threads_gives_the_same_litter() {
    let obstructed = World::build(&obstructed_scene(81, LEAVES, 4.0, 1.0 / 60.0)).expect("valid");
    let pond = World::build(&pond_scene(83, LEAVES, 4.0, 1.0 / 60.0)).expect("valid");
    for world in [world(), obstructed, pond] {
        same_litter_everywhere(&world);
    }
}

/// Steps a world in every way that the CPU has.
fn same_litter_everywhere(world: &World) {
    let plain = on_cpu(world, CpuOptions { simd: Some(Simd::Scalar), threads: Some(1) }, 300);
    for simd in Simd::available() {
        for threads in [1, 3] {
            let options = CpuOptions { simd: Some(simd), threads: Some(threads) };
            let found = on_cpu(world, options, 300);
            assert_eq!(found.state_hash(), plain.state_hash(), "{simd:?} on {threads} threads");
        }
    }
    let mut stepped = world.clone();
    windfall_core::oracle::step(&mut stepped, 300);
    assert_eq!(stepped.state_hash(), plain.state_hash(), "the plain loop");
}

#[test]
fn heights_are_what_lies_there_to_the_unit() {
    let mut world = world();
    let (heights, volumes) = sums(&world);
    assert!(heights > 0 && heights == volumes, "before: {heights} of {volumes}");
    for step in 0..60 {
        world = on_cpu(&world, CpuOptions::default(), 10);
        let (heights, volumes) = sums(&world);
        assert_eq!(heights, volumes, "after {} steps", 10 * step + 10);
    }
}
