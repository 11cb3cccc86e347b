// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Parsers of the values of options; their errors name the allowed range.

use std::path::PathBuf;

use windfall_core::SceneError;

/// Largest edge of a picture in pixels.
const MAX_EDGE: u32 = 16_384;
/// Most pixels of a picture: 8K UHD.
const MAX_PIXELS: u32 = 7680 * 4320;

/// Reads a whole number from `LOW` to `HIGH`, also in the form 1e6.
///
/// # Errors
/// Names the allowed range.
pub(crate) fn whole<T: TryFrom<u64>, const LOW: u64, const HIGH: u64>(text: &str) -> Result<T, String> {
    let number = text.parse().ok().or_else(|| scientific(text));
    number
        .filter(|number| (LOW..=HIGH).contains(number))
        .and_then(|number| T::try_from(number).ok())
        .ok_or_else(|| format!("allowed: a whole number from {LOW} to {HIGH}"))
}

/// Digits, an `e` and the number of zeros to follow.
fn scientific(text: &str) -> Option<u64> {
    let (digits, zeros) = text.split_once(['e', 'E'])?;
    let plain = |part: &str| !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit());
    if !plain(digits) || !plain(zeros) {
        return None;
    }
    digits.parse::<u64>().ok()?.checked_mul(10u64.checked_pow(zeros.parse().ok()?)?)
}

/// Reads a number from `low` to `high`.
pub(crate) fn within(text: &str, low: f64, high: f64) -> Result<f64, String> {
    let number = text.parse().ok().filter(|number| (low..=high).contains(number));
    number.ok_or_else(|| format!("allowed: a number from {low} to {high}"))
}

/// Reads a size such as 1280x720.
pub(crate) fn picture_size(text: &str) -> Result<(u32, u32), String> {
    let edge = |text: &str| text.parse().ok().filter(|edge| (1..=MAX_EDGE).contains(edge));
    let size = text.split_once(['x', 'X']).and_then(|(width, height)| Some((edge(width)?, edge(height)?)));
    size.filter(|(width, height)| width * height <= MAX_PIXELS).ok_or_else(|| {
        format!("allowed: width x height such as 1280x720, each 1 to {MAX_EDGE}, at most {MAX_PIXELS} pixels")
    })
}

/// Reads a number of frames per second.
pub(crate) fn frame_rate(text: &str) -> Result<f64, String> {
    within(text, 1.0, 1000.0)
}

/// Reads the length of a round in seconds.
pub(crate) fn loop_length(text: &str) -> Result<f64, String> {
    within(text, 1.0, 120.0)
}

/// Reads the name of a picture.
pub(crate) fn png_file(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    match path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png")) {
        true => Ok(path),
        false => Err("allowed: a file name that ends in .png".into()),
    }
}

/// Names the option in an error of the field that the option sets.
pub(crate) fn option_error(error: SceneError, set: &str, option: &str) -> SceneError {
    match error {
        SceneError::Field { file, field, value, allowed } if field == set => {
            SceneError::Field { file, field: option.into(), value, allowed }
        }
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_numbers_are_read_in_both_forms_and_checked() {
        assert_eq!(whole::<u32, 1, 2_000_000>("1e6"), Ok(1_000_000), "scientific");
        assert_eq!(whole::<u32, 0, 7>("7"), Ok(7), "plain");
        let rejected = ["", "8", "-1", "1.5", "e", "1e", "e3", "1e99", "1e+1", "99999999999999999999", "x"];
        for text in rejected {
            assert_eq!(
                whole::<u32, 0, 7>(text),
                Err("allowed: a whole number from 0 to 7".into()),
                "{text:?} is not one"
            );
        }
    }

    #[test]
    fn sizes_are_read_and_checked() {
        assert_eq!(picture_size("1280x720"), Ok((1280, 720)), "the usual");
        assert_eq!(picture_size("1X16384"), Ok((1, 16_384)), "a column");
        let rejected =
            ["", "x", "1280", "0x720", "1280x0", "-1x5", "1280x", "16385x1", "16384x16384", "9e9x9"];
        for text in rejected {
            let error = picture_size(text).expect_err("no size");
            assert!(error.contains("1280x720") && error.contains("16384"), "{text}: {error}");
        }
    }

    #[test]
    fn rates_are_read_and_checked() {
        assert_eq!(frame_rate("29.97"), Ok(29.97), "a rate");
        for text in ["0", "-1", "nan", "inf", "1001", "x", ""] {
            assert!(frame_rate(text).is_err(), "{text} is no rate");
        }
    }
}
