// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Tier 3: ten thousand leaves, a thousand steps, wind and ground. Under the exact contract the state is the same to
//! the last bit, in any wind. Under the tolerant one, in a wind without chaos, the integers of all leaves but one in a thousand are the same and
//! positions stay together; in turbulence a rounding error grows e-fold every second or so, and the counts still agree.

use windfall_core::motion::JOINED_COUNT;
use windfall_core::{Clock, CompiledScene, Contract, SimError, Simulator, SimulatorInfo, Stats, World};
use windfall_cpu::{CpuOptions, CpuSimulator};
use windfall_tests::compare::{LONG_OTHERS, LONG_POSITION_M, LONG_QUATERNION, difference};
use windfall_tests::strategies::{flying_scene, hilly_scene, smooth_scene, varied_scene, winding_scene};
use windfall_tests::{adapter, suite};
use windfall_wgpu::{Shaders, WgpuOptions, WgpuSimulator};

use crate::stepped::{exact, exact_adapters, on_cpu, on_gpu};

const LEAVES: u32 = 10_000;
const STEPS: u32 = 1000;

fn world() -> World {
    World::build(&varied_scene(2015, LEAVES, 3.0, 1.0 / 60.0)).expect("the varied scene is valid")
}

fn is_lively(world: &World) {
    let stats = world.stats();
    assert!(stats.leaves.falling > 500 && stats.leaves.resting > 500, "leaves fly and lie: {stats:?}");
    assert!(
        stats.leaves.primitives[..JOINED_COUNT].iter().all(|&count| count > 0),
        "all motions that are joined are flown: {stats:?}"
    );
    assert_eq!(stats.leaves.broken, 0, "no broken leaf");
}

#[test]
fn a_thousand_steps_are_equal_to_the_bit_under_the_exact_contract() {
    let world = world();
    let oracle = on_cpu(&world, CpuOptions::default(), STEPS);
    is_lively(&oracle);
    for gpu in exact_adapters() {
        let candidate = on_gpu(&gpu, &world, &exact(None), &[STEPS]);
        let found = difference(&oracle, &candidate);
        assert!(found.is_none(), "{}: {found:?}", gpu.info().name);
        assert_eq!(oracle.state_hash(), candidate.state_hash(), "{}", gpu.info().name);
    }
}

/// The same on hills with a pond between them, with trees and bodies.
#[test]
fn a_thousand_steps_on_hills_are_equal_to_the_bit_under_the_exact_contract() {
    let scene = hilly_scene(flying_scene(2016, LEAVES / 4, 3.0, 1.0 / 60.0));
    let world = World::build(&scene).expect("the hilly scene is valid");
    let oracle = on_cpu(&world, CpuOptions::default(), STEPS);
    is_lively(&oracle);
    for (gpu, contract) in adapter::contracts() {
        if contract == Contract::Exact {
            let options = WgpuOptions { contract: Some(contract), ..WgpuOptions::default() };
            let candidate = on_gpu(&gpu, &world, &options, &[STEPS]);
            let found = difference(&oracle, &candidate);
            assert!(found.is_none(), "{}: {found:?}", gpu.info().name);
            assert_eq!(oracle.state_hash(), candidate.state_hash(), "{}", gpu.info().name);
        }
    }
}

/// The same of leaves on cone spirals among others: to the bit, and together.
#[test]
fn a_thousand_steps_of_cone_spirals_agree() {
    for (gpu, contract) in adapter::contracts() {
        let air = if contract == Contract::Exact { varied_scene } else { smooth_scene };
        let world =
            World::build(&winding_scene(air(2017, LEAVES / 2, 3.0, 1.0 / 60.0))).expect("it is valid");
        let oracle = on_cpu(&world, CpuOptions::default(), STEPS);
        is_lively(&oracle);
        let winding = oracle.stats().leaves.primitives[JOINED_COUNT];
        assert!(winding > 500, "{winding} leaves on cone spirals");
        let options = WgpuOptions { contract: Some(contract), ..WgpuOptions::default() };
        let found = difference(&oracle, &on_gpu(&gpu, &world, &options, &[STEPS]));
        let is_near = match contract {
            Contract::Exact => found.is_none(),
            Contract::Tolerant => {
                found.leaves().integer_rows <= (LEAVES / LONG_OTHERS) as usize
                    && found.is_finite()
                    && found.leaves().largest("place.position") <= LONG_POSITION_M
                    && found.leaves().largest("attitude.quaternion") <= LONG_QUATERNION
            }
        };
        println!("{} {contract}: {found:?}", gpu.info().name);
        assert!(is_near, "{} {contract}: {found:?}", gpu.info().name);
    }
}

#[test]
fn a_thousand_smooth_steps_stay_together_under_the_tolerant_contract() {
    let world =
        World::build(&smooth_scene(2015, LEAVES, 3.0, 1.0 / 60.0)).expect("the smooth scene is valid");
    let oracle = on_cpu(&world, CpuOptions::default(), STEPS);
    is_lively(&oracle);
    for gpu in adapter::all() {
        let options = WgpuOptions { contract: Some(Contract::Tolerant), ..WgpuOptions::default() };
        let found = difference(&oracle, &on_gpu(&gpu, &world, &options, &[STEPS]));
        let others = found.leaves().integer_rows;
        assert!(others <= (LEAVES / LONG_OTHERS) as usize, "{}: {found:?}", gpu.info().name);
        assert!(
            found.is_finite() && found.leaves().largest("place.position") <= LONG_POSITION_M,
            "{}: {found:?}",
            gpu.info().name
        );
        assert!(
            found.leaves().largest("attitude.quaternion") <= LONG_QUATERNION,
            "{}: {found:?}",
            gpu.info().name
        );
    }
}

