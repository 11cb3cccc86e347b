// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Numbers below the normal ones change nothing: graphics processors may take them for zero (NVIDIA's do), so that the same bits come out on all only
//! if there are none that matter. The program runs on a processor that takes them for zero too.

use std::path::PathBuf;
use std::process::Command;

use serde_json::Value;
use tempfile::TempDir;
use windfall_core::Scene;
use windfall_tests::strategies::{
    burning_scene, flying_scene, hilly_scene, obstructed_scene, particle_scene, pond_scene, varied_scene,
    winding_scene,
};

use crate::common_cli::{command, folder};

/// Makes a program flush subnormal numbers from its start on, in all its threads, and say so.
const FLUSHES: &str = r#"
#include <stdio.h>
#include <xmmintrin.h>
__attribute__((constructor)) static void flush(void) {
    _mm_setcsr(_mm_getcsr() | 0x8040);
    volatile float smallest = 1.2e-38f;
    if (smallest * 0.5f == 0.0f) fputs("subnormal numbers are flushed\n", stderr);
}
"#;

/// A library of [`FLUSHES`] for the loader, by the compiler that links Rust.
fn flushing_library(folder: &TempDir) -> PathBuf {
    let (source, library) = (folder.path().join("flush.c"), folder.path().join("flush.so"));
    std::fs::write(&source, FLUSHES).expect("it is written");
    let mut compiler = Command::new("cc");
    compiler.args(["-shared", "-fPIC", "-O0", "-o"]).arg(&library).arg(&source);
    let status = compiler.status().expect("the C compiler, with which Rust links, starts");
    assert!(status.success(), "it compiles");
    library
}

/// Hash of a scene after so many steps on the CPU, with a library loaded before.
fn hash_after(folder: &TempDir, scene: &str, steps: &str, library: Option<&PathBuf>) -> String {
    let mut command = command(
        folder,
        &["simulate", scene, "--allow-outside", "--backend", "cpu", "--steps", steps, "--json"],
    );
    command.envs(library.map(|library| ("LD_PRELOAD", library)));
    let output = command.output().expect("the program starts");
    assert!(output.status.success(), "{scene}: {output:?}");
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(said.contains("subnormal numbers are flushed"), library.is_some(), "{said}");
    let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    report["state_hash"].as_str().expect("a hash").to_owned()
}

#[test]
fn subnormal_numbers_change_nothing() {
    let folder = folder();
    let library = flushing_library(&folder);
    let dt_s = 1.0 / 60.0;
    let scenes: [(&str, Scene); 7] = [
        ("particles.ron", particle_scene(31, 4.0, dt_s)),
        ("particles-on-hills.ron", hilly_scene(particle_scene(32, 7.0, dt_s))),
        ("varied.ron", winding_scene(varied_scene(41, 2000, 3.0, dt_s))),
        ("flying.ron", hilly_scene(flying_scene(42, 500, 4.0, dt_s))),
        ("obstructed.ron", obstructed_scene(43, 1000, 4.0, dt_s)),
        ("pond.ron", pond_scene(44, 1000, 4.0, dt_s)),
        ("burning.ron", burning_scene(45, 1000, 3.0, dt_s)),
    ];
    for (name, scene) in scenes {
        std::fs::write(folder.path().join(name), scene.to_ron()).expect("it is written");
        let [kept, flushed] = [None, Some(&library)].map(|library| hash_after(&folder, name, "300", library));
        assert_eq!(kept, flushed, "{name}");
    }
    for (preset, steps) in [("bonfire", "120"), ("gale", "60"), ("particle-lab", "240"), ("first-snow", "60")]
    {
        let [kept, flushed] =
            [None, Some(&library)].map(|library| hash_after(&folder, preset, steps, library));
        assert_eq!(kept, flushed, "{preset}");
    }
}
