// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! From spectra to linear sRGB: daylight (CIE D65) and the 2° observer.

use super::prospect::{Leaf, Wavelength};

/// First wavelength and spacing in nm of everything here.
const FIRST_NM: f64 = 400.0;
const SPACING_NM: f64 = 10.0;

/// Relative power of CIE standard illuminant D65 every 10 nm from 400 to 780 nm.
const D65: [f64; 39] = [
    82.7549, 91.486, 93.4318, 86.6823, 104.865, 117.008, 117.812, 114.861, 115.923, 108.811, 109.354,
    107.802, 104.79, 107.689, 104.405, 104.046, 100.0, 96.3342, 95.788, 88.6856, 90.0062, 89.5991, 87.6987,
    83.2886, 83.6992, 80.0268, 80.2146, 82.2778, 78.2842, 69.7213, 71.6091, 74.349, 61.604, 69.8856, 75.087,
    63.5927, 46.4182, 66.8054, 63.3828,
];

/// XYZ to linear sRGB (IEC 61966-2-1).
const TO_SRGB: [[f64; 3]; 3] = [
    [3.240_625, -1.537_208, -0.498_629],
    [-0.968_931, 1.875_756, 0.041_518],
    [0.055_710, -0.204_021, 1.056_996],
];

/// Colour matching functions of the CIE 2° observer as lobes (Wyman, Sloan and Shirley 2013).
fn observer(wavelength_nm: f64) -> [f64; 3] {
    let lobe = |height: f64, centre: f64, left: f64, right: f64| {
        let z = (wavelength_nm - centre) / if wavelength_nm < centre { left } else { right };
        height * libm::exp(-0.5 * z * z)
    };
    [
        lobe(1.056, 599.8, 37.9, 31.0) + lobe(0.362, 442.0, 16.0, 26.7) + lobe(-0.065, 501.1, 20.4, 26.2),
        lobe(0.821, 568.8, 46.9, 40.5) + lobe(0.286, 530.9, 16.3, 31.1),
        lobe(1.217, 437.0, 11.8, 36.0) + lobe(0.681, 459.0, 26.0, 13.8),
    ]
}

/// Wavelengths with their weights in red, green and blue; a white surface sums to 1 in each.
pub(super) struct Eye {
    wavelengths: Vec<(Wavelength, [f64; 3])>,
}

impl Eye {
    pub(super) fn new() -> Self {
        let mut wavelengths = Vec::with_capacity(D65.len());
        let mut white = [0.0; 3];
        for (index, power) in (0_u8..).zip(D65) {
            let nm = FIRST_NM + SPACING_NM * f64::from(index);
            let xyz = observer(nm).map(|x| x * power);
            let rgb = TO_SRGB.map(|row| row[0] * xyz[0] + row[1] * xyz[1] + row[2] * xyz[2]);
            for (sum, part) in white.iter_mut().zip(rgb) {
                *sum += part;
            }
            wavelengths.push((Wavelength::new(nm), rgb));
        }
        for (_, weights) in &mut wavelengths {
            for (weight, white) in weights.iter_mut().zip(white) {
                *weight /= white;
            }
        }
        Self { wavelengths }
    }

    /// Linear sRGB of a leaf's reflected and transmitted daylight; saturated colours may be slightly negative.
    pub(super) fn see(&self, leaf: &Leaf) -> ([f64; 3], [f64; 3]) {
        let (mut reflected, mut transmitted) = ([0.0; 3], [0.0; 3]);
        for (wavelength, weights) in &self.wavelengths {
            let (r, t) = wavelength.spectrum(leaf);
            for i in 0..3 {
                reflected[i] += weights[i] * r;
                transmitted[i] += weights[i] * t;
            }
        }
        (reflected, transmitted)
    }
}
