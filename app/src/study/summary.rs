// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! A point of a study in one row.

use windfall_core::device::flight::regime::REGIME_NAMES;
use windfall_core::motion::Primitive;

use super::landing::{Landing, MOTION_COUNT};
use super::statistics::Distribution;

/// Names of the columns behind the point's number and settings. Mean, standard deviation, the lower end of the middle eight in ten, median
/// and the upper end, over the drops that landed, of each quantity; then shares of all time in the air: the motions of synthesised leaves,
/// and the regimes of bodies.
pub(crate) const COLUMNS: [&str; 2 + NUMBERS] = [
    "drops",
    "landed",
    "aloft_mean_s",
    "aloft_std_s",
    "aloft_p10_s",
    "aloft_median_s",
    "aloft_p90_s",
    "descent_mean_m_s",
    "descent_std_m_s",
    "descent_p10_m_s",
    "descent_median_m_s",
    "descent_p90_m_s",
    "drift_mean_m",
    "drift_std_m",
    "drift_p10_m",
    "drift_median_m",
    "drift_p90_m",
    "along_mean_m",
    "along_std_m",
    "along_p10_m",
    "along_median_m",
    "along_p90_m",
    "across_mean_m",
    "across_std_m",
    "across_p10_m",
    "across_median_m",
    "across_p90_m",
    Primitive::SteadyDescent.code(),
    Primitive::PeriodicTumbling.code(),
    Primitive::TransitionalChaotic.code(),
    Primitive::PeriodicFluttering.code(),
    Primitive::TransitionalHelical.code(),
    Primitive::PeriodicSpiraling.code(),
    Primitive::ConeSpiral.code(),
    REGIME_NAMES[0],
    REGIME_NAMES[1],
    REGIME_NAMES[2],
    REGIME_NAMES[3],
    REGIME_NAMES[4],
    REGIME_NAMES[5],
    REGIME_NAMES[6],
];
/// Quantities that have a distribution.
pub(crate) const QUANTITIES: usize = 5;
/// Numbers behind the counts.
const NUMBERS: usize = Distribution::NUMBERS * QUANTITIES + MOTION_COUNT;

/// Numbers of a point. A number that there is none of (nothing landed, one drop has no spread) is NaN.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Summary {
    /// Drops.
    pub drops: u32,
    /// Those that landed in time.
    pub landed: u32,
    /// Time aloft in s, mean descent in m/s, horizontal distance in m, and how far along and across the wind in m.
    pub quantities: [Distribution; QUANTITIES],
    /// Shares of the time in the air, as in [`COLUMNS`].
    pub motions: [f64; MOTION_COUNT],
}

impl Summary {
    /// Of all drops of a point.
    pub(crate) fn of(landings: &[Landing]) -> Self {
        let landed: Vec<&Landing> = landings.iter().filter(|landing| landing.is_landed()).collect();
        let spread = |value: &dyn Fn(&Landing) -> Option<f64>| {
            Distribution::of(landed.iter().filter_map(|landing| value(landing)).collect())
        };
        let mut steps = [0u64; MOTION_COUNT];
        for landing in landings {
            for (sum, own) in steps.iter_mut().zip(landing.steps) {
                *sum += u64::from(own);
            }
        }
        let all: u64 = steps.iter().sum();
        let count = |length: usize| u32::try_from(length).unwrap_or(u32::MAX);
        Self {
            drops: count(landings.len()),
            landed: count(landed.len()),
            quantities: [
                spread(&|landing| landing.end.map(|(_, aloft_s)| aloft_s)),
                spread(&Landing::descent_m_s),
                spread(&|landing| Some(landing.distance_m())),
                spread(&|landing| Some(landing.drift.0)),
                spread(&|landing| Some(landing.drift.1)),
            ],
            motions: steps.map(|own| own as f64 / all as f64),
        }
    }

    /// Fields in the order of [`COLUMNS`]; what is NaN is empty.
    pub(super) fn fields(&self) -> impl Iterator<Item = String> {
        let numbers = self.quantities.iter().flat_map(|quantity| quantity.to_array()).chain(self.motions);
        let number = |number: f64| if number.is_nan() { String::new() } else { number.to_string() };
        [self.drops, self.landed].into_iter().map(|count| count.to_string()).chain(numbers.map(number))
    }

    /// Reads what [`Summary::fields`] gives, bit for bit; `None` for anything else.
    pub(super) fn from_fields<'a>(fields: impl IntoIterator<Item = &'a str>) -> Option<Self> {
        let fields: Vec<&str> = fields.into_iter().collect();
        let [drops, landed, numbers @ ..] = fields.as_slice() else { return None };
        let number = |text: &&str| if text.is_empty() { Some(f64::NAN) } else { text.parse().ok() };
        let numbers: Vec<f64> = numbers.iter().map(number).collect::<Option<_>>()?;
        let (distributions, motions) = numbers.split_at_checked(Distribution::NUMBERS * QUANTITIES)?;
        let (distributions, _) = distributions.as_chunks();
        Some(Self {
            drops: drops.parse().ok()?,
            landed: landed.parse().ok()?,
            quantities: std::array::from_fn(|index| Distribution::from_array(distributions[index])),
            motions: motions.try_into().ok()?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn landing(along: f64, aloft_s: f64) -> Landing {
        let mut landing = Landing { begin: Some([1.0, 6.0, 2.0]), ..Landing::default() };
        landing.steps[1] = 3;
        landing.steps[7] = 1;
        landing.land([1.0, 0.0, 2.0 + along], aloft_s);
        // A wind towards +z.
        landing.turn(0.0, 1.0);
        landing
    }

    #[test]
    fn a_summary_has_means_spreads_and_shares() {
        let aloft = Landing { begin: Some([0.0; 3]), ..Landing::default() };
        let summary = Summary::of(&[landing(3.0, 2.0), landing(5.0, 4.0), aloft]);
        assert_eq!((summary.drops, summary.landed), (3, 2), "one is still in the air");
        let half = 0.5f64.sqrt();
        let expected =
            [(3.0, 2.0 * half), (2.25, 1.5 * half), (4.0, 2.0 * half), (4.0, 2.0 * half), (0.0, 0.0)];
        for (found, expected) in summary.quantities.iter().zip(expected) {
            assert!(
                (found.mean - expected.0).abs() < 1e-12 && (found.deviation - expected.1).abs() < 1e-12,
                "{summary:?}"
            );
        }
        assert_eq!(summary.quantities[0].median, 3.0, "half way between two");
        assert_eq!((summary.motions[1], summary.motions[7]), (0.75, 0.25), "of time in the air");
    }

    #[test]
    fn rows_are_read_back_to_the_bit() {
        for landings in
            [&[landing(0.1, 0.3), landing(0.7, 1.1), landing(1e-9, 3.3)][..], &[landing(1.0, 1.0)], &[]]
        {
            let fields: Vec<String> = Summary::of(landings).fields().collect();
            assert_eq!(fields.len(), COLUMNS.len(), "as many fields as columns: {fields:?}");
            let read = Summary::from_fields(fields.iter().map(String::as_str)).expect("a row");
            assert_eq!(read.fields().collect::<Vec<_>>(), fields, "the same again");
        }
        assert!(Summary::from_fields(["1", "2", "3"]).is_none(), "too few");
        let many: Vec<String> = Summary::of(&[]).fields().chain(["0".to_owned()]).collect();
        assert!(Summary::from_fields(many.iter().map(String::as_str)).is_none(), "too many");
    }
}
