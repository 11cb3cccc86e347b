// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Skies from Radiance pictures: read, laid out by latitude and longitude, parted from the sun, and asked for what shaders need.
#![no_main]

use libfuzzer_sys::fuzz_target;

/// The renderer's own light, without the renderer.
#[path = "../../../../app/render/src/light/mod.rs"]
#[expect(dead_code, unreachable_pub, unused_imports, reason = "skies from files are a part of it")]
mod light;
#[path = "../sky.rs"]
mod sky;

fuzz_target!(|data: &[u8]| {
    if data.starts_with(b"#?") {
        sky::read(data);
    }
});
