// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Values of USD's text format.

use std::fmt::Write as _;

/// Adds an array of vectors, each in parentheses.
pub(super) fn vectors<const N: usize>(out: &mut String, values: impl IntoIterator<Item = [f32; N]>) {
    list(out, values, tuple);
}

/// The same to so many decimal places, for what nobody sees more of.
pub(super) fn rounded<const N: usize>(
    out: &mut String,
    values: impl IntoIterator<Item = [f32; N]>,
    places: i32,
) {
    vectors(out, values.into_iter().map(|value| value.map(|part| round(part, places))));
}

/// Adds an array of numbers to so many decimal places.
pub(super) fn rounded_numbers(out: &mut String, values: impl IntoIterator<Item = f32>, places: i32) {
    numbers(out, values.into_iter().map(|value| round(value, places)));
}

#[expect(clippy::cast_possible_truncation, reason = "as precise as it was")]
fn round(value: f32, places: i32) -> f32 {
    let scale = 10.0_f64.powi(places);
    ((f64::from(value) * scale).round() / scale) as f32
}

/// Adds an array of pairs in double precision.
pub(super) fn pairs(out: &mut String, values: impl IntoIterator<Item = [f64; 2]>) {
    list(out, values, |out, [a, b]| {
        let _ = write!(out, "({a}, {b})");
    });
}

/// Adds an array of quaternions given as x, y, z, w; the format has w first.
pub(super) fn quaternions(out: &mut String, values: impl IntoIterator<Item = [f32; 4]>) {
    list(out, values, |out, [x, y, z, w]| tuple(out, [w, x, y, z]));
}

/// The same in half precision, as its readers round them: four digits are more than a half holds.
pub(super) fn half_quaternions(out: &mut String, values: impl IntoIterator<Item = [f32; 4]>) {
    list(out, values, |out, [x, y, z, w]| {
        let _ = write!(out, "({w:.4}, {x:.4}, {y:.4}, {z:.4})");
    });
}

/// Adds an array of numbers.
pub(super) fn numbers<T: std::fmt::Display>(out: &mut String, values: impl IntoIterator<Item = T>) {
    list(out, values, |out, value| {
        let _ = write!(out, "{value}");
    });
}

/// Adds an array of texts, which hold neither quotes nor line breaks.
pub(super) fn texts(out: &mut String, values: impl IntoIterator<Item = String>) {
    list(out, values, |out, value| {
        let _ = write!(out, "\"{value}\"");
    });
}

/// Adds an array of matrices that turn rows of vectors: four rows each.
pub(super) fn matrices(out: &mut String, values: impl IntoIterator<Item = glam::Mat4>) {
    list(out, values, matrix);
}

/// Adds a matrix. Its columns are the rows of the format, in which vectors stand on the left.
pub(super) fn matrix(out: &mut String, value: glam::Mat4) {
    let rows = value.to_cols_array_2d();
    out.push('(');
    for (number, row) in rows.into_iter().enumerate() {
        if number > 0 {
            out.push_str(", ");
        }
        tuple(out, row);
    }
    out.push(')');
}

fn tuple<const N: usize>(out: &mut String, value: [f32; N]) {
    for (number, part) in value.into_iter().enumerate() {
        // Writing to a String cannot fail.
        let _ = write!(out, "{}{part}", if number == 0 { "(" } else { ", " });
    }
    out.push(')');
}

fn list<T>(out: &mut String, values: impl IntoIterator<Item = T>, mut write: impl FnMut(&mut String, T)) {
    out.push('[');
    for (number, value) in values.into_iter().enumerate() {
        if number > 0 {
            out.push_str(", ");
        }
        write(out, value);
    }
    out.push(']');
}

/// A text in quotes, whatever it holds.
pub(super) fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_written_as_the_format_has_them() {
        let mut out = String::new();
        vectors(&mut out, [[1.0, -0.5, 1e-3], [0.1, 0.0, 3.0]]);
        assert_eq!(out, "[(1, -0.5, 0.001), (0.1, 0, 3)]", "shortest text that reads back equal");
        out.clear();
        quaternions(&mut out, [[0.1, 0.2, 0.3, 0.9]]);
        assert_eq!(out, "[(0.9, 0.1, 0.2, 0.3)]", "w first");
        out.clear();
        numbers(&mut out, Vec::<u32>::new());
        assert_eq!(out, "[]", "nothing");
        out.clear();
        matrix(&mut out, glam::Mat4::from_translation(glam::Vec3::new(7.0, 8.0, 9.0)));
        assert!(out.ends_with("(7, 8, 9, 1))"), "translation in the last row: {out}");
        out.clear();
        rounded(&mut out, [[0.123_456, -7.000_04]], 3);
        assert_eq!(out, "[(0.123, -7)]", "to three places");
        out.clear();
        rounded_numbers(&mut out, [0.123_456, 2.0], 2);
        assert_eq!(out, "[0.12, 2]", "to two places");
        assert_eq!(quoted("a\"b\\c\nd"), r#""a\"b\\c d""#, "escaped");
    }
}
