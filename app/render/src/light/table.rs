// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Steps between the double precision of paths through the air and the single precision of light.

/// The cell of a table of `count` rows in which a place lies, and how far in it; places beyond its ends lie on them.
pub(super) fn cell(at: f64, count: usize) -> (usize, f64) {
    let at = at.clamp(0.0, (count - 1) as f64);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the table")]
    let row = (at as usize).min(count - 2);
    (row, at - row as f64)
}

/// A number rounded to single precision.
pub(super) fn single(value: f64) -> f32 {
    #[expect(clippy::cast_possible_truncation, reason = "all of these are small numbers")]
    let rounded = value as f32;
    rounded
}
