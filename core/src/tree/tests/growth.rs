// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Growth in time: steady, never back, thick before thin; and the pipe model at every age.

use crate::scene::{Tree, TreePreset};
use crate::tree::growth::{self, Grown};
use crate::tree::turtle::{self, Shoot};

use super::SEED;

/// Ages from seedling to full-grown.
fn ages() -> impl Iterator<Item = f64> {
    (0..=95).map(|step| 0.05 + 0.01 * f64::from(step))
}

/// The shoots of a preset, and the tree at each age by the index of its shoots.
fn life(preset: TreePreset) -> (Vec<Shoot>, f64, Vec<Vec<Option<Grown>>>) {
    let grammar = preset.grammar();
    let settings = *grammar.settings();
    let derivation = grammar.derive(SEED, 3).expect("presets grow");
    let shoots = turtle::draw(&derivation, &settings).expect("presets grow");
    let scale = settings.height_m / growth::full_height(&shoots);
    let life = ages().map(|age| {
        let mut at = vec![None; shoots.len()];
        for grown in growth::grow(&shoots, &settings, scale, age) {
            at[grown.shoot] = Some(grown);
        }
        at
    });
    let life = life.collect();
    (shoots, scale, life)
}

#[test]
fn what_has_grown_stays_and_never_shrinks() {
    for preset in TreePreset::ALL {
        let (shoots, scale, life) = life(preset);
        for (before, after) in life.iter().zip(&life[1..]) {
            for (index, (before, after)) in before.iter().zip(after).enumerate() {
                let Some(before) = before else { continue };
                let after = after.as_ref().unwrap_or_else(|| panic!("{preset:?}: segment {index} has gone"));
                assert!(after.length_m >= before.length_m, "{preset:?}: segment {index} shrinks");
                assert!(after.start_radius_m >= before.start_radius_m, "{preset:?}: segment {index} thins");
                assert!(after.end_radius_m >= before.end_radius_m, "{preset:?}: segment {index} thins");
            }
        }
        let last = life.last().expect("many ages");
        for (shoot, grown) in shoots.iter().zip(last) {
            let length_m = grown.expect("everything is there at last").length_m;
            assert!((length_m - shoot.length * scale).abs() < 1e-9, "{preset:?}: full length");
        }
    }
}

#[test]
fn growth_is_continuous() {
    for preset in TreePreset::ALL {
        let (_, _, life) = life(preset);
        for (before, after) in life.iter().zip(&life[1..]) {
            for (index, (before, after)) in before.iter().zip(after).enumerate() {
                let Some(after) = after else { continue };
                let full_m = life.last().and_then(|last| last[index]).expect("full-grown").length_m;
                let from_m = before.as_ref().map_or(0.0, |before| before.length_m);
                // A hundredth of a life is a fortieth of the time that a shoot grows; powers up to 1.8 make at most
                // that much steeper. A bud may come to a length of a millimetre.
                let most_m = full_m * 1.8 / 40.0 + 0.001 + 1e-9;
                let step_m = after.length_m - from_m;
                assert!(step_m <= most_m, "{preset:?}: segment {index} jumps by {step_m} m of {full_m} m");
            }
        }
    }
}

#[test]
fn thick_branches_come_before_thin_ones() {
    for preset in TreePreset::ALL {
        let (shoots, scale, life) = life(preset);
        for (age, at) in ages().zip(&life) {
            let share = |index: usize| {
                at[index].as_ref().map_or(0.0, |grown| grown.length_m / (shoots[index].length * scale))
            };
            for (index, shoot) in shoots.iter().enumerate() {
                let Some(parent) = shoot.parent else { continue };
                let (thin, thick) = (share(index), share(parent));
                assert!(
                    thin <= thick + 1e-9,
                    "{preset:?} at age {age}: {thin} on {thick} of the full length"
                );
            }
        }
    }
}

#[test]
fn joints_pass_on_what_comes_from_below() {
    for preset in TreePreset::ALL {
        let exponent = preset.grammar().settings().pipe_exponent;
        let (_, _, life) = life(preset);
        let mut tested = 0;
        for at in [&life[30], &life[95]] {
            let segments: Vec<&Grown> = at.iter().flatten().collect();
            let mut above = vec![0.0; segments.len()];
            for segment in &segments {
                if let Some(parent) = segment.parent {
                    above[parent] += libm::pow(segment.start_radius_m, exponent);
                }
            }
            for (segment, above) in segments.iter().zip(above) {
                // Thinner ones have the smallest radius that there is.
                let is_tip = libm::pow(0.4 * segment.start_radius_m, exponent) > above;
                if segment.end_radius_m > 0.0005 && above > 0.0 && !is_tip {
                    let end = libm::pow(segment.end_radius_m, exponent);
                    assert!((end / above - 1.0).abs() < 1e-3, "{preset:?}: {end} carries {above}");
                    tested += 1;
                }
                assert!(segment.end_radius_m <= segment.start_radius_m, "{preset:?}: wood tapers");
            }
        }
        assert!(tested > 20, "{preset:?}: only {tested} joints");
    }
}

#[test]
fn young_trees_are_lower() {
    for preset in TreePreset::ALL {
        let height_m = |age| super::grown(preset, &Tree { age, number: 3, ..Tree::default() }).height_m();
        let heights: Vec<f32> = [0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 1.0].map(height_m).to_vec();
        assert!(heights.is_sorted_by(|a, b| a < b), "{preset:?}: {heights:?}");
        assert!(heights[0] < 0.1 * heights[6], "{preset:?} begins as a seedling: {heights:?}");
    }
}
