// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The way of a picture to the light of a sky, for the targets of both kinds of pictures.

use std::sync::LazyLock;

use windfall_core::scene::{Sky, SkyMap, View};
use windfall_fuzz::folder::Folder;

use super::light::{Daylight, SphericalHarmonics};

static FOLDER: LazyLock<Folder> = LazyLock::new(Folder::new);

/// Reads a sky from the bytes of a file and asks for its light.
pub(super) fn read(bytes: &[u8]) {
    let path = FOLDER.write("sky", bytes);
    let map = SkyMap::new(path.to_string_lossy().into_owned());
    match Daylight::new(&View { sky: Sky::Map(map), ..View::default() }) {
        Ok(day) => {
            assert!(day.sun.direction.is_normalized(), "the sun is somewhere: {}", day.sun.direction);
            let sum = SphericalHarmonics::of(&day.sky);
            std::hint::black_box(sum);
        }
        Err(error) => assert!(!error.to_string().contains('\n'), "an error in one line: {error}"),
    }
}
