// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Colours baked into a table, so that a texel costs a look-up instead of 39 wavelengths.

use std::sync::LazyLock;

use super::light::Eye;
use super::prospect::Leaf;
use crate::math::{floor_i32, luminance};

/// Daylight that a leaf sends back and lets through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Appearance {
    /// Diffuse reflectance in linear sRGB.
    pub reflectance: [f32; 3],
    /// Diffuse transmittance in linear sRGB.
    pub transmittance: [f32; 3],
}

/// One axis: amounts grow with the square of the index, since colour changes fastest near zero.
struct Axis {
    most: f32,
    entries: usize,
}

const CHLOROPHYLL: Axis = Axis { most: 90.0, entries: 13 };
const CAROTENOID: Axis = Axis { most: 24.0, entries: 7 };
const ANTHOCYANIN: Axis = Axis { most: 40.0, entries: 10 };
const BROWN: Axis = Axis { most: 4.0, entries: 10 };

impl Axis {
    fn amount(&self, index: usize) -> f32 {
        let share = index as f32 / (self.entries - 1) as f32;
        self.most * share * share
    }

    /// Entry below an amount, and how far it is to the next.
    fn place(&self, amount: f32) -> (usize, f32) {
        let x = (amount.max(0.0) / self.most).min(1.0).sqrt() * (self.entries - 1) as f32;
        let index = usize::try_from(floor_i32(x)).unwrap_or(0).min(self.entries - 2);
        (index, x - index as f32)
    }
}

/// Reflectance and transmittance at every combination of the axes, brown running fastest.
static TABLE: LazyLock<Vec<[f32; 6]>> = LazyLock::new(|| {
    let eye = Eye::new();
    let mut table = Vec::new();
    for chlorophyll in 0..CHLOROPHYLL.entries {
        for carotenoid in 0..CAROTENOID.entries {
            for anthocyanin in 0..ANTHOCYANIN.entries {
                for brown in 0..BROWN.entries {
                    let amounts = [
                        CHLOROPHYLL.amount(chlorophyll),
                        CAROTENOID.amount(carotenoid),
                        ANTHOCYANIN.amount(anthocyanin),
                        BROWN.amount(brown),
                    ];
                    let (r, t) = eye.see(&leaf(amounts));
                    #[expect(clippy::cast_possible_truncation, reason = "colours need no more than f32")]
                    table.push([r[0], r[1], r[2], t[0], t[1], t[2]].map(|x| x as f32));
                }
            }
        }
    }
    table
});

/// A leaf with these pigments; browning tissue dries and fills with air, which the plates count.
fn leaf([chlorophyll, carotenoid, anthocyanin, brown]: [f32; 4]) -> Leaf {
    let dryness = (f64::from(brown) / 0.6).min(1.0);
    Leaf {
        structure: 1.6 + 0.6 * dryness,
        chlorophyll: chlorophyll.into(),
        carotenoid: carotenoid.into(),
        anthocyanin: anthocyanin.into(),
        brown: brown.into(),
        dry_matter: 0.005,
    }
}

impl Appearance {
    /// Looks pigments up: chlorophyll, carotenoid and anthocyanin in µg/cm², brown in its own unit.
    pub(super) fn of(amounts: [f32; 4]) -> Self {
        let axes = [CHLOROPHYLL, CAROTENOID, ANTHOCYANIN, BROWN];
        let places: [(usize, f32); 4] = std::array::from_fn(|i| axes[i].place(amounts[i]));
        let table = &*TABLE;
        let mut mixed = [0.0_f32; 6];
        for corner in 0..16_usize {
            let (mut index, mut weight) = (0, 1.0);
            for (axis, (below, share)) in axes.iter().zip(places).enumerate().map(|(k, (a, p))| ((a, k), p)) {
                let up = corner >> axis.1 & 1;
                index = index * axis.0.entries + below + up;
                weight *= if up == 1 { share } else { 1.0 - share };
            }
            if weight > 0.0 {
                for (sum, value) in mixed.iter_mut().zip(table[index]) {
                    *sum += weight * value;
                }
            }
        }
        let [r, g, b, tr, tg, tb] = mixed.map(|x| x.max(0.0));
        Self { reflectance: [r, g, b], transmittance: [tr, tg, tb] }
    }

