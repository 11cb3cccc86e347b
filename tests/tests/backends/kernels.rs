// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Tier 2: every kernel, one step from the same uploaded state, on random worlds.

use proptest::prelude::*;
use proptest::test_runner::{Config, TestCaseResult, TestRunner};
use windfall_core::device::leaf::record::GRID_UNIT;
use windfall_core::device::leaf::record::flies;
use windfall_core::{Contract, Scene, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};
use windfall_tests::adapter;
use windfall_tests::compare::{STEP_SEGMENT, STEP_ULPS, difference, ulp};
use windfall_tests::mutation::{edited_kernels, two_at_a_time};
use windfall_tests::strategies::{
    burning_scene, flying_scene, hilly_scene, jet, littered_scene, obstructed_scene, plume, scenes,
    varied_scene,
};
use windfall_wgpu::{Gpu, KernelId, Shaders, WgpuOptions, WgpuSimulator};

/// Topics of edits that are tried under the tolerant contract as well.
const LOOSE_TOPICS: [&str; 2] = ["wind/", "flight/"];
/// Worlds for each adapter and contract.
const WORLDS: u32 = 12;

/// The world of a scene after some steps on the oracle: leaves in every state.
fn warmed(scene: &Scene, steps: u32) -> World {
    let mut world = World::build(scene).expect("random scenes are valid");
    let mut oracle = CpuSimulator::new(&world, CpuOptions::default()).expect("threads start");
    oracle.step(steps).expect("the CPU steps");
    oracle.read_state(&mut world).expect("same size");
    world
}

fn one_step(gpu: &Gpu, contract: Contract, shaders: Option<Shaders>, world: &World) -> (World, World) {
    let options = WgpuOptions { contract: Some(contract), shaders, ..WgpuOptions::default() };
    let mut candidate = WgpuSimulator::new(gpu, world, &options).expect("the device takes the world");
    let mut oracle = CpuSimulator::new(world, CpuOptions::default()).expect("threads start");
    let mut results = (world.clone(), world.clone());
    for (simulator, result) in
        [(&mut oracle as &mut dyn Simulator, &mut results.0), (&mut candidate, &mut results.1)]
    {
        simulator.step(1).expect("one step");
        simulator.read_state(result).expect("same size");
        assert_eq!(simulator.stats().expect("counts"), result.stats(), "measure counts what is there");
    }
    results
}

fn agree(contract: Contract, oracle: &World, candidate: &World) -> TestCaseResult {
    let found = difference(oracle, candidate);
    match contract {
        Contract::Exact => {
            prop_assert!(found.is_none(), "{:?}", found);
            prop_assert_eq!(oracle.state_hash(), candidate.state_hash(), "state hash");
        }
        Contract::Tolerant => {
            let largest = |pick: fn(&World, usize) -> [f32; 3]| {
                (0..oracle.leaves.len()).flat_map(|slot| pick(oracle, slot)).fold(1f32, |a, x| a.max(x.abs()))
            };
            let place = largest(|world, slot| world.leaves.place[slot].position);
            let drift = largest(|world, slot| world.leaves.drift[slot].velocity);
            // What lands at the very end of the step may do so at the beginning of the next.
            prop_assert!(found.leaves().integer_rows <= 1, "{:?}", found);
            prop_assert!(found.is_finite(), "{:?}", found);
            for column in ["base", "pose"] {
                prop_assert!(found.segments().largest(column) <= STEP_SEGMENT, "{:?}", found);
            }
            // Leaves on twigs are as far off as the twigs; at most so fast have twigs come there within a step.
            let is_wooded = !oracle.branches.is_empty();
            let carried = if is_wooded { STEP_SEGMENT } else { 0.0 };
            let swung = carried * oracle.compiled.block().inv_dt_s;
            // A body's step is up to 64 steps of some hundred roundings each, of forces that grow with its speed.
            let is_flown = oracle.leaves.place.iter().any(|place| flies(place.bits));
            let flown = if is_flown { 1e-3 + 3e-4 * drift } else { 0.0 };
            prop_assert!(
                // Up to four displacements may be rounded to the other side of their grid.
                found.leaves().largest("place.position")
                    <= STEP_ULPS * ulp(place) + 4.0 * GRID_UNIT + carried + 0.1 * flown,
                "{:?}, largest position {}",
                found,
                place
            );
            // The wind is read at a place given to within an ulp; a narrow vortex may change it by as much
            // as four times the drift over a metre.
            let reading = 4.0 * drift * ulp(place);
            prop_assert!(
                found.leaves().largest("drift.velocity")
                    <= STEP_ULPS * (ulp(drift) + reading) + swung + flown,
                "{:?}, largest drift {}",
                found,
                drift
            );
            prop_assert!(
                found.leaves().largest("attitude.quaternion") <= 1e-5 + carried + 0.1 * flown,
                "{:?}",
                found
            );
        }
    }
    Ok(())
}

