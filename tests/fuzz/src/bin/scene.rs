// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Texts of scenes: read, checked, and written and read again to the same scene.
#![no_main]

use libfuzzer_sys::{fuzz_mutator, fuzz_target};
use windfall_core::Scene;
use windfall_fuzz::pieces;

fuzz_target!(|data: &[u8]| {
    let Ok(text) = std::str::from_utf8(data) else { return };
    match Scene::from_ron(text, "a scene") {
        Ok(scene) => {
            let written = scene.to_ron();
            let again = Scene::from_ron(&written, "the scene again").expect("what is written can be read");
            assert_eq!(again.to_ron(), written, "the same scene");
        }
        Err(error) => assert!(!error.to_string().is_empty(), "an error says something"),
    }
});

fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    pieces::mutate(data, size, max_size, seed)
});
