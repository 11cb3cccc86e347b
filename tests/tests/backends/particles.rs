// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Particles: the same bits on CPU and GPU, whatever the threads, instructions and pages, and changes that must be noticed. One file, as all
//! of it steps the same scene of particles.

use windfall_core::scene::{
    Air, ForceKind, MeanSpeed, Meets, ObjectMotion, ParticleEvent, ParticleRelease, Particles, Release,
    Spread, Tree, TreeForm, TreeKind, TreePreset,
};
use windfall_core::{SimError, Simulator, World, oracle};
use windfall_cpu::{CpuOptions, CpuSimulator, Simd};
use windfall_tests::adapter;
use windfall_tests::compare::difference;
use windfall_tests::mutation::{Course, two_at_a_time};
use windfall_tests::strategies::{hilly_scene, particle_scene};
use windfall_wgpu::{WgpuOptions, WgpuSimulator};

use crate::stepped::{exact, exact_adapters, on_cpu, on_gpu};

const DT_S: f32 = 1.0 / 60.0;
/// Steps after which a change is looked for: most show at once.
const LOOKS: [u32; 3] = [4, 16, 60];
fn world() -> World {
    World::build(&particle_scene(31, 4.0, DT_S)).expect("the scene of particles is valid")
}

/// Counts of all populations together: births, deaths, hits, stops, lives cut short.
fn totals(world: &World) -> [u32; 5] {
    let mut totals = [0; 5];
    for stats in world.particle_stats() {
        let found = [stats.born, stats.died, stats.hits, stats.stopped, stats.cut_short];
        totals = std::array::from_fn(|at| totals[at] + found[at]);
    }
    totals
}

/// The CPU backend moves the same particles, contacts included, with the same bits (bevy_hanabi#41, godot-proposals#3865: no such fallback, or
/// one without collisions).
#[test]
fn a_thousand_steps_of_particles_are_equal_to_the_bit() {
    let world = world();
    let expected = on_cpu(&world, CpuOptions::default(), 1000);
    let [born, died, hits, ..] = totals(&expected);
    assert!(born > 8000 && died > 7000 && hits > 8000, "much happens: {:?}", totals(&expected));
    for gpu in exact_adapters() {
        let found = on_gpu(&gpu, &world, &exact(None), &[1000]);
        let apart = difference(&expected, &found);
        assert!(apart.is_none(), "{}: {apart:?}", gpu.info().name);
        assert_eq!(expected.state_hash(), found.state_hash(), "{}", gpu.info().name);
        // Small pages, and portions of any length.
        let found = on_gpu(&gpu, &world, &exact(Some(4096)), &[1, 40, 7, 72]);
        assert_eq!(on_cpu(&world, CpuOptions::default(), 120).state_hash(), found.state_hash(), "pages");
    }
}

/// A strength of nothing is allowed, as one that a user lowers in the window may become: every kernel that it needs is there.
#[test]
fn particles_that_attract_one_another_by_nothing_are_equal_to_the_bit() {
    let mut scene = particle_scene(33, 4.0, DT_S);
    for force in &mut scene.forces {
        if let ForceKind::Mutual { gm_m3_s2, .. } = &mut force.of {
            *gm_m3_s2 = 0.0;
        }
    }
    let world = World::build(&scene).expect("valid");
    let expected = on_cpu(&world, CpuOptions::default(), 60);
    let mut stepped = world.clone();
    oracle::step(&mut stepped, 60);
    assert_eq!(stepped.state_hash(), expected.state_hash(), "the oracle");
    for gpu in exact_adapters() {
        let found = on_gpu(&gpu, &world, &exact(None), &[60]);
        assert_eq!(expected.state_hash(), found.state_hash(), "{}", gpu.info().name);
    }
}

