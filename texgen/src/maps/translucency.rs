// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Light that passes through a leaf.

/// Share of light that passes through tissue of an sRGB colour. What is neither absorbed nor sent back by pigments
/// comes out on the far side, a little less than on the near one; veins and petiole are thick.
pub(super) fn transmittance(rgb: [u8; 3], thickness: f32) -> f32 {
    let light = |byte: u8| crate::math::linear_from_srgb(byte);
    let [r, g, b] = rgb.map(light);
    let luminance = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    (0.9 * luminance * libm::expf(-1.7 * thickness)).clamp(0.0, 1.0)
}
