// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Perceived difference of two colours.

use crate::lab::Lab;

/// Colour difference CIEDE2000 with unit weights.
///
/// # Source
/// Sharma, Wu and Dalal 2005, "The CIEDE2000 color-difference formula", eq. 2 to 22.
pub(super) fn delta_e2000(first: Lab, second: Lab) -> f32 {
    let [l1, a1, b1] = first.map(f64::from);
    let [l2, a2, b2] = second.map(f64::from);
    let seventh = |c: f64| (libm::pow(c, 7.0) / (libm::pow(c, 7.0) + 6_103_515_625.0)).sqrt();
    let chroma = |a: f64, b: f64| (a * a + b * b).sqrt();
    let g = 0.5 * (1.0 - seventh((chroma(a1, b1) + chroma(a2, b2)) / 2.0));
    let (a1, a2) = (a1 * (1.0 + g), a2 * (1.0 + g));
    let (c1, c2) = (chroma(a1, b1), chroma(a2, b2));
    let hue = |a: f64, b: f64| {
        if a == 0.0 && b == 0.0 { 0.0 } else { libm::atan2(b, a).to_degrees().rem_euclid(360.0) }
    };
    let (h1, h2) = (hue(a1, b1), hue(a2, b2));
    let grey = c1 * c2 == 0.0;
    let turn = if grey { 0.0 } else { (h2 - h1 + 180.0).rem_euclid(360.0) - 180.0 };
    // At exactly opposite hues the sign of the turn is a convention: half a turn forward.
    let turn = if turn == -180.0 && h2 > h1 { 180.0 } else { turn };
    let (dl, dc) = (l2 - l1, c2 - c1);
    let dh = 2.0 * (c1 * c2).sqrt() * libm::sin((turn / 2.0).to_radians());
    let (l, c) = ((l1 + l2) / 2.0, (c1 + c2) / 2.0);
    let h = match () {
        () if grey => h1 + h2,
        () if (h1 - h2).abs() <= 180.0 => (h1 + h2) / 2.0,
        () if h1 + h2 < 360.0 => (h1 + h2 + 360.0) / 2.0,
        () => (h1 + h2 - 360.0) / 2.0,
    };
    let cosine = |degrees: f64| libm::cos(degrees.to_radians());
    let t = 1.0 - 0.17 * cosine(h - 30.0) + 0.24 * cosine(2.0 * h) + 0.32 * cosine(3.0 * h + 6.0)
        - 0.20 * cosine(4.0 * h - 63.0);
    let bend = 60.0 * libm::exp(-((h - 275.0) / 25.0) * ((h - 275.0) / 25.0));
    let off = (l - 50.0) * (l - 50.0);
    let sl = 1.0 + 0.015 * off / (20.0 + off).sqrt();
    let (sc, sh) = (1.0 + 0.045 * c, 1.0 + 0.015 * c * t);
    let rotation = -libm::sin(bend.to_radians()) * 2.0 * seventh(c);
    let (x, y, z) = (dl / sl, dc / sc, dh / sh);
    #[expect(clippy::cast_possible_truncation, reason = "a small number")]
    let difference = (x * x + y * y + z * z + rotation * y * z).max(0.0).sqrt() as f32;
    difference
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pairs 1, 4, 7, 9, 17, 20 and 25 of table 1 in Sharma, Wu and Dalal 2005.
    #[test]
    fn published_pairs() {
        let pairs: [(Lab, Lab, f32); 7] = [
            ([50.0, 2.6772, -79.7751], [50.0, 0.0, -82.7485], 2.0425),
            ([50.0, -1.3802, -84.2814], [50.0, 0.0, -82.7485], 1.0000),
            ([50.0, 0.0, 0.0], [50.0, -1.0, 2.0], 2.3669),
            ([50.0, 2.49, -0.001], [50.0, -2.49, 0.0009], 7.1792),
            ([50.0, 2.5, 0.0], [73.0, 25.0, -18.0], 27.1492),
            ([50.0, 2.5, 0.0], [58.0, 24.0, 15.0], 19.4535),
            ([60.2574, -34.0099, 36.2677], [60.4626, -34.1751, 39.4387], 1.2644),
        ];
        for (first, second, expected) in pairs {
            for found in [delta_e2000(first, second), delta_e2000(second, first)] {
                assert!(
                    (found - expected).abs() < 2e-4,
                    "{first:?} {second:?}: {found}, expected {expected}"
                );
            }
        }
    }
}