/// Events of parents have their children on both backends, all of them and once; a device whose windows do not reach from parents to children says so.
#[test]
fn children_are_the_same_on_both_backends() {
    let world = world();
    let expected = on_cpu(&world, CpuOptions::default(), 1000);
    let stats = expected.particle_stats();
    for (population, row) in stats.iter().zip(&expected.compiled.scene().particles) {
        if row.nest.is_some() {
            assert!(population.born > 500, "much is born: {population:?}");
        }
    }
    for (children, of) in [(9, 6), (12, 11)] {
        assert_eq!(stats[children].born, row_fan(&expected, children) * stats[of].hits, "of every hit");
    }
    assert_eq!(stats[11].born, 8 * stats[8].died, "of every death");
    // Of several births in one slot and step only the last lives, and has children.
    let lost = stats[12].born - stats[13].born;
    assert!(lost <= stats[12].cut_short && stats[12].cut_short < stats[12].born, "of every birth: {stats:?}");
    let gpu = exact_adapters().pop().expect("an adapter that keeps the exact contract");
    let soon = on_cpu(&world, CpuOptions::default(), 240).particle_stats();
    assert_eq!(on_gpu(&gpu, &world, &exact(None), &[240]).particle_stats(), soon, "on the device");
    let mut apart = world.compiled.scene().clone();
    for (population, count) in [(8, 600), (10, 3600), (11, 4800)] {
        apart.particles[population].count = count;
    }
    for (population, count) in [(12, 3 * 4800), (13, 3 * 4800), (14, 4800), (15, 4800)] {
        apart.particles[population].count = count;
    }
    // So many carry no force.
    apart.forces.iter_mut().for_each(|force| force.carried_by = None);
    let apart = World::build(&apart).expect("valid with more slots");
    let refused = WgpuSimulator::new(&gpu, &apart, &exact(Some(4096))).expect_err("too far apart");
    assert!(matches!(refused, SimError::Capacity { rows: 6005, .. }), "{refused}");
}

fn row_fan(world: &World, population: usize) -> u32 {
    world.compiled.scene().particles[population].nest.as_ref().map_or(0, |nest| nest.fan)
}

#[test]
fn particles_on_hills_are_equal_to_the_bit() {
    let world = World::build(&hilly_scene(particle_scene(32, 7.0, DT_S))).expect("valid on hills");
    let expected = on_cpu(&world, CpuOptions::default(), 150);
    for gpu in exact_adapters() {
        let apart = difference(&expected, &on_gpu(&gpu, &world, &exact(None), &[150]));
        assert!(apart.is_none(), "{}: {apart:?}", gpu.info().name);
    }
}

/// Threads, instructions and the plain loop: any order of work gives the same bits (pains such as bevy_hanabi#376, where strips of a race
/// joined the wrong particles, come from lists filled in an order of threads).
#[test]
fn every_instruction_set_and_number_of_threads_moves_particles_alike() {
    for world in [world(), World::build(&hilly_scene(particle_scene(33, 2.0, DT_S))).expect("valid")] {
        let plain = on_cpu(&world, CpuOptions { simd: Some(Simd::Scalar), threads: Some(1) }, 60);
        for simd in Simd::available() {
            for threads in [1, 3, 16] {
                let options = CpuOptions { simd: Some(simd), threads: Some(threads) };
                let apart = difference(&on_cpu(&world, options, 60), &plain);
                assert!(apart.is_none(), "{simd:?} on {threads} threads: {apart:?}");
            }
        }
        let mut stepped = world.clone();
        oracle::step(&mut stepped, 60);
        let apart = difference(&stepped, &plain);
        assert!(apart.is_none(), "the plain loop: {apart:?}");
        assert_eq!(stepped.state_hash(), plain.state_hash(), "clock and births as well");
    }
}

/// Flakes that go straight on between two samples of the air are moved apart from others, with the same bits.
#[test]
fn flakes_that_coast_are_equal_to_the_bit() {
    let mut scene = particle_scene(37, 6.0, DT_S);
    // Without small eddies, the air is sampled once in four steps.
    scene.wind.turbulence.cell_m = 10.0;
    scene.wind.vortices.clear();
    scene.walkers.clear();
    scene.objects.iter_mut().for_each(|object| object.motion = ObjectMotion::Still);
    // So many land in a step that threads share the cells.
    scene.particles[1].count = 20_000;
    let world = World::build(&scene).expect("valid without small eddies");
    assert_eq!(world.compiled.block().wind.interval_steps, 4, "steps of an interval");
    let plain = on_cpu(&world, CpuOptions { simd: Some(Simd::Scalar), threads: Some(1) }, 150);
    let snow = &plain.particle_stats()[1];
    assert!(snow.born > 20_000 && snow.died > 15_000, "flakes fall: {snow:?}");
    for simd in Simd::available() {
        let options = CpuOptions { simd: Some(simd), threads: Some(3) };
        let apart = difference(&on_cpu(&world, options, 150), &plain);
        assert!(apart.is_none(), "{simd:?}: {apart:?}");
    }
    let mut stepped = world.clone();
    oracle::step(&mut stepped, 150);
    let apart = difference(&stepped, &plain);
    assert!(apart.is_none(), "the plain loop: {apart:?}");
    for gpu in exact_adapters() {
        let apart = difference(&plain, &on_gpu(&gpu, &world, &exact(None), &[150]));
        assert!(apart.is_none(), "{}: {apart:?}", gpu.info().name);
    }
}