#[test]
fn one_step_agrees_on_every_adapter() {
    for (gpu, contract) in adapter::contracts() {
        let mut proptest = TestRunner::new(Config {
            cases: WORLDS,
            failure_persistence: None,
            max_shrink_iters: 40,
            ..Config::default()
        });
        let strategy = (scenes(1..3000), 0u32..900);
        let outcome = proptest.run(&strategy, |(scene, steps)| {
            let world = warmed(&scene, steps);
            let (oracle, candidate) = one_step(&gpu, contract, None, &world);
            agree(contract, &oracle, &candidate)
        });
        assert!(outcome.is_ok(), "{} {contract}: {}", gpu.info().name, outcome.expect_err("it failed"));
    }
}

/// Mutation: floats that are not numbers show under either contract.
#[test]
fn what_is_not_a_number_is_noticed() {
    let world = warmed(&varied_scene(3, 500, 5.0, 1.0 / 60.0), 200);
    let spoilt: [fn(&mut World); 3] = [
        |world| world.leaves.attitude[250].quaternion[3] = f32::NAN,
        |world| world.leaves.drift[250].velocity[0] = f32::NAN,
        |world| world.leaves.place[250].position[1] = f32::NAN,
    ];
    for (index, spoil) in spoilt.into_iter().enumerate() {
        let mut other = world.clone();
        spoil(&mut other);
        for contract in [Contract::Exact, Contract::Tolerant] {
            assert!(agree(contract, &world, &world).is_ok(), "the same world");
            assert!(agree(contract, &world, &other).is_err(), "{index}: not noticed, {contract}");
            assert!(agree(contract, &other, &world).is_err(), "{index}: not noticed, {contract}");
        }
    }
}

