// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Tier 1: every device function gives the same results in Rust and in WGSL.

use std::cell::RefCell;

use glam::{Vec2, Vec3};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use windfall_core::device::leaf::burn::fire_words;
use windfall_core::scene::{Burning, Litter, Meets, ParticleRelease, Plume, VortexProfile};
use windfall_core::{Contract, Scene, World};
use windfall_tests::adapter;
use windfall_tests::functions::{self, Function};
use windfall_tests::mutation::two_at_a_time;
use windfall_tests::runner::{FunctionRunner, Words, carriers_of};
use windfall_tests::strategies::{
    cases, flying_scene, hilly_scene, jet, obstructed_scene, particle_scene, plume, winding_scene,
};
use windfall_wgpu::{Gpu, Shaders};

use crate::function_edits::EDITS;

/// Cases in one dispatch; not a multiple of the workgroup size.
const CASES: usize = 1234;
/// Dispatches for each function.
const ROUNDS: u32 = 6;

/// A bed of several layers.
fn bed() -> Litter {
    Litter { size_m: Vec2::splat(12.0), leaf_area_index: 3.0, adhesion_n_m2: 0.5, ..Litter::default() }
}

/// Populations of particles, for the functions that read one.
fn add_particles(scene: &mut Scene) {
    let with = particle_scene(7, 4.0, 1.0 / 60.0);
    (scene.particles, scene.forces, scene.weather) = (with.particles, with.forces, with.weather);
    // Of these, none is born of the fifth.
    let falls = &mut scene.particles[4];
    (falls.release, falls.meets) = (ParticleRelease::BranchSnow, Meets::Die);
}

fn world(litter: Option<Litter>) -> World {
    let mut scene = hilly_scene(flying_scene(5, 300, 6.0, 1.0 / 60.0));
    scene.wind.jets = vec![jet()];
    scene.wind.plumes = vec![plume()];
    scene.ground.litter = litter;
    if litter.is_some() {
        scene.sources.iter_mut().for_each(|source| source.recycle_after_s = None);
        (scene.regrow_after_s, scene.species[0].burns) = (None, Some(Burning::default()));
        scene.wind.plumes.push(Plume {
            name: "fed".into(),
            fed_within_m: Some(3.0),
            keys: Vec::new(),
            ..plume()
        });
    }
    add_particles(&mut scene);
    let mut world = World::build(&scene).expect("the flying scene is valid on hills");
    for _ in 0..100 {
        world.compiled.advance(&mut world.clock);
    }
    let block = *world.compiled.block();
    world.bed.branch_snow_mut(&block).falls.iter_mut().step_by(3).for_each(|units| *units = 100);
    if litter.is_some() {
        add_ridges(&mut world);
        let fires = world.bed.fires_mut(world.compiled.block());
        fires.iter_mut().for_each(|fire| *fire = fire_words(300_000, 900_000));
        let snow = world.bed.snow_mut(world.compiled.block());
        (0..)
            .zip(snow.depth)
            .for_each(|(cell, depth): (u32, _)| *depth = cell.wrapping_mul(0x9E37_79B9) >> 15);
    }
    world
}

/// Raises ridges of litter across the bed, a metre wide and a metre apart.
fn add_ridges(world: &mut World) {
    let block = &world.compiled.block().litter;
    let (line, count) = (block.columns as usize + 1, world.bed.heights(block).len());
    for (node, height) in world.bed.words[..count].iter_mut().enumerate() {
        *height += if node % line / 8 % 2 == 0 { 150_000 } else { 0 };
    }
}

/// The same with solid things, half a second after its start.
fn obstructed() -> World {
    let mut scene = hilly_scene(flying_scene(5, 300, 6.0, 1.0 / 60.0));
    let among = obstructed_scene(6, 300, 4.0, 1.0 / 60.0);
    scene.ground.litter = Some(bed());
    for vortex in &mut scene.wind.vortices {
        vortex.profile = VortexProfile::Compact { d: 0.5 };
        vortex.spline_m =
            (0..5u8).map(|point| vortex.center_m + Vec3::new(0.3, 1.0, 0.1) * f32::from(point)).collect();
        vortex.spline_m[2].x += 1.0;
    }
    (scene.objects, scene.walkers) = (among.objects, among.walkers);
    scene.wind.plumes = vec![plume()];
    scene = winding_scene(scene);
    add_particles(&mut scene);
    let mut world = World::build(&scene).expect("valid");
    for _ in 0..30 {
        world.compiled.advance(&mut world.clock);
    }
    world
}

