// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Tiers 2 and 3 for trees: swaying segments and leaves on twigs are the same on both backends.

use windfall_core::scene::SwayScheme;
use windfall_core::{Contract, Scene, World};
use windfall_cpu::{CpuOptions, Simd};
use windfall_tests::adapter;
use windfall_tests::compare::{Difference, STEP_SEGMENT, difference};
use windfall_tests::mutation::{Course, two_at_a_time};
use windfall_tests::strategies::wooded_scene;
use windfall_wgpu::WgpuOptions;

use crate::stepped::{exact, exact_adapters, on_cpu, on_gpu};

const STEPS: u32 = 1000;

fn world() -> World {
    world_of(SwayScheme::Articulated)
}

fn world_of(sway: SwayScheme) -> World {
    let scene = Scene { sway, ..wooded_scene(7, 600, 9.0, 1.0 / 60.0) };
    World::build(&scene).expect("the wooded scene is valid")
}

/// Leaves hang, fall and lie, and the trees move.
fn is_lively(before: &World, after: &World) {
    let stats = after.stats();
    let trees = before.compiled.scene().tree_leaf_count() as usize;
    let off = (0..trees).filter(|&slot| {
        let state = |world: &World| world.leaves.place[slot].state();
        state(before) == windfall_core::leaf::LeafState::Attached && state(after) != state(before)
    });
    assert!(off.count() > 20, "leaves have come off: {stats:?}");
    assert!(stats.leaves.attached > 300, "leaves hang: {stats:?}");
    assert_eq!(stats.leaves.broken, 0, "no broken leaf");
    let moved = difference(before, after);
    let base_m = moved.segments().largest("base");
    assert!(base_m > 0.02 && base_m < 20.0, "trees sway: {moved:?}");
}

/// Returns true if no segment is farther off in m, or in a component of its orientation.
fn segments_within(found: &Difference, most: f32) -> bool {
    found.is_finite() && ["base", "pose"].iter().all(|column| found.segments().largest(column) <= most)
}

#[test]
fn a_thousand_steps_of_trees_are_equal_to_the_bit_under_the_exact_contract() {
    let world = world();
    let oracle = on_cpu(&world, CpuOptions::default(), STEPS);
    is_lively(&world, &oracle);
    for gpu in exact_adapters() {
        for page_leaves in [None, Some(4096)] {
            let options = exact(page_leaves);
            let candidate = on_gpu(&gpu, &world, &options, &[STEPS]);
            let found = difference(&oracle, &candidate);
            assert!(found.is_none(), "{}: {found:?}", gpu.info().name);
            assert_eq!(oracle.state_hash(), candidate.state_hash(), "{}", gpu.info().name);
        }
    }
}

#[test]
fn every_scheme_is_equal_to_the_bit_under_the_exact_contract() {
    for scheme in [SwayScheme::Quigley, SwayScheme::OliapuramKumar] {
        let world = world_of(scheme);
        let oracle = on_cpu(&world, CpuOptions::default(), 300);
        is_lively(&world, &oracle);
        for gpu in exact_adapters() {
            let found = difference(&oracle, &on_gpu(&gpu, &world, &exact(None), &[300]));
            assert!(found.is_none(), "{scheme:?} on {}: {found:?}", gpu.info().name);
        }
    }
}

/// Three trees in a row along the wind, the middle one first.
#[test]
fn trees_that_shelter_each_other_are_equal_to_the_bit() {
    let mut scene = wooded_scene(7, 600, 9.0, 1.0 / 60.0);
    scene.trees.truncate(3);
    for (tree, along_m) in scene.trees.iter_mut().zip([0.0, 11.0, -12.0]) {
        tree.at_m = [along_m * 0.866, along_m * 0.5];
    }
    let world = World::build(&scene).expect("the wooded scene is valid");
    assert!(world.compiled.block().has_shelter(), "trees shelter each other");
    let oracle = on_cpu(&world, CpuOptions::default(), 300);
    scene.wind.shelter = false;
    let free = on_cpu(&World::build(&scene).expect("the same scene"), CpuOptions::default(), 300);
    assert!(difference(&free, &oracle).segments().largest("base") > 1e-3, "shelter moves trees");
    for simd in Simd::available() {
        let lanes = on_cpu(&world, CpuOptions { simd: Some(simd), threads: Some(2) }, 300);
        assert!(difference(&oracle, &lanes).is_none(), "{simd:?}");
    }
    for gpu in exact_adapters() {
        let found = difference(&oracle, &on_gpu(&gpu, &world, &exact(None), &[300]));
        assert!(found.is_none(), "{}: {found:?}", gpu.info().name);
    }
}

#[test]
fn joints_solved_in_every_other_step_are_equal_to_the_bit() {
    let scene = Scene { sway_every: 2, ..wooded_scene(7, 600, 4.0, 1.0 / 60.0) };
    let world = World::build(&scene).expect("the wooded scene is valid");
    assert_eq!(world.compiled.block().sway.interval_steps, 2, "a wind light enough");
    let oracle = on_cpu(&world, CpuOptions { simd: Some(Simd::Scalar), ..CpuOptions::default() }, 301);
    let every = World::build(&Scene { sway_every: 1, ..scene }).expect("the same scene");
    let every = on_cpu(&every, CpuOptions::default(), 301);
    assert!(difference(&every, &oracle).segments().largest("base") > 1e-5, "it is another motion");
    for simd in Simd::available() {
        let lanes = on_cpu(&world, CpuOptions { simd: Some(simd), threads: Some(2) }, 301);
        assert!(difference(&oracle, &lanes).is_none(), "{simd:?}");
    }
    for gpu in exact_adapters() {
        let found = difference(&oracle, &on_gpu(&gpu, &world, &exact(None), &[301]));
        assert!(found.is_none(), "{}: {found:?}", gpu.info().name);
    }
}

