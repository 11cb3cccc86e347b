// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Programs in C and C++ with the library: they compile without a warning, and say what Rust says.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use windfall_core::{Scene, Simulator, World};
use windfall_cpu::{CpuOptions, CpuSimulator};

/// Compiles a program of this package and runs it.
fn run(compiler: &[&str], source: &str, arguments: &[&str]) -> Output {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    // The library lies beside this test.
    let libraries = std::env::current_exe().expect("a program").parent().expect("a folder").to_owned();
    let name = Path::new(source).file_stem().expect("a name");
    let program = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let (compiler, options) = compiler.split_first().expect("a compiler");
    let compiled = Command::new(compiler)
        .args(options)
        .args(["-O1", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-I"])
        .arg(package.join("include"))
        .arg(package.join(source))
        .arg("-L")
        .arg(&libraries)
        .arg("-lwindfall_c")
        .arg(format!("-Wl,-rpath,{}", libraries.display()))
        .arg("-o")
        .arg(&program)
        .output()
        .expect("the compiler, with which Rust links, starts");
    assert!(compiled.status.success(), "{source}: {}", String::from_utf8_lossy(&compiled.stderr));
    Command::new(program).args(arguments).output().expect("it starts")
}

/// Text that a program printed that succeeded.
fn printed(output: &Output) -> String {
    assert!(output.status.success(), "{output:?}");
    String::from_utf8(output.stdout.clone()).expect("UTF-8")
}

#[test]
fn a_c_program_gets_the_bits_that_rust_gets() {
    let mut world = World::build(&Scene::preset("six-motions").expect("a preset")).expect("valid");
    let mut simulator = CpuSimulator::new(&world, CpuOptions::default()).expect("threads start");
    simulator.step(120).expect("it steps");
    simulator.read_state(&mut world).expect("the state is in memory");
    let heights = world.leaves.place.iter().map(|place| f64::from(place.position[1]));
    let wanted = format!(
        "{:.3} s, {} leaves, {} in the air, mean height {:.4} m, hash {:016x}\n",
        world.clock.seconds(),
        world.leaves.len(),
        world.stats().leaves.falling,
        heights.sum::<f64>() / world.leaves.len() as f64,
        world.state_hash(),
    );
    for backend in ["cpu", "wgpu"] {
        let found = printed(&run(&["cc", "-std=c99"], "examples/fall.c", &["six-motions", "120", backend]));
        assert_eq!(found, wanted, "on {backend}");
    }
}

#[test]
fn presets_have_the_same_hashes_in_c() {
    let table = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/state_hashes.csv");
    let table = std::fs::read_to_string(table).expect("a table");
    assert!(table.lines().count() > 5, "{table}");
    for line in table.lines().skip(1) {
        let row: Vec<&str> = line.split(',').collect();
        let text = printed(&run(&["cc", "-std=c99"], "examples/fall.c", &[row[0], row[1], "cpu"]));
        assert!(text.trim_end().ends_with(&format!(", hash {}", row[2])), "{line}: {text}");
    }
}

#[test]
fn a_c_program_is_told_what_the_command_says() {
    let output = run(&["cc", "-std=c99"], "tests/misuse.c", &[]);
    assert_eq!(printed(&output), "all refused as they should be\n");
}

#[test]
fn a_cpp_program_makes_instances() {
    let text = printed(&run(&["c++", "-std=c++17"], "examples/instances.cpp", &["flight-lab", "60"]));
    let words: Vec<&str> = text.split_whitespace().collect();
    let count: usize = words[0].parse().expect("a number");
    let off: f64 = words[5].parse().expect("a number");
    assert!(count > 0 && off < 1e-4, "{text}");
}