/// Particles in a wind without small eddies, in which leaves and flakes sample the air once in several steps.
fn windswept() -> World {
    let mut scene = flying_scene(5, 300, 6.0, 1.0 / 60.0);
    scene.wind.turbulence.cell_m = 10.0;
    scene.wind.vortices.clear();
    scene.wind.plumes = vec![Plume { base_radius_m: 15.0, ..plume() }];
    add_particles(&mut scene);
    let world = World::build(&scene).expect("valid");
    assert_eq!(world.compiled.block().wind.interval_steps, 4, "steps of an interval");
    world
}

/// Reason for which a case's results do not fit, if they do not.
fn mismatch(
    function: &Function,
    contract: Contract,
    input: &Words,
    cpu: &Words,
    gpu: &Words,
) -> Option<String> {
    if cpu == gpu {
        return None;
    }
    let floats = |words: &Words| words.map(f32::from_bits);
    if let (Contract::Tolerant, Some(tolerance)) = (contract, function.tolerance) {
        let largest = floats(input)
            .into_iter()
            .chain(floats(cpu))
            .filter(|x| x.is_finite() && x.abs() < 1e6)
            .fold(1f32, |largest, x| largest.max(x.abs()));
        let close = |(a, b): (f32, f32)| {
            let scale = largest.max(a.abs());
            a.to_bits() == b.to_bits() || (a - b).abs() <= tolerance * scale
        };
        if floats(cpu).into_iter().zip(floats(gpu)).all(close) {
            return None;
        }
    }
    Some(format!(
        "{}: input {input:x?}: cpu {cpu:x?} {:?}, gpu {gpu:x?} {:?}",
        function.name,
        floats(cpu),
        floats(gpu)
    ))
}

/// Runs one function on random cases in each of these worlds; the first case that does not fit, if any.
fn check<'a>(
    gpu: &Gpu,
    contract: Contract,
    shaders: &Shaders,
    function: &Function,
    worlds: impl IntoIterator<Item = &'a World>,
) -> Result<(), String> {
    let runner = FunctionRunner::new(gpu, contract, shaders, function)
        .map_err(|error| format!("{}: {error}", function.name))?;
    worlds.into_iter().try_for_each(|world| check_in(world, &runner, contract, function))
}

/// The same in one world.
fn check_in(
    world: &World,
    runner: &FunctionRunner,
    contract: Contract,
    function: &Function,
) -> Result<(), String> {
    let context = runner.context(world);
    let step = world.compiled.step_block(&world.clock);
    let carriers = carriers_of(world);
    let cx = world.context(&step).with_carriers(&carriers);
    let failure = RefCell::new(None);
    let mut proptest = TestRunner::new(Config {
        cases: ROUNDS,
        max_shrink_iters: 0,
        failure_persistence: None,
        ..Config::default()
    });
    let outcome = proptest.run(&cases(function.inputs, CASES), |inputs| {
        let results = runner.run(&context, &inputs).expect("the device is there");
        for (input, gpu_words) in inputs.iter().zip(&results) {
            let cpu_words = (function.rust)(&cx, input);
            if let Some(message) = mismatch(function, contract, input, &cpu_words, gpu_words) {
                failure.replace(Some(message));
                return Err(TestCaseError::fail("mismatch"));
            }
        }
        Ok(())
    });
    match failure.into_inner() {
        Some(message) => Err(message),
        None => outcome.map_err(|error| format!("{}: {error}", function.name)),
    }
}

/// Functions that rounding decides about under the looser contract (of any inertia, some are all but singular), and those that do so where there is
/// litter.
const STRIKES: [&str; 8] = [
    "core_may_be_met",
    "ground_strike",
    "bent_share",
    "wedged_velocity",
    "particle_contact",
    "particle_push",
    "snow_pressed",
    "quigley_step",
];
const TOUCHES: [&str; 8] = [
    "flight_advance",
    "flight_contact",
    "strike_solids",
    "solid_footing",
    "solids_cell",
    "may_meet_solids_on_way",
    "own_sums",
    "collisions_of",
];

/// Returns true if a function's results in a world can be compared: rounding decides about a strike, and if a body touches, and after that it
/// goes another way. The row of a vortex that is not there divides nothing by nothing, and adapters write the result with either sign.
fn is_comparable(contract: Contract, function: &Function, world: &World) -> bool {
    if function.name == "wind_vortex" && world.compiled.scene().wind.vortices.is_empty() {
        return false;
    }
    let is_loose = contract == Contract::Tolerant;
    let touches = !world.bed.is_empty() && TOUCHES.contains(&function.name);
    !(is_loose && (touches || STRIKES.contains(&function.name)))
}