#[test]
fn trees_stay_together_under_the_tolerant_contract() {
    let world = world();
    let warm = on_cpu(&world, CpuOptions::default(), 240);
    let oracle = on_cpu(&warm, CpuOptions::default(), 1);
    let later = on_cpu(&warm, CpuOptions::default(), 60);
    for gpu in adapter::all() {
        let options = WgpuOptions { contract: Some(Contract::Tolerant), ..WgpuOptions::default() };
        let found = difference(&oracle, &on_gpu(&gpu, &warm, &options, &[1]));
        assert_eq!(found.leaves().integer_rows, 0, "{}: {found:?}", gpu.info().name);
        assert!(segments_within(&found, STEP_SEGMENT), "{}: {found:?}", gpu.info().name);
        let found = difference(&later, &on_gpu(&gpu, &warm, &options, &[60]));
        assert!(segments_within(&found, 1e-3), "{}: {found:?}", gpu.info().name);
    }
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let world = world();
    let one = on_cpu(&world, CpuOptions { threads: Some(1), ..CpuOptions::default() }, 300);
    for threads in [2, 3, 7] {
        let several = on_cpu(&world, CpuOptions { threads: Some(threads), ..CpuOptions::default() }, 300);
        assert!(difference(&one, &several).is_none(), "{threads} threads");
        assert_eq!(one.state_hash(), several.state_hash(), "{threads} threads");
    }
}

#[test]
fn every_instruction_set_gives_the_same_bits() {
    let world = world();
    let scalar = on_cpu(&world, CpuOptions { simd: Some(Simd::Scalar), ..CpuOptions::default() }, 200);
    for simd in Simd::available() {
        let lanes = on_cpu(&world, CpuOptions { simd: Some(simd), ..CpuOptions::default() }, 200);
        assert!(difference(&scalar, &lanes).is_none(), "{simd:?}");
        assert_eq!(scalar.state_hash(), lanes.state_hash(), "{simd:?}");
    }
}

#[test]
fn a_checkpoint_brings_trees_back_to_the_bit() {
    let warm = on_cpu(&world(), CpuOptions::default(), 200);
    let mut bytes = Vec::new();
    warm.write_checkpoint(&mut bytes).expect("memory takes it");
    let back = World::from_checkpoint(&bytes, "memory").expect("it is whole");
    assert_eq!(back.state_hash(), warm.state_hash(), "read back");
    let (on, again) = (on_cpu(&warm, CpuOptions::default(), 100), on_cpu(&back, CpuOptions::default(), 100));
    assert_eq!(on.state_hash(), again.state_hash(), "stepped on");
}

/// Mutation test: each line of the trees' dynamics that is changed in WGSL shows.
#[test]
fn a_changed_kernel_is_noticed() {
    let edits = [
        ("arith/matrix", "l32 * l21 - l31", "l32 * l21 + l31"),
        ("arith/quaternion", "z + z);", "z + x);"),
        ("tree/sway/load", "drag.wood * dt", "drag.leaves * dt"),
        ("tree/sway/inward", "1.0 - inverse_sqrt", "1.001 - inverse_sqrt"),
        ("tree/sway/inward", "sym3_add(turned, swung)", "sym3_add(turned, turned)"),
        ("tree/sway/outward", "gain * IMPLICITNESS", "gain"),
        ("tree/sway/twig", "inverse_across * load.coupling", "inverse_along * load.coupling"),
        ("tree/sway/row", "select(row, segments[row].parent, is_twig)", "row"),
        ("tree/sway/row", "columns + row] = vec4<f32>(air,", "columns + row] = vec4<f32>(body.velocity,"),
        ("tree/sway/load", "wind_at_moment(MOMENT_MIDDLE", "wind_at_moment(MOMENT_NOW"),
        ("wind/sample", "place.x, above, place.z", "place.z, above, place.x"),
        (
            "tree/sway/row",
            "whole = articulated_add(whole, load",
            "whole = articulated_add(segment_body(load, axis), load",
        ),
        ("leaf/carry", "share * LEAN_MOST", "share * LEAN_SPEED"),
        ("leaf/carry", "change - 1u", "change"),
        ("leaf/release", "own_size(schedules", "drawn_size(schedules"),
        ("prelude", "const AIR_SPEED_SMOOTHING: f32 = 0.25", "const AIR_SPEED_SMOOTHING: f32 = 0.26"),
    ];
    // Soft wood in a storm leans on its stops, so that they count as well.
    let mut scene = wooded_scene(7, 600, 14.0, 1.0 / 60.0);
    let mut soft = scene.tree_kind("bush").expect("a preset");
    soft.name = "soft".into();
    soft.wood.youngs_modulus_gpa = 1e-4;
    scene.tree_kinds = vec![soft];
    scene.trees[2].kind = "soft".into();
    let world = on_cpu(&World::build(&scene).expect("valid"), CpuOptions::default(), 200);
    // Steps after which a change is looked for: most show at once.
    let course = Course::new(world, &[3, 12, 60]);
    let Some(gpu) = exact_adapters().pop() else { return };
    two_at_a_time(&gpu, edits.into_iter(), |gpu, (module, old, new)| {
        assert!(course.notices(gpu, module, old, new), "nobody noticed '{new}' in {module}");
    });
}
