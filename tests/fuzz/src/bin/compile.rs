// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Scenes that are allowed, however odd: compiled, filled and stepped twice, if they are cheap.
#![no_main]

use libfuzzer_sys::{Corpus, fuzz_mutator, fuzz_target};
use windfall_core::{Scene, World, oracle};
use windfall_fuzz::{budget, pieces};

fuzz_target!(|data: &[u8]| -> Corpus {
    let Ok(text) = std::str::from_utf8(data) else { return Corpus::Reject };
    // What is no scene is the other target's.
    let Ok(scene) = Scene::from_ron(text, "a scene") else { return Corpus::Reject };
    if !budget::is_cheap(&scene) {
        return Corpus::Reject;
    }
    match World::build(&scene) {
        Ok(mut world) => {
            oracle::step(&mut world, 2);
        }
        Err(error) => assert!(!error.to_string().is_empty(), "an error says something"),
    }
    Corpus::Keep
});

fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    pieces::mutate(data, size, max_size, seed)
});
