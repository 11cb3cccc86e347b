// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A leaf whose colours serve as an example.

use image::RgbImage;

use crate::{Blade, VeinGraph};

/// A pictured leaf with all that is known about it: cut out of a photo or painted.
#[derive(Clone, Debug)]
pub struct Specimen {
    /// Origin, such as a file's name.
    pub name: String,
    /// The picture, upright or not, as large as the blade's mask.
    pub picture: RgbImage,
    /// Place of the leaf in the picture.
    pub blade: Blade,
    /// Its main and lateral veins.
    pub veins: VeinGraph,
}
