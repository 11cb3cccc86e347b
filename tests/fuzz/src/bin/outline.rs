// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Outlines of pieces as tables of corners: read and measured.
#![no_main]

use std::sync::LazyLock;

use libfuzzer_sys::{fuzz_mutator, fuzz_target};
use windfall_core::scene::Planform;
use windfall_fuzz::folder::Folder;
use windfall_fuzz::pieces;

/// The program's own reader, without the program.
#[path = "../../../../app/src/commands/flight/outline.rs"]
mod outline;

static FOLDER: LazyLock<Folder> = LazyLock::new(Folder::new);

fuzz_target!(|data: &[u8]| {
    let path = FOLDER.write("outline.csv", data);
    match outline::read(&path) {
        Ok(corners) => {
            assert!(corners.len() >= 3 && corners.iter().all(|corner| corner.is_finite()), "an outline");
            Planform::of_outline(&corners);
        }
        Err(error) => assert!(!error.to_string().is_empty(), "an error says something"),
    }
});

fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    pieces::mutate(data, size, max_size, seed)
});
