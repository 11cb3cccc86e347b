// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Checkpoints, with length and checksum set right: read, and saved with the same state.
#![no_main]

use libfuzzer_sys::{fuzz_mutator, fuzz_target, fuzzer_mutate};
use windfall_core::World;
use windfall_fuzz::random::Random;
use windfall_fuzz::{budget, checksum, pieces};

fuzz_target!(|data: &[u8]| {
    let scene = checksum::checkpoint_parts(data).and_then(|(scene, _)| std::str::from_utf8(scene).ok());
    if scene.is_some_and(|text| !budget::is_cheap_text(text)) {
        return;
    }
    match World::from_checkpoint(data, "a checkpoint") {
        Ok(world) => {
            let mut saved = Vec::new();
            world.write_checkpoint(&mut saved).expect("memory takes everything");
            let parts =
                [data, &saved].map(|bytes| checksum::checkpoint_parts(bytes).expect("it has these parts"));
            assert_eq!(parts[0].1, parts[1].1, "the same state");
        }
        Err(error) => assert!(!error.to_string().is_empty(), "an error says something"),
    }
});

fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    let mut random = Random::new(seed);
    let most = max_size.min(data.len());
    let Some((scene, rest)) = checksum::checkpoint_parts(&data[..size]) else {
        return fuzzer_mutate(data, size, most);
    };
    let head = data[..12.min(size)].to_vec();
    let (mut scene, mut rest) = (scene.to_vec(), rest.to_vec());
    let change = |part: &mut Vec<u8>, change: fn(&mut [u8], usize, usize, u32) -> usize, seed| {
        let size = part.len();
        part.resize(size + size / 8 + 64, 0);
        let most = part.len();
        let size = change(part, size, most, seed);
        part.truncate(size);
    };
    match random.below(8) {
        0 => return fuzzer_mutate(data, size, most),
        1..4 => change(&mut scene, pieces::mutate, seed),
        _ => change(&mut rest, |data, size, most, _| fuzzer_mutate(data, size, most), seed),
    }
    let whole = checksum::checkpoint(&head, &scene, &rest);
    let size = whole.len().min(most);
    data[..size].copy_from_slice(&whole[..size]);
    size
});