    /// Light that passes through for each unit of light in a colour that the leaf shows, both as luminance.
    pub(crate) fn transmitted(&self, shown: [f32; 3]) -> f32 {
        luminance(self.transmittance) / luminance(shown).max(1e-3)
    }

    /// Diffuse colour of a leaf that daylight reaches from both sides, as falling leaves show it. The gloss of the
    /// surface is taken off: whoever lights the leaf adds it again.
    pub fn in_daylight(&self) -> [f32; 3] {
        // Most of the light from behind comes on to the eye; ground and foliage shade the rest.
        const FROM_BEHIND: f32 = 0.75;
        // About half of what a cuticle of index 1.45 mirrors: the other half is too rough to look like gloss.
        const GLOSS: f32 = 0.02;
        std::array::from_fn(|i| {
            let diffuse = (self.reflectance[i] - GLOSS).max(0.002);
            diffuse + FROM_BEHIND * self.transmittance[i]
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn table_agrees_with_the_model() {
        let eye = Eye::new();
        let mut worst = 0.0_f64;
        for amounts in [
            [45.0, 9.0, 0.0, 0.0],
            [3.3, 7.1, 1.3, 0.07],
            [0.4, 8.6, 13.0, 0.2],
            [12.0, 6.0, 4.0, 0.5],
            [0.0, 2.2, 0.6, 1.4],
            [70.0, 12.0, 30.0, 3.0],
        ] {
            let (r, t) = eye.see(&leaf(amounts));
            let found = Appearance::of(amounts);
            for i in 0..3 {
                worst = worst.max((f64::from(found.reflectance[i]) - r[i].max(0.0)).abs());
                worst = worst.max((f64::from(found.transmittance[i]) - t[i].max(0.0)).abs());
            }
        }
        assert!(worst < 0.012, "the table is off by {worst}");
    }

    #[test]
    fn bands_reproduce_the_reference_model() {
        let text = include_str!("prospect_d_reference.csv");
        let eye = Eye::new();
        let (mut worst, mut sum, mut cases) = (0.0_f64, 0.0, 0.0);
        for line in text.lines().filter(|line| !line.starts_with('#') && !line.starts_with("case")) {
            let fields: Vec<&str> = line.split(',').collect();
            let number = |i: usize| fields[i].parse::<f64>().expect("a number");
            let leaf = Leaf {
                structure: number(1),
                chlorophyll: number(2),
                carotenoid: number(3),
                anthocyanin: number(4),
                brown: number(5),
                dry_matter: number(7),
            };
            #[expect(clippy::cast_possible_truncation, reason = "colours need no more than f32")]
            let seen = eye.see(&leaf).0.map(|light| light as f32);
            let lab = crate::lab::from_linear(seen);
            let far = (0..3).map(|i| (f64::from(lab[i]) - number(13 + i)).powi(2)).sum::<f64>().sqrt();
            let spectrum = [(450.0, 8), (550.0, 9), (650.0, 10), (700.0, 11)];
            let off = spectrum
                .iter()
                .map(|&(nm, i)| {
                    (crate::season::prospect::Wavelength::new(nm).spectrum(&leaf).0 - number(i)).abs()
                })
                .fold(0.0, f64::max);
            assert!(off < 0.005, "{}: reflectance off by {off}", fields[0]);
            worst = worst.max(far);
            sum += far;
            cases += 1.0;
        }
        assert!(worst < 0.6, "worst colour difference (CIE76) is {worst}");
        assert!(sum / cases < 0.3, "mean colour difference is {}", sum / cases);
    }
}
