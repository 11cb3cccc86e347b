// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Small scalar and plane helpers.

use std::sync::LazyLock;

use glam::Vec2;

/// Linear blend from `a` (t = 0) to `b` (t = 1).
pub(crate) fn lerp(a: f32, b: f32, t: f32) -> f32 {
    a + (b - a) * t
}

/// Smooth step from 0 at `from` to 1 at `to`; `from` may be the larger.
pub(crate) fn smoothstep(from: f32, to: f32, x: f32) -> f32 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Point at a compass bearing in degrees (0 is +y, 90 is +x) and a distance.
pub(crate) fn polar(bearing_deg: f32, radius: f32) -> Vec2 {
    let (sin, cos) = bearing_deg.to_radians().sin_cos();
    Vec2::new(sin, cos) * radius
}

/// Quadratic Bézier point.
pub(crate) fn quadratic(a: Vec2, control: Vec2, b: Vec2, t: f32) -> Vec2 {
    a.lerp(control, t).lerp(control.lerp(b, t), t)
}

/// Floor as an integer; callers stay far inside the range of `i32`. (Older processors have no instruction for it, and a
/// call for each pixel costs more than all else about it.)
pub(crate) fn floor_i32(x: f32) -> i32 {
    #[expect(
        clippy::cast_possible_truncation,
        reason = "the cast saturates and callers pass grid coordinates"
    )]
    let towards_zero = x as i32;
    towards_zero.saturating_sub(i32::from(towards_zero as f32 > x))
}

/// Nearest `f32`, for lengths and colours that need no more.
pub(crate) fn single(x: f64) -> f32 {
    #[expect(clippy::cast_possible_truncation, reason = "rounds to the nearest")]
    let rounded = x as f32;
    rounded
}

/// Nearest byte of a value in 0..=1.
pub(crate) fn to_byte(x: f32) -> u8 {
    #[expect(clippy::cast_possible_truncation, reason = "clamped to 0..=255 first")]
    let byte = (x.clamp(0.0, 1.0) * 255.0).round() as u8;
    byte
}

/// Linear light to an sRGB byte, by the formula.
fn encoded(x: f32) -> u8 {
    to_byte(if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * libm::powf(x, 1.0 / 2.4) - 0.055 })
}

/// Linear light to an sRGB byte.
pub(crate) fn srgb_from_linear(x: f32) -> u8 {
    // Least light of each byte but 0.
    static LEAST: LazyLock<[f32; 255]> = LazyLock::new(|| {
        std::array::from_fn(|below| {
            // Positive numbers are in the order of their bits.
            let (mut less, mut enough) = (0, 1.0_f32.to_bits());
            while enough - less > 1 {
                let middle = less.midpoint(enough);
                if usize::from(encoded(f32::from_bits(middle))) > below {
                    enough = middle;
                } else {
                    less = middle;
                }
            }
            f32::from_bits(enough)
        })
    });
    u8::try_from(LEAST.partition_point(|least| *least <= x)).unwrap_or(u8::MAX)
}

/// sRGB byte to linear light.
pub(crate) fn linear_from_srgb(byte: u8) -> f32 {
    static LINEAR: LazyLock<[f32; 256]> = LazyLock::new(|| {
        std::array::from_fn(|byte| {
            let x = byte as f32 / 255.0;
            if x <= 0.040_45 { x / 12.92 } else { libm::powf((x + 0.055) / 1.055, 2.4) }
        })
    });
    LINEAR[usize::from(byte)]
}

/// Luminance of linear sRGB light.
pub(crate) fn luminance([r, g, b]: [f32; 3]) -> f32 {
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

/// Length of a polyline.
pub(crate) fn path_length(points: &[Vec2]) -> f32 {
    points.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
}

/// Distance from `p` to the segment from `a` to `b`, and where along it (0..=1) the nearest point lies.
pub(crate) fn segment_distance(p: Vec2, a: Vec2, b: Vec2) -> (f32, f32) {
    let along = b - a;
    let t = ((p - a).dot(along) / along.length_squared().max(1e-12)).clamp(0.0, 1.0);
    (p.distance(a + along * t), t)
}

/// Point at a fraction (0..=1) of a polyline's length, and the unit direction there.
pub(crate) fn point_along(points: &[Vec2], fraction: f32) -> (Vec2, Vec2) {
    let mut left = path_length(points) * fraction.clamp(0.0, 1.0);
    let mut last = (points[0], Vec2::Y);
    for pair in points.windows(2) {
        let step = pair[1] - pair[0];
        let length = step.length();
        if length <= 0.0 {
            continue;
        }
        let direction = step / length;
        if left <= length {
            return (pair[0] + direction * left, direction);
        }
        left -= length;
        last = (pair[1], direction);
    }
    last
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn srgb_bytes_survive_the_round_trip() {
        for byte in 0..=255 {
            assert_eq!(srgb_from_linear(linear_from_srgb(byte)), byte, "sRGB transfer must invert");
        }
    }

    #[test]
    fn srgb_bytes_are_those_of_the_formula() {
        for i in 0..=100_000_u32 {
            let x = i as f32 / 80_000.0 - 0.1;
            assert_eq!(srgb_from_linear(x), encoded(x), "byte of {x}");
        }
    }

    #[test]
    fn floors_are_those_of_the_library() {
        for x in [-2.5, -2.0, -1e-9, -0.0, 0.0, 0.5, 1.0, 3e9, -3e9, f32::INFINITY, f32::NAN] {
            #[expect(clippy::cast_possible_truncation, reason = "the cast saturates")]
            let floor = x.floor() as i32;
            assert_eq!(floor_i32(x), floor, "floor of {x}");
        }
    }

    #[test]
    fn half_way_along_a_corner() {
        let (at, direction) = point_along(&[Vec2::ZERO, Vec2::X, Vec2::ONE], 0.75);
        assert!(at.distance(Vec2::new(1.0, 0.5)) < 1e-6, "expected the middle of the second leg, got {at}");
        assert_eq!(direction, Vec2::Y, "second leg points up");
    }
}
