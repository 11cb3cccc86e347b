// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Colours that stand for something.
//!
//! Amounts go from dark violet over teal to light yellow: lightness grows evenly, so the order survives in grey and for eyes
//! that see fewer colours. Kinds of motion have the colours of `windfall flight`.

use glam::Vec3;
use windfall_core::motion::PRIMITIVE_COUNT;
use windfall_core::shared_constants;

shared_constants! {
    /// Colours of an amount.
    pub(crate) const SHADES: u32 = 16;
    /// Index of the colour of leaves at rest, behind those of amounts.
    pub(crate) const RESTING_COLOR: u32 = SHADES;
    /// Index of the colour of leaves on twigs.
    pub(crate) const ATTACHED_COLOR: u32 = SHADES + 1;
    /// Index of the colour of leaves without a value.
    pub(crate) const NO_COLOR: u32 = SHADES + 2;
}

/// Lightness, chroma and hue in degrees of OKLCH at the ends of the amounts.
const LOW: [f32; 3] = [0.30, 0.12, 295.0];
const HIGH: [f32; 3] = [0.92, 0.15, 100.0];
/// Least chroma on the way, where the hues between have less room.
const WAIST: f32 = 0.07;

/// The kinds of motion in the order of [`Primitive::ALL`](windfall_core::motion::Primitive::ALL), with their colours in sRGB.
pub const MOTIONS: [(&str, [u8; 3]); PRIMITIVE_COUNT] = [
    ("steady", [120, 132, 140]),
    ("tumbling", [222, 142, 28]),
    ("chaotic", [186, 60, 48]),
    ("fluttering", [44, 124, 176]),
    ("helical", [62, 138, 84]),
    ("spiralling", [126, 84, 162]),
    ("cone spiral", [226, 116, 168]),
];
/// At rest, on its twig, and of a leaf about which nothing is known yet.
pub const RESTING: [u8; 3] = [82, 66, 50];
/// On its twig.
pub const ATTACHED: [u8; 3] = [84, 98, 70];
/// Nothing is known yet.
pub(crate) const NONE: [u8; 3] = [70, 70, 70];

/// The colour of a share of an amount, 0 to 1, linear sRGB.
pub(crate) fn shade(share: f32) -> Vec3 {
    let t = share.clamp(0.0, 1.0);
    let [lightness, chroma, hue] = std::array::from_fn(|index| LOW[index] + t * (HIGH[index] - LOW[index]));
    let waist = 4.0 * t * (1.0 - t);
    let chroma = chroma + waist * (WAIST - chroma).min(0.0);
    let (sin, cos) = hue.to_radians().sin_cos();
    linear_of_oklab(Vec3::new(lightness, chroma * cos, chroma * sin)).clamp(Vec3::ZERO, Vec3::ONE)
}

/// The same as bytes of sRGB.
pub fn shade_bytes(share: f32) -> [u8; 3] {
    shade(share).to_array().map(encode)
}

/// The colour of a population of particles, linear sRGB: hues by the golden angle, so that neighbours lie far apart, in turn light and
/// dark.
pub(crate) fn population(number: usize) -> Vec3 {
    let lightness = if number.is_multiple_of(2) { 0.78 } else { 0.60 };
    let (sin, cos) = (30.0 + 137.507_77 * number as f32).to_radians().sin_cos();
    linear_of_oklab(Vec3::new(lightness, 0.13 * cos, 0.13 * sin)).clamp(Vec3::ZERO, Vec3::ONE)
}

/// The same as bytes of sRGB.
pub fn population_bytes(number: usize) -> [u8; 3] {
    population(number).to_array().map(encode)
}

/// Bytes of sRGB as linear light.
pub(crate) fn linear(bytes: [u8; 3]) -> Vec3 {
    Vec3::from(bytes.map(|byte| {
        let share = f32::from(byte) / 255.0;
        if share <= 0.040_45 { share / 12.92 } else { ((share + 0.055) / 1.055).powf(2.4) }
    }))
}

fn encode(light: f32) -> u8 {
    let share = if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a share of a byte")]
    let byte = (share.clamp(0.0, 1.0) * 255.0).round() as u8;
    byte
}

/// Linear sRGB of OKLab (Ottosson 2020).
fn linear_of_oklab(Vec3 { x: l, y: a, z: b }: Vec3) -> Vec3 {
    let cube = |x: f32| x * x * x;
    let long = cube(l + 0.396_337_78 * a + 0.215_803_76 * b);
    let medium = cube(l - 0.105_561_346 * a - 0.063_854_17 * b);
    let short = cube(l - 0.089_484_18 * a - 1.291_485_5 * b);
    Vec3::new(
        4.076_741_7 * long - 3.307_711_6 * medium + 0.230_969_94 * short,
        -1.268_438 * long + 2.609_757_4 * medium - 0.341_319_4 * short,
        -0.004_196_086_3 * long - 0.703_418_6 * medium + 1.707_614_7 * short,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn luminance(color: Vec3) -> f32 {
        color.dot(Vec3::new(0.2126, 0.7152, 0.0722))
    }

    #[test]
    fn more_is_lighter_and_neighbours_differ_alike() {
        let colors: Vec<Vec3> = (0..=20u8).map(|step| shade(f32::from(step) / 20.0)).collect();
        // CIE lightness, 0 to 1.
        let lightness: Vec<f32> = colors.iter().map(|color| 1.16 * luminance(*color).cbrt() - 0.16).collect();
        let steps: Vec<f32> = lightness.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let (least, most) =
            steps.iter().fold((f32::MAX, 0.0_f32), |(low, high), s| (low.min(*s), high.max(*s)));
        assert!(least > 0.015 && most < 2.5 * least, "steps of lightness from {least} to {most}");
        assert!(lightness[0] < 0.3 && lightness[20] > 0.85, "from dark to light: {lightness:?}");
    }

    #[test]
    fn shades_need_no_clipping() {
        for step in 0..=20u8 {
            let share = f32::from(step) / 20.0;
            let color = shade(share);
            assert!(color.min_element() > 0.0 && color.max_element() < 1.0, "{share}: {color}");
        }
    }

    #[test]
    fn bytes_come_back() {
        for byte in [0, 3, 10, 11, 60, 128, 254, 255] {
            assert_eq!(linear([byte; 3]).to_array().map(encode), [byte; 3], "there and back");
        }
    }

    #[test]
    fn populations_are_told_apart() {
        let colors: Vec<Vec3> = (0..windfall_core::scene::MAX_POPULATIONS).map(population).collect();
        for (first, a) in colors.iter().enumerate() {
            for (second, b) in colors.iter().enumerate().skip(first + 1) {
                let apart = (a.map(f32::sqrt) - b.map(f32::sqrt)).length();
                let least = if second < 8 { 0.15 } else { 0.05 };
                assert!(apart > least, "{first} and {second}: {apart}");
            }
        }
    }

    #[test]
    fn kinds_of_motion_are_told_apart() {
        let colors: Vec<Vec3> = MOTIONS.iter().map(|(_, bytes)| linear(*bytes)).collect();
        for (first, a) in colors.iter().enumerate() {
            for (second, b) in colors.iter().enumerate().skip(first + 1) {
                let apart = (a.map(f32::sqrt) - b.map(f32::sqrt)).length();
                assert!(apart > 0.15, "{} and {}: {apart}", MOTIONS[first].0, MOTIONS[second].0);
            }
        }
    }
}
