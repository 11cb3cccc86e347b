// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Light that passes through a leaf.

use crate::math::{linear_from_srgb, luminance};

/// Share of light that passes through tissue of an sRGB colour: `clearness` times the light that it shows. Veins and
/// petiole are thick and let less through.
pub(super) fn transmittance(rgb: [u8; 3], clearness: f32, thickness: f32) -> f32 {
    (clearness * luminance(rgb.map(linear_from_srgb)) * libm::expf(-1.7 * thickness)).clamp(0.0, 1.0)
}