#[test]
fn in_chaos_the_counts_agree_under_the_tolerant_contract() {
    let world = world();
    let expected = on_cpu(&world, CpuOptions::default(), STEPS).stats();
    for gpu in adapter::all() {
        let options = WgpuOptions { contract: Some(Contract::Tolerant), ..WgpuOptions::default() };
        let found = on_gpu(&gpu, &world, &options, &[STEPS]).stats();
        let off = found.leaves.falling.abs_diff(expected.leaves.falling);
        assert!(off <= LEAVES / 1000, "{}: {found:?}, expected {expected:?}", gpu.info().name);
    }
}

/// State larger than one binding is paged; the pages change nothing.
#[test]
fn pages_change_nothing() {
    let world = world();
    for gpu in adapter::all() {
        let whole = on_gpu(&gpu, &world, &WgpuOptions::default(), &[STEPS]);
        let options = WgpuOptions { page_leaves: Some(4096), ..WgpuOptions::default() };
        let simulator = WgpuSimulator::new(&gpu, &world, &options).expect("the device takes the world");
        assert_eq!(simulator.page_count(), 3, "10,000 leaves in pages of 4,096");
        let paged = on_gpu(&gpu, &world, &options, &[STEPS]);
        assert_eq!(whole.state_hash(), paged.state_hash(), "{}", gpu.info().name);
    }
}

/// Mutation test: the last bit of one constant shows.
#[test]
fn one_bit_of_one_constant_is_noticed() {
    let world = world();
    let oracle = on_cpu(&world, CpuOptions::default(), STEPS);
    let old = "const LENGTH_UNIT: f32 = 0.0009765625f";
    let shaders = Shaders::default().edited("prelude", old, "const LENGTH_UNIT: f32 = 0.00097656262f");
    let shaders = shaders.expect("the constant is in the prelude");
    for gpu in adapter::all() {
        let options = WgpuOptions { shaders: Some(shaders.clone()), ..WgpuOptions::default() };
        let candidate = on_gpu(&gpu, &world, &options, &[STEPS]);
        let found = difference(&oracle, &candidate);
        assert!(found.leaves().bit_rows > 0, "{}: nobody noticed: {found:?}", gpu.info().name);
        assert_ne!(oracle.state_hash(), candidate.state_hash(), "{}", gpu.info().name);
    }
}

/// The suite that backends of others are checked with: ours pass it, and one with a wrong constant does not.
#[test]
fn the_suite_for_other_backends_passes_ours_and_notices_a_wrong_bit() {
    let old = "const LENGTH_UNIT: f32 = 0.0009765625f";
    let shaders = Shaders::default().edited("prelude", old, "const LENGTH_UNIT: f32 = 0.00097656262f");
    let shaders = shaders.expect("the constant is there");
    for (gpu, contract) in adapter::contracts() {
        let options = WgpuOptions { contract: Some(contract), ..WgpuOptions::default() };
        for case in suite::worlds(300) {
            let passed = suite::check(&case, |world| WgpuSimulator::new(&gpu, world, &options));
            assert_eq!(passed, Ok(()), "{} {contract}", gpu.info().name);
        }
        if contract == Contract::Exact {
            let wrong = WgpuOptions { shaders: Some(shaders.clone()), ..options };
            let case = &suite::worlds(300)[1];
            let error =
                suite::check(case, |world| WgpuSimulator::new(&gpu, world, &wrong)).expect_err("wrong");
            assert!(error.contains("too far"), "{error}");
        }
    }
}

/// A backend under the tolerant contract that spoils a state before it hands it over.
struct Spoilt(CpuSimulator, fn(&mut World));

impl Simulator for Spoilt {
    fn info(&self) -> SimulatorInfo {
        SimulatorInfo { contract: Contract::Tolerant, ..self.0.info() }
    }

    fn clock(&self) -> Clock {
        self.0.clock()
    }

    fn write_state(&mut self, world: &World) -> Result<(), SimError> {
        self.0.write_state(world)
    }

    fn read_state(&mut self, world: &mut World) -> Result<(), SimError> {
        self.0.read_state(world)?;
        self.1(world);
        Ok(())
    }

    fn set_scene(&mut self, compiled: &CompiledScene) -> Result<(), SimError> {
        self.0.set_scene(compiled)
    }

    fn step(&mut self, count: u32) -> Result<(), SimError> {
        self.0.step(count)
    }

    fn sync(&mut self) -> Result<(), SimError> {
        self.0.sync()
    }

    fn stats(&mut self) -> Result<Stats, SimError> {
        self.0.stats()
    }
}

/// Mutation: floats that are not numbers, and leaves that fall elsewhere, show under the tolerant contract.
#[test]
fn the_suite_notices_what_is_not_a_number_under_the_tolerant_contract() {
    let spoil: [fn(&mut World); 4] = [
        |_| (),
        |world| world.leaves.attitude[7].quaternion[0] = f32::NAN,
        |world| world.leaves.drift[7].velocity[2] = f32::NAN,
        |world| world.leaves.place.iter_mut().for_each(|place| place.position[1] += 0.02),
    ];
    for case in suite::worlds(300) {
        for (index, spoil) in spoil.into_iter().enumerate() {
            let outcome = suite::check(&case, |world| {
                Ok(Spoilt(CpuSimulator::new(world, CpuOptions::default())?, spoil))
            });
            assert_eq!(outcome.is_err(), index > 0, "{}: mutation {index}: {outcome:?}", case.name);
        }
    }
}
