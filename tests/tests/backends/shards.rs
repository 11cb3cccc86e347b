// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Shards of a world, stepped apart, are the whole to the bit.

use windfall_core::scene::{PRESETS, Scene, Source};
use windfall_core::{LeafStats, Shard, World};
use windfall_cpu::CpuOptions;

use crate::stepped::{exact, exact_adapters, on_cpu, on_gpu};

/// All shards of a scene that is divided into so many.
fn shards_of(scene: &Scene, count: u32) -> Vec<World> {
    let shard = |number| Shard::new(number, count).expect("one of them");
    (1..=count).map(|number| World::build_shard(scene, "test", shard(number)).expect("divisible")).collect()
}

/// Sum of the hashes of worlds.
fn sum_of_hashes(shards: &[World]) -> u64 {
    shards.iter().fold(0, |sum, shard| sum.wrapping_add(shard.state_hash()))
}

/// Sum of the numbers of leaves that hang, fall, lie and wait.
fn counts(worlds: &[World]) -> [u32; 4] {
    worlds.iter().fold([0; 4], |sum, world| {
        let LeafStats { attached, falling, resting, dormant, .. } = world.stats().leaves;
        let own = [attached, falling, resting, dormant];
        std::array::from_fn(|state| sum[state] + own[state])
    })
}

/// Asserts that shards of a scene have the hash and the counts of the whole, at time zero and after so many steps.
fn assert_shards_are_the_whole(scene: &Scene, count: u32, steps: u32) {
    let name = &scene.name;
    let (whole, shards) = (World::build(scene).expect("valid"), shards_of(scene, count));
    assert_eq!(sum_of_hashes(&shards), whole.state_hash(), "{name} in {count}, at time zero");
    let step = |world: &World| on_cpu(world, CpuOptions::default(), steps);
    let shards: Vec<World> = shards.iter().map(step).collect();
    let whole = step(&whole);
    assert_eq!(sum_of_hashes(&shards), whole.state_hash(), "{name} in {count}, after {steps} steps");
    assert_eq!(counts(&shards), counts(&[whole]), "{name} in {count}: leaves by state");
}

/// A scene with so many leaves, or with its own where it has fewer.
fn scaled(scene: &Scene, most: u32) -> Scene {
    match scene.leaf_count() > most {
        true => scene.with_leaf_count("test", most).expect("enough for its trees and sources"),
        false => scene.clone(),
    }
}

/// A wood in a gale, in several groups of trees, with leaves of sources besides.
fn gale() -> Scene {
    let mut scene = Scene::preset("forest").expect("a preset");
    scene.name = "gale".into();
    scene.autumn = 0.6;
    scene.regrow_after_s = Some(1.0);
    scene.sources = vec![Source { count: 3_000, ..Source::default() }];
    scaled(&scene, 5_000)
}

#[test]
fn shards_of_presets_are_the_whole() {
    let mut divided = 0;
    for (name, _) in PRESETS {
        let scene = Scene::preset(name).expect("a preset");
        let scene = scaled(&scene, 6_000);
        match World::build_shard(&scene, name, Shard::new(1, 3).expect("one of three")) {
            Ok(_) => assert_shards_are_the_whole(&scene, 3, 90),
            Err(error) => {
                let shares = scene.ground.litter.is_some() || scene.weather.is_some() || scene.leaves_burn();
                assert!(shares, "{error}");
                continue;
            }
        }
        divided += 1;
    }
    assert!(divided >= 15, "{divided} presets");
}

#[test]
fn trees_are_divided_whole() {
    let scene = gale();
    for count in [2, 5, 16] {
        assert_shards_are_the_whole(&scene, count, 120);
        let shards = shards_of(&scene, count);
        let (mut slot, mut tree, mut segment) = (0, 0, 0);
        for shard in &shards {
            let rows = shard.compiled.shard_rows();
            assert_eq!(
                (rows.slots.start, rows.trees.start, rows.segments.start),
                (slot, tree, segment),
                "each shard begins where the one before ends"
            );
            (slot, tree, segment) = (rows.slots.end, rows.trees.end, rows.segments.end);
        }
        let whole = &shards[0].compiled;
        assert_eq!(
            (slot, tree, segment),
            (scene.leaf_count(), scene.trees.len(), whole.forest().len()),
            "the last one ends with the scene"
        );
    }
    let with_trees =
        shards_of(&scene, 5).iter().filter(|shard| !shard.compiled.shard_rows().trees.is_empty()).count();
    assert!(with_trees > 1, "trees in {with_trees} shards");
}

#[test]
fn shards_on_a_device_are_the_whole() {
    for scene in [gale(), Scene::preset("pollen").expect("a preset")] {
        let scene = scaled(&scene, 1_500);
        let whole = on_cpu(&World::build(&scene).expect("valid"), CpuOptions::default(), 24);
        for gpu in exact_adapters() {
            let step = |world: &World| on_gpu(&gpu, world, &exact(Some(512)), &[7, 17]);
            let shards: Vec<World> = shards_of(&scene, 3).iter().map(step).collect();
            assert_eq!(sum_of_hashes(&shards), whole.state_hash(), "{}", scene.name);
        }
    }
}

#[test]
fn a_shard_is_resumed_to_the_bit() {
    let scene = gale();
    let shard =
        World::build_shard(&scene, "test", Shard::new(2, 3).expect("one of three")).expect("divisible");
    let half = on_cpu(&shard, CpuOptions::default(), 30);
    let mut bytes = Vec::new();
    half.write_checkpoint(&mut bytes).expect("memory");
    let back = World::from_checkpoint(&bytes, "memory").expect("whole");
    assert_eq!(back.compiled.shard(), shard.compiled.shard(), "the same shard");
    let (resumed, unbroken) =
        (on_cpu(&back, CpuOptions::default(), 30), on_cpu(&shard, CpuOptions::default(), 60));
    assert_eq!(resumed.state_hash(), unbroken.state_hash(), "the same bits");
}

#[test]
fn what_leaves_share_is_not_divided() {
    let half = Shard::new(1, 2).expect("one of two");
    let refused =
        |scene: &Scene| World::build_shard(scene, "it", half).map(|_| ()).expect_err("shared").to_string();
    let mut snow = Scene::preset("snowstorm").expect("a preset");
    (snow.ground.litter, snow.objects) = (None, Vec::new());
    let litter = Scene::preset("blower").expect("a preset");
    for (scene, field) in [(litter, "it: ground.litter is"), (snow, "it: weather is")] {
        let error = refused(&scene);
        assert!(error.contains(field) && error.contains("share"), "{error}");
    }
    let scene = Scene { sources: vec![Source { count: 3, ..Source::default() }], ..Scene::default() };
    let error = World::build_shard(&scene, "few", Shard::new(4, 4).expect("one of four"))
        .map(|_| ())
        .expect_err("three leaves");
    assert!(error.to_string().contains("at most 3 shards"), "{error}");
}
