// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Variations of a study: a place in the scene, and the values put there, as in `wind.gusts.strength=0..1/5`.

use std::str::FromStr;

use serde_json::{Number, Value};
use thiserror::Error;

/// Most values of one variation, and most points of a study.
pub(crate) const MAX_POINTS: usize = 10_000;
/// Up to here every whole number is one in double precision.
const WHOLE: f64 = 9.0e15;

/// A value that a study puts into a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// As it is written.
    pub text: String,
    /// As it goes into the scene.
    pub value: Value,
}

/// A place in the scene and the values that it takes one after another.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Variation {
    /// Fields and numbers of list entries with dots between them.
    pub path: String,
    /// At least one, no two the same.
    pub settings: Vec<Setting>,
}

/// Text that says no variation.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{reason}; allowed: PATH=FROM..TO/NUMBER such as wind.gusts.strength=0..1/5, or PATH=A,B,C")]
pub(crate) struct VariationError {
    reason: String,
}

impl Variation {
    /// The values as numbers, if all of them are.
    pub(crate) fn numbers(&self) -> Option<Vec<f64>> {
        self.settings.iter().map(|setting| setting.value.as_f64()).collect()
    }
}

impl FromStr for Variation {
    type Err = VariationError;

    fn from_str(text: &str) -> Result<Self, VariationError> {
        let fail = |reason: String| Err(VariationError { reason });
        let Some((path, values)) = text.split_once('=') else { return fail("no '='".into()) };
        let path = path.trim();
        if path.is_empty() {
            return fail("no path before the '='".into());
        }
        let settings: Vec<_> = match values.split_once("..") {
            Some((from, rest)) => range(from, rest)?.into_iter().map(|value| setting(&value)).collect(),
            None => values.split(',').map(|value| setting(value.trim())).collect(),
        };
        if settings.iter().any(|setting| setting.text.is_empty()) {
            return fail("an empty value".into());
        }
        if settings.len() > MAX_POINTS {
            return fail(format!("{} values are more than {MAX_POINTS}", settings.len()));
        }
        for (index, setting) in settings.iter().enumerate() {
            if settings[..index].iter().any(|earlier| earlier.value == setting.value) {
                return fail(format!("{} stands there twice", setting.text));
            }
        }
        // Errors and reports write places in lists with brackets.
        let path = path.replace('[', ".").replace(']', "");
        Ok(Self { path, settings })
    }
}

/// Evenly spaced values from one to another, both included, as text.
fn range(from: &str, rest: &str) -> Result<Vec<String>, VariationError> {
    let fail = |reason: String| VariationError { reason };
    let number = |text: &str| {
        let number = text.trim().parse().ok().filter(|number: &f64| number.is_finite());
        number.ok_or_else(|| fail(format!("'{}' is not a number", text.trim())))
    };
    let (to, count) =
        rest.split_once('/').ok_or_else(|| fail("a range without the number of values".into()))?;
    let (from, to) = (number(from)?, number(to)?);
    if from > to {
        return Err(fail(format!("{from} is more than {to}")));
    }
    if from == to {
        return Err(fail(format!("nothing lies between {from} and {to}")));
    }
    let count: u32 = count.trim().parse().unwrap_or(0);
    if !(2..=MAX_POINTS).contains(&(count as usize)) {
        return Err(fail(format!("a range has 2 to {MAX_POINTS} values")));
    }
    let between = |index: u32| from + (to - from) * f64::from(index) / f64::from(count - 1);
    Ok((0..count).map(|index| plain(between(index))).collect())
}

/// A number as short as it differs from all others in single precision, which scenes hold.
fn plain(number: f64) -> String {
    if number.fract() == 0.0 && number.abs() < WHOLE {
        return format!("{number:.0}");
    }
    #[expect(clippy::cast_possible_truncation, reason = "scenes hold single precision")]
    let single = number as f32;
    format!("{single}")
}

/// A value from its text: a number if it is one, else a name.
fn setting(text: &str) -> Setting {
    let whole = || text.parse::<u64>().map(Number::from).or_else(|_| text.parse::<i64>().map(Number::from));
    let value = match (whole(), text.parse::<f64>().ok().and_then(as_number)) {
        (Ok(whole), _) => Value::Number(whole),
        (Err(_), Some(number)) => Value::Number(number),
        (Err(_), None) => Value::String(text.into()),
    };
    Setting { text: text.into(), value }
}

/// Whole numbers fit fields of either kind.
fn as_number(number: f64) -> Option<Number> {
    if number.fract() == 0.0 && number.abs() < WHOLE {
        #[expect(clippy::cast_possible_truncation, reason = "whole and small enough")]
        let whole = number as i64;
        return Some(Number::from(whole));
    }
    Number::from_f64(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(text: &str) -> Vec<String> {
        let variation: Variation = text.parse().expect("a variation");
        variation.settings.into_iter().map(|setting| setting.text).collect()
    }

    #[test]
    fn ranges_include_both_ends_and_lists_are_taken_as_they_are() {
        assert_eq!(values("a=0..20/5"), ["0", "5", "10", "15", "20"], "whole steps");
        assert_eq!(values("a=0..1/4"), ["0", "0.33333334", "0.6666667", "1"], "as scenes hold them");
        assert_eq!(values("a=-1..1/3"), ["-1", "0", "1"], "below zero");
        assert_eq!(values("a=1,2.5, 1e3"), ["1", "2.5", "1e3"], "a list");
        assert_eq!(values("a=Uniform"), ["Uniform"], "a name");
    }

    #[test]
    fn values_become_what_fields_take() {
        let variation: Variation = "sources[0].count=1e3,18446744073709551615,0.5,x".parse().expect("one");
        assert_eq!(variation.path, "sources.0.count", "brackets are dots");
        let values: Vec<_> = variation.settings.iter().map(|setting| setting.value.clone()).collect();
        let expected = serde_json::json!([1000, u64::MAX, 0.5, "x"]);
        assert_eq!(Value::Array(values), expected, "whole numbers stay whole");
        assert_eq!(variation.numbers(), None, "not all are numbers");
    }

    #[test]
    fn what_says_no_variation_is_refused() {
        for (text, essential) in [
            ("wind.speed", "no '='"),
            ("=1", "no path"),
            ("a=", "empty value"),
            ("a=1,,2", "empty value"),
            ("a=1,1.0", "twice"),
            ("a=0..1", "number of values"),
            ("a=0..x/3", "'x' is not a number"),
            ("a=0..inf/3", "'inf' is not a number"),
            ("a=2..1/3", "2 is more than 1"),
            ("a=1..1/3", "nothing lies between"),
            ("a=0..1/0", "2 to 10000"),
            ("a=0..1/1", "2 to 10000"),
            ("a=0..1/9000000", "2 to 10000"),
            ("a=0..1/-3", "2 to 10000"),
        ] {
            let error = text.parse::<Variation>().expect_err(text).to_string();
            assert!(error.contains(essential) && error.contains("allowed: PATH="), "{text}: {error}");
        }
    }
}