/// Under the tolerant contract integers are the same, and smooth flight stays close.
#[test]
fn smooth_particles_stay_close_under_the_tolerant_contract() {
    let mut scene = particle_scene(34, 3.0, DT_S);
    scene.wind.turbulence.intensity = 0.0;
    for particles in &mut scene.particles {
        particles.meets = Meets::Nothing;
        particles.feels.retain(|name| !["noise", "sun", "others"].contains(&name.as_str()));
        particles.dies = None;
        if particles.is_snow() {
            particles.release = ParticleRelease::Rate { per_s: 300.0, from_s: -3.0 };
        }
    }
    scene.forces.retain(|force| !["noise", "sun", "others"].contains(&force.name.as_str()));
    // Nothing is hit, so nothing is born of hits, nor of what would be.
    let is_hit = |on: &ParticleEvent| matches!(on, ParticleEvent::Hit);
    scene.particles.retain(|row| row.name != "13" && !row.nest.as_ref().is_some_and(|nest| is_hit(&nest.on)));
    let world = World::build(&scene).expect("valid");
    let expected = on_cpu(&world, CpuOptions::default(), 100);
    for (gpu, contract) in adapter::contracts() {
        let options = WgpuOptions { contract: Some(contract), ..WgpuOptions::default() };
        let apart = difference(&expected, &on_gpu(&gpu, &world, &options, &[100]));
        let particles = apart.of("particles");
        assert_eq!(particles.integer_rows, 0, "{} {contract}: {particles:?}", gpu.info().name);
        let furthest = particles.largest("place.position");
        assert!(furthest < 1e-3, "{} {contract}: {particles:?}", gpu.info().name);
    }
}

#[test]
fn a_resumed_checkpoint_goes_on_to_the_bit() {
    let world = world();
    let whole = on_cpu(&world, CpuOptions::default(), 240);
    let half = on_cpu(&world, CpuOptions::default(), 120);
    let mut bytes = Vec::new();
    half.write_checkpoint(&mut bytes).expect("memory takes every byte");
    let read = World::from_checkpoint(&bytes, "memory").expect("whole");
    assert_eq!(read.state_hash(), half.state_hash(), "births travel with the clock");
    let resumed = on_cpu(&read, CpuOptions::default(), 120);
    assert!(difference(&resumed, &whole).is_none(), "{:?}", difference(&resumed, &whole));
    assert_eq!(resumed.state_hash(), whole.state_hash(), "the same births");
    for gpu in exact_adapters() {
        let found = on_gpu(&gpu, &read, &exact(None), &[120]);
        assert_eq!(found.state_hash(), whole.state_hash(), "{}", gpu.info().name);
    }
}

#[test]
fn another_wind_is_taken_over_and_another_number_of_particles_refused() {
    let world = world();
    let mut windy = world.compiled.scene().clone();
    windy.wind.speed = MeanSpeed::MetresPerSecond(9.0);
    let mut compiled = world.compiled.clone();
    compiled.retune(&windy);
    let mut fewer = world.compiled.scene().clone();
    fewer.particles[1].count += 1;
    let other = World::build(&fewer).expect("valid");
    let gpu = exact_adapters().pop().expect("an adapter that keeps the exact contract");
    let mut simulators: Vec<Box<dyn Simulator>> = vec![
        Box::new(CpuSimulator::new(&world, CpuOptions::default()).expect("threads start")),
        Box::new(WgpuSimulator::new(&gpu, &world, &exact(None)).expect("the device takes it")),
    ];
    let mut hashes = Vec::new();
    for simulator in &mut simulators {
        let refused = simulator.set_scene(&other.compiled);
        assert!(matches!(refused, Err(SimError::Size { store: "particles", .. })), "{refused:?}");
        simulator.step(30).expect("it steps");
        simulator.set_scene(&compiled).expect("the same sizes");
        simulator.step(30).expect("it steps");
        let mut found = world.clone();
        simulator.read_state(&mut found).expect("same size");
        hashes.push(found.state_hash());
    }
    assert_eq!(hashes[0], hashes[1], "on both backends");
    assert_ne!(hashes[0], on_cpu(&world, CpuOptions::default(), 60).state_hash(), "the wind counts");
}

