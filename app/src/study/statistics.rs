// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Statistics of a quantity over drops.

/// Shares of the drops below the lower and the upper end of the middle eight in ten.
pub(crate) const MIDDLE: [f64; 2] = [0.1, 0.9];

/// Distribution of a quantity. A number that there is none of (there are no values, one value has no deviation) is NaN.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Distribution {
    /// Mean.
    pub(crate) mean: f64,
    /// Sample standard deviation.
    pub(crate) deviation: f64,
    /// Value that one in ten stays below.
    pub(crate) p10: f64,
    /// Value that half of them stay below.
    pub(crate) median: f64,
    /// Value that nine in ten stay below.
    pub(crate) p90: f64,
}

impl Distribution {
    /// Numbers of a distribution.
    pub(crate) const NUMBERS: usize = 5;

    /// Distribution of these values.
    pub(crate) fn of(mut values: Vec<f64>) -> Self {
        values.sort_by(f64::total_cmp);
        let (mean, deviation) = mean_and_deviation(&values);
        let [p10, median, p90] =
            [MIDDLE[0], 0.5, MIDDLE[1]].map(|share| quantile(&values, share).unwrap_or(f64::NAN));
        Self { mean, deviation, p10, median, p90 }
    }

    /// Its numbers, in the order of its fields.
    pub(crate) fn to_array(self) -> [f64; Self::NUMBERS] {
        [self.mean, self.deviation, self.p10, self.median, self.p90]
    }

    /// The distribution with these numbers.
    pub(crate) fn from_array([mean, deviation, p10, median, p90]: [f64; Self::NUMBERS]) -> Self {
        Self { mean, deviation, p10, median, p90 }
    }
}

/// Mean and sample standard deviation.
pub(crate) fn mean_and_deviation(values: &[f64]) -> (f64, f64) {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let squares: f64 = values.iter().map(|value| (value - mean) * (value - mean)).sum();
    let deviation = if values.len() > 1 { (squares / (count - 1.0)).sqrt() } else { f64::NAN };
    (mean, deviation)
}

/// Quantile of values in rising order, linear between neighbours; `None` of no values.
pub(crate) fn quantile(sorted: &[f64], share: f64) -> Option<f64> {
    let place = share * sorted.len().saturating_sub(1) as f64;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an index")]
    let below = place.floor() as usize;
    let (low, high) = (*sorted.get(below)?, *sorted.get(below + 1).or(sorted.last())?);
    Some(low + (high - low) * place.fract())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_lie_where_they_should() {
        let values = (0..=10).rev().map(f64::from).collect();
        let found = Distribution::of(values);
        assert_eq!((found.p10, found.median, found.p90), (1.0, 5.0, 9.0), "of eleven even steps");
        assert!((found.deviation - 11f64.sqrt()).abs() < 1e-12, "{found:?}");
        let two = Distribution::of(vec![4.0, 2.0]);
        assert_eq!((two.p10, two.median, two.p90), (2.2, 3.0, 3.8), "linear between neighbours");
        let one = Distribution::of(vec![7.0]);
        assert_eq!((one.mean, one.p10, one.p90), (7.0, 7.0, 7.0), "one value is all of them");
        assert!(one.deviation.is_nan(), "and has no spread");
        assert!(Distribution::of(Vec::new()).to_array().iter().all(|number| number.is_nan()), "no values");
    }
}
