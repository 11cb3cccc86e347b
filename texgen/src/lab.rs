// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! CIE 1976 L\*a\*b\* under D65: the space in which colours are measured, mixed and matched.

use crate::math::{linear_from_srgb, srgb_from_linear};

/// Lightness 0 to 100 and the two opponent axes.
pub(crate) type Lab = [f32; 3];

/// White of D65 for the 2 degree observer.
const WHITE: [f32; 3] = [0.950_47, 1.0, 1.088_83];
/// Value below which a line replaces the cube root: (6/29)^3.
const LINEAR_BELOW: f32 = 216.0 / 24389.0;

/// Lab of an sRGB colour.
pub(crate) fn from_srgb(rgb: [u8; 3]) -> Lab {
    from_linear(rgb.map(linear_from_srgb))
}

/// Lab of linear sRGB light (IEC 61966-2-1).
pub(crate) fn from_linear([r, g, b]: [f32; 3]) -> Lab {
    let xyz = [
        0.412_456_4 * r + 0.357_576_1 * g + 0.180_437_5 * b,
        0.212_672_9 * r + 0.715_152_2 * g + 0.072_175 * b,
        0.019_333_9 * r + 0.119_192 * g + 0.950_304_1 * b,
    ];
    let f = |t: f32| {
        if t > LINEAR_BELOW { libm::cbrtf(t) } else { t * (841.0 / 108.0) + 4.0 / 29.0 }
    };
    let [x, y, z] = [0, 1, 2].map(|i| f(xyz[i] / WHITE[i]));
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// sRGB of a Lab colour; what no screen can show is clipped channel by channel.
pub(crate) fn to_srgb([l, a, b]: Lab) -> [u8; 3] {
    let y = (l + 16.0) / 116.0;
    let inverse = |t: f32| {
        if t > 6.0 / 29.0 { t * t * t } else { (t - 4.0 / 29.0) * (108.0 / 841.0) }
    };
    let [x, y, z] =
        [inverse(y + a / 500.0) * WHITE[0], inverse(y) * WHITE[1], inverse(y - b / 200.0) * WHITE[2]];
    let rgb = [
        3.240_454_2 * x - 1.537_138_5 * y - 0.498_531_4 * z,
        -0.969_266 * x + 1.876_010_8 * y + 0.041_556 * z,
        0.055_643_4 * x - 0.204_025_9 * y + 1.057_225_2 * z,
    ];
    rgb.map(srgb_from_linear)
}

/// Sum of two colours.
pub(crate) fn add(a: Lab, b: Lab) -> Lab {
    std::array::from_fn(|i| a[i] + b[i])
}

/// Difference of two colours.
pub(crate) fn sub(a: Lab, b: Lab) -> Lab {
    std::array::from_fn(|i| a[i] - b[i])
}

/// A colour times a number.
pub(crate) fn scale(a: Lab, factor: f32) -> Lab {
    a.map(|x| x * factor)
}

/// Squared Euclidean distance.
pub(crate) fn distance_squared(a: Lab, b: Lab) -> f32 {
    (0..3).map(|i| (a[i] - b[i]) * (a[i] - b[i])).sum()
}

/// Mean of colours; zero of none.
pub(crate) fn mean(colours: impl Iterator<Item = Lab>) -> Lab {
    let (mut sum, mut count) = ([0.0_f64; 3], 0.0_f64);
    for colour in colours {
        for (total, value) in sum.iter_mut().zip(colour) {
            *total += f64::from(value);
        }
        count += 1.0;
    }
    #[expect(clippy::cast_possible_truncation, reason = "a mean of single precision values is one")]
    let mean = sum.map(|total| (total / count.max(1.0)) as f32);
    mean
}

/// Standard deviation of colours about their mean, channel by channel.
pub(crate) fn deviation(mean: Lab, colours: impl Iterator<Item = Lab>) -> Lab {
    let (mut sum, mut count) = ([0.0_f64; 3], 0.0_f64);
    for colour in colours {
        for channel in 0..3 {
            let offset = f64::from(colour[channel] - mean[channel]);
            sum[channel] += offset * offset;
        }
        count += 1.0;
    }
    #[expect(clippy::cast_possible_truncation, reason = "a deviation of single precision values is one")]
    let deviation = sum.map(|sum| (sum / count.max(1.0)).sqrt() as f32);
    deviation
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::{any, prop_assert, proptest};

    #[test]
    fn known_colours() {
        let near = |a: Lab, b: Lab| distance_squared(a, b).sqrt() < 0.02;
        assert!(near(from_srgb([255; 3]), [100.0, 0.0, 0.0]), "{:?}", from_srgb([255; 3]));
        assert!(near(from_srgb([255, 0, 0]), [53.24, 80.09, 67.20]), "{:?}", from_srgb([255, 0, 0]));
        assert!(near(from_srgb([0, 128, 0]), [46.23, -51.70, 49.90]), "{:?}", from_srgb([0, 128, 0]));
    }

    proptest! {
        #[test]
        fn bytes_survive(rgb in any::<[u8; 3]>()) {
            let back = to_srgb(from_srgb(rgb));
            for (a, b) in rgb.into_iter().zip(back) {
                prop_assert!(a.abs_diff(b) <= 1, "{rgb:?} became {back:?}");
            }
        }
    }
}