#[test]
fn changes_of_a_constant_or_an_operator_are_noticed() {
    // With one leaf that is not let go nothing but particles moves, and their kernels are all that has to be compiled.
    let mut scene = particle_scene(31, 4.0, DT_S);
    scene.sources.truncate(1);
    scene.sources[0].count = 1;
    scene.sources[0].release = Release::Burst { at_s: 60.0 };
    scene.ground.litter.iter_mut().for_each(|litter| litter.leaf_area_index = 0.0);
    let course = Course::new(World::build(&scene).expect("valid with one leaf"), &LOOKS);
    let gpu = exact_adapters().pop().expect("an adapter that keeps the exact contract");
    let edits = [
        ("particle/step", "age < life", "age <= life"),
        ("particle/force", "row + 1u, at).place", "row, at).place"),
        ("particle/force_carrier", "row.z * max(", "row.y * max("),
        ("particle/step", "return rest_frame(frame, new_way_s)", "return frame"),
        (
            "kernels/carry_forces",
            "placed_carriers[row + 1u] = rows.end",
            "placed_carriers[row + 1u] = rows.middle",
        ),
        ("kernels/keep_history", "step_block.index + 1u", "step_block.index"),
        ("kernels/keep_history", "history_run.first + id.x", "id.x"),
        ("kernels/pull_particles", "begin + local_id.x", "begin + (local_id.x ^ 1u)"),
        ("kernels/land_flakes", "scene.snow.flake_water;", "scene.snow.flake_water + 1u;"),
        ("kernels/land_flakes", "left -= share", "left -= min(share, 1u)"),
        ("kernels/step_snow", "one.water - after.water", "one.depth - after.depth"),
        (
            "kernels/step_snow",
            "on.height_m - other_on.height_m, way_m",
            "other_on.height_m - on.height_m, way_m",
        ),
    ];
    let unchanged = course.first_difference(&gpu, &exact(None));
    assert!(unchanged.is_none(), "both backends move particles alike: {unchanged:?}");
    two_at_a_time(&gpu, edits.into_iter(), |gpu, (module, old, new)| {
        assert!(course.notices(gpu, module, old, new), "{module}: '{new}' goes unnoticed");
    });
}

/// Snow that a storm takes along, among things in its way and around the edges: the same bits with any number of threads and on both backends,
/// and changes are noticed.
#[test]
fn drifting_snow_is_equal_to_the_bit() {
    let mut scene = particle_scene(35, 16.0, DT_S);
    scene.particles.retain(Particles::is_snow);
    scene.forces.clear();
    scene.sources.truncate(1);
    scene.sources[0].count = 1;
    scene.sources[0].release = Release::Burst { at_s: 60.0 };
    scene.ground.litter.iter_mut().for_each(|litter| litter.leaf_area_index = 0.0);
    let weather = scene.weather.as_mut().expect("it snows");
    weather.air_c = vec![(0.0, -6.0)];
    weather.lying_h = 0.02;
    let world = World::build(&scene).expect("valid");
    let expected = on_cpu(&world, CpuOptions { simd: Some(Simd::Scalar), threads: Some(1) }, 200);
    let calm = {
        scene.wind.speed = MeanSpeed::MetresPerSecond(2.0);
        on_cpu(&World::build(&scene).expect("valid"), CpuOptions::default(), 200)
    };
    let snow = |world: &World| world.bed.snow(world.compiled.block()).water.to_vec();
    let moved = snow(&expected).iter().zip(snow(&calm)).filter(|(one, two)| **one != *two).count();
    assert!(moved > 1000, "the storm takes it along: {moved} cells");
    for threads in [1, 3, 16] {
        let options = CpuOptions { threads: Some(threads), ..CpuOptions::default() };
        let apart = difference(&on_cpu(&world, options, 200), &expected);
        assert!(apart.is_none(), "{threads} threads: {apart:?}");
    }
    let course = Course::new(world, &[36, 180]);
    let gpu = exact_adapters().pop().expect("an adapter that keeps the exact contract");
    let edits = [
        ("kernels/step_snow", "snow_drift(here, rise_m", "snow_drift(there, rise_m"),
        ("kernels/step_snow", "drifted_depth(to)", "to.depth"),
        ("kernels/step_snow", "center.x, depth_m, center.y", "center.x, 0.0, center.x"),
        ("kernels/press_snow", "solid_of_rows(number,", "solid_of_rows(0u,"),
        ("kernels/press_snow", "cells] = after.depth", "cells] = before.depth"),
        ("terrain/snow", "cell - column, is_around", "cell, is_around"),
        ("terrain/snow", "return SnowPair(column, false, true)", "return none"),
        ("terrain/snow", "left * toward <= 0.0", "left * toward >= 0.0"),
    ];
    let unchanged = course.first_difference(&gpu, &exact(None));
    assert!(unchanged.is_none(), "both backends drift snow alike: {unchanged:?}");
    two_at_a_time(&gpu, edits.into_iter(), |gpu, (module, old, new)| {
        assert!(course.notices(gpu, module, old, new), "{module}: '{new}' goes unnoticed");
    });
}

