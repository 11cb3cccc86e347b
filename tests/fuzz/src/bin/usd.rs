// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Names of scenes, populations and species in USD stages. Each line of an input is a name.
#![no_main]

use std::collections::HashSet;

use libfuzzer_sys::fuzz_target;
use windfall_core::Scene;
use windfall_core::scene::{MAX_POPULATIONS, Particles};
use windfall_fuzz::identifier::{is_prim_name, unquoted};

/// The program's own names and texts, without the program.
#[path = "../../../../app/src/export/names.rs"]
mod names;
#[path = "../../../../app/src/export/usd/text.rs"]
#[expect(dead_code, reason = "texts in quotes are a part of it")]
mod text;

fuzz_target!(|data: &[u8]| {
    let lines: Vec<String> =
        data.split(|byte| *byte == b'\n').map(|line| String::from_utf8_lossy(line).into_owned()).collect();
    let named = |name: &String| Particles { name: name.clone(), ..Particles::default() };
    let particles = lines.iter().take(MAX_POPULATIONS).map(named).collect();
    let scene = Scene { particles, ..Scene::default() };
    let prims = names::prim_names(&scene);
    assert_eq!(
        prims.iter().collect::<HashSet<_>>().len(),
        scene.particles.len(),
        "prims of their own: {prims:?}"
    );
    for prim in &prims {
        assert!(is_prim_name(prim), "{prim:?} is a name");
    }
    for line in &lines {
        let leaf = format!("leaf_0_{}_0", names::plain(line));
        assert!(is_prim_name(&leaf), "{leaf:?} is a name");
        let quoted = text::quoted(line);
        let shown: String = line.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        assert_eq!(unquoted(&quoted), Some(shown), "{quoted} is a text");
    }
});
