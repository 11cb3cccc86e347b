// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Light in a leaf: a stack of absorbing plates (Jacquemoud and Baret 1990; PROSPECT-D, Féret et al. 2017).

use super::absorption::{self, Absorption};

/// Constituents of a leaf.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leaf {
    /// Number of plates: 1 for a compact leaf, 2.5 for a dry one full of air.
    pub(super) structure: f64,
    /// µg/cm².
    pub(super) chlorophyll: f64,
    /// µg/cm².
    pub(super) carotenoid: f64,
    /// µg/cm².
    pub(super) anthocyanin: f64,
    /// Own unit.
    pub(super) brown: f64,
    /// g/cm².
    pub(super) dry_matter: f64,
}

/// Constants of one wavelength that do not depend on the leaf.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wavelength {
    absorption: Absorption,
    index: f64,
    /// Transmittance of a plate's surface for light within 40° and from everywhere.
    enter_40: f64,
    enter_all: f64,
}

impl Wavelength {
    pub(super) fn new(wavelength_nm: f64) -> Self {
        let index = absorption::refractive_index(wavelength_nm);
        Self {
            absorption: absorption::at(wavelength_nm),
            index,
            enter_40: surface_transmittance(40.0, index),
            enter_all: surface_transmittance(90.0, index),
        }
    }

    /// Reflectance and transmittance of a leaf.
    pub(super) fn spectrum(&self, leaf: &Leaf) -> (f64, f64) {
        let a = &self.absorption;
        let k = (leaf.chlorophyll * a.chlorophyll
            + leaf.carotenoid * a.carotenoid
            + leaf.anthocyanin * a.anthocyanin
            + leaf.brown * a.brown
            + leaf.dry_matter * a.dry_matter)
            / leaf.structure;
        let tau = if k <= 0.0 { 1.0 } else { (1.0 - k) * libm::exp(-k) + k * k * exponential_integral(k) };
        let leave = self.enter_all / (self.index * self.index);
        let kept = 1.0 - leave;
        let echo = 1.0 - kept * kept * tau * tau;
        // Top plate, lit from above, and a plate inside the leaf, lit from everywhere.
        let top_t = self.enter_40 * tau * leave / echo;
        let top_r = 1.0 - self.enter_40 + kept * tau * top_t;
        let t = self.enter_all * tau * leave / echo;
        let r = 1.0 - self.enter_all + kept * tau * t;
        let (below_r, below_t) = stack(r, t, leaf.structure - 1.0);
        let between = 1.0 - below_r * r;
        (top_r + top_t * below_r * t / between, top_t * below_t / between)
    }
}

/// Reflectance and transmittance of a pile of equal plates, their number not necessarily whole (Stokes 1862).
fn stack(r: f64, t: f64, plates: f64) -> (f64, f64) {
    if plates <= 0.0 {
        return (0.0, 1.0);
    }
    if r + t >= 1.0 - 1e-12 {
        let through = t / (t + (1.0 - t) * plates);
        return (1.0 - through, through);
    }
    let d = ((1.0 + r + t) * (1.0 + r - t) * (1.0 - r + t) * (1.0 - r - t)).sqrt();
    let a = (1.0 + r * r - t * t + d) / (2.0 * r);
    let b = (1.0 - r * r + t * t + d) / (2.0 * t.max(1e-30));
    let power = libm::pow(b, plates);
    let below = a * a - 1.0 / (power * power);
    (a * (1.0 - 1.0 / (power * power)) / below, (a * a - 1.0) / (power * below))
}

/// Average transmittance of a smooth surface for light within a cone (Stern 1964; Allen 1973).
fn surface_transmittance(cone_deg: f64, n: f64) -> f64 {
    let n2 = n * n;
    let (np, nm) = (n2 + 1.0, n2 - 1.0);
    let a = (n + 1.0) * (n + 1.0) / 2.0;
    let k = -nm * nm / 4.0;
    let sine = libm::sin(cone_deg.to_radians());
    let b2 = sine * sine - np / 2.0;
    let b1 = if cone_deg >= 90.0 { 0.0 } else { (b2 * b2 + k).max(0.0).sqrt() };
    let b = b1 - b2;
    let part = |x: f64| k * k / (6.0 * x * x * x) + k / x - x / 2.0;
    let s = part(b) - part(a);
    let (ub, ua) = (2.0 * np * b - nm * nm, 2.0 * np * a - nm * nm);
    let p = -2.0 * n2 * (b - a) / (np * np) - 2.0 * n2 * np * libm::log(b / a) / (nm * nm)
        + n2 * (1.0 / b - 1.0 / a) / 2.0
        + 16.0 * n2 * n2 * (n2 * n2 + 1.0) * libm::log(ub / ua) / (np * np * np * nm * nm)
        + 16.0 * n2 * n2 * n2 * (1.0 / ub - 1.0 / ua) / (np * np * np);
    (s + p) / (2.0 * sine * sine)
}

/// Exponential integral E₁ (Abramowitz and Stegun 1964, 5.1.11 and the continued fraction 5.1.22).
fn exponential_integral(x: f64) -> f64 {
    const EULER: f64 = 0.577_215_664_901_532_9;
    if x < 1.5 {
        let (mut sum, mut term) = (-EULER - libm::log(x), -1.0);
        let mut k = 1.0;
        while k < 30.0 {
            term *= -x / k;
            let next = sum + term / k;
            // From k = 2 on terms only shrink.
            if next == sum && k >= 2.0 {
                break;
            }
            sum = next;
            k += 1.0;
        }
        return sum;
    }
    let mut fraction = 0.0;
    let mut k = 40.0;
    while k >= 1.0 {
        fraction = k / (1.0 + k / (x + fraction));
        k -= 1.0;
    }
    libm::exp(-x) / (x + fraction)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponential_integral_matches_tables() {
        for (x, expected) in
            [(0.1, 1.822_923_96), (1.0, 0.219_383_93), (2.0, 0.048_900_51), (5.0, 0.001_148_296)]
        {
            let found = exponential_integral(x);
            assert!((found - expected).abs() < 1e-8, "E1({x}) is {found}, tables say {expected}");
        }
    }

    #[test]
    fn no_light_is_made() {
        for structure in [1.0, 1.5, 2.4] {
            let clear = Leaf {
                structure,
                chlorophyll: 0.0,
                carotenoid: 0.0,
                anthocyanin: 0.0,
                brown: 0.0,
                dry_matter: 0.0,
            };
            let (r, t) = Wavelength::new(600.0).spectrum(&clear);
            assert!((r + t - 1.0).abs() < 1e-9, "without absorption all light comes out, got {r} + {t}");
            let (r, t) = Wavelength::new(600.0).spectrum(&Leaf { chlorophyll: 40.0, ..clear });
            assert!(r > 0.0 && t > 0.0 && r + t < 0.9, "chlorophyll absorbs red, got {r} + {t}");
        }
    }
}