/// Snow on the branches of a tree in a storm, which bends them and falls from them: the same bits with any instructions and threads and on both
/// backends, and changes are noticed.
#[test]
fn snow_on_branches_is_equal_to_the_bit() {
    let mut scene = particle_scene(36, 9.0, DT_S);
    scene.particles.retain(Particles::is_snow);
    scene.particles.push(Particles {
        name: "falls".into(),
        count: 37,
        release: ParticleRelease::BranchSnow,
        life_s: Some(Spread::Constant(3.0)),
        air: Air::Settling { m_s: Spread::Constant(6.0) },
        meets: Meets::Die,
        ..Particles::default()
    });
    scene.forces.clear();
    scene.sources.clear();
    scene.autumn = 0.3;
    scene.ground.litter.iter_mut().for_each(|litter| litter.leaf_area_index = 0.0);
    scene.tree_kinds = vec![TreeKind {
        name: "maple".into(),
        form: TreeForm::Preset(TreePreset::Maple),
        ..TreeKind::default()
    }];
    let tree = Tree { kind: "maple".into(), at_m: [1.0, -0.5], age: 0.35, leaves: 300, ..Tree::default() };
    scene.trees = vec![tree];
    let weather = scene.weather.as_mut().expect("it snows");
    (weather.lying_mm, weather.air_c) = (9.0, vec![(0.0, -1.0)]);
    let world = World::build(&scene).expect("valid");
    let held = |world: &World| {
        let held = world.bed.branch_snow(world.compiled.block());
        held.iter().copied().map(u64::from).sum::<u64>()
    };
    let expected = on_cpu(&world, CpuOptions { simd: Some(Simd::Scalar), threads: Some(1) }, 400);
    assert!(
        held(&world) > 1000 && held(&expected) != held(&world),
        "branches hold snow, and catch more or lose it"
    );
    let falls = &expected.particle_stats()[1];
    assert!(falls.born > 20 && falls.died > 10, "snow falls from branches: {falls:?}");
    let bent = (world.branches.pose.iter().zip(&expected.branches.pose)).filter(|(a, b)| a != b).count();
    assert!(bent > world.branches.pose.len() / 2, "{bent} segments have moved");
    for threads in [1, 3, 16] {
        let options = CpuOptions { threads: Some(threads), ..CpuOptions::default() };
        let apart = difference(&on_cpu(&world, options, 400), &expected);
        assert!(apart.is_none(), "{threads} threads: {apart:?}");
    }
    let course = Course::new(world, &[40, 160]);
    let gpu = exact_adapters().pop().expect("an adapter that keeps the exact contract");
    let edits = [
        ("kernels/step_branch_snow", "crown_word(square, pool)]", "crown_word(square, pool + 2u)]"),
        ("kernels/step_branch_snow", "after.lost - after.caught", "after.caught - after.lost"),
        ("kernels/step_branch_snow", "given -= after.lost", "given -= after.caught"),
        (
            "kernels/land_flakes",
            "atomicExchange(&table_words[falling], 0u)",
            "atomicExchange(&table_words[falling], 1u)",
        ),
        ("tree/branch_fall", "row += scene.snow.fall_slots", "row += 1u"),
        ("particle/step", "position = fall_start(row)", "position = fall_start(0u)"),
        ("kernels/step_snow", "CROWN_POOL - crown_pool", "crown_pool"),
        ("tree/branch_snow", "words.x % CROWN_CELLS", "words.y % CROWN_CELLS"),
        ("tree/branch_snow", "1.0 - axis_y * axis_y", "axis_y * axis_y"),
        ("tree/branch_snow", "open <= unit_float", "open > unit_float"),
        ("tree/branch_snow", "[place & 3u]) * SNOW_UNIT_KG", "[place & 3u]) * SNOW_UNIT_KG * 1.1"),
    ];
    let unchanged = course.first_difference(&gpu, &exact(None));
    assert!(unchanged.is_none(), "both backends load branches alike: {unchanged:?}");
    two_at_a_time(&gpu, edits.into_iter(), |gpu, (module, old, new)| {
        assert!(course.notices(gpu, module, old, new), "{module}: '{new}' goes unnoticed");
    });
}