/// Mutation test: each line of the life of a leaf that is changed in WGSL shows within one step of a busy world. Those of functions
/// that the table of functions tries are changed there: an edit here compiles whole kernels.
#[test]
fn a_changed_kernel_is_noticed() {
    let synthesised = [
        ("leaf/fall", "before * part.decay", "before * (part.decay * 1.001)"),
        ("leaf/settle", "(1.0 - share) * scene.dt_s", "share * scene.dt_s"),
        ("leaf/join", "before - after", "after - before"),
        ("leaf/advance", "state == STATE_RESTING) {", "state == STATE_ATTACHED) {"),
        ("wind/sample", "turbulence.y *", "turbulence.x *"),
        ("kernels/sample_air", "0u - step_block.index", "1u - step_block.index"),
    ];
    let blown = [
        ("wind/jet", "(width_squared - squared)", "(width_squared + squared)"),
        ("wind/jet", "* slowed, velocity.y", ", velocity.y"),
    ];
    let risen = [("wind/plume", "turned * past", "turned")];
    let flown = [
        ("flight/rates", "- normal_force,", "+ normal_force,"),
        ("leaf/fly", "motion = step.end", "motion.velocity = step.end.velocity"),
        ("kernels/fly", "counts[turn]", "counts[turn] / 2u"),
    ];
    let hilly = [
        ("terrain/ground", "cell.z * (far - near)", "cell.x * (far - near)"),
        ("wind/sample", "above = height - max(ground_relief", "above = height + max(ground_relief"),
    ];
    let littered = [
        ("leaf/wake", "rest + reach, place.z));", "rest + 2.0 * reach, place.z));"),
        ("leaf/wake", "* RAISING_RAD_S", "* LOOSE_LAYERS"),
        ("leaf/wake", "COVERED_LAYERS < above", "LOOSE_LAYERS * 4.0 < above"),
        ("leaf/lie", "own * scene.gravity_m_s2", "own * 9.0"),
        ("leaf/fly", "contact.position", "contact.position + vec3<f32>(0.0, 0.001, 0.0)"),
        ("kernels/gather_collisions", "first + 11u", "first + 10u"),
        ("leaf/stack", "added = here;", "added = none;"),
        ("kernels/stack_litter", "node + line, heights.z", "node + line, heights.y"),
        ("lists/turns", "0u - step_block.index", "1u - step_block.index"),
        ("kernels/check_cover", "scene.litter.cover_steps", "scene.litter.wake_steps"),
    ];
    let obstructed = [
        ("leaf/strike", "(end - start) * scene.inv_dt_s", "(end - start) * scene.dt_s"),
        ("leaf/strike", "< size_m + way", "< way"),
    ];
    let burned = [
        ("kernels/gather_heat", "first + 2u], heat.sums.power", "first + 2u], heat.sums.count"),
        ("kernels/settle_fires", "fire_rows[row].x, heat_words[word]", "heat_words[word], fire_rows[row].x"),
        ("kernels/follow_leaves", "place.position, drifts", "place.position * 2.0, drifts"),
        ("leaf/burn", "warmth - leaf_rise(species, heat)", "warmth"),
        ("leaf/burn", "stage * scene.species_count", "stage"),
        ("particle/on_leaf", "position = leaf.place", "position = leaf.velocity"),
    ];
    // So many leaves that some land within any step.
    let mut calm = [varied_scene(3, 10_000, 5.0, 1.0 / 60.0), flying_scene(3, 3000, 5.0, 1.0 / 60.0)];
    calm.iter_mut().for_each(|scene| scene.wind.vortices.clear());
    let hills = warmed(&hilly_scene(calm[0].clone()), 400);
    let mut jets = calm[0].clone();
    jets.wind.jets = vec![jet()];
    jets.wind.plumes = vec![plume()];
    let jets = warmed(&jets, 400);
    let litter = warmed(&littered_scene(5, 20_000, 3.5, 1.0 / 60.0), 400);
    let fire = warmed(&burning_scene(5, 600, 0.7, 1.0 / 60.0), 240);
    let solids = warmed(&obstructed_scene(5, 20_000, 2.0, 1.0 / 60.0), 150);
    let [plain, flying] = calm.map(|scene| warmed(&scene, 400));
    for (gpu, contract) in adapter::contracts() {
        let edits = synthesised.map(|edit| (edit, &plain)).into_iter();
        let edits = edits.chain(blown.map(|edit| (edit, &jets)));
        let edits = edits.chain(flown.map(|edit| (edit, &flying))).chain(hilly.map(|edit| (edit, &hills)));
        let edits = edits.chain(risen.map(|edit| (edit, &jets)));
        // The wind decides about lying leaves by comparing floats: to the bit, or not at all. The looser contract sees the same state:
        // of what both could notice, the edits that compile fast are enough for it.
        let is_exact = contract == Contract::Exact;
        let is_tried = |module: &str| is_exact || LOOSE_TOPICS.iter().any(|topic| module.starts_with(topic));
        let edits = edits.filter(|((module, ..), _)| is_tried(module));
        let among =
            littered.map(|edit| (edit, &litter)).into_iter().chain(obstructed.map(|edit| (edit, &solids)));
        let among = among.chain(burned.map(|edit| (edit, &fire)));
        let edits = edits.chain(among.filter(|_| is_exact));
        two_at_a_time(&gpu, edits, |gpu, ((module, old, new), world)| {
            let is_noticed = edited_kernels(world, module, old, new).into_iter().any(|shaders| {
                let (oracle, candidate) = one_step(gpu, contract, Some(shaders), world);
                agree(contract, &oracle, &candidate).is_err()
            });
            assert!(is_noticed, "{} {contract}: nobody noticed '{new}' in {module}", gpu.info().name);
        });
    }
}

#[test]
fn every_kernel_has_a_twin_on_the_cpu() {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/..");
    // The CPU notes which units of slots are idle as it steps them.
    for kernel in KernelId::ALL.into_iter().filter(|kernel| *kernel != KernelId::ListActive) {
        let rust = format!("{root}/backend-cpu/src/kernels/{}.rs", kernel.name());
        let text = std::fs::read_to_string(&rust).unwrap_or_else(|error| panic!("{rust}: {error}"));
        let name = format!("fn {}", kernel.name());
        let is_there = text.split(&name).skip(1).any(|rest| rest.starts_with(['(', '<']));
        assert!(is_there, "{rust} holds no function of its name");
        let source = Shaders::default().kernel(kernel).expect("it composes");
        assert!(
            source.contains(&format!("fn {}(", kernel.name())),
            "{} is its own entry point",
            kernel.name()
        );
    }
}
