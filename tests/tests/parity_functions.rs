// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Tier 1: every device function gives the same results in Rust and in WGSL.

use std::cell::RefCell;

use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use windfall_core::{Contract, World};
use windfall_tests::adapter;
use windfall_tests::functions::{FUNCTIONS, Function};
use windfall_tests::runner::{FunctionRunner, Words};
use windfall_tests::strategies::{cases, varied_scene};
use windfall_wgpu::{Gpu, Shaders};

/// Cases in one dispatch; not a multiple of the workgroup size.
const CASES: usize = 1234;
/// Dispatches for each function.
const ROUNDS: u32 = 6;

fn world() -> World {
    let mut world = World::build(&varied_scene(5, 300, 6.0, 1.0 / 60.0)).expect("the varied scene is valid");
    for _ in 0..100 {
        world.clock.advance(&world.environment.clone());
    }
    world
}

/// Why a case's results do not fit, if they do not.
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
            (a - b).abs() <= tolerance * scale
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

/// Runs one function on random cases; the first case that does not fit, if any.
fn check(
    gpu: &Gpu,
    contract: Contract,
    shaders: &Shaders,
    function: &Function,
    world: &World,
) -> Result<(), String> {
    let runner = FunctionRunner::new(gpu, contract, shaders, function, world)
        .map_err(|error| format!("{}: {error}", function.name))?;
    let step = world.environment.step_block(&world.clock);
    let cx = world.environment.context(&step);
    let failure = RefCell::new(None);
    let mut proptest = TestRunner::new(Config {
        cases: ROUNDS,
        max_shrink_iters: 0,
        failure_persistence: None,
        ..Config::default()
    });
    let outcome = proptest.run(&cases(function.inputs, CASES), |inputs| {
        let results = runner.run(&inputs).expect("the device is there");
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

#[test]
fn functions_agree_on_every_adapter() {
    let world = world();
    let mut failures = Vec::new();
    for (gpu, contract) in adapter::contracts() {
        for function in FUNCTIONS {
            if let Err(message) = check(&gpu, contract, &Shaders::default(), function, &world) {
                failures.push(format!("{} {contract}: {message}", gpu.info().name));
            }
        }
    }
    assert!(failures.is_empty(), "{} of the functions differ:\n{}", failures.len(), failures.join("\n"));
}

/// Canary: one constant or operator changed in one twin is noticed by the function that uses it.
#[test]
fn a_changed_twin_is_noticed() {
    let edits = [
        ("kernel/math", "0.5 * r2", "0.4999 * r2", "sin_cos_turns"),
        ("kernel/rng", "high1 ^ c.y", "high1 ^ c.z", "philox"),
        ("motion/lookup", "row + 1u), fraction_of", "row + 2u), fraction_of", "motion_displacement"),
        ("wind/gust", "row.y - row.x", "row.x - row.y", "wind_gust"),
        ("leaf/settle", "0.5 * seconds", "0.51 * seconds", "slide"),
        ("leaf/release", "<< 17u, extent", "<< 16u, extent", "release_place"),
    ];
    let world = world();
    for (gpu, contract) in adapter::contracts() {
        for (module, old, new, name) in edits {
            let shaders = Shaders::default().edited(module, old, new).expect("the edited text is there");
            let function =
                FUNCTIONS.iter().find(|function| function.name == name).expect("a function of the table");
            let result = check(&gpu, contract, &shaders, function, &world);
            assert!(result.is_err(), "{name} agrees on {} although {module} says '{new}'", gpu.info().name);
        }
    }
}