#[test]
fn functions_agree_on_every_adapter() {
    let worlds = [world(None), world(Some(bed())), obstructed(), windswept()];
    let mut failures = Vec::new();
    for (gpu, contract) in adapter::contracts() {
        for function in functions::all() {
            let worlds = worlds.iter().filter(|world| is_comparable(contract, function, world));
            if let Err(message) = check(&gpu, contract, &Shaders::default(), function, worlds) {
                failures.push(format!("{} {contract}: {message}", gpu.info().name));
            }
        }
    }
    assert!(failures.is_empty(), "{} of the functions differ:\n{}", failures.len(), failures.join("\n"));
}

/// Mutation test: one constant or operator changed in one twin is noticed by the function that uses it.
#[test]
fn a_changed_twin_is_noticed() {
    let worlds = [world(None), world(Some(bed())), obstructed(), windswept()];
    for (gpu, contract) in adapter::contracts() {
        two_at_a_time(&gpu, EDITS.into_iter(), |gpu, (module, old, new, name)| {
            let shaders = Shaders::default().edited(module, old, new).expect("the edited text is there");
            let function =
                functions::all().find(|function| function.name == name).expect("a function of the table");
            let worlds = worlds.iter().filter(|world| is_comparable(contract, function, world));
            let worlds: Vec<_> = worlds.collect();
            if worlds.is_empty() {
                return;
            }
            let noticed = check(gpu, contract, &shaders, function, worlds);
            let noticed = noticed.err().unwrap_or_else(|| panic!("{module}: '{new}' goes unnoticed"));
            assert!(noticed.contains(": input "), "{name} differs on {}: {noticed}", gpu.info().name);
        });
    }
}

/// Functions that only a kernel can call, as they read or write records of leaves and segments.
const RECORDS: [&str; 17] = [
    "places",
    "drifts",
    "attitudes",
    "schedules",
    "identities",
    "burns",
    "segments",
    "branch_rows",
    "work_rows",
    "leaf_counts",
    "carrier_rows",
    "carried",
    "particle_places",
    "particle_motions",
    "particle_traits",
    "particle_tallies",
    "carrier_run",
];

/// Names and bodies of the functions of a WGSL text.
fn bodies(text: &str) -> Vec<(&str, &str)> {
    let pieces = text.split("\nfn ").skip(1);
    pieces.filter_map(|piece| Some((piece.split_once('(')?.0, piece.split_once("\n}")?.0))).collect()
}

/// Returns true if a text says this word, as `is_call` a call.
fn says(text: &str, word: &str, is_call: bool) -> bool {
    let is_part = |character: char| character.is_alphanumeric() || character == '_';
    text.match_indices(word).any(|(at, _)| {
        let (before, after) = (&text[..at], &text[at + word.len()..]);
        !before.ends_with(is_part) && !after.starts_with(is_part) && (!is_call || after.starts_with('('))
    })
}

/// Every device function that works on numbers alone is in the table, or called by one that is. Lists only order the work, and have
/// tests of their own.
#[test]
fn the_table_reaches_every_function_of_numbers() {
    let shaders = Shaders::default();
    let is_of_state = |name: &&str| !name.starts_with("kernels/") && !name.starts_with("lists/");
    let names: Vec<_> = shaders.names().filter(is_of_state).collect();
    let all: Vec<_> =
        names.iter().flat_map(|name| bodies(shaders.text(name).expect("a module of this name"))).collect();
    assert!(all.len() > 80, "only {} functions found", all.len());
    let mut reached: Vec<bool> = all
        .iter()
        .map(|(name, _)| functions::all().any(|function| says(function.wgsl, name, true)))
        .collect();
    let mut on_records: Vec<bool> =
        all.iter().map(|(_, body)| RECORDS.iter().any(|record| says(body, record, false))).collect();
    let calls: Vec<(usize, usize)> = (0..all.len())
        .flat_map(|caller| (0..all.len()).map(move |callee| (caller, callee)))
        .filter(|&(caller, callee)| caller != callee && says(all[caller].1, all[callee].0, true))
        .collect();
    // Calls go at most as deep as there are functions.
    for _ in 0..all.len() {
        for &(caller, callee) in &calls {
            reached[callee] |= reached[caller];
            on_records[caller] |= on_records[callee];
        }
    }
    let missing: Vec<_> =
        (0..all.len()).filter(|&i| !reached[i] && !on_records[i]).map(|i| all[i].0).collect();
    assert!(missing.is_empty(), "no case calls {missing:?}");
    let of_records = on_records.iter().filter(|&&is| is).count();
    assert!(
        2 * of_records < all.len(),
        "most functions are of numbers alone, all but {of_records} of {}",
        all.len()
    );
}
